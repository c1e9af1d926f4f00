// SIMD and threads: the hot passes run in kernels chosen for this machine, the others node by node. All are
// divided into parts by their size alone. A node's result does not depend on its part, so neither the number
// of threads nor the width of a pack changes a bit.
#include <algorithm>
#include <chrono>
#include <utility>

#include "backend/cpu/cpu_body.hpp"
#include "backend/cpu/jobs.hpp"
#include "backend/cpu/kernels.hpp"
#include "backend/cpu/measured_springs.hpp"
#include "backend/cpu/mesh_tables.hpp"
#include "backend/cpu/pointers.hpp"
#include "backend/cpu/sheet_steps.hpp"
#include "backend/cpu/spring_list.hpp"
#include "backend/cpu/state_records.hpp"
#include "backend/cpu/team.hpp"
#include "backend/host/kept_state.hpp"
#include "backend/host/plain_cloth.hpp"
#include "backend/host/solver_state.hpp"
#include "backend/pass_runner.hpp"

namespace pliant {
namespace {

using cpu::Kernels;
using cpu::pointers;

struct CpuCloth {
    CpuCloth(const ClothModel& model, std::size_t most_parts)
        : plain(model),
          records(plain),
          springs(plain),
          measured(plain),
          solver(model, model.hierarchy),
          mesh(model.hierarchy, solver),
          body(plain),
          sheet(plain.layout, model.plan.on_grid ? most_parts : 0)
    {
    }
    PlainCloth<float> plain;
    cpu::StateRecords records;
    cpu::SpringList springs;
    cpu::MeasuredSprings measured;
    SolverState<float> solver;
    KeptState<float> kept;
    cpu::MeshTables mesh;
    cpu::CpuBody body;
    cpu::SheetSteps sheet;
};

/// One call with its data; `part` runs a part of it.
struct Work {
    enum class Unit { rows, springs, list, measures, values, solver, single, body } unit = Unit::values;
    std::size_t size = 0;      ///< in units
    std::size_t multiple = 1;  ///< parts begin at multiples of this
    std::size_t weight = 1;    ///< nodes or springs in a unit, from which the number of threads follows
    const Call* call = nullptr;
    CpuCloth* cloth = nullptr;
    const Kernels* kernels = nullptr;
    const StepConstants<float>* constants = nullptr;
    std::span<const Laws<float>::Collider> colliders;
    const SolverContext<float>* solver = nullptr;

    Work(const Call& c, CpuCloth& target, const Kernels& k, const StepConstants<float>& values,
         const SolverConstants<float>& solver_values, std::span<const Laws<float>::Collider> shapes)
        : call(&c), cloth(&target), kernels(&k), constants(&values), colliders(shapes)
    {
        PlainCloth<float>& plain = cloth->plain;
        const PassFamily family = family_of(call->pass);
        const PassUnit pass_unit = unit_of(call->pass);
        if (is_solver_pass(call->pass)) {
            const bool scalar = is_single_pass(call->pass) || pass_unit == PassUnit::flag ||
                                family == PassFamily::paper ||
                                (family == PassFamily::mesh && !has_lanes(call->pass));
            unit = scalar ? Unit::single : Unit::solver;
            size = cloth->solver.size_of(c);
            weight = cloth->solver.weight_of(c);
            solver = &cloth->solver.context(c, plain, solver_values, shapes);
        } else if (cpu::CpuBody::has_kernel(call->pass)) {
            unit = Unit::body;
            size = cloth->body.size_of(c);
            weight = block_size;
            cloth->body.prepare(c, plain, values);
        } else if (call->pass == Pass::sheet_wind || call->pass == Pass::sheet_normal ||
                   call->pass == Pass::sheet_strain) {
            plain.make_room_for(call->pass);
            unit = Unit::rows;
            size = plain.layout.rows;
            weight = plain.layout.columns;
        } else if (call->pass == Pass::spring_force) {
            unit = Unit::springs;
            size = cloth->springs.spring_count();
            multiple = cpu::SpringList::pack;
        } else if (call->pass == Pass::list_step) {
            unit = Unit::list;
            size = cloth->springs.slice_count();
            weight = cpu::Slices::lanes;
        } else {
            plain.make_room_for(call->pass);
            size = plain.size_of(*call);
            const bool of_mesh = call->pass == Pass::list_measure && !plain.model.plan.on_grid;
            if (call->pass == Pass::sheet_measure || of_mesh) unit = Unit::measures;
            if (pass_unit == PassUnit::block || pass_unit == PassUnit::merged_block) weight = block_size;
        }
    }

    /// Groups of nodes whose records the call needs.
    std::size_t record_groups() const
    {
        return asks_for_records(call->pass) ? cloth->mesh.record_groups(*call) : 0;
    }
    void make_records(std::size_t index, std::size_t count) const
    {
        const std::size_t groups = record_groups();
        kernels->solver_records(*solver, *call, static_cast<int>(groups * index / count),
                                static_cast<int>(groups * (index + 1) / count));
    }

    void part(std::size_t index, std::size_t count) const
    {
        const cpu::DenormalsFlushed flushed;
        const std::size_t steps = size / multiple;
        const std::size_t begin = steps * index / count * multiple;
        const std::size_t end = index + 1 == count ? size : steps * (index + 1) / count * multiple;
        if (unit == Unit::rows)
            rows(begin, end);
        else if (unit == Unit::springs)
            cloth->springs.find_forces(*call, cloth->plain, cloth->records, *kernels, begin, end);
        else if (unit == Unit::list)
            cloth->springs.step(*call, cloth->plain, cloth->records, *kernels, *constants, colliders, begin,
                                end);
        else if (unit == Unit::measures)
            measures(begin, end);
        else if (unit == Unit::solver)
            kernels->solve(*solver, *call, static_cast<int>(begin), static_cast<int>(end));
        else if (unit == Unit::body)
            cloth->body.run(*call, cloth->plain, cloth->records, *kernels, *constants, colliders, begin, end);
        else if (unit == Unit::single)
            cloth->solver.run(*call, *solver, begin, end);
        else
            cloth->plain.run(*call, *constants, colliders, begin, end);
    }

private:
    void rows(std::size_t begin, std::size_t end) const
    {
        PlainCloth<float>& plain = cloth->plain;
        cpu::SheetArguments arguments{};
        arguments.layout = &plain.layout;
        arguments.position = pointers(std::as_const(plain.position[call->parity]));
        arguments.velocity = pointers(std::as_const(plain.velocity[call->parity]));
        arguments.wind_force = pointers(plain.external_force);
        arguments.normal = pointers(plain.normal);
        arguments.strain = plain.strain.data();
        arguments.constants = constants;
        const auto kernel = call->pass == Pass::sheet_wind     ? kernels->sheet_wind
                            : call->pass == Pass::sheet_normal ? kernels->sheet_normal
                                                               : kernels->sheet_strain;
        kernel(arguments, begin, end);
    }

    void measures(std::size_t begin, std::size_t end) const
    {
        PlainCloth<float>& plain = cloth->plain;
        using Measure = Laws<float>::Measure;
        static_assert(sizeof(Measure) == 8 * sizeof(float));
        cpu::MeasureArguments arguments{};
        arguments.layout = &plain.layout;
        arguments.position = pointers(std::as_const(plain.position[call->parity]));
        arguments.velocity = pointers(std::as_const(plain.velocity[call->parity]));
        arguments.inverse_mass = plain.inverse_mass.data();
        arguments.masses = plain.model.masses.kg.data();
        arguments.node_count = plain.model.node_count();
        arguments.constants = constants;
        arguments.colliders = colliders.data();
        arguments.collider_count = colliders.size();
        arguments.measures = &plain.measures.data()->max_stretch;
        if (call->pass == Pass::sheet_measure) return kernels->sheet_measure(arguments, begin, end);
        arguments.state = cloth->records.at(call->parity);
        arguments.springs = cloth->measured.view();
        kernels->mesh_measure(arguments, begin, end);
    }
};

class CpuRunner final : public PassRunner {
public:
    CpuRunner(std::span<const ClothModel> models, const SimulationOptions& options)
        : kernels_(cpu::choose_kernels(options.instruction_set, options.fast_math)),
          jobs_(options.job_system),
          threads_are_asked_for_(options.threads > 0)
    {
        if (!jobs_) {
            own_jobs_ = cpu::make_job_system(options.threads);
            jobs_ = own_jobs_.get();
        }
        cloths_.reserve(models.size());
        for (const ClothModel& model : models) {
            cloths_.emplace_back(model, std::min<std::size_t>(thread_count(), cpu::Team::most_parts));
            constants_.emplace_back(model, 0.0);
            solver_constants_.push_back(make_solver_constants<float>(model, 0.0));
        }
    }

    void run(const Program& program, const FrameInput& input) override
    {
        for (const Kept& kept : program.keeps) {
            CpuCloth& cloth = cloths_[kept.cloth];
            cloth.kept.keep(kept, cloth.plain, cloth.solver);
        }
        for (std::size_t c = 0; c < cloths_.size(); ++c) {
            const ClothModel& model = cloths_[c].plain.model;
            constants_[c] = StepConstants<float>(model, input.step_length);
            if (!input.attached.empty()) constants_[c].attached = input.attached[c];
            if (!input.goals.empty()) constants_[c].goals = input.goals[c];
            const GrabInput grab = input.grab_of(c);
            constants_[c].set(grab);
            solver_constants_[c] = make_solver_constants<float>(model, input.step_length, grab);
        }
        // A host lends its threads for one task at a time; Pliant's own stay together for the frame.
        together_ = own_jobs_ && thread_count() > 1 && is_worth_threads();
        if (together_)
            team_.gather(*jobs_, thread_count(), [&] { run_calls(program, input); });
        else
            run_calls(program, input);
    }
    void put_back(const Kept& kept) override
    {
        CpuCloth& cloth = cloths_[kept.cloth];
        cloth.kept.put_back(kept, cloth.plain, cloth.solver);
        cloth.records.forget();
    }
    void read(std::uint32_t cloth, Resource resource, std::uint32_t parity,
              std::vector<float>& values) override
    {
        cloths_[cloth].plain.read(resource, parity, values);
    }
    void write(std::uint32_t cloth, std::span<const Vec3> positions,
               std::span<const Vec3> velocities) override
    {
        cloths_[cloth].plain.write(positions, velocities);
        cloths_[cloth].records.forget();
    }
    void take_mass(std::uint32_t cloth, std::uint32_t node) override
    {
        cloths_[cloth].plain.take_mass(node);
        cloths_[cloth].solver.take_mass(cloths_[cloth].plain.model, node);
    }
    double volume(std::uint32_t cloth, std::size_t body) override
    {
        return double{cloths_[cloth].plain.body.volumes[body]};
    }
    double solver_scalar(std::uint32_t cloth, std::size_t number) override
    {
        return double{cloths_[cloth].solver.scalars()[number]};
    }
    void solver_numbers(std::uint32_t cloth, std::size_t first, std::size_t count,
                        std::vector<float>& values) override
    {
        const auto of = cloths_[cloth].solver.arena().subspan(first, count);
        values.assign(of.begin(), of.end());
    }
    void write_solver_numbers(std::uint32_t cloth, std::size_t first, std::span<const float> values) override
    {
        cloths_[cloth].solver.put(first, values);
    }
    MeasureTotals measures(std::uint32_t cloth) override { return cloths_[cloth].plain.totals(); }
    const PassClock& clock() const override { return clock_; }
    std::string device_name() const override
    {
        return std::string("CPU, ") + kernels_.name + ", " + std::to_string(thread_count()) +
               (thread_count() == 1 ? " thread" : " threads");
    }
    unsigned thread_count() const override { return std::max(1u, jobs_->thread_count()); }

private:
    void run_calls(const Program& program, const FrameInput& input)
    {
        colliders_known_ = false;
        auto time = std::chrono::steady_clock::now();
        for (std::size_t k = 0; k < program.calls.size(); ++k) {
            const Call& call = program.calls[k];
            CpuCloth& cloth = cloths_[call.cloth];
            if (cloth.solver.skips(call)) {
                k += call.guarded_after;
                continue;
            }
            std::size_t calls = 1;
            if (call.pass == Pass::sheet_step) {
                calls = run_sheet_steps(program, k, input);
                k += calls - 1;
            } else {
                place_colliders(call, cloth.plain.model.shape.origin, input);
                Work work(call, cloth, kernels_, constants_[call.cloth], solver_constants_[call.cloth],
                          colliders_);
                make_records(call, cloth);
                run(work);
            }
            cloth.records.follow(call);
            const auto now = std::chrono::steady_clock::now();
            clock_.add(call.pass, std::chrono::duration<double, std::milli>(now - time).count(), calls);
            time = now;
        }
    }

    void make_records(const Call& call, CpuCloth& cloth)
    {
        if (!cloth.records.are_missing(call)) return;
        const cpu::RecordArguments arguments = cloth.records.missing(call, cloth.plain);
        constexpr std::size_t pack = NodeLayout::pad;
        const std::size_t packs = cloth.plain.layout.size / pack, parts = part_count(packs, pack);
        run_parts(parts, [&](std::size_t index) {
            kernels_.record_states(arguments, packs * index / parts * pack,
                                   packs * (index + 1) / parts * pack);
        });
    }

    void place_colliders(const Call& call, Vec3d origin, const FrameInput& input)
    {
        if (colliders_known_ && call.index == known_index_ && origin == known_origin_) return;
        colliders_.clear();
        for (const PlacedCollider& placed : input.colliders_at(call.index))
            colliders_.push_back(make_collider<float>(seen_from(placed, origin)));
        colliders_known_ = true;
        known_index_ = call.index;
        known_origin_ = origin;
    }

    /// Runs the step at `first` and the steps that follow it directly; returns their number.
    std::size_t run_sheet_steps(const Program& program, std::size_t first, const FrameInput& input)
    {
        const Call& call = program.calls[first];
        CpuCloth& cloth = cloths_[call.cloth];
        const NodeLayout& layout = cloth.plain.layout;
        const std::size_t parts = part_count(layout.rows, layout.columns);
        const std::size_t most = cpu::SheetSteps::most_steps(layout.rows, parts);
        cloth.sheet.begin();
        for (std::size_t k = first; k < program.calls.size() && cloth.sheet.count() < most; ++k) {
            const Call& next = program.calls[k];
            if (next.pass != call.pass || next.cloth != call.cloth || next.guard != call.guard) break;
            place_colliders(next, cloth.plain.model.shape.origin, input);
            cloth.sheet.add(cloth.plain, next.parity, constants_[call.cloth], colliders_);
        }
        for (unsigned phase = 0; phase < 2; ++phase) {
            if (phase == 1 && cloth.sheet.count() == 1) break;
            run_parts(parts - phase, [&](std::size_t index) {
                const cpu::DenormalsFlushed flushed;
                cloth.sheet.part(kernels_, phase, index, parts);
            });
        }
        return cloth.sheet.count();
    }

    std::size_t part_count(std::size_t size, std::size_t weight) const
    {
        const std::size_t worthwhile = std::max<std::size_t>(1, size * weight / least_work());
        return std::min<std::size_t>(
            {thread_count(), worthwhile, std::max<std::size_t>(1, size), cpu::Team::most_parts});
    }

    void run(const Work& work)
    {
        if (const std::size_t groups = work.record_groups(); groups > 0) {
            const std::size_t parts = part_count(groups, sum_columns);
            run_parts(parts, [&](std::size_t index) { work.make_records(index, parts); });
        }
        const std::size_t count = part_count(work.size / work.multiple, work.multiple * work.weight);
        run_parts(count, [&](std::size_t index) { work.part(index, count); });
    }

    /// Runs part(0) ... part(count - 1) on the available threads.
    template <class Part>
    void run_parts(std::size_t count, const Part& part)
    {
        if (count == 0) return;  // no gaps with a single part
        if (count == 1) return part(0);
        const auto task = [](void* pointer, unsigned index) { (*static_cast<const Part*>(pointer))(index); };
        void* context = const_cast<Part*>(&part);
        if (together_)
            team_.run(static_cast<unsigned>(count), task, context);
        else
            jobs_->run(static_cast<unsigned>(count), task, context);
    }

    /// Whether any cloth has enough work for two threads.
    bool is_worth_threads() const
    {
        const std::size_t least = threads_are_asked_for_ ? 1 : 2048;
        const auto work = [](const CpuCloth& cloth) {
            return std::max<std::size_t>(cloth.plain.model.node_count(),
                                         cloth.plain.model.springs.list.size());
        };
        return std::any_of(cloths_.begin(), cloths_.end(),
                           [&](const CpuCloth& cloth) { return work(cloth) >= least; });
    }
    /// Nodes or springs that justify one more thread; almost none if the caller has asked for a number of
    /// threads.
    std::size_t least_work() const { return threads_are_asked_for_ ? 64 : together_ ? 512 : 1024; }

    const Kernels& kernels_;
    JobSystem* jobs_;
    bool threads_are_asked_for_;
    bool together_ = false;  ///< in this frame
    cpu::Team team_;
    std::unique_ptr<JobSystem> own_jobs_;
    std::vector<CpuCloth> cloths_;
    std::vector<StepConstants<float>> constants_;
    std::vector<SolverConstants<float>> solver_constants_;
    std::vector<Laws<float>::Collider> colliders_;  ///< of one step, in a cloth's coordinates
    bool colliders_known_ = false;
    std::uint32_t known_index_ = 0;  ///< the step of colliders_
    Vec3d known_origin_;             ///< the cloth's origin
    PassClock clock_;
};

}  // namespace

std::unique_ptr<PassRunner> make_cpu_runner(std::span<const ClothModel> cloths,
                                            const SimulationOptions& options)
{
    return std::make_unique<CpuRunner>(cloths, options);
}

}  // namespace pliant

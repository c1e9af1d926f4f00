// The oracle: serial, double, plain loops.
#include <chrono>

#include "backend/host/kept_state.hpp"
#include "backend/host/plain_cloth.hpp"
#include "backend/host/solver_state.hpp"
#include "backend/pass_runner.hpp"

namespace pliant {
namespace {

class ReferenceRunner final : public PassRunner {
public:
    explicit ReferenceRunner(std::span<const ClothModel> models)
        : cloths_(models.begin(), models.end()), kept_(models.size())
    {
        for (const ClothModel& model : models) solvers_.emplace_back(model, model.hierarchy);
    }

    void run(const Program& program, const FrameInput& input) override
    {
        for (const Kept& kept : program.keeps)
            kept_[kept.cloth].keep(kept, cloths_[kept.cloth], solvers_[kept.cloth]);
        std::vector<StepConstants<double>> constants;
        std::vector<SolverConstants<double>> solver_constants;
        for (const auto& cloth : cloths_) {
            constants.emplace_back(cloth.model, input.step_length);
            if (!input.attached.empty()) constants.back().attached = input.attached[constants.size() - 1];
            if (!input.goals.empty()) constants.back().goals = input.goals[constants.size() - 1];
            const GrabInput grab = input.grab_of(constants.size() - 1);
            constants.back().set(grab);
            solver_constants.push_back(make_solver_constants<double>(cloth.model, input.step_length, grab));
        }
        std::vector<Laws<double>::Collider> colliders;
        std::uint32_t known_index = ~0u;
        Vec3d known_origin;
        for (const Call& call : program.calls) {
            auto& cloth = cloths_[call.cloth];
            if (call.index != known_index || cloth.model.shape.origin != known_origin) {
                colliders.clear();
                for (const PlacedCollider& placed : input.colliders_at(call.index))
                    colliders.push_back(make_collider<double>(seen_from(placed, cloth.model.shape.origin)));
                known_index = call.index;
                known_origin = cloth.model.shape.origin;
            }
            const auto start = std::chrono::steady_clock::now();
            if (is_solver_pass(call.pass)) {
                SolverState<double>& solver = solvers_[call.cloth];
                if (solver.skips(call)) continue;
                solver.run(call, solver.context(call, cloth, solver_constants[call.cloth], colliders), 0,
                           solver.size_of(call));
            } else {
                cloth.make_room_for(call.pass);
                cloth.run(call, constants[call.cloth], colliders, 0, cloth.size_of(call));
            }
            const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
            clock_.add(call.pass, spent.count());
        }
    }
    void put_back(const Kept& kept) override
    {
        kept_[kept.cloth].put_back(kept, cloths_[kept.cloth], solvers_[kept.cloth]);
    }
    void read(std::uint32_t cloth, Resource resource, std::uint32_t parity,
              std::vector<float>& values) override
    {
        cloths_[cloth].read(resource, parity, values);
    }
    void write(std::uint32_t cloth, std::span<const Vec3> positions,
               std::span<const Vec3> velocities) override
    {
        cloths_[cloth].write(positions, velocities);
    }
    void take_mass(std::uint32_t cloth, std::uint32_t node) override
    {
        cloths_[cloth].take_mass(node);
        solvers_[cloth].take_mass(cloths_[cloth].model, node);
    }
    double volume(std::uint32_t cloth, std::size_t body) override
    {
        return cloths_[cloth].body.volumes[body];
    }
    double solver_scalar(std::uint32_t cloth, std::size_t number) override
    {
        return solvers_[cloth].scalars()[number];
    }
    void solver_numbers(std::uint32_t cloth, std::size_t first, std::size_t count,
                        std::vector<float>& values) override
    {
        values.clear();
        for (const double number : solvers_[cloth].arena().subspan(first, count))
            values.push_back(static_cast<float>(number));
    }
    void write_solver_numbers(std::uint32_t cloth, std::size_t first, std::span<const float> values) override
    {
        solvers_[cloth].put(first, values);
    }
    MeasureTotals measures(std::uint32_t cloth) override { return cloths_[cloth].totals(); }
    const PassClock& clock() const override { return clock_; }
    std::string device_name() const override { return "CPU, one thread, double"; }
    unsigned thread_count() const override { return 1; }

private:
    std::vector<PlainCloth<double>> cloths_;
    std::vector<SolverState<double>> solvers_;
    std::vector<KeptState<double>> kept_;
    PassClock clock_;
};

}  // namespace

std::unique_ptr<PassRunner> make_reference_runner(std::span<const ClothModel> cloths)
{
    return std::make_unique<ReferenceRunner>(cloths);
}

}  // namespace pliant

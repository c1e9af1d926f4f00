#include "pliant/simulation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

#include "backend/cpu/kernels.hpp"
#include "backend/pass_runner.hpp"
#include "backend/vulkan/vulkan_runner.hpp"
#include "body/cloth_model.hpp"
#include "kernels/planes.hpp"
#include "simulation/hand.hpp"
#include "simulation/held_springs.hpp"
#include "solve/frame.hpp"
#include "solve/mass_spring.hpp"
#include "solve/newton_multigrid.hpp"

namespace pliant {
namespace {

bool hardware_gpu_exists()
{
    for (const auto& device : vulkan::list_physical_devices())
        if (device.hardware) return true;
    return false;
}

Backend resolve(const SimulationOptions& options)
{
    if (options.backend != Backend::automatic) return options.backend;
    return options.device >= 0 || hardware_gpu_exists() ? Backend::vulkan : Backend::cpu;
}

bool all_rest(const std::vector<Collider>& colliders)
{
    for (const Collider& collider : colliders)
        if (placed_at(collider, 0).moves) return false;
    return true;
}

/// FNV-1a, 64 bit, over the bytes of floats.
class StateHash {
public:
    void add(std::span<const Vec3> values)
    {
        for (const Vec3& v : values)
            for (const float number : {v.x, v.y, v.z}) {
                std::uint32_t bits = 0;
                std::memcpy(&bits, &number, sizeof bits);
                for (int byte = 0; byte < 4; ++byte)
                    hash_ = (hash_ ^ (bits >> (8 * byte) & 0xff)) * 0x100000001b3ull;
            }
    }
    std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_ = 0xcbf29ce484222325ull;
};

std::string seconds(double s)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.3g s", s);
    return text;
}

}  // namespace

class Simulation::Implementation {
public:
    Implementation(const Scene& given, const SimulationOptions& options)
        : scene(given), backend(resolve(options))
    {
        validate(scene);
        cpu::choose_kernels(options.instruction_set);  // a name that does not exist is wrong on every backend
        make_models();
        stable_step = std::numeric_limits<double>::infinity();
        for (const ClothModel& model : models) stable_step = std::min(stable_step, model.stable_step());
        refuse_too_many_steps();
        colliders_rest = all_rest(scene.colliders);
        place_colliders(1, 0);
        read_backs.resize(scene.cloth_count());
        read_models.resize(models.size());
        report.failure.reserve(256);
        try {
            start_runner(options);
        } catch (const Error&) {
            if (backend != Backend::vulkan || options.backend == Backend::vulkan || options.device >= 0)
                throw;
            backend = Backend::cpu;  // automatic: whatever the GPU's trouble is, the CPU does not share it
            device_state = nullptr;
            start_runner(options);
        }
        take_measures();
        for (ClothModel& model : models) model.forget_start();
    }

    /// A model of each cloth, and of soft bodies that can be stepped as one.
    void make_models()
    {
        models.reserve(scene.cloth_count());
        for (std::size_t c = 0; c < scene.cloth_count(); ++c) {
            ClothModel model(scene.cloth(c), scene);
            ClothPlace place{static_cast<std::uint32_t>(models.size()), 0, model.node_count(), 0, 0.0f,
                             std::exchange(model.node_of_vertex, {})};
            if (model.is_body()) report.bodies.push_back({c});
            const auto host = std::find_if(models.begin(), models.end(),
                                           [&](const ClothModel& other) { return other.can_take(model); });
            if (host == models.end()) {
                models.push_back(std::move(model));
            } else {
                place.model = static_cast<std::uint32_t>(host - models.begin());
                place.first_node = host->node_count();
                place.part = static_cast<std::uint32_t>(host->body->parts.size());
                host->take(model);
            }
            places.push_back(std::move(place));
        }
        for (ClothPlace& place : places)
            for (const Vec3& x :
                 std::span(models[place.model].positions).subspan(place.first_node, place.node_count))
                place.farthest = std::max({place.farthest, std::abs(x.x), std::abs(x.y), std::abs(x.z)});
    }

    /// Makes the runner and lets it measure the start.
    void start_runner(const SimulationOptions& options)
    {
        if (backend == Backend::vulkan) {
            auto vulkan = make_vulkan_runner(models, options);
            device_state = vulkan.get();
            runner = std::move(vulkan);
        } else {
            runner =
                backend == Backend::cpu ? make_cpu_runner(models, options) : make_reference_runner(models);
        }
        try {
            measure();
        } catch (const std::runtime_error& error) {
            throw Error(ErrorKind::device_failure,
                        "the device " + runner->device_name() + " failed at once: " + error.what());
        }
    }

    void measure()
    {
        Program program{next_program_id++, {}, parity};
        append_measures(models, parity, 0, program.calls);
        runner->run(program, input(0));
    }

    /// Steps of a stretch of time, and how long each is.
    std::pair<std::uint64_t, double> steps_of(double duration) const
    {
        if (scene.time.substeps > 0) {
            const double step = 1 / (scene.time.frame_rate * scene.time.substeps);
            return {static_cast<std::uint64_t>(std::max(1ll, std::llround(duration / step))), step};
        }
        if (stepped_method(scene) ==
            Method::constraint) {  // implicit: a step is as long as a frame unless asked for
            const double frames = std::max(1.0, std::round(duration * scene.time.frame_rate));
            return {static_cast<std::uint64_t>(frames), duration / frames};
        }
        constexpr double rounding = 1e-9;
        const double count = std::max(1.0, std::ceil(duration / stable_step * (1 - rounding)));
        return {static_cast<std::uint64_t>(count), duration / count};
    }

    void refuse_too_many_steps() const
    {
        constexpr double most = 100'000;  // as many as a scene may ask for by itself
        const double frame = 1 / scene.time.frame_rate;
        if (stepped_method(scene) != Method::constraint && scene.time.substeps == 0 &&
            frame / stable_step > most)
            throw Error(ErrorKind::bad_input,
                        "time.substeps is 0 (automatic), and a stable step of " + seconds(stable_step) +
                            " would take more than 100000 substeps per frame; use softer springs, "
                            "less damping or heavier nodes");
    }

    void advance(double duration)
    {
        const auto start = std::chrono::steady_clock::now();
        const auto [steps, step] = steps_of(duration);
        // A long stretch runs in pieces, so that programs stay short and few.
        const std::uint64_t node_count = total(&ClothModel::node_count);
        const std::uint64_t most =
            std::clamp<std::uint64_t>(most_work_at_once / node_count, 1, most_steps_at_once);
        for (std::uint64_t left = steps; left > 0;) {
            const auto piece = static_cast<std::uint32_t>(std::min<std::uint64_t>(left, most));
            run_steps(piece, step);
            left -= piece;
        }
        ++state_number;
        ++report.frames;
        take_measures();
        report.validation_messages = runner->validation_messages();
        report.wall_seconds +=
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    void run_steps(std::uint32_t steps, double step)
    {
        const Program& program = frame_program(steps);
        hold(step);
        place_colliders(steps, step);
        place_attached(steps, step);
        place_goals(steps, step);
        runner->run(program, input(step));
        parity = program.parity_after;
        report.simulated_seconds = on_frame(report.simulated_seconds + steps * step, steps * step);
        report.steps += steps;
        if (uses_solver(stepped_method(scene))) count_solves();
    }

    /// Adds the solver's counters of the program that has just run.
    void count_solves()
    {
        SolverReport& s = report.solver;
        s.active_last = 0;
        s.newton_last = s.iterations_last = 0;
        s.residual_last = 0;
        for (std::uint32_t c = 0; c < models.size(); ++c) {
            const auto number = [&](int scalar) {
                return runner->solver_scalar(c, static_cast<std::size_t>(scalar));
            };
            const auto whole = [&](int scalar) { return static_cast<std::uint32_t>(number(scalar)); };
            s.solves += whole(scalar_solves);
            newton_sum += number(scalar_newton_sum);
            iterations_sum += number(scalar_iterations_sum);
            active_sum += number(scalar_active_sum);
            s.newton_max = std::max(s.newton_max, whole(scalar_newton_max));
            s.iterations_max = std::max(s.iterations_max, whole(scalar_iterations_max));
            s.residual_max = std::max(s.residual_max, number(scalar_residual_max));
            s.energy_lost += number(scalar_energy_lost);
            s.active_max = std::max<std::uint64_t>(s.active_max, whole(scalar_active_max));
            s.active_last += whole(scalar_active_last);
            s.newton_last = std::max(s.newton_last, whole(scalar_newton_last));
            s.iterations_last = std::max(s.iterations_last, whole(scalar_iterations_last));
            s.residual_last = std::max(s.residual_last, number(scalar_residual_last));
        }
        if (s.solves == 0) return;
        const auto solves = static_cast<double>(s.solves);
        s.newton_mean = newton_sum / solves;
        s.iterations_mean = iterations_sum / solves;
        s.active_mean = active_sum / solves;
    }

    /// A time within a millionth of a frame of a whole frame is that frame's: sums of 1/60 must reach 5.0.
    double on_frame(double time, double advanced) const
    {
        const double frames = time * scene.time.frame_rate, nearest = std::round(frames);
        const double tolerance =
            std::min(1e-6, 0.25 * advanced * scene.time.frame_rate);  // never back to the start
        return std::abs(frames - nearest) < tolerance ? nearest / scene.time.frame_rate : time;
    }

    const Program& frame_program(std::uint32_t steps)
    {
        const std::uint32_t grabbed = hand ? hand->model : no_cloth;
        const auto key = std::make_tuple(steps, parity, grabbed);
        auto found = programs.find(key);
        if (found == programs.end() && programs.size() >= most_programs) programs.clear();
        if (found == programs.end()) {
            Program program{next_program_id++, {}, 0};
            program.parity_after = append_frame(models, steps, parity, program.calls, grabbed);
            found = programs.emplace(key, std::move(program)).first;
        }
        return found->second;
    }

    /// Keeps the reason in memory that is there already: this may be about memory.
    void stop(std::string_view reason) noexcept
    {
        report.device_lost = true;
        report.failure.assign(reason.substr(0, report.failure.capacity()));
    }

    void place_colliders(std::uint32_t steps, double step)
    {
        const std::size_t count = scene.colliders.size();
        if (colliders_rest && placed.size() == count) return;
        placed.resize(colliders_rest ? count : count * steps);
        for (std::size_t s = 0; s * count < placed.size(); ++s)
            for (std::size_t k = 0; k < count; ++k)
                placed[s * count + k] = placed_at(
                    scene.colliders[k], report.simulated_seconds + static_cast<double>(s + 1) * step);
    }

    void place_attached(std::uint32_t steps, double step)
    {
        attached.resize(models.size());
        for (std::size_t c = 0; c < models.size(); ++c) {
            const std::size_t count = models[c].attached.size();
            attached[c].resize(count * steps);
            for (std::size_t s = 0; count > 0 && s < steps; ++s)
                models[c].place_attached(report.simulated_seconds + static_cast<double>(s + 1) * step,
                                         std::span(attached[c]).subspan(s * count, count));
        }
    }

    /// The volumes and pressures of bodies at the end of each step.
    void place_goals(std::uint32_t steps, double step)
    {
        goals.resize(models.size());
        for (std::size_t c = 0; c < models.size(); ++c) {
            if (!models[c].body) continue;
            const BodyModel& body = *models[c].body;
            const std::uint32_t rows = body.goals_move() ? steps : 1;
            goals[c].resize(rows * body.parts.size());
            for (std::size_t s = 0; s < rows; ++s)
                for (std::size_t k = 0; k < body.parts.size(); ++k)
                    goals[c][s * body.parts.size() + k] =
                        body.goal_at(k, report.simulated_seconds + static_cast<double>(s + 1) * step);
        }
    }

    FrameInput input(double step) const
    {
        return {step,  static_cast<std::uint32_t>(scene.colliders.size()), placed, colliders_rest, attached,
                goals,
                hand && step > 0 ? hand->input(step, models[hand->model].parameters.damping) : GrabInput{}};
    }

    /// Makes the held node as heavy as it is in the hand, in steps of this length; with 0, as it is without.
    void hold(double step)
    {
        if (hand && set_mass(models[hand->model], *hand, step)) runner->take_mass(hand->model, hand->node);
    }

    void grab(std::size_t cloth, std::size_t node, Vec3d target, double stiffness, double damping)
    {
        const auto refuse = [](const std::string& what) {
            throw Error(ErrorKind::bad_usage, "Simulation::grab: " + what);
        };
        if (cloth >= places.size() || node >= places[cloth].node_count)
            refuse("there is no node " + std::to_string(node) + " of cloth " + std::to_string(cloth));
        if (!(stiffness >= 0 && stiffness <= 1e9)) refuse("the stiffness must be 0 to 1e9 N/m");
        if (!(damping >= 0 && damping <= 1e6)) refuse("the damping must be 0 to 1e6 N s/m");
        if (!std::isfinite(dot(target, target))) refuse("the target must be finite");
        const ClothPlace& place = places[cloth];
        const ClothModel& model = models[place.model];
        const auto at = static_cast<std::uint32_t>(place.node(node));
        const bool same = hand && hand->model == place.model && hand->node == at;
        if (!same) release();
        if (!(model.inverse_mass(at) > 0)) return;  // pinned
        if (!same) hand = Hand{.model = place.model, .node = at, .mass = model.masses[at]};
        hand->target = target - model.origin;
        if (hand->stiffness != stiffness || hand->damping != damping) hold(0);
        hand->stiffness = stiffness;
        hand->damping = damping;
    }

    void release()
    {
        hold(0);
        hand.reset();
    }

    State state()
    {
        State now{report.simulated_seconds, {}};
        for (std::size_t c = 0; c < places.size(); ++c) {
            const auto x = values(c, Resource::position), v = values(c, Resource::velocity);
            now.cloths.push_back({{x.begin(), x.end()}, {v.begin(), v.end()}});
        }
        return now;
    }

    void set_state(const State& state)
    {
        bool fits = state.cloths.size() == places.size();
        for (std::size_t c = 0; fits && c < places.size(); ++c)
            fits = state.cloths[c].positions.size() == places[c].node_count &&
                   state.cloths[c].velocities.size() == places[c].node_count;
        if (!fits)
            throw Error(ErrorKind::bad_usage,
                        "Simulation::set_state: the state has other cloths, or other numbers of nodes, than "
                        "the scene");
        release();
        for (std::uint32_t m = 0; m < models.size(); ++m) {
            std::vector<Vec3> x(models[m].node_count()), v(models[m].node_count());
            for (std::size_t c = 0; c < places.size(); ++c) {
                if (places[c].model != m) continue;
                const Vec3d origin = models[m].origin;
                for (std::size_t i = 0; i < places[c].node_count; ++i) {
                    const Vec3 at = state.cloths[c].positions[i];
                    x[places[c].node(i)] = origin == Vec3d{} ? at : to_float(to_double(at) - origin);
                    v[places[c].node(i)] = state.cloths[c].velocities[i];
                }
            }
            std::vector<bool> moved(x.size(), false);
            for (const AttachedNode& a : models[m].attached) moved[a.node] = true;
            for (std::size_t i = 0; i < x.size(); ++i)
                if (!(models[m].inverse_mass(i) > 0) && !moved[i]) v[i] = {};  // a pin that stands still
            runner->write(m, x, v);
        }
        report.simulated_seconds = state.time;
        report.finite = true;
        idle_seconds = 0;
        ++state_number;
        measure();
        take_measures();
    }

    void take_measures()
    {
        FrameMeasures m;
        m.max_stretch = -1;
        double stretch_sum = 0, speed2 = 0;
        std::uint64_t measured_springs = 0;
        const double g = std::sqrt(dot(scene.gravity, scene.gravity));
        for (std::uint32_t c = 0; c < models.size(); ++c) {
            const MeasureTotals totals = runner->measures(c);
            m.max_stretch = std::max(m.max_stretch, totals.max_stretch);
            m.max_penetration = std::max(m.max_penetration, totals.max_penetration);
            speed2 = std::max(speed2, totals.max_speed2);
            stretch_sum += totals.stretch_sum;
            measured_springs += models[c].measured_spring_count();
            m.kinetic_energy += totals.kinetic_energy;
            m.elastic_energy += totals.elastic_energy;
            m.potential_energy += g * totals.height_moment;
            if (models[c].is_body())
                m.potential_energy -= models[c].mass() * dot(models[c].origin, scene.gravity);
            m.non_finite += static_cast<std::uint64_t>(totals.non_finite);
        }
        m.max_speed = std::sqrt(speed2);
        m.mean_stretch = measured_springs > 0 ? stretch_sum / static_cast<double>(measured_springs) : 0;
        if (measured_springs == 0) m.max_stretch = 0;
        report.measures = m;
        measure_volumes();
        if (m.non_finite > 0 && report.finite) find_bad_node();
    }

    void measure_volumes()
    {
        double loss = 0;
        for (BodyMeasures& measures : report.bodies) {
            const ClothPlace& place = places[measures.cloth];
            const BodyPart& part = models[place.model].body->parts[place.part];
            measures.volume = runner->volume(place.model, place.part) / 6;
            measures.ratio = measures.volume / part.volume;
            measures.error = measures.ratio / value_at(part.options.target, report.simulated_seconds, 1) - 1;
            VolumeReport& all = report.volume;
            all.error_max = std::max(all.error_max, std::abs(measures.error));
            all.loss_max = std::max(all.loss_max, -measures.error);
            all.gain_max = std::max(all.gain_max, measures.error);
            if (std::abs(measures.error) > part.options.tolerance && report.frames > 0) ++all.misses;
            loss += std::max(0.0, -measures.error);
        }
        if (report.bodies.empty() || report.frames == 0) return;
        loss_sum += loss / static_cast<double>(report.bodies.size());
        report.volume.loss_mean = loss_sum / static_cast<double>(report.frames);
    }

    void find_bad_node()
    {
        report.finite = false;
        report.bad_frame = report.frames;
        const auto finite = [](Vec3 a) { return std::isfinite(a.x * a.x + a.y * a.y + a.z * a.z); };
        for (std::size_t c = 0; c < places.size(); ++c) {
            const auto x = values(c, Resource::position), v = values(c, Resource::velocity);
            for (std::size_t i = 0; i < x.size(); ++i)
                if (!finite(x[i]) || !finite(v[i])) {
                    report.bad_cloth = c;
                    report.bad_node = i;
                    return;
                }
        }
    }

    std::span<const Vec3> values(std::size_t cloth, Resource resource)
    {
        ReadBack& read_back = read_backs.at(cloth);
        ReadBack::Values<Vec3>& target = resource == Resource::position   ? read_back.positions
                                         : resource == Resource::velocity ? read_back.velocities
                                                                          : read_back.normals;
        if (target.frame == state_number) return target.values;
        if (resource == Resource::normal) update_drawing(cloth);
        const ClothPlace& place = places[cloth];
        const std::vector<float>& all = read_model(place.model, resource);
        const Vec3d origin = resource == Resource::position ? models[place.model].origin : Vec3d{};
        target.values.resize(place.node_count);
        target.frame = state_number;
        if (place.node_of_vertex.empty() && origin == Vec3d{}) {
            static_assert(sizeof(Vec3) == 3 * sizeof(float));
            std::memcpy(static_cast<void*>(target.values.data()), &all[3 * std::size_t{place.first_node}],
                        target.values.size() * sizeof(Vec3));
            return target.values;
        }
        for (std::size_t i = 0; i < target.values.size(); ++i) {
            const std::size_t at = 3 * place.node(i);
            const Vec3 a{all[at], all[at + 1], all[at + 2]};
            target.values[i] = origin == Vec3d{} ? a : to_float(to_double(a) + origin);
        }
        return target.values;
    }

    /// Numbers of all nodes of a model, read once for each state.
    const std::vector<float>& read_model(std::uint32_t model, Resource resource)
    {
        ReadBack::Values<float>& target = read_models[model][resource];
        if (target.frame != state_number) runner->read(model, resource, parity, target.values);
        target.frame = state_number;
        return target.values;
    }

    std::span<const float> strains(std::size_t cloth)
    {
        ReadBack::Values<float>& target = read_backs.at(cloth).strains;
        if (target.frame == state_number) return target.values;
        update_drawing(cloth);
        const std::vector<float>& all = read_model(places[cloth].model, Resource::strain);
        target.values.resize(places[cloth].node_count);
        for (std::size_t i = 0; i < target.values.size(); ++i) target.values[i] = all[places[cloth].node(i)];
        target.frame = state_number;
        return target.values;
    }

    std::span<const float> multipliers(std::size_t cloth)
    {
        ReadBack::Values<float>& target = read_backs.at(cloth).multipliers;
        if (target.frame == state_number) return target.values;
        const std::uint32_t model = places[cloth].model;
        if (!uses_solver(stepped_method(scene))) {
            target.values.assign(places[cloth].node_count, 0.0f);
        } else {
            Program& program = multiplier_programs[{model, parity}];
            if (program.calls.empty()) {
                program = {next_program_id++, {}, parity};
                append_multipliers(models[model], model, parity, program.calls);
            }
            runner->run(program, input(1 / scene.time.frame_rate));
            runner->read(model, Resource::multiplier, parity, target.values);
        }
        target.frame = state_number;
        return target.values;
    }

    std::span<const std::uint32_t> held_springs(std::size_t cloth)
    {
        ReadBack::Values<std::uint32_t>& target = read_backs.at(cloth).held;
        if (target.frame == state_number) return target.values;
        const ClothPlace& place = places[cloth];
        if (models[place.model].is_body()) return {};  // they have no constraints
        held.resize(places.size());
        if (!held[cloth]) held[cloth].emplace(models[place.model], scene, scene.cloth(cloth));
        const auto forces = multipliers(cloth);
        held[cloth]->read(*runner, place.model, values(cloth, Resource::position), forces, target.values);
        target.frame = state_number;
        return target.values;
    }

    /// Normals and strains are computed only when someone looks.
    void update_drawing(std::size_t cloth)
    {
        const std::uint32_t model = places[cloth].model;
        if (drawn.size() < models.size()) drawn.resize(models.size(), 0);
        if (drawn[model] == state_number) return;
        drawn[model] = state_number;
        if (device_state) {
            device_state->drawable(model);
            return;
        }
        Program& program = drawing_programs[{model, parity}];
        if (program.calls.empty()) {
            program = {next_program_id++, {}, parity};
            append_drawing(models[model], model, parity, program.calls);
        }
        runner->run(program, input(0));
    }

    template <class Count>
    std::uint64_t total(Count count) const
    {
        std::uint64_t sum = 0;
        for (const ClothModel& model : models) sum += (model.*count)();
        return sum;
    }

    static constexpr std::uint64_t most_steps_at_once = 4096;
    /// Nodes times steps of one submission: drivers give up on a GPU that is busy for seconds.
    static constexpr std::uint64_t most_work_at_once = 500'000'000;
    static constexpr std::size_t most_programs =
        32;  ///< a host that varies its frames does not fill the memory

    /// What was read back of a cloth, and of which state; kept from frame to frame, so that reading allocates
    /// once.
    struct ReadBack {
        template <class T>
        struct Values {
            std::vector<T> values;
            std::uint64_t frame = 0;
        };
        Values<Vec3> positions, velocities, normals;
        Values<float> strains, multipliers;
        Values<std::uint32_t> held;
    };

    /// Where a cloth or body of the scene lies in the models.
    struct ClothPlace {
        std::uint32_t model = 0, first_node = 0, node_count = 0, part = 0;
        float farthest = 0;                         ///< m, the largest coordinate at the start
        std::vector<std::uint32_t> node_of_vertex;  ///< against first_node; empty where they are the same
        std::size_t node(std::size_t vertex) const
        {
            return first_node + (node_of_vertex.empty() ? vertex : node_of_vertex[vertex]);
        }
    };

    Scene scene;
    Backend backend;
    std::vector<ClothModel> models;
    std::vector<ClothPlace> places;  ///< by cloth of the scene
    std::unique_ptr<PassRunner> runner;
    VulkanRunner* device_state = nullptr;
    double stable_step = 0;
    bool colliders_rest = true;
    std::optional<Hand> hand;
    std::vector<PlacedCollider> placed;
    std::vector<std::vector<Vec3>> attached;  ///< by cloth, see FrameInput
    /// By steps, parity and the model that a hand holds.
    std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, Program> programs;
    /// By model and parity.
    std::map<std::pair<std::uint32_t, std::uint32_t>, Program> drawing_programs, multiplier_programs;
    std::uint64_t next_program_id = 1;
    std::uint32_t parity = 0;
    std::uint64_t state_number = 1;  ///< counts states; 0 is none
    std::vector<ReadBack> read_backs;
    std::vector<std::map<Resource, ReadBack::Values<float>>> read_models;
    std::vector<std::optional<HeldSprings>> held;  ///< by cloth, made when first asked for
    std::vector<std::uint64_t> drawn;              ///< by model: the state of its normals and strains
    std::vector<std::vector<VolumeGoal>> goals;    ///< by model, see FrameInput
    double loss_sum = 0;
    Report report;
    double newton_sum = 0, iterations_sum = 0, active_sum = 0;  ///< of the solver, over the run
    double idle_seconds = 0;                                    ///< asked for after the run had ended
};

Simulation::Simulation(const Scene& scene, const SimulationOptions& options)
    : implementation_(std::make_unique<Implementation>(scene, options))
{
}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

void Simulation::advance(double duration) noexcept
{
    Report& report = implementation_->report;
    if (!(duration > 0) || !std::isfinite(duration)) return;
    if (!report.finite || report.device_lost) {
        implementation_->idle_seconds += duration;
        return;
    }
    try {
        implementation_->advance(duration);
    } catch (const std::exception& error) {
        implementation_->stop(error.what());
    } catch (...) {
        implementation_->stop("a job system threw what is no std::exception");
    }
}

double Simulation::time() const
{
    return implementation_->report.simulated_seconds + implementation_->idle_seconds;
}
const Report& Simulation::report() const { return implementation_->report; }
std::vector<PassTime> Simulation::pass_times() const
{
    std::vector<PassTime> times;
    pass_times(times);
    return times;
}
void Simulation::pass_times(std::vector<PassTime>& into) const
{
    implementation_->runner->clock().times(into);
}

void Simulation::grab(std::size_t cloth, std::size_t node, Vec3d target, double stiffness, double damping)
{
    implementation_->grab(cloth, node, target, stiffness, damping);
}
void Simulation::release() noexcept
{
    try {
        implementation_->release();
    } catch (const std::exception& error) {
        implementation_->stop(error.what());  // the device is lost
    }
}
State Simulation::state() { return implementation_->state(); }
void Simulation::set_state(const State& state) { implementation_->set_state(state); }

std::vector<PinListing> Simulation::pins(std::size_t cloth) const
{
    const auto& place = implementation_->places.at(cloth);
    const ClothModel& model = implementation_->models[place.model];
    std::vector<PinListing> listing;
    for (std::uint32_t k = 0; k < place.node_count; ++k) {
        const auto node = static_cast<std::uint32_t>(place.node(k));
        if (model.inverse_mass(node) > 0) continue;
        const bool moves = std::any_of(model.attached.begin(), model.attached.end(),
                                       [&](const AttachedNode& a) { return a.node == node; });
        listing.push_back({k, moves});
    }
    return listing;
}

std::vector<SpringListing> Simulation::springs(std::size_t cloth) const
{
    const auto& place = implementation_->places.at(cloth);
    const ClothModel& model = implementation_->models[place.model];
    std::vector<SpringListing> listing;
    const auto add = [&](std::uint32_t i, std::uint32_t j, SpringClass of, double rest_length) {
        auto kind = static_cast<SpringKind>(of);
        if (model.is_body() && of == SpringClass::shear) kind = SpringKind::internal;
        listing.push_back({i, j, kind, rest_length});
    };
    if (model.springs.empty() && model.sheet) {
        for_each_sheet_spring(*model.sheet, [&](std::uint32_t i, std::uint32_t j, const SheetNeighbour& n) {
            add(i, j, n.spring_class, model.sheet->rest_lengths[static_cast<std::size_t>(n.rest)]);
        });
        return listing;
    }
    std::vector<std::uint32_t> vertex_of(place.node_count);
    for (std::uint32_t k = 0; k < place.node_count; ++k) vertex_of[place.node(k) - place.first_node] = k;
    for (const Spring& spring : model.springs) {
        if (spring.i < place.first_node || spring.i >= place.first_node + place.node_count) continue;
        const auto [i, j] =
            std::minmax(vertex_of[spring.i - place.first_node], vertex_of[spring.j - place.first_node]);
        add(i, j, spring.spring_class, spring.rest_length);
    }
    std::sort(listing.begin(), listing.end(), [](const SpringListing& a, const SpringListing& b) {
        return a.i != b.i ? a.i < b.i : a.j < b.j;
    });
    return listing;
}

std::span<const Vec3> Simulation::positions(const ClothHandle& cloth) { return positions(cloth.index()); }
std::span<const Vec3> Simulation::positions(std::size_t cloth)
{
    return implementation_->values(cloth, Resource::position);
}
std::span<const Vec3> Simulation::velocities(const ClothHandle& cloth) { return velocities(cloth.index()); }
std::span<const Vec3> Simulation::velocities(std::size_t cloth)
{
    return implementation_->values(cloth, Resource::velocity);
}
std::span<const Vec3> Simulation::normals(std::size_t cloth)
{
    return implementation_->values(cloth, Resource::normal);
}
std::span<const float> Simulation::strains(std::size_t cloth) { return implementation_->strains(cloth); }
std::span<const Triangle> Simulation::triangles(std::size_t cloth) const
{
    if (const auto* mesh = std::get_if<SurfaceMesh>(&scene().cloth(cloth).shape)) return mesh->triangles;
    return implementation_->models[implementation_->places.at(cloth).model].triangles();
}

std::span<const float> Simulation::multipliers(std::size_t cloth)
{
    return implementation_->multipliers(cloth);
}

std::span<const std::uint32_t> Simulation::held_springs(std::size_t cloth)
{
    return implementation_->held_springs(cloth);
}

std::uint64_t Simulation::state_hash()
{
    StateHash hash;
    for (std::size_t c = 0; c < implementation_->places.size(); ++c) hash.add(positions(c));
    for (std::size_t c = 0; c < implementation_->places.size(); ++c) hash.add(velocities(c));
    return hash.value();
}

const Scene& Simulation::scene() const { return implementation_->scene; }
Backend Simulation::backend() const { return implementation_->backend; }
std::string Simulation::device_name() const { return implementation_->runner->device_name(); }
unsigned Simulation::thread_count() const { return implementation_->runner->thread_count(); }
std::uint64_t Simulation::node_count() const
{
    std::uint64_t sum = 0;
    for (const ClothModel& model : implementation_->models) sum += model.node_count();
    return sum;
}
std::uint32_t Simulation::node_count(std::size_t cloth) const
{
    return implementation_->places.at(cloth).node_count;
}
std::size_t Simulation::body_count() const { return implementation_->report.bodies.size(); }
std::uint64_t Simulation::spring_count() const { return implementation_->total(&ClothModel::spring_count); }
std::uint64_t Simulation::triangle_count() const
{
    return implementation_->total(&ClothModel::triangle_count);
}

double Simulation::step_length() const
{
    return implementation_->steps_of(1 / scene().time.frame_rate).second;
}
std::uint32_t Simulation::steps_per_frame() const
{
    return static_cast<std::uint32_t>(implementation_->steps_of(1 / scene().time.frame_rate).first);
}
double Simulation::stable_step() const { return implementation_->stable_step; }

std::string Simulation::resolution_warning() const
{
    constexpr double half_ulp = 0x1p-24, noticeable = 1e-3;  // of a rest length
    for (std::size_t c = 0; c < implementation_->places.size(); ++c) {
        const auto& place = implementation_->places[c];
        const ClothModel& model = implementation_->models[place.model];
        const double farthest = double{place.farthest};
        const double shortest = model.shortest_rest_length();
        if (farthest * half_ulp > noticeable * shortest) {
            char text[256];
            std::snprintf(text, sizeof text,
                          " single precision rounds positions by %.2g m, which is more than a thousandth of "
                          "the shortest spring of %.3g m: ",
                          farthest * half_ulp, shortest);
            char distance[64];
            std::snprintf(distance, sizeof distance, "at %.3g m from ", farthest);
            const std::string& name = scene().cloth(c).name;
            // The coordinates of a body begin near its middle, wherever it is.
            if (model.is_body())
                return "body '" + name + "': " + distance + "its middle" + text +
                       "use a mesh without edges as short as that";
            return "cloth '" + name + "': " + distance + "the origin" + text +
                   "move the cloth nearer to the origin, or use fewer nodes";
        }
    }
    return {};
}

std::string Simulation::stability_warning() const
{
    const double step = step_length(), stable = stable_step();
    const bool implicit = uses_solver(scene().method) && scene().solver == Solver::newton_multigrid;
    if (step <= stable || implicit || stepped_method(scene()) == Method::constraint) return {};
    const double frame = 1 / scene().time.frame_rate;
    if (scene().method == Method::acad)
        return "the step of " + seconds(step) + " exceeds the largest safe one of " + seconds(stable) +
               ": below the threshold, springs are taken softer, as stiff as this step can carry; for their "
               "full "
               "stiffness use at least " +
               std::to_string(static_cast<long long>(std::ceil(frame / stable))) +
               " substeps per frame (time.substeps)";
    return "the step of " + seconds(step) + " exceeds the largest safe one of " + seconds(stable) +
           " and the run may diverge: use at least " +
           std::to_string(static_cast<long long>(std::ceil(frame / stable))) +
           " substeps per frame (time.substeps), softer springs or heavier nodes";
}

std::optional<DeviceBuffers> Simulation::device_buffers(std::size_t cloth)
{
    if (!implementation_->device_state) return std::nullopt;
    if (scene().cloth(cloth).is_body()) return std::nullopt;  // its nodes lie in an order of their own
    const vulkan::Device& device = *implementation_->device_state->device();
    const DeviceClothBuffers buffers = [&] {
        try {
            return implementation_->device_state->drawable(implementation_->places[cloth].model);
        } catch (const std::runtime_error& error) {
            throw Error(ErrorKind::device_failure,
                        "the device " + device_name() + " failed: " + error.what());
        }
    }();
    const auto handle = [](vk::Buffer buffer) {
        return reinterpret_cast<std::uint64_t>(static_cast<VkBuffer>(buffer));
    };
    return DeviceBuffers{static_cast<VkInstance>(*device.instance()),
                         static_cast<VkPhysicalDevice>(*device.physical()),
                         static_cast<VkDevice>(*device.handle()),
                         device.queue_family(),
                         handle(buffers.position),
                         handle(buffers.normal),
                         handle(buffers.strain),
                         buffers.node_count,
                         node_of_vertex(cloth)};
}

std::span<const std::uint32_t> Simulation::node_of_vertex(std::size_t cloth) const
{
    return implementation_->places.at(cloth).node_of_vertex;
}

DeviceState* Simulation::device_state() { return implementation_->device_state; }

}  // namespace pliant

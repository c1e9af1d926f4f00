// Creates a simulation, steps it and measures it.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "backend/cpu/kernels.hpp"
#include "kernels/planes.hpp"
#include "pliant/extremes.hpp"
#include "simulation/implementation.hpp"
#include "simulation/solver_memory.hpp"
#include "simulation/start_warnings.hpp"
#include "solve/mass_spring.hpp"

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

}  // namespace

std::string text_of_seconds(double s)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.3g s", s);
    return text;
}

Simulation::Implementation::Implementation(const Scene& given, const SimulationOptions& options)
    : scene(given), backend(resolve(options))
{
    validate(scene);
    cpu::choose_kernels(options.instruction_set);  // an unknown name is an error on every backend
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
        if (backend != Backend::vulkan || options.backend == Backend::vulkan || options.device >= 0) throw;
        backend = Backend::cpu;  // automatic: fall back to the CPU
        device_state = nullptr;
        start_runner(options);
    }
    take_measures();
    for (ClothModel& model : models) model.shape.forget_start();
}

void Simulation::Implementation::make_models()
{
    models.reserve(scene.cloth_count());
    for (std::size_t c = 0; c < scene.cloth_count(); ++c) {
        ClothModel model(scene.cloth(c), scene);
        ClothPlace place{static_cast<std::uint32_t>(models.size()),    0, model.node_count(), 0, 0.0f,
                         std::exchange(model.shape.node_of_vertex, {})};
        if (model.plan.is_body()) report.bodies.push_back({c});
        const auto warn = [&](const std::vector<std::string>& sentences) {
            start_warnings.insert(start_warnings.end(), sentences.begin(), sentences.end());
        };
        warn(starts_inside(scene, scene.cloth(c), model));
        find_sunk(scene, model, model.shape.positions, 0, lets_rise);
        if (model.plan.keeps_volume()) warn(fast_targets(scene.cloth(c)));
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
             std::span(models[place.model].shape.positions).subspan(place.first_node, place.node_count))
            place.farthest = std::max({place.farthest, std::abs(x.x), std::abs(x.y), std::abs(x.z)});
}

void Simulation::Implementation::start_runner(const SimulationOptions& options)
{
    if (backend == Backend::vulkan) {
        auto vulkan = make_vulkan_runner(models, options);
        device_state = vulkan.get();
        runner = std::move(vulkan);
    } else {
        runner = backend == Backend::cpu ? make_cpu_runner(models, options) : make_reference_runner(models);
    }
    try {
        measure();
    } catch (const std::runtime_error& error) {
        throw Error(ErrorKind::device_failure,
                    "the device " + runner->device_name() + " failed at once: " + error.what());
    }
}

void Simulation::Implementation::measure()
{
    Program program{next_program_id++, {}, parity};
    for (std::uint32_t m = 0; m < models.size(); ++m) append_measures(models[m], m, parity, 0, program.calls);
    runner->run(program, input(0));
}

std::pair<std::uint64_t, double> Simulation::Implementation::steps_of(double duration) const
{
    constexpr double rounding = 1e-9;
    // Limits with memory are corrected from step to step. In long steps they are stable but inaccurate, so
    // such steps are divided. Springs without limits may take long steps to find a state of rest.
    constexpr double longest = 1 / 20.0;
    const bool remembers = std::any_of(models.begin(), models.end(),
                                       [](const ClothModel& m) { return m.limits.remembers_any(); });
    const auto divided = [&](double count, double step) {
        const double parts = remembers ? std::max(1.0, std::ceil(step / longest * (1 - rounding))) : 1;
        return std::pair(static_cast<std::uint64_t>(count * parts), step / parts);
    };
    if (scene.time.substeps > 0) {
        const double step = 1 / (scene.time.frame_rate * scene.time.substeps);
        return divided(std::max(0.0, std::round(duration / step)), step);
    }
    if (stepped_method(scene) == Method::constraint) {  // implicit: one step per frame by default
        const double frames = std::max(1.0, std::round(duration * scene.time.frame_rate));
        return divided(frames, duration / frames);
    }
    const double count = std::max(1.0, std::ceil(duration / stable_step * (1 - rounding)));
    return {static_cast<std::uint64_t>(count), duration / count};
}

void Simulation::Implementation::refuse_too_many_steps() const
{
    constexpr double most = 100'000;  // the largest number that a scene may ask for
    const double frame = 1 / scene.time.frame_rate;
    if (stepped_method(scene) != Method::constraint && scene.time.substeps == 0 && frame / stable_step > most)
        throw Error(ErrorKind::bad_input,
                    "time.substeps is 0 (automatic), and a stable step of " + text_of_seconds(stable_step) +
                        " would take more than 100000 substeps per frame; use softer springs, "
                        "less damping or heavier nodes");
}

void Simulation::Implementation::advance(double duration)
{
    const auto start = std::chrono::steady_clock::now();
    const auto [steps, step] = steps_of(duration + owed_seconds);
    // The steps do not add up to the duration; the remainder carries over to the next call.
    owed_seconds = scene.time.substeps > 0 ? duration + owed_seconds - static_cast<double>(steps) * step : 0;
    // Many steps run in batches, so that programs stay short and few.
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
    report.wall_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void Simulation::Implementation::run_steps(std::uint32_t steps, double step)
{
    for (std::uint32_t m = 0; m < models.size(); ++m) fit_memory(m, step);
    memory_step = step;
    const Program& program = frame_program(steps);
    const std::uint32_t from_parity = parity;
    stretches_before.resize(models.size());
    for (std::uint32_t m = 0; m < models.size(); ++m) stretches_before[m] = runner->measures(m).max_stretch;
    run_program(program, steps, step);
    parity = program.parity_after;
    for (std::uint32_t m = 0; m < models.size(); ++m)
        if (models[m].plan.is_implicit()) cut_steps(m, steps, step, from_parity, stretches_before[m]);
    report.simulated_seconds = on_frame(report.simulated_seconds + steps * step, steps * step);
    report.steps += steps;
    if (uses_solver(stepped_method(scene))) count_solves();
}

void Simulation::Implementation::run_program(const Program& program, std::uint32_t steps, double step)
{
    hold(step);
    place_colliders(steps, step);
    place_attached(steps, step);
    place_goals(steps, step);
    runner->run(program, input(step));
}

Kept Simulation::Implementation::kept(std::uint32_t model, std::uint32_t steps,
                                      std::uint32_t from_parity) const
{
    // A single step leaves its initial state unchanged; its three parts do not.
    const bool may_overwrite = steps > 1 || models[model].plan.newton.step_cuts > 1;
    return {model, from_parity, may_overwrite, solver_memory_ranges(models[model])};
}

void Simulation::Implementation::fit_memory(std::uint32_t model, double step)
{
    if (memory_step > 0) fit_solver_memory(*runner, models[model], model, memory_step, step);
}

void Simulation::Implementation::cut_steps(std::uint32_t model, std::uint32_t steps, double step,
                                           std::uint32_t from_parity, double stretch_before)
{
    // An odd number of parts, so that the state ends in the same copy as those of the other cloths.
    constexpr std::uint32_t parts = 3;
    // The force of a limit lags by one step. A sudden pull, such as by a pin that begins to move, stretches
    // it by more than this, in proportion to the step's length.
    constexpr double at_once = 0.01, helps = 0.8;
    const bool holds = models[model].limits.does_not_stretch(step);
    const double limit = models[model].limits.largest();
    // Cloth that is already overstretched cannot follow the pull in steps of any length.
    const double most = stretch_before < limit + 2 * at_once ? std::max(stretch_before, limit) + at_once
                                                             : std::numeric_limits<double>::infinity();
    const auto stretch_now = [&] { return holds ? runner->measures(model).max_stretch : 0; };
    double residual = solver_number(model, scalar_residual_max), stretch = stretch_now();
    std::uint32_t all_parts = 1;
    for (std::uint32_t cut = 0; cut < models[model].plan.newton.step_cuts; ++cut) {
        const bool is_solved = residual <= double{solved_residual};
        if (is_solved && !(stretch > most)) break;
        runner->put_back(kept(model, steps, from_parity));
        all_parts *= parts;
        fit_memory(model, step / all_parts);
        run_program(frame_program(steps * all_parts, model), steps * all_parts, step / all_parts);
        const double residual_before = std::exchange(residual, solver_number(model, scalar_residual_max));
        const double longest = std::exchange(stretch, stretch_now());
        if (is_solved ? !(stretch < helps * longest) : !(residual < residual_before))
            break;  // a further cut would not help
    }
    if (all_parts == 1) return;
    ++report.solver.frames_cut;
    report.solver.steps_added += std::uint64_t{steps} * (all_parts - 1);
    hold(step);
}

void Simulation::Implementation::count_solves()
{
    SolverReport& s = report.solver;
    s.active_last = 0;
    s.newton_last = s.iterations_last = 0;
    s.residual_last = 0;
    for (std::uint32_t c = 0; c < models.size(); ++c) {
        const auto number = [&](int scalar) { return solver_number(c, scalar); };
        const auto whole = [&](int scalar) { return static_cast<std::uint32_t>(number(scalar)); };
        s.solves += whole(scalar_solves);
        newton_sum += number(scalar_newton_sum);
        iterations_sum += number(scalar_iterations_sum);
        active_sum += number(scalar_active_sum);
        s.newton_max = std::max(s.newton_max, whole(scalar_newton_max));
        s.iterations_max = std::max(s.iterations_max, whole(scalar_iterations_max));
        s.residual_max = larger(s.residual_max, number(scalar_residual_max));
        s.energy_lost += number(scalar_energy_lost);
        if (models[c].plan.is_implicit()) s.searches_refused += whole(scalar_refused);
        s.active_max = std::max<std::uint64_t>(s.active_max, whole(scalar_active_max));
        s.active_last += whole(scalar_active_last);
        s.newton_last = std::max(s.newton_last, whole(scalar_newton_last));
        s.iterations_last = std::max(s.iterations_last, whole(scalar_iterations_last));
        s.residual_last = larger(s.residual_last, number(scalar_residual_last));
    }
    if (s.solves == 0) return;
    const auto solves = static_cast<double>(s.solves);
    s.newton_mean = newton_sum / solves;
    s.iterations_mean = iterations_sum / solves;
    s.active_mean = active_sum / solves;
}

double Simulation::Implementation::on_frame(double time, double advanced) const
{
    const double frames = time * scene.time.frame_rate, nearest = std::round(frames);
    const double tolerance =
        std::min(1e-6, 0.25 * advanced * scene.time.frame_rate);  // never back to the start
    return std::abs(frames - nearest) < tolerance ? nearest / scene.time.frame_rate : time;
}

const Program& Simulation::Implementation::frame_program(std::uint32_t steps, std::uint32_t only)
{
    const std::uint32_t grabbed = hand ? hand->model : no_cloth;
    // Steps that are repeated begin in the same copy of the state as the first time.
    const std::uint32_t from_parity = only == no_cloth ? parity : (parity ^ steps) & 1;
    const std::array key = {steps, from_parity, grabbed, only};
    auto found = programs.find(key);
    if (found == programs.end() && programs.size() >= most_programs) programs.clear();
    if (found == programs.end()) {
        Program program{next_program_id++, {}, 0};
        program.parity_after = append_frame(models, steps, from_parity, program.calls, grabbed, only);
        for (std::uint32_t m = 0; only == no_cloth && m < models.size(); ++m)
            if (models[m].plan.is_implicit() && models[m].plan.newton.step_cuts > 0)
                program.keeps.push_back(kept(m, steps, from_parity));
        found = programs.emplace(key, std::move(program)).first;
    }
    return found->second;
}

void Simulation::Implementation::stop(std::string_view reason) noexcept
{
    report.device_lost = true;
    report.failure.assign(reason.substr(0, report.failure.capacity()));
}

void Simulation::Implementation::place_colliders(std::uint32_t steps, double step)
{
    const std::size_t count = scene.colliders.size();
    if (!colliders_rest || placed.size() != count) {
        placed.resize(colliders_rest ? count : count * steps);
        for (std::size_t s = 0; s * count < placed.size(); ++s)
            for (std::size_t k = 0; k < count; ++k)
                placed[s * count + k] = placed_at(
                    scene.colliders[k], report.simulated_seconds + static_cast<double>(s + 1) * step);
        if (!colliders_rest && step > 0) find_jumps(steps, step);
    }
    for (std::size_t i = 0; i < placed.size(); ++i) placed[i].lets_rise = lets_rise[i % count] != 0;
}

void Simulation::Implementation::find_jumps(std::uint32_t steps, double step)
{
    constexpr double fastest_collider = 100;  // m/s; a faster collider counts as jumping, and gives no speed
                                              // to nodes
    const std::size_t count = scene.colliders.size();
    const auto length = [](Vec3d a) { return std::sqrt(dot(a, a)); };
    for (std::size_t k = 0; k < count; ++k) {
        PlacedCollider before = placed_at(scene.colliders[k], report.simulated_seconds);
        if (length(before.velocity) > fastest_collider) before.velocity = {};
        for (std::size_t s = 0; s < steps; ++s) {
            PlacedCollider& now = placed[s * count + k];
            if (length(now.velocity) > fastest_collider) now.velocity = {};
            // A collider that starts or stops within a step moves at most at its speed.
            const double way = step * (length(before.velocity) + length(now.velocity));
            if (length(now.centre - before.centre) > way + deepest_contact) lets_rise[k] = 1;
            before = now;
        }
    }
}

void Simulation::Implementation::place_attached(std::uint32_t steps, double step)
{
    attached.resize(models.size());
    for (std::size_t c = 0; c < models.size(); ++c) {
        const std::size_t count = models[c].attachments.nodes.size();
        attached[c].resize(count * steps);
        for (std::size_t s = 0; count > 0 && s < steps; ++s)
            models[c].attachments.place(report.simulated_seconds + static_cast<double>(s + 1) * step,
                                        std::span(attached[c]).subspan(s * count, count));
    }
}

void Simulation::Implementation::place_goals(std::uint32_t steps, double step)
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

FrameInput Simulation::Implementation::input(double step) const
{
    return {step,
            static_cast<std::uint32_t>(scene.colliders.size()),
            placed,
            colliders_rest,
            attached,
            goals,
            hand && step > 0 ? grab_input(models[hand->model], *hand, step) : GrabInput{}};
}

void Simulation::Implementation::hold(double step)
{
    if (hand && set_mass(models[hand->model], *hand, step)) runner->take_mass(hand->model, hand->node);
}

void Simulation::Implementation::grab(std::size_t cloth, std::size_t node, Vec3d target, double stiffness,
                                      double damping)
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
    if (!(model.masses.inverse(at) > 0)) return;  // pinned
    if (!same) hand = Hand{.model = place.model, .node = at, .mass = model.masses.kg[at]};
    hand->target = target - model.shape.origin;
    if (hand->stiffness != stiffness || hand->damping != damping) hold(0);
    hand->stiffness = stiffness;
    hand->damping = damping;
}

void Simulation::Implementation::release()
{
    hold(0);
    hand.reset();
}

void Simulation::Implementation::take_measures()
{
    FrameMeasures m;
    m.max_stretch = -1;
    double stretch_sum = 0, speed2 = 0;
    std::uint64_t measured_springs = 0;
    const double g = std::sqrt(dot(scene.gravity, scene.gravity));
    for (std::uint32_t c = 0; c < models.size(); ++c) {
        const MeasureTotals totals = runner->measures(c);
        m.max_stretch = larger(m.max_stretch, totals.max_stretch);
        m.max_penetration = larger(m.max_penetration, totals.max_penetration);
        speed2 = larger(speed2, totals.max_speed2);
        stretch_sum += totals.stretch_sum;
        measured_springs += models[c].springs.measured_count;
        m.kinetic_energy += totals.kinetic_energy;
        m.elastic_energy += totals.elastic_energy;
        m.potential_energy += g * totals.height_moment;
        if (models[c].plan.is_body())
            m.potential_energy -= models[c].masses.sum() * dot(models[c].shape.origin, scene.gravity);
        m.non_finite += static_cast<std::uint64_t>(totals.non_finite);
    }
    m.max_speed = std::sqrt(speed2);
    m.mean_stretch = measured_springs > 0 ? stretch_sum / static_cast<double>(measured_springs) : 0;
    if (measured_springs == 0) m.max_stretch = 0;
    report.measures = m;
    if (m.max_penetration <= deepest_contact) std::fill(lets_rise.begin(), lets_rise.end(), std::uint8_t{0});
    measure_volumes();
    if (m.non_finite > 0 && report.finite) find_bad_node();
}

void Simulation::Implementation::measure_volumes()
{
    double loss = 0;
    for (BodyMeasures& measures : report.bodies) {
        const ClothPlace& place = places[measures.cloth];
        const BodyPart& part = models[place.model].body->parts[place.part];
        measures.volume = runner->volume(place.model, place.part) / 6;
        measures.ratio = measures.volume / part.volume;
        measures.error = measures.ratio / value_at(part.options.target, report.simulated_seconds, 1) - 1;
        VolumeReport& all = report.volume;
        all.error_max = larger(all.error_max, std::abs(measures.error));
        all.loss_max = larger(all.loss_max, -measures.error);
        all.gain_max = larger(all.gain_max, measures.error);
        if (!(std::abs(measures.error) <= part.options.tolerance) && report.frames > 0) ++all.misses;
        loss += larger(0, -measures.error);
    }
    if (report.bodies.empty() || report.frames == 0) return;
    loss_sum += loss / static_cast<double>(report.bodies.size());
    report.volume.loss_mean = loss_sum / static_cast<double>(report.frames);
}

void Simulation::Implementation::find_bad_node()
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

}  // namespace pliant

#include "viewer/session.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "render/stage.hpp"
#include "stopwatch.hpp"

namespace pliant::tool {
Method method_of(const std::string& name)
{
    for (const Method method : {Method::mass_spring, Method::constraint, Method::acad, Method::volume})
        if (name == name_of(method)) return method;
    throw Error(ErrorKind::bad_usage,
                "'" + name + "' is no method: it must be mass_spring, constraint, acad or volume");
}

Scene scene_of_mesh(const std::string& file)
{
    SurfaceMesh mesh = read_mesh(file);
    const MeshReport report = inspect_mesh(mesh);
    const Vec3d extent = report.bounds_max - report.bounds_min;
    const double largest = std::max({extent.x, extent.y, extent.z});
    if (!(largest > 0))
        throw Error(ErrorKind::bad_input,
                    "the mesh '" + file + "' has no extent, so that it cannot be shown");
    const double scale = 1 / largest;
    const Vec3d middle = (report.bounds_min + report.bounds_max) * (0.5 * scale);
    const Vec3d above = {-middle.x, 0.3 - scale * report.bounds_min.y, -middle.z};
    Scene scene;
    scene.name = std::filesystem::path(file).stem().string();
    scene.add(Plane{});
    if (report.closed) {
        require_closed(mesh, file);
        const double vertices = static_cast<double>(mesh.vertices.size());
        auto body =
            scene.add(Cloth::soft_body(std::move(mesh), {}, {.node_mass = 10 / vertices, .scale = scale}));
        body->position = above;
        body->springs.structural = {500, 0.5};
        scene.method = Method::volume;
    } else {
        auto cloth = scene.add(Cloth::mesh(std::move(mesh), {.scale = scale}));
        cloth->position = above;
    }
    scene.camera.position = {1.8, 1.3, 2.6};
    scene.camera.target = {0, 0.5, 0};
    return scene;
}

Session::Session(const SimulationOptions& options, std::shared_ptr<vulkan::Device> device)
    : options_(options), device_(device), stepper_(std::move(device))
{
}

void Session::open(const std::string& scene_or_mesh, const std::vector<std::string>& overrides)
{
    Scene scene =
        is_mesh_file(scene_or_mesh) ? scene_of_mesh(scene_or_mesh) : read_scene(scene_or_mesh, overrides);
    start(std::move(scene), nullptr);
    opened_ = scene_or_mesh;
    overrides_ = overrides;
    ++scene_number_;
    held_.reset();
    histories_.clear();
    notice.clear();
}

void Session::start(Scene scene, const State* state)
{
    SimulationOptions options = options_;
    options.shared_device = device_;
    auto next = std::make_unique<Simulation>(scene, options);
    if (state) next->set_state(*state);
    if (before_change) before_change();
    stepper_.detach();
    simulation_ = std::move(next);
    scene_ = std::move(scene);
    ++simulation_number_;
    changed_ = stepped_ = false;
    if (!state) waiting_ = 0;
    times_before_.clear();
    pass_costs_.clear();
    if (held_ && state) simulation_->grab(held_->cloth, held_->node, hand_, hand_stiffness, hand_damping);
    // A sheet's triangles are made on first use: now, while nothing steps.
    for (std::size_t c = 0; c < scene_.cloth_count(); ++c) static_cast<void>(simulation_->triangles(c));
    stepper_.attach(*simulation_, overlays);
    hold();
}

void Session::when_idle(std::function<void()> edit)
{
    if (edits_.empty() && stepper_.is_idle()) return edit();
    edits_.push_back(std::move(edit));  // after the waiting edits, to keep their order
    stepper_.interrupt();
}

Stepper::Seen Session::hold()
{
    const Stepper::Seen seen = stepper_.hold();
    report_ = &seen.last.source.report();
    time_ = seen.last.source.time();
    return seen;
}

void Session::apply_changes()
{
    if (!changed_) return;
    changed_ = false;
    try {
        State state = simulation_->state();
        // Nodes that are pinned now must stop.
        start(scene_, &state);
        notice.clear();
    } catch (const Error& error) {
        notice = error.what();
        scene_ = simulation_->scene();
    }
}

void Session::set(const std::string& path_is_value)
{
    if (is_mesh_file(opened_)) {
        notice = "values of a mesh's scene can be changed in the panel alone";
        return;
    }
    try {
        overrides_.push_back(path_is_value);
        scene_ = read_scene(opened_, overrides_);
        scene_changed();
    } catch (const Error& error) {
        notice = error.what();
        overrides_.pop_back();
    }
}

void Session::set_method(Method method)
{
    scene_.method = method;
    scene_changed();
}

void Session::reset()
{
    try {
        held_.reset();
        start(scene_, nullptr);
        histories_.clear();
    } catch (const Error& error) {
        notice = error.what();
        scene_ = simulation_->scene();
    }
}

void Session::step_once()
{
    paused = true;
    ++single_steps_;
}

void Session::advance(double seconds, double patience)
{
    step_seconds_ = waited_seconds_ = state_seconds_ = 0;
    collect();
    if (!paused) {
        waiting_ += speed * seconds;
        measured_ += seconds;
    }
    if (stepper_.is_idle()) {
        for (std::size_t k = 0; k < edits_.size(); ++k) {  // NOLINT: an edit may add more
            const auto edit = std::move(edits_[k]);
            edit();
        }
        edits_.clear();
        apply_changes();
        if (std::exchange(hand_moved_, false)) move_hand(hand_);
        if (hold().last.overlays != overlays) stepper_.look_again(overlays);
        begin_steps();
    } else if (paused || changed_ || hand_moved_) {
        stepper_.interrupt();
    }
    if (patience > 0) {  // also if idle: its results may not be collected yet
        const auto start = Clock::now();
        stepper_.wait(patience);
        waited_seconds_ = seconds_since(start);
        collect();
    }
    if (measured_ >= 0.5) {
        real_time_factor_ = simulated_ / measured_;
        simulated_ = measured_ = 0;
    }
}

void Session::begin_steps()
{
    if (paused) {
        behind_ = false;
        if (single_steps_ > 0) stepper_.start(single_steps_, overlays);
        return;
    }
    const double frame = 1 / simulation_->scene().time.frame_rate;
    constexpr double rounding = 1e-9;
    const double due = std::floor((waiting_ + rounding) / frame);
    // Overdue steps are dropped: the simulation is then slower than real time, but does not lag more and
    // more.
    behind_ = due > most_steps;
    if (behind_) waiting_ = most_steps * frame;
    if (due >= 1) stepper_.start(behind_ ? most_steps : static_cast<unsigned>(due), overlays);
}

void Session::collect()
{
    const double frame = 1 / simulation_->scene().time.frame_rate;
    const unsigned made = stepper_.take(numbers_);
    for (unsigned k = 0; k < made; ++k) record(numbers_[k]);
    if (made > 0) {
        const unsigned single = std::min(single_steps_, made);
        single_steps_ -= single;
        waiting_ = single > 0 ? 0 : std::max(0.0, waiting_ - made * frame);
        stepped_ = single == 0;  // a single step is shown without interpolation
        simulated_ += (made - single) * frame;
    }
    record_passes();
    state_seconds_ += stepper_.take_seconds_of_states();
    if (std::string failure = stepper_.take_failure(); !failure.empty()) notice = std::move(failure);
    hold();
}

float Session::blend() const
{
    if (paused || !stepped_) return 1;
    return static_cast<float>(std::min(1.0, waiting_ * simulation_->scene().time.frame_rate));
}

void Session::record(const StepNumbers& numbers)
{
    const FrameMeasures& m = numbers.measures;
    step_seconds_ += 1e-3 * numbers.milliseconds;
    histories_.max_stretch.add(100 * m.max_stretch);
    histories_.mean_stretch.add(100 * m.mean_stretch);
    if (simulation_->body_count() > 0) histories_.volume.add(numbers.volume);
    histories_.energy.add(m.kinetic_energy + m.elastic_energy + m.potential_energy);
    histories_.active.add(numbers.active);
    histories_.iterations.add(numbers.iterations);
    histories_.residual.add(numbers.residual);
    histories_.frame_time.add(numbers.milliseconds);
}

void Session::record_passes()
{
    if (!stepper_.take_pass_times(times_)) return;
    pass_costs_.resize(times_.size());
    for (std::size_t k = 0; k < times_.size(); ++k) {
        const bool known = k < times_before_.size() && times_before_[k].name == times_[k].name;
        pass_costs_[k].name = times_[k].name;
        pass_costs_[k].milliseconds = (times_[k].milliseconds - (known ? times_before_[k].milliseconds : 0)) /
                                      Stepper::steps_between_times;
    }
    times_before_ = times_;
}

std::optional<NodeOf> Session::node_at(const OrbitCamera& camera, double x, double y, double width,
                                       double height)
{
    constexpr double reach = 40, together = 6;  // pixels
    const Matrix4 clip = clip_from_world(camera.camera(), width / height);
    const auto for_each_within = [&](double pixels, const auto& f) {
        for (std::size_t c = 0; c < scene_.cloth_count(); ++c) {
            const auto positions = simulation_->positions(c);
            for (std::size_t i = 0; i < positions.size(); ++i) {
                const Vec3d place = to_double(positions[i]), seen = seen_at(clip, place, width, height);
                const double distance = std::hypot(seen.x - x, seen.y - y);
                if (seen.z > 0 && distance <= pixels) f(NodeOf{c, i}, place, distance);
            }
        }
    };
    std::optional<NodeOf> nearest;
    double least = reach;
    Vec3d place_of_nearest;
    for_each_within(reach, [&](NodeOf node, Vec3d place, double distance) {
        if (nearest && distance >= least) return;
        nearest = node;
        least = distance;
        place_of_nearest = place;
    });
    if (!nearest) return nearest;
    // A node directly in front, as of another layer, has priority, even if it is some pixels further away;
    // neighbours on the cloth are beside it, not in front.
    const Vec3d eye = camera.camera().position;
    const double depth = length(place_of_nearest - eye);
    NodeOf front = *nearest;
    double most = 0;
    for_each_within(least + together, [&](NodeOf node, Vec3d place, double) {
        const double before = depth - length(place - eye);
        if (before <= most || before < 0.9 * length(place - place_of_nearest)) return;
        front = node;
        most = before;
    });
    return front;
}

void Session::grab(NodeOf node, Vec3d target)
{
    held_ = node;
    hand_ = target;
    simulation_->grab(node.cloth, node.node, target, hand_stiffness, hand_damping);
}

void Session::move_hand(Vec3d target)
{
    if (!held_) return;
    if (stepper_.is_idle()) return grab(*held_, target);
    hand_ = target;
    hand_moved_ = true;
    stepper_.interrupt();
}

void Session::release()
{
    when_idle([this] {
        held_.reset();
        simulation_->release();
    });
}

Vec3d Session::position_of(NodeOf node) { return to_double(simulation_->positions(node.cloth)[node.node]); }

void Session::toggle_pin(NodeOf node)
{
    apply_changes();
    const auto pins = simulation_->pins(node.cloth);
    const auto known =
        std::find_if(pins.begin(), pins.end(), [&](const PinListing& pin) { return pin.node == node.node; });
    Cloth& cloth = *scene_.cloth_handle(node.cloth);
    if (known == pins.end()) {
        cloth.pin(static_cast<std::uint32_t>(node.node));
    } else if (known->moves) {
        notice = "this node is held by a pin that moves: it cannot be released here";
        return;
    } else {
        // Edges and regions are replaced by their nodes, without this one.
        std::erase_if(cloth.pins, [](const Attachment& pin) { return pin.keyframes.empty(); });
        for (const PinListing& pin : pins)
            if (!pin.moves && pin.node != node.node) cloth.pin(pin.node);
    }
    scene_changed();
    apply_changes();
}

std::pair<Vec3d, double> Session::bounds()
{
    Bounds box;
    for (std::size_t c = 0; c < scene_.cloth_count(); ++c)
        for (const Vec3& x : simulation_->positions(c)) box.include(to_double(x));
    if (box.empty()) return {{0, 0, 0}, 1};
    return {(box.min + box.max) * 0.5, std::max(1e-3, 0.5 * length(box.max - box.min))};
}

}  // namespace pliant::tool

#include "viewer/viewer.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "backend/vulkan/device_state.hpp"
#include "pliant/render.hpp"
#include "stopwatch.hpp"

namespace pliant::tool {
Viewer::Viewer(std::unique_ptr<Screen> screen, const SimulationOptions& simulation)
    : screen_(std::move(screen)),
      kit_(std::make_shared<vulkan::PictureKit>(screen_->device(), screen_->passes())),
      interface_(*screen_),
      session_(simulation, screen_->device())
{
    session_.before_change = [this] { screen_->device()->wait_idle(); };
}

Viewer::~Viewer()
{
    try {
        if (recorder_) recorder_->finish();
        screen_->device()->wait_idle();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "warning: %s\n", error.what());
    }
}

void Viewer::open(const std::string& scene_or_mesh, const std::vector<std::string>& overrides)
{
    session_.open(scene_or_mesh, overrides);
    camera_ = OrbitCamera(session_.scene().camera);
    view_.overlays = {};
    if (session_.scene().camera.colour == ClothColour::strain) view_.overlays.set(Overlay::strain, true);
    screen_->set_title("pliant: " + session_.scene().name);
}

void Viewer::try_open(const std::string& scene_or_mesh)
{
    session_.when_idle([this, scene_or_mesh] {
        try {
            open(scene_or_mesh);
        } catch (const Error& error) {
            session_.notice = error.what();
        }
    });
}

void Viewer::record(const std::string& file)
{
    recorder_ = std::make_unique<PictureRecorder>(file, session_.scene().time.frame_rate);
    recorded_ = 0;
    view_.recording = true;
}

void Viewer::toggle_recording()
{
    try {
        if (recorder_) {
            recorder_->finish();
            recorder_.reset();
            view_.recording = false;
            return;
        }
        char name[32];
        do std::snprintf(name, sizeof name, "pliant_%04u.mp4", ++files_);
        while (std::filesystem::exists(name));
        record(name);
    } catch (const Error& error) {
        session_.notice = error.what();
        recorder_.reset();
        view_.recording = false;
    }
}

void Viewer::handle(const Event& event)
{
    using Kind = Event::Kind;
    interface_.take(event);
    switch (event.kind) {
        case Kind::key:
            if (event.code == GLFW_KEY_LEFT_SHIFT || event.code == GLFW_KEY_RIGHT_SHIFT) shift_ = event.down;
            if (event.down && !interface_.wants_keys()) press_key(event.code);
            break;
        case Kind::button: press_button(event.code, event.down); break;
        case Kind::move: move_mouse(event.x, event.y); break;
        case Kind::move_to: {
            const NodeOf node{static_cast<std::size_t>(event.code), event.index};
            if (!session_.is_idle() || node.cloth >= session_.scene().cloth_count() ||
                node.node >= session_.simulation().node_count(node.cloth))
                break;
            const auto [width, height] =
                std::pair<double, double>{screen_->size().width, screen_->size().height};
            const Vec3d seen = seen_at(clip_from_world(camera_.camera(), width / height),
                                       session_.position_of(node), width, height);
            handle({.kind = Kind::move, .x = seen.x, .y = seen.y});
            break;
        }
        case Kind::scroll:
            if (!interface_.wants_mouse()) camera_.dolly(event.y);
            break;
        case Kind::drop:
        case Kind::scene: try_open(event.text); break;
        case Kind::resize:
            screen_->resize(static_cast<std::uint32_t>(event.x), static_cast<std::uint32_t>(event.y));
            break;
        case Kind::close: done_ = true; break;
        case Kind::lose_surface: screen_->lose_surface(); break;
        case Kind::set: session_.set(event.text); break;
        case Kind::method: try { session_.set_method(method_of(event.text));
            } catch (const Error& error) {
                session_.notice = error.what();
            }
            break;
        case Kind::screenshot: screenshots_.push_back(event.text); break;
        case Kind::text: break;  // for the user interface
    }
}

void Viewer::press_key(int key)
{
    if (key >= GLFW_KEY_1 && key <= GLFW_KEY_8)
        return view_.overlays.toggle(static_cast<Overlay>(key - GLFW_KEY_1));
    switch (key) {
        case GLFW_KEY_9: view_.overlays = {}; break;
        case GLFW_KEY_SPACE: session_.paused = !session_.paused; break;
        case GLFW_KEY_PERIOD: session_.step_once(); break;
        case GLFW_KEY_R: view_.wants_reset = true; break;
        case GLFW_KEY_F: frame_everything(); break;
        case GLFW_KEY_H: view_.panel = !view_.panel; break;
        case GLFW_KEY_F1: view_.help = !view_.help; break;
        case GLFW_KEY_P: with_node_at_mouse([this](NodeOf node) { session_.toggle_pin(node); }); break;
        case GLFW_KEY_S: {
            char name[32];
            do std::snprintf(name, sizeof name, "pliant_%04u.png", ++files_);
            while (std::filesystem::exists(name));
            screenshots_.emplace_back(name);
            break;
        }
        case GLFW_KEY_V: toggle_recording(); break;
        case GLFW_KEY_ESCAPE: done_ = true; break;
        default: break;
    }
}

void Viewer::press_button(int button, bool down)
{
    if (button < 0 || button > 2) return;
    if (!down) {
        held_buttons_[button] = false;
        if (button == GLFW_MOUSE_BUTTON_RIGHT) session_.release();
        return;
    }
    if (interface_.wants_mouse()) return;
    held_buttons_[button] = true;
    if (button == GLFW_MOUSE_BUTTON_RIGHT) grab();
    if (button != GLFW_MOUSE_BUTTON_LEFT) return;
    constexpr double quick = 0.35, near = 4;  // s, pixels
    const bool twice =
        clock_ - last_click_ < quick && std::hypot(mouse_x_ - click_x_, mouse_y_ - click_y_) < near;
    last_click_ = twice ? -1 : clock_;
    click_x_ = mouse_x_, click_y_ = mouse_y_;
    if (!twice) return;
    with_node_at_mouse([this](NodeOf node) { camera_.look_at(session_.position_of(node)); });
}

/// Between steps: calls `use` with the node under the mouse, if there is one.
template <class Use>
void Viewer::with_node_at_mouse(Use&& use)
{
    session_.when_idle([this, use, x = mouse_x_, y = mouse_y_] {
        const vk::Extent2D size = screen_->size();
        if (const auto node = session_.node_at(camera_, x, y, size.width, size.height)) use(*node);
    });
}

void Viewer::move_mouse(double x, double y)
{
    const double dx = x - mouse_x_, dy = y - mouse_y_, height = std::max(1u, screen_->size().height);
    mouse_x_ = x, mouse_y_ = y;
    if (session_.held()) session_.move_hand(on_hand_plane());
    if (held_buttons_[GLFW_MOUSE_BUTTON_MIDDLE] || (held_buttons_[GLFW_MOUSE_BUTTON_LEFT] && shift_))
        camera_.pan(dx, dy, height);
    else if (held_buttons_[GLFW_MOUSE_BUTTON_LEFT])
        camera_.orbit(dx, dy, height);
}

void Viewer::grab()
{
    with_node_at_mouse([this](NodeOf node) {
        hand_point_ = session_.position_of(node);
        hand_normal_ = normalized(camera_.camera().position - camera_.centre(), {0, 0, 1});
        session_.grab(node, hand_point_);
    });
}

/// The mouse position in the plane of the hand's motion.
Vec3d Viewer::on_hand_plane() const
{
    const Ray ray = camera_.ray(mouse_x_, mouse_y_, screen_->size().width, screen_->size().height);
    const double towards = dot(ray.direction, hand_normal_);
    if (std::abs(towards) < 1e-6) return session_.hand();
    return ray.origin + ray.direction * (dot(hand_point_ - ray.origin, hand_normal_) / towards);
}

void Viewer::frame_everything()
{
    session_.when_idle([this] {
        const auto [centre, radius] = session_.bounds();
        camera_.frame(centre, radius,
                      static_cast<double>(screen_->size().width) / std::max(1u, screen_->size().height));
    });
}

void Viewer::update_drawing()
{
    Simulation& simulation = session_.simulation();
    const bool other_scene = drawn_scene_ != session_.scene_number();
    const bool other_simulation = drawn_simulation_ != session_.simulation_number();
    if (other_scene || other_simulation) {
        // Also after mere changes of parameters: buffers of a new simulation may reuse old handles.
        screen_->device()->wait_idle();
        const auto topologies = topologies_of(simulation);
        drawing_ =
            std::make_unique<vulkan::SceneDrawing>(kit_, simulation.scene(), topologies, Screen::slots);
        drawn_scene_ = session_.scene_number();
        drawn_simulation_ = session_.simulation_number();
        springs_known_ = false;
    }
    if (view_.overlays.needs_springs() && !springs_known_) {
        screen_->device()->wait_idle();
        for (std::size_t c = 0; c < simulation.scene().cloth_count(); ++c)
            drawing_->set_springs(c, drawn_springs(simulation, c));
        springs_known_ = true;
    }
}

/// Sets what is drawn of each cloth.
void Viewer::show(const Stepper::Seen& seen)
{
    frames_.clear();
    const Simulation& simulation = session_.simulation();
    for (std::size_t c = 0; c < simulation.scene().cloth_count(); ++c) {
        if (PictureSource::is_direct(session_.simulation()))
            frames_.emplace_back(
                DeviceCloth{*seen.last.copies[c], simulation.node_count(c), *seen.before.copies[c]});
        else
            frames_.emplace_back(HostCloth{seen.last.source.positions(c), seen.before.source.positions(c)});
    }
}

void Viewer::draw(double seconds)
{
    const auto place = screen_->begin();
    interface_.begin(screen_->size(), seconds);
    panel_.draw(session_, view_);
    if (!place) return interface_.end(nullptr);
    update_drawing();
    const Stepper::Seen seen = session_.hold();
    show(seen);
    PictureState state{.camera = camera_.camera(),
                       .time = seen.last.source.time(),
                       .overlays = view_.overlays,
                       .scale = &seen.last.source.scale(),
                       .frames = frames_,
                       .extras = seen.last.source.extras(),
                       .blend = session_.blend()};
    drawing_->prepare(state, place->target.size, place->slot);
    drawing_->begin(*place->commands, place->target, place->slot);
    interface_.end(place->commands);
    drawing_->end(*place->commands);
    const bool kept = recorder_ || !screenshots_.empty();
    screen_->finish(*place, kept);
    if (kept) take_picture();
}

void Viewer::take_picture()
{
    try {
        if (!screen_->read(image_)) {
            session_.notice = "this window does not give its pictures back";
        } else {
            for (const std::string& file : screenshots_) write_png(file, image_);
            if (recorder_) recorder_->add(image_, ++recorded_);
        }
    } catch (const Error& error) {
        session_.notice = error.what();
        recorder_.reset();
        view_.recording = false;
    }
    screenshots_.clear();
}

void Viewer::frame(double seconds, double patience)
{
    const auto start = Clock::now();
    clock_ += seconds;
    events_.clear();
    screen_->poll(events_);
    for (const Event& event : events_) handle(event);
    if (!view_.wants_scene.empty()) try_open(std::exchange(view_.wants_scene, {}));
    if (std::exchange(view_.wants_reset, false)) session_.when_idle([this] { session_.reset(); });
    session_.overlays = view_.overlays;
    session_.advance(seconds, patience);
    draw(seconds);

    const double driver = screen_->take_driver_seconds(), whole = seconds_since(start);
    view_.cost.add({.whole = 1000 * seconds,
                    .simulation = 1000 * session_.step_seconds(),
                    .driver = 1000 * driver,
                    .own = 1000 * (whole - driver - session_.waited_seconds() + session_.state_seconds())});
}

}  // namespace pliant::tool

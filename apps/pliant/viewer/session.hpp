// A simulation that runs beside a clock, on a thread of its own, and what a person does to it. It knows no
// window.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pliant/simulation.hpp"
#include "render/picture_source.hpp"
#include "viewer/orbit_camera.hpp"
#include "viewer/stepper.hpp"

namespace pliant::tool {

/// A number over the last frames, oldest first when read from `first`.
struct History {
    static constexpr std::size_t length = 300;
    std::array<float, length> values{};
    std::size_t next = 0, count = 0;

    void add(double value)
    {
        values[next] = static_cast<float>(value);
        next = (next + 1) % length;
        count = std::min(count + 1, length);
    }
    void clear() { next = count = 0; }
    float last() const { return count > 0 ? values[(next + length - 1) % length] : 0.0f; }
};

struct Histories {
    History max_stretch, mean_stretch, volume, energy, active, iterations, residual, frame_time;
    void clear()
    {
        for (History* history :
             {&max_stretch, &mean_stretch, &volume, &energy, &active, &iterations, &residual, &frame_time})
            history->clear();
    }
};

/// A node of a cloth.
struct NodeOf {
    std::size_t cloth = 0, node = 0;
    friend bool operator==(const NodeOf&, const NodeOf&) = default;
};

/// Milliseconds of a pass in a frame, a mean over the last ones.
struct PassCost {
    std::string name;
    double milliseconds = 0;
};

class Session {
public:
    /// Vulkan simulations run on `device`.
    Session(const SimulationOptions& options, std::shared_ptr<vulkan::Device> device);

    /// Opens a built-in scene, a scene file, or a mesh, for which a scene is made. Throws Error; what was
    /// open stays open then.
    void open(const std::string& scene_or_mesh, const std::vector<std::string>& overrides = {});

    /// What moves in it, time and report included, is its thread's unless `is_idle`; what does not, as
    /// numbers of nodes, may be read at any time.
    Simulation& simulation() { return *simulation_; }
    const Simulation& simulation() const { return *simulation_; }
    bool is_idle() const { return stepper_.is_idle(); }
    /// Does it now, or when the step that runs has ended.
    void when_idle(std::function<void()> edit);
    /// The last two states, to be drawn; they stay until the next call.
    Stepper::Seen hold();
    /// Of the last state that was held.
    const Report& report() const { return *report_; }
    double time() const { return time_; }
    /// What was opened, for the scene picker.
    const std::string& opened() const { return opened_; }
    /// Counts scenes that were opened: cloths and triangles are others then.
    std::uint64_t scene_number() const { return scene_number_; }
    /// Counts simulations: buffers are others then.
    std::uint64_t simulation_number() const { return simulation_number_; }
    /// Called before a simulation goes: what is drawn from its buffers must have been drawn.
    std::function<void()> before_change;

    /// The scene as it is wanted; whoever changes it says so, and it counts from the next step on. Positions
    /// and velocities stay. What cannot be is told by `notice` and taken back.
    Scene& scene() { return scene_; }
    void scene_changed() { changed_ = true; }
    void apply_changes();
    /// Reads the scene again with this value and those that were set so before; what was changed otherwise
    /// goes back to what the scene says.
    void set(const std::string& path_is_value);
    void set_method(Method method);
    /// To the start, with the parameters of now.
    void reset();

    bool paused = false;
    OverlaySet overlays;                            ///< that states are looked at for
    unsigned most_steps = 4;                        ///< frames of the simulation in a frame of the display
    double speed = 1;                               ///< of the simulation's time against the clock's
    double hand_stiffness = 100, hand_damping = 2;  ///< N/m, N s/m

    /// Lets `seconds` pass: begins what steps are due when the last ones have ended, and waits for them up to
    /// `patience`, in s. With 0 the display goes on while they run.
    void advance(double seconds, double patience);
    /// One frame, then a pause.
    void step_once();
    /// Where the display is between the last two states: 0 to 1.
    float blend() const;
    bool is_behind() const { return behind_; }
    double real_time_factor() const { return real_time_factor_; }
    /// Seconds of the last `advance`: that steps took which ended in it, that it waited for them, and that
    /// their thread took to leave what is drawn.
    double step_seconds() const { return step_seconds_; }
    double waited_seconds() const { return waited_seconds_; }
    double state_seconds() const { return state_seconds_; }

    /// The node that is seen nearest to a pixel, in front where several are; nothing within 40 pixels,
    /// nothing.
    /// When it is idle, as all below that names a node.
    std::optional<NodeOf> node_at(const OrbitCamera& camera, double x, double y, double width, double height);
    void grab(NodeOf node, Vec3d target);
    void move_hand(Vec3d target);
    void release();
    const std::optional<NodeOf>& held() const { return held_; }
    Vec3d hand() const { return hand_; }
    Vec3d position_of(NodeOf node);
    void toggle_pin(NodeOf node);
    /// A ball around all nodes.
    std::pair<Vec3d, double> bounds();

    const Histories& histories() const { return histories_; }
    const std::vector<PassCost>& pass_costs() const { return pass_costs_; }
    /// What went wrong last, or a remark; empty when there is nothing to say.
    std::string notice;

private:
    void start(Scene scene, const State* state);
    void collect();
    void begin_steps();
    void record(const StepNumbers& numbers);
    void record_passes();

    SimulationOptions options_;
    std::shared_ptr<vulkan::Device> device_;
    std::unique_ptr<Simulation> simulation_;
    Scene scene_;
    std::string opened_;
    std::vector<std::string> overrides_;
    std::uint64_t scene_number_ = 0, simulation_number_ = 0;
    bool changed_ = false;

    double waiting_ = 0;  ///< s that the display is ahead of the last state
    bool stepped_ = false, behind_ = false, hand_moved_ = false;
    unsigned single_steps_ = 0;
    double real_time_factor_ = 1, step_seconds_ = 0, waited_seconds_ = 0, state_seconds_ = 0;
    double simulated_ = 0, measured_ = 0;  ///< s, since the factor was taken last

    std::optional<NodeOf> held_;
    Vec3d hand_;
    Histories histories_;
    std::vector<PassTime> times_, times_before_;
    std::vector<PassCost> pass_costs_;
    std::array<StepNumbers, Stepper::most_steps> numbers_;
    std::vector<std::function<void()>> edits_;  ///< that wait for the end of a step
    const Report* report_ = nullptr;
    double time_ = 0;
    Stepper stepper_;  ///< the last, so that its thread ends first
};

/// A scene for a mesh: scaled to a metre, over a plane; a closed one is a soft body, an open one cloth.
Scene scene_of_mesh(const std::string& file);

/// Throws Error(bad_usage) that names the methods.
Method method_of(const std::string& name);

}  // namespace pliant::tool

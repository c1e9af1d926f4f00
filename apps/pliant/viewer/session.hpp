// A simulation that runs alongside a clock, on its own thread, and the user's actions on it. It is
// independent of windows.
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

/// A number over the last frames; the oldest is at `first`.
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

/// Milliseconds per frame in a pass, averaged over the last frames.
struct PassCost {
    std::string name;
    double milliseconds = 0;
};

class Session {
public:
    /// Vulkan simulations run on `device`.
    Session(const SimulationOptions& options, std::shared_ptr<vulkan::Device> device);

    /// Opens a built-in scene, a scene file, or a mesh, for which a scene is made. Throws Error; then nothing
    /// changes.
    void open(const std::string& scene_or_mesh, const std::vector<std::string>& overrides = {});

    /// State that changes with steps, including time and report, belongs to the stepping thread unless
    /// `is_idle`; constant data, such as numbers of nodes, may be read at any time.
    Simulation& simulation() { return *simulation_; }
    const Simulation& simulation() const { return *simulation_; }
    bool is_idle() const { return stepper_.is_idle(); }
    /// Runs the edit now, or after the current step.
    void when_idle(std::function<void()> edit);
    /// The last two states, for drawing; valid until the next call.
    Stepper::Seen hold();
    /// The report of the last state from hold().
    const Report& report() const { return *report_; }
    double time() const { return time_; }
    /// The name of the open scene, for the scene picker.
    const std::string& opened() const { return opened_; }
    /// Increases with every opened scene: cloths and triangles then differ.
    std::uint64_t scene_number() const { return scene_number_; }
    /// Increases with every new simulation: buffers then differ.
    std::uint64_t simulation_number() const { return simulation_number_; }
    /// Called before a simulation is destroyed: drawing from its buffers must be complete.
    std::function<void()> before_change;

    /// The wanted scene. After a change, call scene_changed(); it takes effect with the next step, and
    /// positions and velocities are kept. An invalid change is reported in `notice` and undone.
    Scene& scene() { return scene_; }
    void scene_changed() { changed_ = true; }
    void apply_changes();
    /// Reads the scene again with this value and all values set before; other changes are lost.
    void set(const std::string& path_is_value);
    void set_method(Method method);
    /// Restarts with the present parameters.
    void reset();

    bool paused = false;
    OverlaySet overlays;                            ///< for which states are gathered
    unsigned most_steps = 4;                        ///< maximum simulation frames per display frame
    double speed = 1;                               ///< simulated time relative to the clock
    double hand_stiffness = 100, hand_damping = 2;  ///< N/m, N s/m

    /// Advances the clock by `seconds`: starts due steps after the last ones have ended, and waits for them
    /// up to `patience` s. With 0 the display continues while they run.
    void advance(double seconds, double patience);
    /// One frame, then a pause.
    void step_once();
    /// The display's position between the last two states: 0 to 1.
    float blend() const;
    bool is_behind() const { return behind_; }
    double real_time_factor() const { return real_time_factor_; }
    /// Seconds of the last `advance`: taken by steps that ended in it, waiting for them, and copying states
    /// for drawing.
    double step_seconds() const { return step_seconds_; }
    double waited_seconds() const { return waited_seconds_; }
    double state_seconds() const { return state_seconds_; }

    /// The node nearest to a pixel on screen, the front one if there are several; empty if none is within 40
    /// pixels. Only while idle, as all functions below that name a node.
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
    /// The last error or remark; empty if there is none.
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

    double waiting_ = 0;  ///< s by which the display is ahead of the last state
    bool stepped_ = false, behind_ = false, hand_moved_ = false;
    unsigned single_steps_ = 0;
    double real_time_factor_ = 1, step_seconds_ = 0, waited_seconds_ = 0, state_seconds_ = 0;
    double simulated_ = 0, measured_ = 0;  ///< s, since the last update of the factor

    std::optional<NodeOf> held_;
    Vec3d hand_;
    Histories histories_;
    std::vector<PassTime> times_, times_before_;
    std::vector<PassCost> pass_costs_;
    std::array<StepNumbers, Stepper::most_steps> numbers_;
    std::vector<std::function<void()>> edits_;  ///< waiting for the end of a step
    const Report* report_ = nullptr;
    double time_ = 0;
    Stepper stepper_;  ///< declared last, so that its thread ends first
};

/// A scene for a mesh: scaled to a metre, above a plane; a closed mesh is a soft body, an open one cloth.
Scene scene_of_mesh(const std::string& file);

/// Throws Error(bad_usage) that lists the methods.
Method method_of(const std::string& name);

}  // namespace pliant::tool

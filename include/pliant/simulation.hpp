// A running simulation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pliant/api.hpp"
#include "pliant/options.hpp"
#include "pliant/scene.hpp"
#include "pliant/vec3.hpp"

namespace pliant {

/// Measures of the state at the end of the last frame, over all cloths. Stretch is (l - l0) / l0 over
/// structural and shear springs.
struct FrameMeasures {
    double max_stretch = 0;
    double mean_stretch = 0;
    double max_penetration = 0;    ///< m, of a node below a collider's surface plus the cloth's thickness
    double max_speed = 0;          ///< m/s
    double kinetic_energy = 0;     ///< J
    double elastic_energy = 0;     ///< J
    double potential_energy = 0;   ///< J, of gravity against the origin
    std::uint64_t non_finite = 0;  ///< nodes with a position or velocity that is not finite
};

/// A soft body at the end of a frame.
struct BodyMeasures {
    std::size_t cloth = 0;  ///< its index in the scene
    double volume = 0;      ///< m3
    double ratio = 1;       ///< V / V0
    double error = 0;       ///< V / V_target - 1; the target is V0 unless the scene changes it
};

/// Volumes of all soft bodies at the ends of all frames since the start.
struct VolumeReport {
    double error_max = 0;      ///< largest abs(V / V_target - 1)
    double loss_max = 0;       ///< largest 1 - V / V_target, at least 0
    double gain_max = 0;       ///< largest V / V_target - 1, at least 0
    double loss_mean = 0;      ///< of the losses of all bodies and frames
    std::uint64_t misses = 0;  ///< bodies times frames whose error exceeds their tolerance
};

/// What the constraint solver did since the start, over all steps and cloths. A residual is a force relative
/// to the load of its step.
struct PLIANT_API SolverReport {
    std::uint64_t solves = 0;          ///< steps of a cloth that were solved
    double newton_mean = 0;            ///< Newton iterations per solve
    std::uint32_t newton_max = 0;      ///< in one step
    double iterations_mean = 0;        ///< linear iterations (V-cycles; of the solver paper, of CG) per step
    std::uint32_t iterations_max = 0;  ///< in one step
    double residual_max = 0;           ///< largest residual that a step ended with
    /// Frames of a cloth that were taken anew in shorter steps (NewtonMultigridOptions::step_cuts), since the
    /// residual of a step was above 1, and how many steps more they took.
    std::uint64_t frames_cut = 0, steps_added = 0;
    std::uint64_t searches_refused = 0;  ///< Newton steps of which nothing lowered the energy
    /// J: work that the residual forces took from the cloth, against the method's own balance.
    double energy_lost = 0;
    double active_mean = 0;             ///< constraints that were active, per step
    std::uint64_t active_max = 0;       ///< in one step
    std::uint64_t active_last = 0;      ///< in the last step
    std::uint32_t newton_last = 0;      ///< Newton iterations of the last step
    std::uint32_t iterations_last = 0;  ///< linear iterations of the last step
    double residual_last = 0;           ///< that the last step ended with

    /// False with the method mass_spring, and before the first step.
    bool used() const { return solves > 0; }

    /// Of every step, and of the last one: its residual is at most 1.
    bool is_solved() const noexcept;
    bool last_is_solved() const noexcept;
};

/// Counters of a simulation.
struct Report {
    std::uint64_t frames = 0;
    std::uint64_t steps = 0;
    double simulated_seconds = 0;
    double wall_seconds = 0;  ///< spent in advance()
    bool finite = true;
    bool device_lost = false;  ///< a step could not be run: the device, or the memory for it, was not there
    std::string failure;       ///< and why
    FrameMeasures measures;
    SolverReport solver;               ///< zeros with the methods mass_spring and volume
    std::vector<BodyMeasures> bodies;  ///< in the order of the scene; empty without soft bodies
    VolumeReport volume;
    // The first non-finite node, when there is one.
    std::size_t bad_cloth = 0;
    std::uint64_t bad_node = 0;
    std::uint64_t bad_frame = 0;
    std::uint64_t validation_messages = 0;  ///< Vulkan, with validation
};

/// Where a cloth lies on its Vulkan device, for hosts that draw or compute from it without a copy. Handles
/// are given without Vulkan's types, so that this header needs none of its own: cast them to those named.
struct DeviceBuffers {
    void* instance = nullptr;         ///< VkInstance
    void* physical_device = nullptr;  ///< VkPhysicalDevice
    void* device = nullptr;           ///< VkDevice
    std::uint32_t queue_family = 0;   ///< that owns the buffers
    std::uint64_t position = 0;       ///< VkBuffer, vec4 per node: xyz in m, w the inverse mass in 1/kg
    std::uint64_t normal = 0;         ///< VkBuffer, vec4 per node: xyz of unit length
    std::uint64_t strain = 0;         ///< VkBuffer, float per node: the largest stretch of its springs
    std::uint32_t node_count = 0;
    /// Of a mesh: where each of its vertices lies in the buffers; empty where that is their order. Valid as
    /// long as the simulation.
    std::span<const std::uint32_t> node_of_vertex;
};

/// All that moves, at a moment: what Simulation::set_state takes back.
struct State {
    double time = 0;  ///< s
    struct Nodes {
        std::vector<Vec3> positions;   ///< m
        std::vector<Vec3> velocities;  ///< m/s
    };
    std::vector<Nodes> cloths;  ///< in the order of the scene, nodes as in Simulation::positions
    /// What constraints and contact remember of their forces, as state() gives it; empty, and they begin
    /// anew, which is right where nodes are put somewhere else.
    std::vector<std::vector<float>> memory = {};
    double step = 0;  ///< s, the length of the last steps, whose forces are remembered; 0 before the first
    /// By collider: 1 while nodes that were found inside are let out; empty, and it is found out anew.
    std::vector<std::uint8_t> lets_rise = {};
};

/// What a spring is there for.
enum class SpringKind { structural, shear, bend, internal };

/// A spring of a cloth, by its nodes as in Simulation::positions.
struct SpringListing {
    std::uint32_t i = 0, j = 0;
    SpringKind kind = SpringKind::structural;
    double rest_length = 0;  ///< m
};

/// A node that a pin holds.
struct PinListing {
    std::uint32_t node = 0;
    bool moves = false;  ///< the pin has keyframes
};

class DeviceState;  // Pliant's own renderer draws through it, see src/backend/vulkan

/// Steps a scene through time. The scene is copied; changing it afterwards changes nothing here.
class PLIANT_API Simulation {
public:
    /// Throws Error(bad_input) for an invalid scene and Error(device_failure) when the backend is not to be
    /// had.
    explicit Simulation(const Scene& scene, const SimulationOptions& options = {});
    ~Simulation();
    Simulation(Simulation&&) noexcept;
    Simulation& operator=(Simulation&&) noexcept;

    /// Advances by `duration` seconds in equal steps: the scene's substeps when it sets them, else as many as
    /// stability asks for. With substeps a step lasts 1 / (frame_rate substeps), and `duration` is rounded to
    /// whole steps, which may be none; the next call makes up for it, so that time() is never off by more
    /// than half a step from the sum of all durations. set_state() drops that rest. Never throws. Once a node
    /// is not finite or the device is lost (see report()) nothing moves any more but time(), so that loops
    /// come to their end.
    void advance(double duration) noexcept;

    /// Pulls a node towards `target` (m) from the next step on, by a spring of `stiffness` (N/m, 0 to 1e9)
    /// and `damping` (N s/m, 0 to 1e6) without length, as a hand would. It is stepped implicitly with every
    /// method, so that no stiffness is too large; while it is held the node counts as heavier by dt (damping
    /// + dt stiffness). One node at a time: the last call counts, and calling it for the same node moves the
    /// target. A pinned node stays where it is. Throws Error(bad_usage) for a cloth or node that does not
    /// exist, or a number out of range.
    void grab(std::size_t cloth, std::size_t node, Vec3d target, double stiffness, double damping);
    /// Lets go; nothing happens when nothing is held.
    void release() noexcept;

    /// Where everything is now; reads back from the device.
    State state();
    /// Puts everything there; it lets go of a node that is held, and takes a run that had diverged up again.
    /// Counters go on. What the method acad remembers of a spring being a constraint stays. Throws
    /// Error(bad_usage) for another number of cloths or nodes.
    void set_state(const State& state);

    double time() const;  ///< s
    const Report& report() const;
    std::vector<PassTime> pass_times() const;
    /// The same into what is kept from frame to frame: allocates the first time.
    void pass_times(std::vector<PassTime>& into) const;

    /// Positions of a cloth or soft body in m, one for each node, row by row on a sheet, in the order of its
    /// mesh otherwise. Read back from the device when asked for; valid until the next call of advance().
    std::span<const Vec3> positions(const ClothHandle& cloth);
    std::span<const Vec3> positions(std::size_t cloth = 0);
    /// Velocities in m/s.
    std::span<const Vec3> velocities(const ClothHandle& cloth);
    std::span<const Vec3> velocities(std::size_t cloth = 0);
    /// Unit normals (Algorithm 5 of the cloth paper).
    std::span<const Vec3> normals(std::size_t cloth = 0);
    /// The largest stretch of the structural and shear springs at each node, for colouring.
    std::span<const float> strains(std::size_t cloth = 0);
    /// The largest constraint force in N of the springs at each node (their Lagrange multipliers); 0 where
    /// none acts, and everywhere with the method mass_spring.
    std::span<const float> multipliers(std::size_t cloth = 0);
    /// By spring, in the order of `springs`: 1 where a constraint holds it at the end of the last step, by
    /// the marks of the solver itself (acad, and the paper's solver), or as it is beyond its limit and under
    /// force (constraint); else 0. Empty for soft bodies, and with the methods mass_spring and volume.
    std::span<const std::uint32_t> held_springs(std::size_t cloth = 0);
    /// Triangles of a cloth, fixed over time.
    std::span<const Triangle> triangles(std::size_t cloth = 0) const;

    /// Springs of a cloth, fixed over time.
    std::vector<SpringListing> springs(std::size_t cloth = 0) const;
    /// Nodes of a cloth that pins hold, ascending.
    std::vector<PinListing> pins(std::size_t cloth = 0) const;

    /// The bits of all positions and velocities, in node order (FNV-1a, 64 bit). Equal hashes mean equal
    /// states.
    std::uint64_t state_hash();

    const Scene& scene() const;
    Backend backend() const;          ///< never automatic
    std::string device_name() const;  ///< the GPU's, or the CPU's with the instruction set
    unsigned thread_count() const;
    std::uint64_t node_count() const;
    std::uint32_t node_count(std::size_t cloth) const;
    std::size_t body_count() const;  ///< soft bodies among the cloths
    std::uint64_t spring_count() const;
    std::uint64_t triangle_count() const;

    /// Length of a step of a frame in s.
    double step_length() const;
    std::uint32_t steps_per_frame() const;
    /// The largest step that is certainly stable for the springs' stiffness, damping and the masses, by
    /// Gershgorin's theorem; up to twice as much may do. See docs/physics.md. Infinite without springs and
    /// damping.
    double stable_step() const;
    /// A sentence when a cloth is so far from the origin, or so fine, that single precision cannot resolve
    /// its springs; else empty.
    std::string resolution_warning() const;
    /// A sentence when the scene's step is larger than `stable_step`, else empty.
    std::string stability_warning() const;
    /// All that there is to warn of before the first step, a sentence each: both of these, nodes that start
    /// inside colliders, and volumes that change too fast.
    std::vector<std::string> warnings() const;

    /// The buffers of a cloth (of a soft body there are none) on the device, up to date and idle until the
    /// next advance(), which submits to queue 0 of the family; nothing unless the backend is vulkan. Throws
    /// Error(device_failure) when the device is lost. `position` alternates between two buffers, so ask again
    /// after every advance().
    std::optional<DeviceBuffers> device_buffers(std::size_t cloth = 0);
    /// See DeviceBuffers: how the backend numbers the nodes of a cloth, which nothing else here shows.
    std::span<const std::uint32_t> node_of_vertex(std::size_t cloth = 0) const;
    /// For Pliant's own renderer; null unless the backend is vulkan.
    DeviceState* device_state();

private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace pliant

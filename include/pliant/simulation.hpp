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
    double max_penetration = 0;    ///< m, depth of a node below a collider's surface plus the cloth's
                                   ///< thickness
    double max_speed = 0;          ///< m/s
    double kinetic_energy = 0;     ///< J
    double elastic_energy = 0;     ///< J
    double potential_energy = 0;   ///< J, of gravity, relative to the origin
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

/// Statistics of the constraint solver since the start, over all steps and cloths. A residual is relative to
/// the load of its step.
struct PLIANT_API SolverReport {
    std::uint64_t solves = 0;          ///< solved steps of a cloth
    double newton_mean = 0;            ///< Newton iterations per solve
    std::uint32_t newton_max = 0;      ///< in one step
    double iterations_mean = 0;        ///< linear iterations (V-cycles; for the paper's solver, of CG) per
                                       ///< step
    std::uint32_t iterations_max = 0;  ///< in one step
    double residual_max = 0;           ///< largest residual at the end of a step
    /// Frames of a cloth that were repeated in shorter steps (NewtonMultigridOptions::step_cuts), since the
    /// residual of a step was above 1, and the number of additional steps.
    /// residual of a step was above 1, and how many steps more they took.
    std::uint64_t frames_cut = 0, steps_added = 0;
    std::uint64_t searches_refused = 0;  ///< Newton steps of which no length lowered the energy
    /// J: work that the residual forces took from the cloth, beyond the losses of the method itself.
    double energy_lost = 0;
    double active_mean = 0;             ///< active constraints per step
    std::uint64_t active_max = 0;       ///< in one step
    std::uint64_t active_last = 0;      ///< in the last step
    std::uint32_t newton_last = 0;      ///< Newton iterations of the last step
    std::uint32_t iterations_last = 0;  ///< linear iterations of the last step
    double residual_last = 0;           ///< at the end of the last step

    /// False for the method mass_spring, and before the first step.
    bool used() const { return solves > 0; }

    /// Whether the residual of every step, and that of the last step, is at most 1.
    bool is_solved() const noexcept;
    bool last_is_solved() const noexcept;
};

/// Counters of a simulation.
struct Report {
    std::uint64_t frames = 0;
    std::uint64_t steps = 0;
    double simulated_seconds = 0;
    double wall_seconds = 0;  ///< time spent in advance()
    bool finite = true;
    bool device_lost = false;  ///< a step could not run: the device or its memory failed
    std::string failure;       ///< the reason
    FrameMeasures measures;
    SolverReport solver;               ///< zeros for the methods mass_spring and volume
    std::vector<BodyMeasures> bodies;  ///< in the order of the scene; empty without soft bodies
    VolumeReport volume;
    // The first non-finite node, if there is one.
    std::size_t bad_cloth = 0;
    std::uint64_t bad_node = 0;
    std::uint64_t bad_frame = 0;
    std::uint64_t validation_messages = 0;  ///< Vulkan, with validation
};

/// Where a cloth is on its Vulkan device, for hosts that draw or compute from it without a copy. Handles have
/// no Vulkan types, so that this header does not include Vulkan: cast them to the types named.
struct DeviceBuffers {
    void* instance = nullptr;         ///< VkInstance
    void* physical_device = nullptr;  ///< VkPhysicalDevice
    void* device = nullptr;           ///< VkDevice
    std::uint32_t queue_family = 0;   ///< that owns the buffers
    std::uint64_t position = 0;       ///< VkBuffer, vec4 per node: xyz in m, w the inverse mass in 1/kg
    std::uint64_t normal = 0;         ///< VkBuffer, vec4 per node: xyz of unit length
    std::uint64_t strain = 0;         ///< VkBuffer, float per node: the largest strain of its springs
    std::uint32_t node_count = 0;
    /// Of a mesh: the node of each vertex in the buffers; empty if the order is the same. Valid as long as
    /// the simulation.
    std::span<const std::uint32_t> node_of_vertex;
};

/// The complete state at one time, for Simulation::set_state.
struct State {
    double time = 0;  ///< s
    struct Nodes {
        std::vector<Vec3> positions;   ///< m
        std::vector<Vec3> velocities;  ///< m/s
    };
    std::vector<Nodes> cloths;  ///< in the order of the scene, nodes as in Simulation::positions
    /// Forces that constraints and contact keep from step to step, from state(). Empty: they start at 0,
    /// which is right if nodes have been moved elsewhere.
    std::vector<std::vector<float>> memory = {};
    double step = 0;  ///< s, length of the last steps, to which `memory` belongs; 0 before the first
    /// By collider: 1 while nodes inside it rise slowly to its surface; empty: determined anew.
    std::vector<std::uint8_t> lets_rise = {};
};

/// The role of a spring.
enum class SpringKind { structural, shear, bend, internal };

/// A spring of a cloth, by its nodes as in Simulation::positions.
struct SpringListing {
    std::uint32_t i = 0, j = 0;
    SpringKind kind = SpringKind::structural;
    double rest_length = 0;  ///< m
};

/// A pinned node.
struct PinListing {
    std::uint32_t node = 0;
    bool moves = false;  ///< the pin has keyframes
};

class DeviceState;  // for Pliant's own renderer, see src/backend/vulkan

/// Steps a scene through time. It copies the scene, so later changes to the original have no effect.
class PLIANT_API Simulation {
public:
    /// Throws Error(bad_input) for an invalid scene and Error(device_failure) if the backend is not
    /// available.
    explicit Simulation(const Scene& scene, const SimulationOptions& options = {});
    ~Simulation();
    Simulation(Simulation&&) noexcept;
    Simulation& operator=(Simulation&&) noexcept;

    /// Advances by `duration` seconds in equal steps: the scene's substeps if set, else as many as stability
    /// requires. With substeps a step lasts 1 / (frame_rate substeps), and `duration` is rounded to whole
    /// steps, possibly none; the next call includes the remainder, so time() differs from the sum of all
    /// durations by at most half a step. set_state() drops the remainder. Never throws. After a node becomes
    /// non-finite or the device is lost (see report()), only time() advances, so that loops end.
    void advance(double duration) noexcept;

    /// Pulls a node towards `target` (m) from the next step on, by a spring of rest length 0 with `stiffness`
    /// (N/m, 0 to 1e9) and `damping` (N s/m, 0 to 1e6). The spring is stepped implicitly with every method,
    /// so any stiffness is stable; meanwhile the node's mass is increased by dt (damping + dt stiffness).
    /// Pulls one node at a time: another call replaces the last, and a call for the same node moves the
    /// target. A pinned node does not move. Throws Error(bad_usage) for a cloth or node that does not exist,
    /// or a number out of range.
    void grab(std::size_t cloth, std::size_t node, Vec3d target, double stiffness, double damping);
    /// Ends the pull; does nothing if there is none.
    void release() noexcept;

    /// The present state, read back from the device.
    State state();
    /// Sets the state; this ends a pull, and a run that had diverged continues. Counters are not reset. The
    /// marks of the method acad stay. Throws Error(bad_usage) for another number of cloths or nodes.
    void set_state(const State& state);

    double time() const;  ///< s
    const Report& report() const;
    std::vector<PassTime> pass_times() const;
    /// The same into an existing vector: allocates only the first time.
    void pass_times(std::vector<PassTime>& into) const;

    /// Positions of a cloth or soft body in m, one per node: row by row for a sheet, otherwise in the order
    /// of its mesh. Reads back from the device; valid until the next call of advance().
    std::span<const Vec3> positions(const ClothHandle& cloth);
    std::span<const Vec3> positions(std::size_t cloth = 0);
    /// Velocities in m/s.
    std::span<const Vec3> velocities(const ClothHandle& cloth);
    std::span<const Vec3> velocities(std::size_t cloth = 0);
    /// Unit normals (Algorithm 5 of the cloth paper).
    std::span<const Vec3> normals(std::size_t cloth = 0);
    /// The largest strain of the structural and shear springs at each node, for colouring.
    std::span<const float> strains(std::size_t cloth = 0);
    /// The largest constraint force in N of the springs at each node (their Lagrange multipliers); 0 if none
    /// acts, and everywhere for the method mass_spring.
    std::span<const float> multipliers(std::size_t cloth = 0);
    /// By spring, in the order of `springs`: 1 if a constraint holds it at the end of the last step, else 0.
    /// For acad and the paper's solver, by the solver's marks; for constraint, if it is beyond its limit and
    /// under force. Empty for soft bodies, and for the methods mass_spring and volume.
    std::span<const std::uint32_t> held_springs(std::size_t cloth = 0);
    /// Triangles of a cloth, fixed over time.
    std::span<const Triangle> triangles(std::size_t cloth = 0) const;

    /// Springs of a cloth, fixed over time.
    std::vector<SpringListing> springs(std::size_t cloth = 0) const;
    /// Pinned nodes of a cloth, ascending.
    std::vector<PinListing> pins(std::size_t cloth = 0) const;

    /// A hash of the bits of all positions and velocities, in node order (FNV-1a, 64 bit).
    std::uint64_t state_hash();

    const Scene& scene() const;
    Backend backend() const;          ///< never automatic
    std::string device_name() const;  ///< the GPU, or the CPU with its instruction set
    unsigned thread_count() const;
    std::uint64_t node_count() const;
    std::uint32_t node_count(std::size_t cloth) const;
    std::size_t body_count() const;  ///< soft bodies among the cloths
    std::uint64_t spring_count() const;
    std::uint64_t triangle_count() const;

    /// Length of a step, s.
    double step_length() const;
    std::uint32_t steps_per_frame() const;
    /// A step that is certainly stable for the springs' stiffness, damping and masses, by Gershgorin's
    /// theorem; up to twice that may be stable. See docs/physics.md. Infinite without springs and damping.
    double stable_step() const;
    /// A sentence if a cloth is so far from the origin, or so fine, that single precision cannot resolve its
    /// springs; else empty.
    std::string resolution_warning() const;
    /// A sentence if the scene's step is larger than `stable_step`, else empty.
    std::string stability_warning() const;
    /// All warnings before the first step, a sentence each: the two above, nodes that start inside colliders,
    /// and volumes that change too fast.
    std::vector<std::string> warnings() const;

    /// The buffers of a cloth on the device, up to date and idle until the next advance(), which submits to
    /// queue 0 of the family. Empty for soft bodies, and unless the backend is vulkan. Throws
    /// Error(device_failure) if the device is lost. `position` alternates between two buffers, so ask again
    /// after every advance().
    std::optional<DeviceBuffers> device_buffers(std::size_t cloth = 0);
    /// See DeviceBuffers: the backend's order of a cloth's nodes, which all other functions hide.
    std::span<const std::uint32_t> node_of_vertex(std::size_t cloth = 0) const;
    /// For Pliant's own renderer; null unless the backend is vulkan.
    DeviceState* device_state();

private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace pliant

// The parts of a Simulation: the models of its cloths and bodies, the runner that steps them, and numbers
// read back. stepping.cpp steps, reading.cpp reads; simulation.cpp is the public interface.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "backend/pass_runner.hpp"
#include "backend/vulkan/vulkan_runner.hpp"
#include "body/cloth_model.hpp"
#include "pliant/simulation.hpp"
#include "simulation/hand.hpp"
#include "simulation/held_springs.hpp"
#include "solve/frame.hpp"

namespace pliant {

/// For messages: "0.00123 s".
std::string text_of_seconds(double s);

class Simulation::Implementation {
public:
    Implementation(const Scene& given, const SimulationOptions& options);
    /// A model of each cloth, and of each group of soft bodies that are stepped together.
    void make_models();
    /// Creates the runner and measures the initial state.
    void start_runner(const SimulationOptions& options);
    void measure();

    /// Number and length of the steps for a duration.
    std::pair<std::uint64_t, double> steps_of(double duration) const;
    void refuse_too_many_steps() const;

    void advance(double duration);
    void run_steps(std::uint32_t steps, double step);
    void run_program(const Program& program, std::uint32_t steps, double step);
    /// Repeats the steps of a cloth in shorter ones if they were not solved, or overstretched its limits at
    /// once.
    void cut_steps(std::uint32_t model, std::uint32_t steps, double step, std::uint32_t from_parity,
                   double stretch_before);
    Kept kept(std::uint32_t model, std::uint32_t steps, std::uint32_t from_parity) const;
    /// Rescales the memory of limits and contact to steps of this length.
    void fit_memory(std::uint32_t model, double step);
    double solver_number(std::uint32_t model, int scalar)
    {
        return runner->solver_scalar(model, static_cast<std::size_t>(scalar));
    }
    /// Adds the solver's counters of the last program.
    void count_solves();
    /// Rounds a time to a whole frame if it is within a millionth of a frame: sums of 1/60 must reach 5.0.
    double on_frame(double time, double advanced) const;
    /// With `only`, the frame of that model alone.
    const Program& frame_program(std::uint32_t steps, std::uint32_t only = no_cloth);
    /// Uses memory that is already allocated: the reason may be a lack of memory.
    void stop(std::string_view reason) noexcept;

    void place_colliders(std::uint32_t steps, double step);
    /// Colliders that jump also let nodes rise.
    void find_jumps(std::uint32_t steps, double step);
    void place_attached(std::uint32_t steps, double step);
    /// Target volumes and pressures of bodies at the end of each step.
    void place_goals(std::uint32_t steps, double step);
    FrameInput input(double step) const;

    /// Sets the mass of the hand's node for steps of this length; 0: its own mass.
    void hold(double step);
    void grab(std::size_t cloth, std::size_t node, Vec3d target, double stiffness, double damping);
    void release();

    State state();
    void set_state(const State& state);

    void take_measures();
    void measure_volumes();
    void find_bad_node();

    std::span<const Vec3> values(std::size_t cloth, Resource resource);
    /// Numbers of all nodes of a model, read once for each state.
    const std::vector<float>& read_model(std::uint32_t model, Resource resource);
    /// The same of one cloth, by vertex.
    void read_cloth(std::size_t cloth, Resource resource, std::vector<float>& into);
    std::vector<SpringListing> springs(std::size_t cloth) const;
    std::span<const float> strains(std::size_t cloth);
    std::span<const float> multipliers(std::size_t cloth);
    std::span<const std::uint32_t> held_springs(std::size_t cloth);
    /// Normals and strains are computed only when they are read.
    void update_drawing(std::size_t cloth);
    template <class Count>
    std::uint64_t total(Count count) const
    {
        std::uint64_t sum = 0;
        for (const ClothModel& model : models) sum += std::invoke(count, model);
        return sum;
    }

    static constexpr std::uint64_t most_steps_at_once = 4096;
    /// Nodes times steps of one submission: drivers reset a GPU that is busy for seconds.
    static constexpr std::uint64_t most_work_at_once = 500'000'000;
    static constexpr std::size_t most_programs =
        32;  ///< so that a host with varying frame lengths does not fill the memory

    /// Numbers read back from a cloth, and the state they belong to. Kept from frame to frame, so that
    /// reading allocates only once.
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
        float farthest = 0;                         ///< m, the largest absolute coordinate at the start
        std::vector<std::uint32_t> node_of_vertex;  ///< relative to first_node; empty if the order is the
                                                    ///< same
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
    double memory_step = 0;  ///< s, length of the steps that the solvers' memory fits; 0: no memory yet
    bool colliders_rest = true;
    std::optional<Hand> hand;
    std::vector<PlacedCollider> placed;
    std::vector<std::vector<Vec3>> attached;  ///< by cloth, see FrameInput
    /// By number of steps, parity, model of the hand's node, and model that is stepped alone.
    std::map<std::array<std::uint32_t, 4>, Program> programs;
    /// By model and parity.
    std::map<std::pair<std::uint32_t, std::uint32_t>, Program> drawing_programs, multiplier_programs;
    std::uint64_t next_program_id = 1;
    std::uint32_t parity = 0;
    std::uint64_t state_number = 1;  ///< number of the present state; 0 means none
    std::vector<ReadBack> read_backs;
    std::vector<std::map<Resource, ReadBack::Values<float>>> read_models;
    std::vector<std::optional<HeldSprings>> held;  ///< by cloth, made when first asked for
    std::vector<std::uint64_t> drawn;              ///< by model: the state of the last normals and strains
    std::vector<std::vector<VolumeGoal>> goals;    ///< by model, see FrameInput
    double loss_sum = 0;
    Report report;
    double newton_sum = 0, iterations_sum = 0, active_sum = 0;  ///< of the solver, over the whole run
    std::vector<double> stretches_before;  ///< maximum strain of each cloth before the current steps
    /// By collider: 1 while nodes inside it, from the start or after a jump, are still rising.
    std::vector<std::uint8_t> lets_rise;
    std::vector<std::string> start_warnings;  ///< warnings about the scene's start
    double owed_seconds = 0;  ///< time asked for but not yet stepped: at most half a step, either sign
    double idle_seconds = 0;  ///< time asked for after the run had ended
};

}  // namespace pliant

// What a Simulation is made of: the models of its cloths and bodies, the runner that steps them, and what was
// read back. Stepping is in stepping.cpp, reading in reading.cpp; simulation.cpp is the public face.
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

/// As a message tells it: "0.00123 s".
std::string text_of_seconds(double s);

class Simulation::Implementation {
public:
    Implementation(const Scene& given, const SimulationOptions& options);
    /// A model of each cloth, and of soft bodies that can be stepped as one.
    void make_models();
    /// Makes the runner and lets it measure the start.
    void start_runner(const SimulationOptions& options);
    void measure();

    /// Steps of a stretch of time, and how long each is.
    std::pair<std::uint64_t, double> steps_of(double duration) const;
    void refuse_too_many_steps() const;

    void advance(double duration);
    void run_steps(std::uint32_t steps, double step);
    void run_program(const Program& program, std::uint32_t steps, double step);
    /// Takes the steps of a cloth that were not solved, or stretched its limits at once, anew in shorter
    /// ones.
    void cut_steps(std::uint32_t model, std::uint32_t steps, double step, std::uint32_t from_parity,
                   double stretch_before);
    Kept kept(std::uint32_t model, std::uint32_t steps, std::uint32_t from_parity) const;
    /// Of limits and contact, that they are of steps of this length from now on.
    void fit_memory(std::uint32_t model, double step);
    double solver_number(std::uint32_t model, int scalar)
    {
        return runner->solver_scalar(model, static_cast<std::size_t>(scalar));
    }
    /// Adds the solver's counters of the program that has just run.
    void count_solves();
    /// A time within a millionth of a frame of a whole frame is that frame's: sums of 1/60 must reach 5.0.
    double on_frame(double time, double advanced) const;
    /// With `only`, the frame of that model alone.
    const Program& frame_program(std::uint32_t steps, std::uint32_t only = no_cloth);
    /// Keeps the reason in memory that is there already: this may be about memory.
    void stop(std::string_view reason) noexcept;

    void place_colliders(std::uint32_t steps, double step);
    /// Colliders that are somewhere else all at once let nodes rise, too.
    void find_jumps(std::uint32_t steps, double step);
    void place_attached(std::uint32_t steps, double step);
    /// The volumes and pressures of bodies at the end of each step.
    void place_goals(std::uint32_t steps, double step);
    FrameInput input(double step) const;

    /// Makes the held node as heavy as it is in the hand, in steps of this length; with 0, as it is without.
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
    /// Normals and strains are computed only when someone looks.
    void update_drawing(std::size_t cloth);
    template <class Count>
    std::uint64_t total(Count count) const
    {
        std::uint64_t sum = 0;
        for (const ClothModel& model : models) sum += std::invoke(count, model);
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
    double memory_step = 0;  ///< s, of the steps that solvers remember things of; 0: of none yet
    bool colliders_rest = true;
    std::optional<Hand> hand;
    std::vector<PlacedCollider> placed;
    std::vector<std::vector<Vec3>> attached;  ///< by cloth, see FrameInput
    /// By steps, parity, the model that a hand holds, and that which is stepped alone.
    std::map<std::array<std::uint32_t, 4>, Program> programs;
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
    std::vector<double> stretches_before;  ///< of each cloth, when the steps at hand began
    /// By collider: 1 while nodes that started in it, or that it was put over, are on their way out.
    std::vector<std::uint8_t> lets_rise;
    std::vector<std::string> start_warnings;  ///< what there is to say of the scene's start
    double owed_seconds = 0;  ///< asked for and not stepped yet: at most half a step, either way
    double idle_seconds = 0;  ///< asked for after the run had ended
};

}  // namespace pliant

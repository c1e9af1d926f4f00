// Steps a simulation on a thread of its own, and keeps what is to be seen of its last states.
#pragma once

#include <array>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "pliant/simulation.hpp"
#include "render/picture_source.hpp"

namespace pliant::tool {

/// What is seen of a state.
struct SeenState {
    PictureSource source;
    OverlaySet overlays;                 ///< that `source` was gathered for
    std::vector<vulkan::Buffer> copies;  ///< of positions on the device, by cloth; where that is direct
    vk::raii::CommandBuffer commands{nullptr};
    vk::raii::Fence copied{nullptr};
};

/// Numbers of a step that are plotted.
struct StepNumbers {
    FrameMeasures measures;
    double volume = 0, active = 0, iterations = 0, residual = 0;
    double milliseconds = 0;  ///< of the step
};

/// Whoever shows states calls it from one thread. Between `start` and the end of its steps the simulation
/// belongs to the stepper's thread; when it is idle, to the caller: `busy_`, which changes under `mutex_`,
/// hands it over. States come in a ring of five: the two that are shown, the last two, and one that is being
/// filled. Their places are named under `mutex_`, and what is in a place that is named to others does not
/// change: so there is no lock around a step, and neither thread waits for the other.
class Stepper {
public:
    static constexpr unsigned most_steps = 16;
    static constexpr unsigned steps_between_times = 20;  ///< of passes

    explicit Stepper(std::shared_ptr<vulkan::Device> device);
    ~Stepper();
    Stepper(const Stepper&) = delete;
    Stepper& operator=(const Stepper&) = delete;

    bool is_idle() const;
    /// Begins no step after the one that runs.
    void interrupt();
    /// Until it is idle, at most for some seconds.
    void wait(double seconds);

    // When it is idle:
    /// From now on it is this one; what is seen is its state.
    void attach(Simulation& simulation, OverlaySet overlays);
    /// Before the simulation goes.
    void detach();
    /// What is seen is the state of now, with none before it.
    void look(OverlaySet overlays);
    /// The same state with other overlays.
    void look_again(OverlaySet overlays);
    /// Begins `steps` frames of the simulation, at most `most_steps`.
    void start(unsigned steps, OverlaySet overlays);

    /// Steps made since it was asked last, oldest first; returns their number.
    unsigned take(std::array<StepNumbers, most_steps>& numbers);
    /// Times of passes, when there are newer ones: they come after every `steps_between_times` steps.
    bool take_pass_times(std::vector<PassTime>& times);
    /// Seconds that filling states took since it was asked last.
    double take_seconds_of_states();
    /// A sentence when the device failed; empty otherwise.
    std::string take_failure();

    /// The last two states; they stay as they are until the next call.
    struct Seen {
        const SeenState& before;
        const SeenState& last;
    };
    Seen hold();

private:
    void work();
    void step();
    unsigned free_place() const;
    void fill(SeenState& state, OverlaySet overlays);
    void copy_on_device(SeenState& state, const SeenState* instead);

    std::shared_ptr<vulkan::Device> device_;
    vulkan::CommandLane lane_;
    Simulation* simulation_ = nullptr;
    std::array<SeenState, 5> states_;

    mutable std::mutex mutex_;  // for all below
    std::condition_variable begun_, ended_;
    unsigned before_ = 0, last_ = 0, shown_before_ = 0, shown_last_ = 0;
    unsigned left_ = 0, steps_timed_ = 0;
    bool busy_ = false, quit_ = false, times_are_new_ = false;
    OverlaySet overlays_;
    std::array<StepNumbers, most_steps> numbers_;
    unsigned made_ = 0;
    std::vector<PassTime> times_, newer_times_;
    double seconds_of_states_ = 0;
    std::string failure_;
    std::thread thread_;  // the last, so that all is there when it begins
};

}  // namespace pliant::tool

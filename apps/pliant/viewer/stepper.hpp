// Steps a simulation on its own thread, and keeps its last states for drawing.
#pragma once

#include <array>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "pliant/simulation.hpp"
#include "render/picture_source.hpp"

namespace pliant::tool {

/// A state for drawing.
struct SeenState {
    PictureSource source;
    OverlaySet overlays;                 ///< for which `source` was gathered
    std::vector<vulkan::Buffer> copies;  ///< of positions on the device, by cloth, if drawing is direct
    vk::raii::CommandBuffer commands{nullptr};
    vk::raii::Fence copied{nullptr};
};

/// Numbers of a step for plots.
struct StepNumbers {
    FrameMeasures measures;
    double volume = 0, active = 0, iterations = 0, residual = 0;
    double milliseconds = 0;  ///< of the step
};

/// One thread calls it and shows states. Between `start` and the end of its steps the simulation belongs to
/// the stepper's thread, and while idle to the caller: `busy_`, which changes under `mutex_`, transfers it.
/// States are in a ring of five: the two shown, the last two, and one being filled. Indices into the ring
/// change under `mutex_`, and a published state does not change. So no lock is held during a step, and
/// neither thread waits for the other.
/// change: so there is no lock around a step, and neither thread waits for the other.
class Stepper {
public:
    static constexpr unsigned most_steps = 16;
    static constexpr unsigned steps_between_times = 20;  ///< times of passes are read after so many steps

    explicit Stepper(std::shared_ptr<vulkan::Device> device);
    ~Stepper();
    Stepper(const Stepper&) = delete;
    Stepper& operator=(const Stepper&) = delete;

    bool is_idle() const;
    /// Starts no further step after the current one.
    void interrupt();
    /// Waits until it is idle, at most `seconds`.
    void wait(double seconds);

    // Only while idle:
    /// Switches to this simulation and publishes its state.
    void attach(Simulation& simulation, OverlaySet overlays);
    /// Call it before the simulation is destroyed.
    void detach();
    /// Publishes the present state, without a previous one.
    void look(OverlaySet overlays);
    /// Publishes the same state with other overlays.
    void look_again(OverlaySet overlays);
    /// Starts `steps` frames of the simulation, at most `most_steps`.
    void start(unsigned steps, OverlaySet overlays);

    /// Steps since the last call, oldest first; returns their number.
    unsigned take(std::array<StepNumbers, most_steps>& numbers);
    /// Times of passes, if there are new ones: after every `steps_between_times` steps.
    bool take_pass_times(std::vector<PassTime>& times);
    /// Seconds spent filling states since the last call.
    double take_seconds_of_states();
    /// A sentence if the device failed; else empty.
    std::string take_failure();

    /// The last two states; unchanged until the next call.
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

    mutable std::mutex mutex_;  // guards all below
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
    std::thread thread_;  // declared last, so that all else exists when it starts
};

}  // namespace pliant::tool

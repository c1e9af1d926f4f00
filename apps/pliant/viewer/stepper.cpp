#include "viewer/stepper.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "backend/vulkan/device_state.hpp"
#include "stopwatch.hpp"

namespace pliant::tool {
namespace {

StepNumbers numbers_of(const Report& report, double seconds)
{
    StepNumbers numbers;
    numbers.measures = report.measures;
    if (!report.bodies.empty()) numbers.volume = report.bodies.front().ratio;
    numbers.active = static_cast<double>(report.solver.active_last);
    numbers.iterations = report.solver.iterations_last;
    numbers.residual = report.solver.residual_last;
    numbers.milliseconds = 1000 * seconds;
    return numbers;
}

}  // namespace

Stepper::Stepper(std::shared_ptr<vulkan::Device> device) : device_(std::move(device)), lane_(*device_)
{
    for (SeenState& state : states_) {
        state.commands = lane_.make_commands();
        state.copied = {device_->handle(), vk::FenceCreateInfo(vk::FenceCreateFlagBits::eSignaled)};
    }
    thread_ = std::thread([this] { work(); });
}

Stepper::~Stepper()
{
    {
        const std::scoped_lock lock(mutex_);
        quit_ = true;
        left_ = 0;
    }
    begun_.notify_one();
    thread_.join();
    device_->wait_idle();  // copies may be in flight
}

bool Stepper::is_idle() const
{
    const std::scoped_lock lock(mutex_);
    return !busy_;
}

void Stepper::interrupt()
{
    const std::scoped_lock lock(mutex_);
    left_ = 0;
}

void Stepper::wait(double seconds)
{
    std::unique_lock lock(mutex_);
    constexpr double longest = 1e6;  // keeps the duration finite
    ended_.wait_for(lock, std::chrono::duration<double>(std::min(seconds, longest)), [&] { return !busy_; });
}

void Stepper::attach(Simulation& simulation, OverlaySet overlays)
{
    simulation_ = &simulation;
    times_.clear();
    newer_times_.clear();
    times_are_new_ = false;
    steps_timed_ = 0;
    made_ = 0;
    look(overlays);
}

void Stepper::detach()
{
    simulation_ = nullptr;
    for (SeenState& state : states_) state.copies.clear();
}

void Stepper::look(OverlaySet overlays)
{
    const unsigned place = free_place();
    fill(states_[place], overlays);
    before_ = last_ = place;
}

void Stepper::look_again(OverlaySet overlays)
{
    states_[last_].source.gather_overlays(*simulation_, overlays);
    states_[last_].overlays = overlays;
}

void Stepper::start(unsigned steps, OverlaySet overlays)
{
    {
        const std::scoped_lock lock(mutex_);
        left_ = std::min(steps, most_steps - made_);
        overlays_ = overlays;
        busy_ = left_ > 0;
    }
    begun_.notify_one();
}

unsigned Stepper::take(std::array<StepNumbers, most_steps>& numbers)
{
    const std::scoped_lock lock(mutex_);
    std::copy_n(numbers_.begin(), made_, numbers.begin());
    return std::exchange(made_, 0u);
}

bool Stepper::take_pass_times(std::vector<PassTime>& times)
{
    const std::scoped_lock lock(mutex_);
    if (!std::exchange(times_are_new_, false)) return false;
    times = newer_times_;  // copied, so that names keep their memory
    return true;
}

double Stepper::take_seconds_of_states()
{
    const std::scoped_lock lock(mutex_);
    return std::exchange(seconds_of_states_, 0.0);
}

std::string Stepper::take_failure()
{
    const std::scoped_lock lock(mutex_);
    return std::exchange(failure_, {});
}

Stepper::Seen Stepper::hold()
{
    const std::scoped_lock lock(mutex_);
    shown_before_ = before_;
    shown_last_ = last_;
    return {states_[shown_before_], states_[shown_last_]};
}

unsigned Stepper::free_place() const
{
    for (unsigned k = 0; k < states_.size(); ++k)
        if (k != before_ && k != last_ && k != shown_before_ && k != shown_last_) return k;
    return 0;  // unreachable: at most four of five are in use
}

void Stepper::work()
{
    std::unique_lock lock(mutex_);
    for (;;) {
        begun_.wait(lock, [&] { return busy_ || quit_; });
        if (quit_) return;
        while (left_ > 0) {
            --left_;
            lock.unlock();
            try {
                step();
                lock.lock();
            } catch (const std::exception& error) {  // steps do not throw; copies from a lost device do
                lock.lock();
                failure_ = error.what();
                left_ = 0;
            }
        }
        busy_ = false;
        ended_.notify_all();
    }
}

void Stepper::step()
{
    const auto start = Clock::now();
    simulation_->advance(1 / simulation_->scene().time.frame_rate);
    const double seconds = seconds_since(start);
    const bool timed = ++steps_timed_ % steps_between_times == 0;
    if (timed) simulation_->pass_times(times_);
    unsigned place = 0;
    OverlaySet overlays;
    {
        const std::scoped_lock lock(mutex_);
        place = free_place();
        overlays = overlays_;
    }
    const auto filling = Clock::now();
    fill(states_[place], overlays);
    const std::scoped_lock lock(mutex_);
    seconds_of_states_ += seconds_since(filling);
    before_ = last_;
    last_ = place;
    numbers_[made_++] = numbers_of(simulation_->report(), seconds);
    if (!timed) return;
    newer_times_ = times_;
    times_are_new_ = true;
}

void Stepper::fill(SeenState& state, OverlaySet overlays)
{
    // Diverging nodes are not visible, and software rasterisers take minutes for their triangles; the last
    // state before is kept.
    constexpr double fastest_drawn = 1e6;  // m/s
    const Report& report = simulation_->report();
    const bool drawn = report.finite && report.measures.max_speed < fastest_drawn;
    const SeenState& last = states_[last_];
    if (PictureSource::is_direct(*simulation_))
        copy_on_device(state, drawn || last.copies.empty() ? nullptr : &last);
    state.source.gather(*simulation_, overlays, drawn ? nullptr : &last.source);
    state.overlays = overlays;
}

void Stepper::copy_on_device(SeenState& state, const SeenState* instead)
{
    using Stage = vk::PipelineStageFlagBits;
    using Access = vk::AccessFlagBits;
    const std::size_t count = simulation_->scene().cloth_count();
    const auto bytes = [&](std::size_t cloth) {
        return vk::DeviceSize{4} * sizeof(float) * simulation_->node_count(cloth);
    };
    if (state.copies.empty())
        for (std::size_t c = 0; c < count; ++c)
            state.copies.push_back(device_->make_buffer(bytes(c), vk::BufferUsageFlagBits::eStorageBuffer,
                                                        vulkan::Memory::device, "positions of a state"));
    if (device_->handle().waitForFences(*state.copied, VK_TRUE, UINT64_MAX) != vk::Result::eSuccess)
        throw Error(ErrorKind::device_failure, "the device " + device_->info().name + " does not answer");
    device_->handle().resetFences(*state.copied);
    const vk::raii::CommandBuffer& commands = state.commands;
    commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    // After the computation of positions, and after drawing from the buffers to be overwritten.
    vulkan::barrier(commands, Stage::eComputeShader | Stage::eTransfer,
                    Access::eShaderWrite | Access::eTransferWrite, Stage::eTransfer,
                    Access::eTransferRead | Access::eTransferWrite);
    for (std::size_t c = 0; c < count; ++c)
        commands.copyBuffer(
            instead ? *instead->copies[c] : simulation_->device_state()->positions_on_device(c),
            *state.copies[c], vk::BufferCopy(0, 0, bytes(c)));
    vulkan::barrier(commands, Stage::eTransfer, Access::eTransferWrite, Stage::eComputeShader,
                    Access::eShaderRead | Access::eShaderWrite);
    commands.end();
    const vk::CommandBuffer handle = *commands;
    device_->submit(vk::SubmitInfo({}, {}, handle), *state.copied);
}

}  // namespace pliant::tool

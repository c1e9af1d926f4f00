#include "viewer/screen.hpp"

#include "pliant/error.hpp"
#include "render/offscreen_target.hpp"
#include "stopwatch.hpp"

namespace pliant::tool {
namespace {

/// Adds its lifetime to a sum of seconds.
class Stopwatch {
public:
    explicit Stopwatch(double& seconds) : seconds_(seconds) {}
    ~Stopwatch() { seconds_ += seconds_since(start_); }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

private:
    double& seconds_;
    Clock::time_point start_ = Clock::now();
};

class HeadlessScreen final : public Screen {
public:
    HeadlessScreen(std::shared_ptr<vulkan::Device> device, vk::Extent2D size) : Screen(std::move(device))
    {
        HeadlessScreen::resize(size.width, size.height);
    }
    ~HeadlessScreen() override { device_->wait_idle(); }

    vulkan::PicturePassHandles passes() const override { return target_->target().passes; }
    vk::Extent2D size() const override { return size_; }
    void poll(std::vector<Event>&) override {}
    bool read(Image& into) override
    {
        device_->wait_idle();
        target_->read(into);
        return true;
    }
    void resize(std::uint32_t width, std::uint32_t height) override
    {
        size_ = vk::Extent2D{width, height};
        if (width == 0 || height == 0) return;
        device_->wait_idle();
        // The first target is kept: pipelines refer to its passes.
        auto next = std::make_unique<vulkan::OffscreenTarget>(*device_, size_);
        if (!first_)
            first_ = std::move(next), target_ = first_.get();
        else
            resized_ = std::move(next), target_ = resized_.get();
    }

private:
    std::optional<vulkan::PictureTarget> next_target(vk::Semaphore) override
    {
        if (size_.width == 0 || size_.height == 0) return std::nullopt;
        return target_->target();
    }
    void record_copy(const vk::raii::CommandBuffer& commands) override { target_->record_copy(commands); }

    vk::Extent2D size_;
    std::unique_ptr<vulkan::OffscreenTarget> first_, resized_;
    vulkan::OffscreenTarget* target_ = nullptr;
};

}  // namespace

Screen::Screen(std::shared_ptr<vulkan::Device> device) : device_(std::move(device))
{
    if (!device_->can_draw())
        throw Error(ErrorKind::device_failure,
                    "the device " + device_->info().name +
                        " computes but does not draw; choose another with --device");
    for (Slot& slot : slots_) {
        slot.commands = device_->make_commands();
        slot.done = {device_->handle(), vk::FenceCreateInfo(vk::FenceCreateFlagBits::eSignaled)};
        slot.free = {device_->handle(), vk::SemaphoreCreateInfo{}};
    }
}

std::optional<FramePlace> Screen::begin()
{
    const Stopwatch watch(driver_seconds_);
    const Slot& slot = slots_[next_];
    if (device_->handle().waitForFences(*slot.done, VK_TRUE, UINT64_MAX) != vk::Result::eSuccess)
        throw Error(ErrorKind::device_failure, "the device " + device_->info().name + " does not answer");
    const auto target = next_target(*slot.free);
    if (!target) return std::nullopt;
    slot.commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    return FramePlace{next_, &slot.commands, *target};
}

void Screen::finish(const FramePlace& place, bool kept)
{
    const Stopwatch watch(driver_seconds_);
    const Slot& slot = slots_[place.slot];
    if (kept) record_copy(slot.commands);
    slot.commands.end();
    const vk::Semaphore drawn_semaphore = drawn(), free = *slot.free;
    const vk::PipelineStageFlags where = vk::PipelineStageFlagBits::eColorAttachmentOutput;
    const vk::CommandBuffer commands = *slot.commands;
    vk::SubmitInfo submit;
    submit.setCommandBuffers(commands);
    if (drawn_semaphore)
        submit.setWaitSemaphores(free).setWaitDstStageMask(where).setSignalSemaphores(drawn_semaphore);
    device_->handle().resetFences(*slot.done);
    device_->submit(submit, *slot.done);
    present();
    next_ = (next_ + 1) % slots;
}

double Screen::take_driver_seconds() { return std::exchange(driver_seconds_, 0.0); }

std::unique_ptr<Screen> make_headless_screen(const vulkan::DeviceOptions& device, std::uint32_t width,
                                             std::uint32_t height)
{
    return std::make_unique<HeadlessScreen>(std::make_shared<vulkan::Device>(device),
                                            vk::Extent2D{width, height});
}

}  // namespace pliant::tool

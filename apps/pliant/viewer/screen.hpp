// The target of a viewer's pictures: a window, or off-screen images.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pliant/render.hpp"
#include "render/picture_pass.hpp"
#include "viewer/event.hpp"

struct GLFWwindow;

namespace pliant::tool {

/// A picture in preparation. Up to `slots` may be in flight.
struct FramePlace {
    unsigned slot = 0;
    const vk::raii::CommandBuffer* commands = nullptr;  ///< begun
    vulkan::PictureTarget target;
};

class Screen {
public:
    static constexpr unsigned slots = 3;

    virtual ~Screen() = default;
    const std::shared_ptr<vulkan::Device>& device() const { return device_; }
    virtual vulkan::PicturePassHandles passes() const = 0;
    virtual vk::Extent2D size() const = 0;

    /// Appends the events since the last call.
    virtual void poll(std::vector<Event>& events) = 0;
    /// Waits for a free place; empty if there is nothing to draw to, as in a minimised window.
    std::optional<FramePlace> begin();
    /// Submits and presents it. If `kept`, the picture can be read afterwards, which waits for it.
    void finish(const FramePlace& place, bool kept);
    /// Reads the kept picture; false if the screen does not support it.
    virtual bool read(Image& into) = 0;

    virtual void resize(std::uint32_t width, std::uint32_t height) = 0;
    virtual void set_title(const std::string&) {}
    /// Simulates the loss of the window's surface before the next picture; does nothing without a window.
    virtual void lose_surface() {}
    /// Seconds spent in the driver by begin and finish since the last call.
    double take_driver_seconds();

protected:
    explicit Screen(std::shared_ptr<vulkan::Device> device);

    /// The target to draw to; empty if there is none. `free`: signalled when drawing may begin.
    virtual std::optional<vulkan::PictureTarget> next_target(vk::Semaphore free) = 0;
    virtual void record_copy(const vk::raii::CommandBuffer& commands) = 0;
    /// Semaphores that drawing waits for and signals; null if none.
    virtual vk::Semaphore drawn() const { return nullptr; }
    virtual void present() {}

    std::shared_ptr<vulkan::Device> device_;

private:
    struct Slot {
        vk::raii::CommandBuffer commands{nullptr};
        vk::raii::Fence done{nullptr};
        vk::raii::Semaphore free{nullptr};
    };
    std::array<Slot, slots> slots_;
    unsigned next_ = 0;
    double driver_seconds_ = 0;
};

/// Off-screen pictures of this size. Throws Error(device_failure) if no device can draw them.
std::unique_ptr<Screen> make_headless_screen(const vulkan::DeviceOptions& device, std::uint32_t width,
                                             std::uint32_t height);
/// A window. Throws Error(device_failure) if there is no display, or no device can present in it.
std::unique_ptr<Screen> make_window_screen(const vulkan::DeviceOptions& device, std::uint32_t width,
                                           std::uint32_t height, const std::string& title);

}  // namespace pliant::tool

// Where a viewer's pictures go: a window, or nowhere but into files.
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

/// A picture that is being made. As many as there are slots may be on their way.
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

    /// What has happened since it was asked last.
    virtual void poll(std::vector<Event>& events) = 0;
    /// Waits until a place is free; nothing while there is nothing to draw to, as in a minimised window.
    std::optional<FramePlace> begin();
    /// Submits and shows it. With `kept`, the picture can be read afterwards, which waits for it.
    void finish(const FramePlace& place, bool kept);
    /// The picture that was kept; false when the screen cannot give it.
    virtual bool read(Image& into) = 0;

    virtual void resize(std::uint32_t width, std::uint32_t height) = 0;
    virtual void set_title(const std::string&) {}
    /// The next picture finds the surface of its window lost; nothing without a window.
    virtual void lose_surface() {}
    /// Seconds that begin and finish spent in the driver since this was asked last.
    double take_driver_seconds();

protected:
    explicit Screen(std::shared_ptr<vulkan::Device> device);

    /// What to draw to; nothing while there is nothing. `free`: signalled when it may be drawn to.
    virtual std::optional<vulkan::PictureTarget> next_target(vk::Semaphore free) = 0;
    virtual void record_copy(const vk::raii::CommandBuffer& commands) = 0;
    /// Semaphores that the drawing waits for and signals; null where there is nothing to wait for.
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

/// Pictures of this size that no one sees. Throws Error(device_failure) when there is no device for it.
std::unique_ptr<Screen> make_headless_screen(const vulkan::DeviceOptions& device, std::uint32_t width,
                                             std::uint32_t height);
/// A window. Throws Error(device_failure) when there is no display, or no device that can show pictures in
/// it.
std::unique_ptr<Screen> make_window_screen(const vulkan::DeviceOptions& device, std::uint32_t width,
                                           std::uint32_t height, const std::string& title);

}  // namespace pliant::tool

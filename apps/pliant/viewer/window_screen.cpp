// A GLFW window.
#define GLFW_INCLUDE_NONE
#include <vulkan/vulkan.h>

#include <GLFW/glfw3.h>

#include "pliant/error.hpp"
#include "render/window_target.hpp"
#include "viewer/screen.hpp"

namespace pliant::tool {
namespace {

/// The lifetime of GLFW.
class Library {
public:
    Library()
    {
        glfwSetErrorCallback([](int, const char* text) { complaint() = text; });
        if (!glfwInit()) refuse();
        if (!glfwVulkanSupported()) {
            glfwTerminate();
            throw Error(ErrorKind::device_failure,
                        "no Vulkan driver that can draw in a window was found: install one (on Debian, "
                        "mesa-vulkan-drivers), or use --headless");
        }
    }
    ~Library() { glfwTerminate(); }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;

    static std::string& complaint()
    {
        static std::string text;
        return text;
    }
    [[noreturn]] static void refuse()
    {
        throw Error(ErrorKind::device_failure,
                    "a window cannot be opened here: " + complaint() +
                        "; run it where there is a display (DISPLAY or WAYLAND_DISPLAY), or use --headless");
    }
};

struct DestroyWindow {
    void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};
using Window = std::unique_ptr<GLFWwindow, DestroyWindow>;

Window make_window(std::uint32_t width, std::uint32_t height, const std::string& title)
{
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    Window window(
        glfwCreateWindow(static_cast<int>(width), static_cast<int>(height), title.c_str(), nullptr, nullptr));
    if (!window) Library::refuse();
    return window;
}

std::shared_ptr<vulkan::Device> make_device(vulkan::DeviceOptions options)
{
    std::uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    options.surface_extensions.assign(names, names + count);
    return std::make_shared<vulkan::Device>(options);
}

class WindowScreen final : public Screen {
public:
    WindowScreen(Window window, std::shared_ptr<vulkan::Device> device)
        : Screen(std::move(device)), window_(std::move(window))
    {
        open_surface();
        glfwSetWindowUserPointer(window_.get(), this);
        listen();
    }
    ~WindowScreen() override
    {
        device_->wait_idle();
        target_->clear();
    }

    vulkan::PicturePassHandles passes() const override { return target_->passes(); }
    vk::Extent2D size() const override { return target_->size(); }

    void poll(std::vector<Event>& events) override
    {
        // A minimised window sleeps until an event arrives.
        if (target_->has_images() && !minimised_)
            glfwPollEvents();
        else
            glfwWaitEventsTimeout(0.1);
        events.insert(events.end(), events_.begin(), events_.end());
        events_.clear();
        if (glfwWindowShouldClose(window_.get())) events.push_back({.kind = Event::Kind::close});
    }
    bool read(Image& into) override
    {
        if (!copied_) return false;
        device_->wait_idle();
        target_->read(into);
        return true;
    }
    void resize(std::uint32_t width, std::uint32_t height) override
    {
        if (width == 0 || height == 0) {
            glfwIconifyWindow(window_.get());
        } else {
            glfwRestoreWindow(window_.get());
            glfwSetWindowSize(window_.get(), static_cast<int>(width), static_cast<int>(height));
        }
        stale_ = true;
    }
    void lose_surface() override { lost_ = true; }
    void set_title(const std::string& title) override { glfwSetWindowTitle(window_.get(), title.c_str()); }

private:
    void open_surface()
    {
        VkSurfaceKHR surface = VK_NULL_HANDLE;
        if (glfwCreateWindowSurface(static_cast<VkInstance>(*device_->instance()), window_.get(), nullptr,
                                    &surface) != VK_SUCCESS)
            Library::refuse();
        surface_ = {device_->instance(), surface};
        target_.emplace(*device_, *surface_);
        rebuild();
    }

    void rebuild()
    {
        int width = 0, height = 0;
        glfwGetFramebufferSize(window_.get(), &width, &height);
        device_->wait_idle();
        target_->resize(*device_, {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)});
        stale_ = false;
    }

    /// After the loss of the surface, as after a restart of the compositor: creates another one of the same
    /// format.
    void replace_surface()
    {
        device_->wait_idle();
        target_->replace_surface([&] {
            surface_ = nullptr;
            VkSurfaceKHR surface = VK_NULL_HANDLE;
            if (glfwCreateWindowSurface(static_cast<VkInstance>(*device_->instance()), window_.get(), nullptr,
                                        &surface) != VK_SUCCESS)
                Library::refuse();
            surface_ = {device_->instance(), surface};
            return *surface_;
        });
        rebuild();
    }

    std::optional<vulkan::PictureTarget> next_target(vk::Semaphore free) override
    {
        for (int attempt = 0; attempt < 3; ++attempt) {
            try {
                int width = 0, height = 0;
                glfwGetFramebufferSize(window_.get(), &width, &height);
                // Some systems keep the size of a minimised window.
                minimised_ =
                    width == 0 || height == 0 || glfwGetWindowAttrib(window_.get(), GLFW_ICONIFIED) != 0;
                if (minimised_) {
                    stale_ = true;
                    return std::nullopt;
                }
                if (std::exchange(lost_, false)) throw vk::SurfaceLostKHRError("as an event said");
                if (stale_ || !target_->has_images()) rebuild();
                if (!target_->has_images()) return std::nullopt;
                if (const auto image = target_->acquire(free)) {
                    image_ = *image;
                    return target_->target(image_);
                }
                stale_ = true;
            } catch (const vk::SurfaceLostKHRError&) {
                replace_surface();
            }
        }
        return std::nullopt;
    }
    void record_copy(const vk::raii::CommandBuffer& commands) override
    {
        copied_ = target_->record_copy(*device_, commands, image_);
    }
    vk::Semaphore drawn() const override { return target_->drawn(image_); }
    void present() override
    {
        try {
            if (!target_->present(*device_, image_)) stale_ = true;
        } catch (const vk::SurfaceLostKHRError&) {
            replace_surface();
        }
    }

    static void add(GLFWwindow* window, Event event)
    {
        static_cast<WindowScreen*>(glfwGetWindowUserPointer(window))->events_.push_back(std::move(event));
    }
    void listen()
    {
        using Kind = Event::Kind;
        GLFWwindow* window = window_.get();
        glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int) {
            if (action != GLFW_REPEAT) add(w, {.kind = Kind::key, .code = key, .down = action == GLFW_PRESS});
        });
        glfwSetCharCallback(window, [](GLFWwindow* w, unsigned letter) {
            add(w, {.kind = Kind::text, .code = static_cast<int>(letter)});
        });
        glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int) {
            add(w, {.kind = Kind::button, .code = button, .down = action == GLFW_PRESS});
        });
        glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
            // Pixels per window unit, which exceed 1 on a high-density display.
            int width = 1, height = 1, pixels = 1, rows = 1;
            glfwGetWindowSize(w, &width, &height);
            glfwGetFramebufferSize(w, &pixels, &rows);
            if (width > 0 && height > 0)
                add(w, {.kind = Kind::move, .x = x * pixels / width, .y = y * rows / height});
        });
        glfwSetScrollCallback(window, [](GLFWwindow* w, double, double notches) {
            add(w, {.kind = Kind::scroll, .y = notches});
        });
        glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** files) {
            for (int k = 0; k < count; ++k) add(w, {.kind = Kind::drop, .text = files[k]});
        });
        glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) {
            static_cast<WindowScreen*>(glfwGetWindowUserPointer(w))->stale_ = true;
        });
    }

    Window window_;
    vk::raii::SurfaceKHR surface_{nullptr};
    std::optional<vulkan::WindowTarget> target_;
    std::vector<Event> events_;
    std::uint32_t image_ = 0;
    bool stale_ = false, copied_ = false, minimised_ = false, lost_ = false;
};

}  // namespace

std::unique_ptr<Screen> make_window_screen(const vulkan::DeviceOptions& device, std::uint32_t width,
                                           std::uint32_t height, const std::string& title)
{
    static const Library library;  // ends with the program
    Window window = make_window(width, height, title);
    return std::make_unique<WindowScreen>(std::move(window), make_device(device));
}

}  // namespace pliant::tool

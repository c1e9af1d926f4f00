// Dear ImGui over a screen's pictures, fed by the viewer's events.
#pragma once

#include "viewer/screen.hpp"

struct ImGuiContext;

namespace pliant::tool {

class Interface {
public:
    explicit Interface(const Screen& screen);
    ~Interface();
    Interface(const Interface&) = delete;
    Interface& operator=(const Interface&) = delete;

    void take(const Event& event);
    bool wants_mouse() const;
    bool wants_keys() const;
    /// Begins a frame, in which widgets may be named.
    void begin(vk::Extent2D size, double seconds);
    /// Ends it, and records it within a render pass; without commands it is dropped.
    void end(const vk::raii::CommandBuffer* commands);

private:
    std::shared_ptr<vulkan::Device> device_;
    vk::raii::DescriptorPool pool_{nullptr};
    ImGuiContext* context_ = nullptr;
};

}  // namespace pliant::tool

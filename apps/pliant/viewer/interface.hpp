// Dear ImGui on top of a screen's pictures, driven by the viewer's events.
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
    /// Begins a frame; widgets may then be created.
    void begin(vk::Extent2D size, double seconds);
    /// Ends the frame and records it within a render pass; without commands it is discarded.
    void end(const vk::raii::CommandBuffer* commands);

private:
    std::shared_ptr<vulkan::Device> device_;
    vk::raii::DescriptorPool pool_{nullptr};
    ImGuiContext* context_ = nullptr;
};

}  // namespace pliant::tool

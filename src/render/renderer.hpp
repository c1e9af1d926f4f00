// Pictures of a simulation, drawn off-screen.
#pragma once

#include <memory>
#include <span>

#include "pliant/render.hpp"
#include "render/offscreen_target.hpp"
#include "render/scene_drawing.hpp"

namespace pliant {

/// Draws a scene as its camera sees it. With a simulation on Vulkan give it the simulation's own device
/// (DeviceState::device()), and frames need not leave the device.
class Renderer {
public:
    /// One topology for each cloth of the scene. Throws Error(device_failure) when the device cannot draw.
    Renderer(std::shared_ptr<vulkan::Device> device, const Scene& scene,
             std::span<const ClothTopology> topologies);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// The scene at a time in s, which places the colliders. Throws Error(device_failure) when the device is
    /// lost.
    Image draw(double time, std::span<const ClothFrame> frames);
    /// The same into a picture that is kept from frame to frame: no allocation.
    void draw(double time, std::span<const ClothFrame> frames, Image& into);
    /// The same with overlays and a camera of its own; its size is that of the scene's camera.
    void draw(const PictureState& state, Image& into);
    /// Springs of a cloth, for the overlays that show them.
    void set_springs(std::size_t cloth, std::span<const DrawnSpring> springs);

private:
    struct Implementation;
    std::shared_ptr<vulkan::Device> device_;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace pliant

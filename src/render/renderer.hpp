// Renders pictures of a simulation off-screen.
#pragma once

#include <memory>
#include <span>

#include "pliant/render.hpp"
#include "render/offscreen_target.hpp"
#include "render/scene_drawing.hpp"

namespace pliant {

/// Draws a scene from its camera. With a simulation on Vulkan, pass the simulation's device
/// (DeviceState::device()), so that frames stay on the device.
class Renderer {
public:
    /// One topology per cloth of the scene. Throws Error(device_failure) if the device cannot draw.
    Renderer(std::shared_ptr<vulkan::Device> device, const Scene& scene,
             std::span<const ClothTopology> topologies);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Draws the scene at a time in s, which determines the colliders. Throws Error(device_failure) if the
    /// device is lost.
    Image draw(double time, std::span<const ClothFrame> frames);
    /// The same into an existing picture, without allocation.
    void draw(double time, std::span<const ClothFrame> frames, Image& into);
    /// The same with overlays and another camera; the size is that of the scene's camera.
    void draw(const PictureState& state, Image& into);
    /// Springs of a cloth, for overlays that show springs.
    void set_springs(std::size_t cloth, std::span<const DrawnSpring> springs);

private:
    struct Implementation;
    std::shared_ptr<vulkan::Device> device_;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace pliant

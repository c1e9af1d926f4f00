// Pictures of a running simulation.
#pragma once

#include <memory>
#include <string>

#include "picture_source.hpp"
#include "pliant/simulation.hpp"
#include "render/image.hpp"
#include "render/renderer.hpp"

namespace pliant::tool {

/// Draws the present state of a simulation from the scene's camera; frames stay on the device if the
/// simulation is there.
class Painter {
public:
    /// Throws Error(device_failure) if no device can draw.
    explicit Painter(Simulation& simulation);

    /// Valid until the next call.
    const Image& draw();
    std::string device_name() const;

private:
    Simulation& simulation_;
    std::shared_ptr<vulkan::Device> device_;
    std::unique_ptr<Renderer> renderer_;
    PictureSource source_;
    Image image_;
};

}  // namespace pliant::tool

// Pictures of a running simulation.
#pragma once

#include <memory>
#include <string>

#include "picture_source.hpp"
#include "pliant/simulation.hpp"
#include "render/image.hpp"
#include "render/renderer.hpp"

namespace pliant::tool {

/// Draws what a simulation is at, as the scene's camera sees it; frames stay on the device when the
/// simulation is there.
class Painter {
public:
    /// Throws Error(device_failure) when no device here can draw.
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

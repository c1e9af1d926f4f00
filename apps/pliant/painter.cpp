#include "painter.hpp"

#include "backend/vulkan/device_state.hpp"
#include "user_folders.hpp"

namespace pliant::tool {

Painter::Painter(Simulation& simulation) : simulation_(simulation)
{
    device_ =
        simulation_.device_state()
            ? simulation_.device_state()->device()
            : std::make_shared<vulkan::Device>(vulkan::DeviceOptions{.pipeline_folder = cache_folder()});
    renderer_ = std::make_unique<Renderer>(device_, simulation_.scene(), topologies_of(simulation_));
    if (simulation_.scene().camera.colour != ClothColour::strain) return;
    for (std::size_t c = 0; c < simulation_.scene().cloth_count(); ++c)
        renderer_->set_springs(c, drawn_springs(simulation_, c));
}

const Image& Painter::draw()
{
    source_.gather(simulation_, {});
    renderer_->draw(simulation_.time(), frames_of(simulation_, source_), image_);
    return image_;
}

std::string Painter::device_name() const { return device_->info().name; }

}  // namespace pliant::tool

#include "backend/vulkan/device_state.hpp"
#include "pliant/render.hpp"
#include "render/picture_source.hpp"
#include "render/renderer.hpp"

namespace pliant {
namespace {

std::shared_ptr<vulkan::Device> device_for(Simulation& simulation, const PainterOptions& options)
{
    if (simulation.device_state()) return simulation.device_state()->device();
    return std::make_shared<vulkan::Device>(
        vulkan::DeviceOptions{.pipeline_folder = options.pipeline_folder});
}

}  // namespace

struct Painter::Implementation {
    Simulation& simulation;
    std::shared_ptr<vulkan::Device> device;
    Renderer renderer;
    PictureSource source = {};
    Image image = {};
};

Painter::Painter(Simulation& simulation, const PainterOptions& options)
{
    const auto device = device_for(simulation, options);
    implementation_.reset(new Implementation{
        simulation, device, Renderer(device, simulation.scene(), topologies_of(simulation))});
    if (simulation.scene().camera.colour != ClothColour::strain) return;
    for (std::size_t c = 0; c < simulation.scene().cloth_count(); ++c)
        implementation_->renderer.set_springs(c, drawn_springs(simulation, c));
}

Painter::~Painter() = default;

const Image& Painter::draw()
{
    auto& [simulation, device, renderer, source, image] = *implementation_;
    source.gather(simulation, {});
    renderer.draw(simulation.time(), frames_of(simulation, source), image);
    return image;
}

std::string Painter::device_name() const { return implementation_->device->info().name; }

}  // namespace pliant

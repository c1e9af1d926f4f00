#include "painter.hpp"

#include "backend/vulkan/device_state.hpp"

namespace pliant::tool {

Painter::Painter(Simulation& simulation) : simulation_(simulation)
{
    device_ = simulation_.device_state() ? simulation_.device_state()->device()
                                         : std::make_shared<vulkan::Device>(vulkan::DeviceOptions{});
    const Scene& scene = simulation_.scene();
    std::vector<ClothTopology> topologies;
    for (std::size_t c = 0; c < scene.cloth_count(); ++c) {
        const auto* sheet = std::get_if<SheetOptions>(&scene.cloth(c).shape);
        topologies.push_back({simulation_.triangles(c),
                              static_cast<std::uint32_t>(simulation_.positions(c).size()),
                              sheet ? sheet->rows : 0, sheet ? sheet->columns : 0});
    }
    renderer_ = std::make_unique<Renderer>(device_, scene, topologies);
}

const Image& Painter::draw()
{
    frames_.clear();
    for (std::size_t c = 0; c < simulation_.scene().cloth_count(); ++c) {
        // The nodes of soft bodies lie in an order, and against an origin, of their own.
        const bool direct = simulation_.device_state() && simulation_.body_count() == 0;
        if (direct)
            frames_.emplace_back(simulation_.device_state()->drawable(c));
        else
            frames_.emplace_back(
                HostCloth{simulation_.positions(c), simulation_.normals(c), simulation_.strains(c)});
    }
    renderer_->draw(simulation_.time(), frames_, image_);
    return image_;
}

std::string Painter::device_name() const { return device_->info().name; }

}  // namespace pliant::tool

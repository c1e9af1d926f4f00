#include "render/renderer.hpp"

#include <optional>
#include <string>
#include <utility>

#include "pliant/error.hpp"

namespace pliant {
namespace {

/// Converts Vulkan's exceptions to Error.
template <class Action>
auto on_device(const vulkan::Device& device, Action&& action)
{
    try {
        return action();
    } catch (const vk::SystemError& error) {
        throw Error(ErrorKind::device_failure, "the device " + device.info().name +
                                                   " cannot draw: " + error.what() +
                                                   "; run without --render, or choose another device");
    }
}

std::shared_ptr<vulkan::Device> able(std::shared_ptr<vulkan::Device> device)
{
    if (!device) throw Error(ErrorKind::bad_usage, "a renderer needs a device");
    if (!device->can_draw())
        throw Error(ErrorKind::device_failure,
                    "the device " + device->info().name +
                        " computes but does not draw; run without --render, or choose "
                        "another device");
    return device;
}

}  // namespace

struct Renderer::Implementation {
    Implementation(const std::shared_ptr<vulkan::Device>& device, const Scene& scene,
                   std::span<const ClothTopology> topologies)
        : camera(scene.camera),
          target(*device, {camera.width, camera.height}),
          drawing(std::make_shared<vulkan::PictureKit>(device, target.target().passes), scene, topologies),
          commands(device->make_commands())
    {
    }

    Camera camera;
    vulkan::OffscreenTarget target;
    vulkan::SceneDrawing drawing;
    vk::raii::CommandBuffer commands;

    /// The present content of the target, if known: it differs from the empty stage only in the area.
    struct Shown {
        Camera camera;
        OverlaySet overlays;
        PixelArea area;
    };
    std::optional<Shown> shown;

    /// The area to draw for the prepared picture; `next`: the content after that.
    PixelArea missing(const PictureState& state, std::optional<Shown>& next) const
    {
        const vk::Extent2D size = target.target().size;
        const bool overlaid = state.overlays != OverlaySet{} && state.overlays != OverlaySet{Overlay::strain};
        next.reset();
        if (!overlaid && state.scale == nullptr)
            if (const auto area = drawing.touched(state, size)) next = {state.camera, state.overlays, *area};
        const bool same = shown && next && shown->overlays == next->overlays &&
                          shown->camera.position == next->camera.position &&
                          shown->camera.target == next->camera.target &&
                          shown->camera.field_of_view == next->camera.field_of_view;
        return same ? united(shown->area, next->area) : PixelArea{0, 0, size.width, size.height};
    }
};

Renderer::Renderer(std::shared_ptr<vulkan::Device> device, const Scene& scene,
                   std::span<const ClothTopology> topologies)
    : device_(able(std::move(device))),
      implementation_(
          on_device(*device_, [&] { return std::make_unique<Implementation>(device_, scene, topologies); }))
{
}

Renderer::~Renderer() = default;

Image Renderer::draw(double time, std::span<const ClothFrame> frames)
{
    Image image;
    draw(time, frames, image);
    return image;
}

void Renderer::draw(double time, std::span<const ClothFrame> frames, Image& into)
{
    PictureState state{.camera = implementation_->camera, .time = time, .frames = frames};
    if (state.camera.colour == ClothColour::strain) state.overlays.set(Overlay::strain, true);
    draw(state, into);
}

void Renderer::draw(const PictureState& state, Image& into)
{
    on_device(*device_, [&] {
        auto& [camera, target, drawing, commands, shown] = *implementation_;
        drawing.prepare(state, target.target().size);
        std::optional<Implementation::Shown> next;
        const PixelArea area = implementation_->missing(state, next);
        shown.reset();  // unknown until it is drawn
        if (!area.empty()) {
            const vk::Rect2D part({static_cast<std::int32_t>(area.left), static_cast<std::int32_t>(area.top)},
                                  {area.width(), area.height()});
            commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
            drawing.begin(commands, target.target(part));
            drawing.end(commands);
            target.record_copy(commands, part);
            commands.end();
            device_->run(commands);
        }
        shown = next;
        target.read(into);
    });
}

void Renderer::set_springs(std::size_t cloth, std::span<const DrawnSpring> springs)
{
    on_device(*device_, [&] { implementation_->drawing.set_springs(cloth, springs); });
    implementation_->shown.reset();
}

}  // namespace pliant

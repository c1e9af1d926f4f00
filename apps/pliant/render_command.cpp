// `pliant render`: pictures of a scene with overlays, and of two methods side by side.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include "backend/vulkan/device_state.hpp"
#include "commands.hpp"
#include "label.hpp"
#include "progress.hpp"
#include "render/picture_recorder.hpp"
#include "render/picture_source.hpp"
#include "render/renderer.hpp"

namespace pliant::tool {
namespace {

/// Parses numbers separated by commas; throws Error(bad_usage).
std::vector<double> numbers_of(const std::string& text)
{
    std::vector<double> numbers;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        const std::string part = text.substr(at, end - at);
        char* stopped = nullptr;
        const double number = std::strtod(part.c_str(), &stopped);
        if (part.empty() || *stopped != '\0' || !std::isfinite(number))
            throw Error(ErrorKind::bad_usage, "--camera '" + text + "': '" + part + "' is not a number");
        numbers.push_back(number);
        at = end + 1;
    }
    return numbers;
}

Camera camera_of(const RenderOptions& options, Camera camera)
{
    if (!options.size.empty()) std::tie(camera.width, camera.height) = picture_size(options.size);
    if (options.camera.empty()) return camera;
    const std::vector<double> n = numbers_of(options.camera);
    if (n.size() != 6 && n.size() != 7)
        throw Error(ErrorKind::bad_usage, "--camera '" + options.camera + "' has " +
                                              std::to_string(n.size()) +
                                              " numbers, but needs 6 (position and target, in m) or 7 "
                                              "(and the vertical field of view in degrees)");
    camera.position = {n[0], n[1], n[2]};
    camera.target = {n[3], n[4], n[5]};
    if (n.size() == 7) camera.field_of_view = n[6];
    return camera;
}

OverlaySet overlays_of(const RenderOptions& options, const Scene& scene)
{
    OverlaySet overlays;
    if (scene.camera.colour == ClothColour::strain) overlays.set(Overlay::strain, true);
    for (const std::string& name : options.overlays) {
        const auto overlay = overlay_of(name);
        if (!overlay) {
            std::string names;
            for (const char* known : overlay_names) names += std::string(names.empty() ? "" : ", ") + known;
            throw Error(ErrorKind::bad_usage, "--overlay '" + name + "' is none of " + names);
        }
        overlays.set(*overlay, true);
    }
    return overlays;
}

/// One simulation and its pictures.
class Film {
public:
    Film(const Scene& scene, const RenderOptions& options, const std::shared_ptr<vulkan::Device>& device)
        : simulation_(scene, with(options.simulation, device)),
          overlays_(overlays_of(options, scene)),
          renderer_(device, scene, topologies_of(simulation_))
    {
        if (!overlays_.needs_springs()) return;
        for (std::size_t c = 0; c < scene.cloth_count(); ++c)
            renderer_.set_springs(c, drawn_springs(simulation_, c));
    }

    void advance() { simulation_.advance(1 / simulation_.scene().time.frame_rate); }
    const Image& draw()
    {
        source_.gather(simulation_, overlays_);
        const std::vector<ClothFrame> frames = frames_of(simulation_, source_);
        renderer_.draw({.camera = simulation_.scene().camera,
                        .time = simulation_.time(),
                        .overlays = overlays_,
                        .scale = &source_.scale(),
                        .frames = frames,
                        .extras = source_.extras()},
                       image_);
        return image_;
    }
    /// Throws Error if the run cannot continue.
    void require_good() const
    {
        const Report& report = simulation_.report();
        const std::string method = name_of(simulation_.scene().method);
        if (report.device_lost)
            throw Error(ErrorKind::device_failure, "the run with " + method + " stopped: " + report.failure);
        if (!report.finite)
            throw Error(ErrorKind::diverged, "the run with " + method + " diverged in frame " +
                                                 std::to_string(report.bad_frame) +
                                                 "; take more substeps (--set time.substeps=N)");
    }
    std::string device_name() const { return simulation_.device_name(); }

private:
    static SimulationOptions with(SimulationOptions options, std::shared_ptr<vulkan::Device> device)
    {
        options.shared_device = std::move(device);
        return options;
    }

    Simulation simulation_;
    OverlaySet overlays_;
    PictureSource source_;
    Renderer renderer_;
    Image image_;
};

/// Joins two pictures of the same height.
void put_side_by_side(const Image& left, const Image& right, Image& both)
{
    both.width = left.width + right.width;
    both.height = left.height;
    both.rgba.resize(std::size_t{4} * both.width * both.height);
    const auto put = [&](const Image& image, std::size_t row, std::size_t column) {
        std::memcpy(&both.rgba[4 * (row * both.width + column)], &image.rgba[4 * row * image.width],
                    std::size_t{4} * image.width);
    };
    for (std::size_t row = 0; row < both.height; ++row) put(left, row, 0), put(right, row, left.width);
}

std::vector<std::string> methods_of(const RenderOptions& options)
{
    if (options.compare.empty()) return {};
    const std::size_t comma = options.compare.find(',');
    if (comma == std::string::npos || options.compare.find(',', comma + 1) != std::string::npos)
        throw Error(ErrorKind::bad_usage,
                    "--compare '" + options.compare + "' must be two methods, such as mass_spring,acad");
    return {options.compare.substr(0, comma), options.compare.substr(comma + 1)};
}

}  // namespace

std::pair<std::uint32_t, std::uint32_t> picture_size(const std::string& text)
{
    unsigned width = 0, height = 0;
    char rest = 0;
    const bool read = std::sscanf(text.c_str(), "%5ux%5u%c", &width, &height, &rest) == 2;
    if (!read || width < 16 || height < 16 || width > 16384 || height > 16384)
        throw Error(ErrorKind::bad_usage,
                    "--size '" + text + "' must be a size in pixels such as 1280x720, each side 16 to 16384");
    return {width, height};
}

int render_command(const RenderOptions& options)
{
    const std::vector<std::string> methods = methods_of(options);
    std::vector<std::string> overrides = options.overrides;
    if (options.frame_rate) overrides.push_back("time.frame_rate=" + std::to_string(*options.frame_rate));
    std::vector<Scene> scenes;
    for (std::size_t k = 0; k < std::max<std::size_t>(1, methods.size()); ++k) {
        auto own = overrides;
        if (!methods.empty()) own.push_back("method=" + methods[k]);
        scenes.push_back(read_scene(options.scene, own));
        Camera& camera = scenes.back().camera;
        camera = camera_of(options, camera);
        if (!methods.empty()) camera.width = std::max(1u, camera.width / 2);
        validate(scenes.back());
    }
    const TimeOptions& time = scenes.front().time;
    PictureRecorder recorder(options.out_file, time.frame_rate);
    const auto device = std::make_shared<vulkan::Device>(
        vulkan::DeviceOptions{.index = options.simulation.device,
                              .validation = options.simulation.validation,
                              .pipeline_folder = options.simulation.pipeline_folder});
    std::vector<std::unique_ptr<Film>> films;
    for (const Scene& scene : scenes) films.push_back(std::make_unique<Film>(scene, options, device));

    const std::uint64_t frames = options.frames.value_or(
        static_cast<std::uint64_t>(std::max(1.0, std::round(time.duration * time.frame_rate))));
    Progress progress(frames, options.quiet);
    Image both;
    for (std::uint64_t frame = 0; frame <= frames; ++frame) {
        if (frame > 0)
            for (const auto& film : films) film->advance(), film->require_good();
        if (recorder.wants(frame, frame == frames)) {
            if (films.size() == 1) {
                recorder.add(films.front()->draw(), frame);
            } else {
                put_side_by_side(films[0]->draw(), films[1]->draw(), both);
                write_label(both, 0, methods[0]);
                write_label(both, both.width / 2, methods[1]);
                recorder.add(both, frame);
            }
        }
        if (frame > 0) progress.update(frame, "");
    }
    recorder.finish();
    if (!options.quiet) {
        if (!methods.empty()) std::printf("left %s, right %s; ", methods[0].c_str(), methods[1].c_str());
        std::printf("%s: %llu frames on %s, pictures on %s\nwrote %s\n", scenes.front().name.c_str(),
                    static_cast<unsigned long long>(frames), films.front()->device_name().c_str(),
                    device->info().name.c_str(), options.out_file.c_str());
    }
    return 0;
}

}  // namespace pliant::tool

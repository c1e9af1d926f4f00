// Pictures of a simulation, drawn off-screen by Vulkan: the library pliant_render, which pliant.hpp does not
// include.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "pliant/api.hpp"
#include "pliant/simulation.hpp"

namespace pliant {

/// A picture in the memory of the host.
struct Image {
    std::uint32_t width = 0, height = 0;  ///< pixels
    /// Rows from the top, pixels from the left, four bytes each: sRGB red, green, blue, and alpha.
    std::vector<std::uint8_t> rgba;
};

struct PainterOptions {
    /// Where compiled pipelines are kept between runs; empty: nowhere.
    std::filesystem::path pipeline_folder = {};
};

/// Draws what a simulation is at, as the camera of its scene sees it. On the backend vulkan it draws from the
/// positions on the simulation's own device; otherwise on the first device that can.
class PLIANT_API Painter {
public:
    /// `simulation` must outlive it. Throws Error(device_failure) when no device here can draw.
    explicit Painter(Simulation& simulation, const PainterOptions& options = {});
    ~Painter();
    Painter(const Painter&) = delete;
    Painter& operator=(const Painter&) = delete;

    /// Valid until the next call. Throws Error(device_failure) when the device is lost.
    const Image& draw();
    std::string device_name() const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

/// Writes a PNG. Throws Error(bad_input) when it cannot; the file then is what it was.
PLIANT_API void write_png(const std::filesystem::path& file, const Image& image);

}  // namespace pliant

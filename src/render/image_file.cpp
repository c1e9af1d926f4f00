#include "pliant/render.hpp"

#include <cstring>

#include "files/atomic_file.hpp"
#include "pliant/error.hpp"

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

namespace pliant {
namespace {

bool opaque(const Image& image)
{
    for (std::size_t i = 3; i < image.rgba.size(); i += 4)
        if (image.rgba[i] != 255) return false;
    return true;
}

/// Three bytes for each pixel.
std::vector<std::uint8_t> without_alpha(const Image& image)
{
    std::vector<std::uint8_t> rgb(image.rgba.size() / 4 * 3);
    for (std::size_t pixel = 0; pixel < image.rgba.size() / 4; ++pixel)
        std::memcpy(&rgb[3 * pixel], &image.rgba[4 * pixel], 3);
    return rgb;
}

void append(void* stream, void* data, int size)
{
    static_cast<std::ostream*>(stream)->write(static_cast<const char*>(data), size);
}

}  // namespace

void write_png(const std::filesystem::path& file, const Image& image)
{
    if (image.width == 0 || image.height == 0 ||
        image.rgba.size() != std::size_t{4} * image.width * image.height)
        throw Error(ErrorKind::bad_input, "cannot write '" + file.string() + "': the picture has no pixels");
    const int width = static_cast<int>(image.width), height = static_cast<int>(image.height);
    AtomicFile out(file);
    const bool encoded =  // pictures of a scene are opaque; without alpha, files are a quarter smaller
        opaque(image)
            ? stbi_write_png_to_func(append, &out.stream(), width, height, 3, without_alpha(image).data(), 0)
            : stbi_write_png_to_func(append, &out.stream(), width, height, 4, image.rgba.data(), 0);
    if (!encoded)
        throw Error(ErrorKind::bad_input,
                    "cannot write '" + file.string() + "': there is not enough memory to encode it");
    out.commit();
}

}  // namespace pliant

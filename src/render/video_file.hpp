// Video files: H.264 in MP4, encoded by the program ffmpeg.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "pliant/render.hpp"

namespace pliant {

/// The file appears under its name when it is complete. If it is destroyed without `finish`, for example by
/// an exception, it still becomes a playable file. Without any picture there is no file.
class VideoFile {
public:
    /// Throws Error(bad_input) if ffmpeg is not installed or the file cannot be created. The format needs
    /// even sizes, so odd sizes grow by one pixel.
    VideoFile(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
              double frame_rate);
    ~VideoFile();
    VideoFile(const VideoFile&) = delete;
    VideoFile& operator=(const VideoFile&) = delete;

    /// Throws Error(bad_usage) for a picture of another size, Error(bad_input) with ffmpeg's own message if
    /// it has failed.
    void add(const Image& image);
    /// Waits for the encoder. Throws as `add` does.
    void finish();

private:
    class Encoder;
    std::unique_ptr<Encoder> encoder_;
};

}  // namespace pliant

#include "render/video_file.hpp"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstring>
#include <string>
#include <system_error>
#include <vector>

#include <unistd.h>

#include "files/atomic_file.hpp"
#include "pliant/error.hpp"
#include "render/child_process.hpp"

namespace pliant {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& reason)
{
    throw Error(ErrorKind::bad_input, "cannot write '" + file.string() + "': " + reason);
}

/// The target, with symbolic links resolved. Throws if the name or the folder is unusable.
std::filesystem::path checked_target(const std::filesystem::path& file)
{
    const AtomicFile probe(file);
    std::error_code ignored;
    return std::filesystem::is_symlink(file, ignored) ? std::filesystem::weakly_canonical(file) : file;
}

/// An unused name beside the file. The encoder must be able to seek, so a stream is not enough.
std::filesystem::path partial_name(const std::filesystem::path& file)
{
    static std::atomic<unsigned> count{0};
    return file.parent_path() /
           (".pliant-" + std::to_string(::getpid()) + "-" + std::to_string(count++) + ".part");
}

/// The shortest text that reads back as the same number, in any locale.
std::string text_of(double number)
{
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, number).ptr};
}

std::uint32_t even(std::uint32_t size) { return size + size % 2; }

std::vector<std::string> command(const std::filesystem::path& to, std::uint32_t width, std::uint32_t height,
                                 double frame_rate)
{
    return {"ffmpeg", "-nostdin", "-loglevel", "error", "-y", "-f", "rawvideo", "-pixel_format", "rgba",
            "-framerate", text_of(frame_rate), "-video_size",
            std::to_string(even(width)) + "x" + std::to_string(even(height)), "-i", "pipe:0",
            // Declares HD colours in the file: players otherwise guess by the size.
            "-vf", "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p", "-colorspace", "bt709",
            "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "tv", "-c:v", "libx264",
            "-preset", "veryfast", "-crf", "18", "-movflags", "+faststart", "-f", "mp4",
            "file:" + to.string()};
}

}  // namespace

class VideoFile::Encoder {
public:
    Encoder(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height, double frame_rate)
        : file_(file),
          target_(checked_target(file)),
          partial_(partial_name(target_)),
          width_(width),
          height_(height),
          process_(command(partial_, width, height, frame_rate))
    {
        if (width % 2 || height % 2) padded_.resize(std::size_t{4} * even(width) * even(height));
    }

    ~Encoder()
    {
        try {
            finish();
        } catch (const std::exception&) {
            // A destructor cannot report errors. The incomplete file is removed.
        }
    }

    void add(const Image& image)
    {
        if (image.width != width_ || image.height != height_ ||
            image.rgba.size() != std::size_t{4} * width_ * height_)
            throw Error(ErrorKind::bad_usage,
                        "a video of " + std::to_string(width_) + " x " + std::to_string(height_) +
                            " pixels was given a picture of " + std::to_string(image.width) + " x " +
                            std::to_string(image.height));
        if (finished_) throw Error(ErrorKind::bad_usage, "a finished video was given another picture");
        const auto& pixels = padded_.empty() ? image.rgba : pad(image);
        if (!process_.write(pixels.data(), pixels.size())) {
            give_up();
            fail(file_, "ffmpeg stopped: " + process_.complaint());
        }
        ++frames_;
    }

    void finish()
    {
        if (finished_) return;
        finished_ = true;
        const bool encoded = process_.finish();
        if (frames_ == 0 || !encoded) ::unlink(partial_.c_str());
        if (frames_ == 0) return;
        if (!encoded) fail(file_, "ffmpeg failed: " + process_.complaint());
        std::error_code error;
        std::filesystem::rename(partial_, target_, error);
        if (!error) return;
        ::unlink(partial_.c_str());
        fail(file_, "the finished file could not be renamed to it (" + error.message() + ")");
    }

private:
    /// Repeats the last column and row if the size is odd.
    const std::vector<std::uint8_t>& pad(const Image& image)
    {
        const std::size_t row_bytes = std::size_t{4} * width_, padded_bytes = std::size_t{4} * even(width_);
        for (std::uint32_t row = 0; row < even(height_); ++row) {
            const std::uint8_t* from = image.rgba.data() + row_bytes * std::min(row, height_ - 1);
            std::uint8_t* to = padded_.data() + padded_bytes * row;
            std::memcpy(to, from, row_bytes);
            if (padded_bytes > row_bytes) std::memcpy(to + row_bytes, from + row_bytes - 4, 4);
        }
        return padded_;
    }

    void give_up()
    {
        finished_ = true;
        process_.finish();
        ::unlink(partial_.c_str());
    }

    std::filesystem::path file_;  // as given by the caller, for messages
    std::filesystem::path target_, partial_;
    std::uint32_t width_, height_;
    std::uint64_t frames_ = 0;
    bool finished_ = false;
    std::vector<std::uint8_t> padded_;
    ChildProcess process_;
};

VideoFile::VideoFile(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
                     double frame_rate)
try : encoder_(std::make_unique<Encoder>(file, width, height, frame_rate)) {
} catch (const std::system_error& error) {
    if (error.code() == std::errc::no_such_file_or_directory)
        fail(file,
             "the program ffmpeg was not found; install the package ffmpeg, or use --render frames_%04d.png");
    fail(file, std::string("ffmpeg could not be started: ") + error.what());
}

VideoFile::~VideoFile() = default;
void VideoFile::add(const Image& image) { encoder_->add(image); }
void VideoFile::finish() { encoder_->finish(); }

}  // namespace pliant

// Writes the pictures of a run: `--render F`, by the file's extension.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "files/numbered_name.hpp"
#include "pliant/render.hpp"
#include "render/video_file.hpp"

namespace pliant {

class PictureRecorder {
public:
    /// `x.png`: the last frame; `frames_%04d.png`: a file per frame, with 0 at the start; `x.mp4`: a video
    /// from frame 1 on. Throws Error(bad_usage) for any other name, Error(bad_input) if the folder is missing
    /// or not writable.
    PictureRecorder(const std::filesystem::path& file, double frame_rate);

    /// Whether this frame is written; other frames need not be drawn.
    bool wants(std::uint64_t frame_index, bool last) const;
    /// Throws Error(bad_input) if the file cannot be written.
    void add(const Image& image, std::uint64_t frame_index);
    /// Completes a video. Without it, for example after an exception, a video still contains the frames
    /// added.
    void finish();

private:
    enum class Form { still, sequence, video };

    std::filesystem::path name_of(std::uint64_t frame_index) const;

    std::filesystem::path file_;
    double frame_rate_;
    Form form_ = Form::still;
    std::optional<NumberedName> names_;  // for a sequence
    std::unique_ptr<VideoFile> video_;   // created with the first picture, in its size
};

}  // namespace pliant

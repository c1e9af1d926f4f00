// Where the pictures of a run go: `--render F`, by the ending of its name.
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
    /// `x.png`: the last frame; `frames_%04d.png`: a file for each frame, 0 being the start; `x.mp4`: a video
    /// from frame 1 on. Throws Error(bad_usage) for any other name, Error(bad_input) when the folder is
    /// missing or closed.
    PictureRecorder(const std::filesystem::path& file, double frame_rate);

    /// Is this frame going to be kept? A frame that is not needs no drawing.
    bool wants(std::uint64_t frame_index, bool last) const;
    /// Throws Error(bad_input) when the file cannot be written.
    void add(const Image& image, std::uint64_t frame_index);
    /// Completes a video. Without it, by an exception for one, a video still keeps what was added.
    void finish();

private:
    enum class Form { still, sequence, video };

    std::filesystem::path name_of(std::uint64_t frame_index) const;

    std::filesystem::path file_;
    double frame_rate_;
    Form form_ = Form::still;
    std::optional<NumberedName> names_;  // of a sequence
    std::unique_ptr<VideoFile> video_;   // from the first picture on, which has its size
};

}  // namespace pliant

#include "render/picture_recorder.hpp"

#include <string>

#include "files/atomic_file.hpp"
#include "pliant/error.hpp"
#include "pliant/render.hpp"

namespace pliant {

PictureRecorder::PictureRecorder(const std::filesystem::path& file, double frame_rate)
    : file_(file), frame_rate_(frame_rate)
{
    const std::string ending = lower_case_ending(file);
    const bool pattern = file.string().find('%') != std::string::npos;
    if (ending == ".mp4")
        form_ = Form::video;
    else if (ending == ".png" && !pattern)
        form_ = Form::still;
    else if (ending == ".png" && NumberedName::is_valid(file.string()))
        form_ = Form::sequence, names_.emplace(file.string());
    else
        throw Error(ErrorKind::bad_usage,
                    "--render '" + file.string() +
                        "' is not a picture or a video: it must be x.png (the last frame), "
                        "frames_%04d.png (a file for each frame, with one %d or %0Nd) or x.mp4 (a video)");
    // A missing folder or encoder should be reported before the run, not after it.
    if (form_ == Form::video)
        const VideoFile probe(file_, 2, 2, frame_rate_);
    else
        const AtomicFile probe(name_of(0));
}

bool PictureRecorder::wants(std::uint64_t frame_index, bool last) const
{
    if (form_ == Form::video) return frame_index > 0;  // so that 300 frames are 5 s
    return form_ == Form::sequence || last;
}

void PictureRecorder::add(const Image& image, std::uint64_t frame_index)
{
    if (form_ != Form::video) return write_png(name_of(frame_index), image);
    if (!video_) video_ = std::make_unique<VideoFile>(file_, image.width, image.height, frame_rate_);
    video_->add(image);
}

void PictureRecorder::finish()
{
    if (video_) video_->finish();
}

std::filesystem::path PictureRecorder::name_of(std::uint64_t frame_index) const
{
    return names_ ? names_->at(frame_index) : file_;
}

}  // namespace pliant

#include "render/picture_recorder.hpp"

#include <algorithm>
#include <cctype>
#include <string>

#include "mesh/atomic_file.hpp"
#include "pliant/error.hpp"
#include "render/image_file.hpp"

namespace pliant {
namespace {

/// The one number of a pattern like frames_%04d.png.
struct Number {
    std::size_t begin = 0, end = 0;  ///< of "%04d" in the name
    std::size_t digits = 0;          ///< at least so many, filled with zeros
    bool valid = false;
};

Number number_in(const std::string& name)
{
    Number number;
    number.begin = name.find('%');
    if (number.begin == std::string::npos || name.find('%', number.begin + 1) != std::string::npos)
        return number;
    std::size_t at = number.begin + 1;
    if (at + 1 < name.size() && name[at] == '0' && name[at + 1] >= '1' && name[at + 1] <= '9') {
        number.digits = static_cast<std::size_t>(name[at + 1] - '0');
        at += 2;
    }
    number.valid = at < name.size() && name[at] == 'd';
    number.end = at + 1;
    return number;
}

std::string lower_case(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

}  // namespace

PictureRecorder::PictureRecorder(const std::filesystem::path& file, double frame_rate)
    : file_(file), frame_rate_(frame_rate)
{
    const std::string name = file.filename().string(), ending = lower_case(file.extension().string());
    const bool pattern = name.find('%') != std::string::npos;
    if (ending == ".mp4")
        form_ = Form::video;
    else if (ending == ".png" && !pattern)
        form_ = Form::still;
    else if (ending == ".png" && number_in(name).valid)
        form_ = Form::sequence;
    else
        throw Error(ErrorKind::bad_usage,
                    "--render '" + file.string() +
                        "' is not a picture or a video: it must be x.png (the last frame), "
                        "frames_%04d.png (a file for each frame, with one %d or %0Nd) or x.mp4 (a video)");
    const AtomicFile probe(
        name_of(0));  // a folder that is missing is better known before the run than after it
}

bool PictureRecorder::wants(std::uint64_t, bool last) const { return form_ != Form::still || last; }

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
    if (form_ != Form::sequence) return file_;
    std::string name = file_.filename().string(), digits = std::to_string(frame_index);
    const Number number = number_in(name);
    if (digits.size() < number.digits) digits.insert(0, number.digits - digits.size(), '0');
    return file_.parent_path() / name.replace(number.begin, number.end - number.begin, digits);
}

}  // namespace pliant

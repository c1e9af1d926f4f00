// Picture files, sequences and videos, and their errors.
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <stb/stb_image.h>
#include <sys/wait.h>

#include "pliant/render.hpp"
#include "render/picture_recorder.hpp"
#include "render/video_file.hpp"
#include "test_errors.hpp"

namespace pliant {
namespace {

namespace fs = std::filesystem;

// ----------------------------------------------------------------------------------------------------------
// tools

/// A folder that is gone after the test.
class Folder {
public:
    Folder()
    {
        std::string name = (fs::temp_directory_path() / "pliant-render-XXXXXX").string();
        path_ = ::mkdtemp(name.data());
    }
    ~Folder() { fs::remove_all(path_); }
    fs::path operator/(const std::string& name) const { return path_ / name; }
    std::vector<std::string> names() const
    {
        std::vector<std::string> result;
        for (const auto& entry : fs::directory_iterator(path_))
            result.push_back(entry.path().filename().string());
        std::sort(result.begin(), result.end());
        return result;
    }

private:
    fs::path path_;
};

Image gradient(std::uint32_t width, std::uint32_t height, int seed = 0)
{
    Image image{width, height, std::vector<std::uint8_t>(std::size_t{4} * width * height, 255)};
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
            std::uint8_t* pixel = &image.rgba[4 * (std::size_t{y} * width + x)];
            pixel[0] = static_cast<std::uint8_t>(x * 7 + static_cast<unsigned>(seed));
            pixel[1] = static_cast<std::uint8_t>(y * 5);
            pixel[2] = static_cast<std::uint8_t>(x ^ y);
        }
    return image;
}

std::string output_of(const std::string& command)
{
    std::string text;
    std::FILE* pipe = ::popen(command.c_str(), "r");
    std::array<char, 256> line;
    while (std::fgets(line.data(), static_cast<int>(line.size()), pipe)) text += line.data();
    ::pclose(pipe);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    return text;
}

/// "frames,width,height" of the video as a player would find it, decoded.
std::string probe(const fs::path& video)
{
    return output_of(
        "ffprobe -v error -count_frames -select_streams v:0 -show_entries "
        "stream=width,height,nb_read_frames -of csv=p=0 '" +
        video.string() + "'");
}

/// PATH as it was comes back at the end.
class ProgramPath {
public:
    explicit ProgramPath(const std::string& path) : before_(std::getenv("PATH"))
    {
        ::setenv("PATH", path.c_str(), 1);
    }
    ~ProgramPath() { ::setenv("PATH", before_.c_str(), 1); }

private:
    std::string before_;
};

// ----------------------------------------------------------------------------------------------------------
// image files

TEST(ImageFile, comes_back_as_it_was)
{
    const Folder folder;
    const auto file = folder / "picture.png";
    const auto expect_round_trip = [&](const Image& image) {
        write_png(file, image);
        int width = 0, height = 0, channels = 0;
        stbi_uc* read = stbi_load(file.c_str(), &width, &height, &channels, 4);
        ASSERT_NE(read, nullptr);
        EXPECT_EQ(width, static_cast<int>(image.width));
        EXPECT_EQ(height, static_cast<int>(image.height));
        EXPECT_TRUE(std::equal(image.rgba.begin(), image.rgba.end(), read));
        stbi_image_free(read);
    };
    Image image = gradient(37, 21);
    expect_round_trip(image);
    image.rgba[7] = 12;  // no longer opaque
    expect_round_trip(image);
    expect_round_trip(gradient(1, 1));
    EXPECT_EQ(folder.names(), std::vector<std::string>{"picture.png"});
}

TEST(ImageFile, says_why_it_cannot_be_written_and_leaves_the_old_file)
{
    const Folder folder;
    EXPECT_ERROR(write_png(folder / "none/picture.png", gradient(4, 4)), bad_input, "none");
    EXPECT_ERROR(write_png(folder / "picture.png", Image{4, 4, {}}), bad_input, "no pixels");
    write_png(folder / "picture.png", gradient(4, 4));
    const auto size = fs::file_size(folder / "picture.png");
    EXPECT_ERROR(write_png(folder / "picture.png", Image{0, 0, {}}), bad_input, "picture.png");
    EXPECT_EQ(fs::file_size(folder / "picture.png"), size);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"picture.png"});
}

// ----------------------------------------------------------------------------------------------------------
// video files

TEST(VideoFile, has_every_frame)
{
    const Folder folder;
    VideoFile video(folder / "x.mp4", 64, 48, 30);
    for (int i = 0; i < 17; ++i) video.add(gradient(64, 48, i));
    EXPECT_FALSE(fs::exists(folder / "x.mp4"));  // not before it is complete
    video.finish();
    EXPECT_EQ(probe(folder / "x.mp4"), "64,48,17");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"x.mp4"});
    EXPECT_EQ(
        output_of("ffprobe -v error -select_streams v:0 -show_entries stream=codec_name,pix_fmt,r_frame_rate "
                  "-of csv=p=0 '" +
                  (folder / "x.mp4").string() + "'"),
        "h264,yuv420p,30/1");
    EXPECT_ERROR(video.add(gradient(64, 48)), bad_usage, "finished");
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);  // no child is left, not even a dead one
    EXPECT_EQ(errno, ECHILD);
}

TEST(VideoFile, keeps_the_colours_up_to_the_edge)
{
    const Folder folder;
    Image red{33, 31, {}};
    for (int i = 0; i < 33 * 31; ++i) red.rgba.insert(red.rgba.end(), {200, 40, 30, 255});
    VideoFile video(folder / "x.mp4", red.width, red.height, 25);
    for (int i = 0; i < 3; ++i) video.add(red);
    video.finish();
    ASSERT_EQ(output_of("ffmpeg -loglevel error -i '" + (folder / "x.mp4").string() + "' -frames:v 1 '" +
                        (folder / "x.png").string() + "' 2>&1"),
              "");
    int width = 0, height = 0, channels = 0;
    stbi_uc* read = stbi_load((folder / "x.png").c_str(), &width, &height, &channels, 4);
    ASSERT_NE(read, nullptr);
    for (const int index :
         {16 * width + 16, 16 * width + width - 1, (height - 1) * width + 16, height * width - 1}) {
        EXPECT_NEAR(read[4 * index], 200, 4);
        EXPECT_NEAR(read[4 * index + 1], 40, 4);
        EXPECT_NEAR(read[4 * index + 2], 30, 4);
    }
    stbi_image_free(read);
}

TEST(VideoFile, grows_odd_sizes_to_even_ones)
{
    const Folder folder;
    VideoFile video(folder / "x.mp4", 33, 21, 25);
    for (int i = 0; i < 3; ++i) video.add(gradient(33, 21, i));
    video.finish();
    EXPECT_EQ(probe(folder / "x.mp4"), "34,22,3");
}

TEST(VideoFile, is_playable_when_the_run_ends_early)
{
    const Folder folder;
    try {
        VideoFile video(folder / "x.mp4", 64, 48, 30);
        for (int i = 0; i < 5; ++i) video.add(gradient(64, 48, i));
        throw Error(ErrorKind::diverged, "the simulation diverged");
    } catch (const Error&) {
    }
    EXPECT_EQ(probe(folder / "x.mp4"), "64,48,5");
    {
        const VideoFile empty(folder / "empty.mp4", 64, 48, 30);
    }
    EXPECT_EQ(folder.names(), std::vector<std::string>{"x.mp4"});
}

TEST(VideoFile, replaces_an_older_file_through_a_link)
{
    const Folder folder;
    std::ofstream(folder / "real.mp4") << "old";
    fs::create_symlink("real.mp4", folder / "link.mp4");
    VideoFile video(folder / "link.mp4", 16, 16, 30);
    video.add(gradient(16, 16));
    video.finish();
    EXPECT_TRUE(fs::is_symlink(folder / "link.mp4"));
    EXPECT_EQ(probe(folder / "real.mp4"), "16,16,1");
}

TEST(VideoFile, says_what_is_wrong)
{
    const Folder folder;
    EXPECT_ERROR(VideoFile(folder / "none/x.mp4", 16, 16, 30), bad_input, "none");
    {
        VideoFile video(folder / "x.mp4", 16, 16, 30);
        EXPECT_ERROR(video.add(gradient(16, 17)), bad_usage, "16 x 17");
    }
    {
        const ProgramPath nothing((folder / "empty").string());
        EXPECT_ERROR(VideoFile(folder / "x.mp4", 16, 16, 30), bad_input, "install the package ffmpeg");
    }
    EXPECT_TRUE(folder.names().empty());
}

TEST(VideoFile, repeats_the_words_of_an_encoder_that_gives_up)
{
    const Folder folder;
    fs::create_directory(folder / "bin");
    std::ofstream(folder / "bin/ffmpeg") << "#!/bin/sh\necho 'no such encoder' >&2\nexit 1\n";
    fs::permissions(folder / "bin/ffmpeg", fs::perms::owner_all);
    const ProgramPath only((folder / "bin").string());
    const auto record = [&] {  // more than fits between two processes, so that writing fails
        VideoFile video(folder / "x.mp4", 512, 512, 30);
        for (int i = 0; i < 10; ++i) video.add(gradient(512, 512));
        video.finish();
    };
    EXPECT_ERROR(record(), bad_input, "no such encoder");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"bin"});
}

// ----------------------------------------------------------------------------------------------------------
// recorder

TEST(PictureRecorder, keeps_the_last_frame_in_a_still)
{
    const Folder folder;
    PictureRecorder recorder(folder / "x.PNG", 60);
    EXPECT_FALSE(recorder.wants(0, false));
    EXPECT_TRUE(recorder.wants(9, true));
    recorder.add(gradient(8, 8), 9);
    recorder.finish();
    EXPECT_EQ(folder.names(), std::vector<std::string>{"x.PNG"});
}

TEST(PictureRecorder, numbers_a_sequence)
{
    const Folder folder;
    for (const std::string name : {"a_%04d.png", "b_%d.png", "%02dc.png"}) {
        PictureRecorder recorder(folder / name, 60);
        EXPECT_TRUE(recorder.wants(0, false));
        recorder.add(gradient(8, 8), 7);
        recorder.add(gradient(8, 8), 12345);
        recorder.finish();
    }
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"07c.png", "12345c.png", "a_0007.png", "a_12345.png",
                                                        "b_12345.png", "b_7.png"}));
}

TEST(PictureRecorder, writes_a_video)
{
    const Folder folder;
    PictureRecorder recorder(folder / "x.mp4", 24);
    EXPECT_FALSE(recorder.wants(0, false));  // the start: 4 frames are to last 4 frames
    EXPECT_TRUE(recorder.wants(1, false));
    for (std::uint64_t i = 1; i <= 4; ++i) recorder.add(gradient(32, 32, static_cast<int>(i)), i);
    recorder.finish();
    EXPECT_EQ(probe(folder / "x.mp4"), "32,32,4");
}

TEST(PictureRecorder, refuses_other_names)
{
    const Folder folder;
    for (const std::string name :
         {"x.gif", "x", "x.png.txt", "f_%04d.jpg", "f_%s.png", "f_%4d.png", "f_%0d.png", "f_%d_%d.png",
          "f_%.png", "f_%%d.png", "f_%00d.png", ".png", "%d"})
        for (const char* form : {"x.png", "frames_%04d.png", "x.mp4"})
            EXPECT_ERROR(PictureRecorder(folder / name, 60), bad_usage, form);
    EXPECT_ERROR(PictureRecorder(folder / "none/x.png", 60), bad_input, "none");
    EXPECT_ERROR(PictureRecorder(folder / "none/x_%d.png", 60), bad_input, "none");
    EXPECT_ERROR(PictureRecorder(folder / "none/x.mp4", 60), bad_input, "none");
    EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace pliant

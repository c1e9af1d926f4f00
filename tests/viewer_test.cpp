// The viewer without a window: every overlay against a stored picture, what a frame allocates, and what stays
// behind.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <new>

#include <imgui.h>
#include <stb/stb_image.h>
#include <unistd.h>

#include "label.hpp"
#include "pliant/render.hpp"
#include "test_errors.hpp"
#include "test_paths.hpp"
#include "viewer/script.hpp"
#include "viewer/viewer.hpp"

namespace {
std::atomic<long long> alive{0}, allocations{0};
}  // namespace

// Sanitizers have operators of their own, which must not be hidden from them.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define PLIANT_SANITIZED
#endif
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define PLIANT_SANITIZED
#endif
#if defined(PLIANT_SANITIZED)
constexpr bool counts_allocations = false;
#else
constexpr bool counts_allocations = true;

// The compiler inlines these, and then takes malloc and free for strangers.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"

// Counts what this program and the libraries that share its operators allocate; drivers use malloc, and do
// not count.
void* operator new(std::size_t size)
{
    ++alive, ++allocations;
    if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
    throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment)
{
    ++alive, ++allocations;
    const auto unit = static_cast<std::size_t>(alignment);
    if (void* memory = std::aligned_alloc(unit, (size + unit - 1) / unit * unit)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept
{
    if (memory) --alive;
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { operator delete(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { operator delete(memory); }
#endif

namespace pliant::tool {
namespace {

using Kind = Event::Kind;

class ViewerTest : public testing::Test {
protected:
    void SetUp() override
    {
        if (vulkan::list_physical_devices().empty()) GTEST_SKIP() << "there is no Vulkan device";
        // Widgets' memory counts, too.
        ImGui::SetAllocatorFunctions([](std::size_t size, void*) { return operator new(size); },
                                     [](void* memory, void*) { operator delete(memory); });
    }

    static std::unique_ptr<Viewer> viewer_of(Backend backend, std::uint32_t width = 400,
                                             std::uint32_t height = 240, bool validation = true)
    {
        SimulationOptions options;
        options.backend = backend;
        options.threads = 1;
        return std::make_unique<Viewer>(make_headless_screen({.validation = validation}, width, height),
                                        options);
    }
    static void run(Viewer& viewer, int frames)
    {
        for (int k = 0; k < frames; ++k) viewer.frame(1 / script_frame_rate, 1e9);
    }
    static Image picture_of(Viewer& viewer)
    {
        const auto file = std::filesystem::temp_directory_path() /
                          ("pliant_viewer_test_" + std::to_string(::getpid()) + ".png");
        viewer.handle({.kind = Kind::screenshot, .text = file.string()});
        run(viewer, 1);
        int width = 0, height = 0, channels = 0;
        stbi_uc* pixels = stbi_load(file.c_str(), &width, &height, &channels, 4);
        EXPECT_NE(pixels, nullptr) << file;
        std::filesystem::remove(file);
        Image image{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
        if (pixels) image.rgba.assign(pixels, pixels + 4 * width * height);
        stbi_image_free(pixels);
        return image;
    }
};

/// Means of 4 x 4 pixels: what a reference is compared by, so that edges may differ by a pixel.
Image reduced(const Image& image)
{
    Image small{image.width / 4, image.height / 4, {}};
    for (std::uint32_t y = 0; y < small.height; ++y)
        for (std::uint32_t x = 0; x < small.width; ++x)
            for (std::uint32_t c = 0; c < 4; ++c) {
                unsigned sum = 0;
                for (std::uint32_t k = 0; k < 16; ++k)
                    sum += image.rgba[4 * ((4 * y + k / 4) * image.width + 4 * x + k % 4) + c];
                small.rgba.push_back(static_cast<std::uint8_t>((sum + 8) / 16));
            }
    return small;
}

/// Rasterisers may place samples a little differently: of 255, 1 in the mean, and a few blocks along edges
/// more.
void expect_alike(const Image& image, const std::uint8_t* other, const std::string& name)
{
    double sum = 0;
    int far = 0;
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        const int difference = std::abs(int{image.rgba[i]} - int{other[i]});
        sum += difference;
        far += difference > 24;
    }
    EXPECT_LT(sum / static_cast<double>(image.rgba.size()), 1.0) << name;
    EXPECT_LT(far, static_cast<int>(image.rgba.size() / 100)) << name;
}

/// Compares with a stored picture, which PLIANT_UPDATE_PICTURES=1 replaces by what there is now.
void expect_picture(const Image& image, const std::string& name)
{
    const auto file = std::filesystem::path(test::project_folder) / "tests/data/pictures" / (name + ".png");
    const Image small = reduced(image);
    if (std::getenv("PLIANT_UPDATE_PICTURES")) return write_png(file, small);
    int width = 0, height = 0, channels = 0;
    stbi_uc* stored = stbi_load(file.c_str(), &width, &height, &channels, 4);
    ASSERT_NE(stored, nullptr) << file << " is missing";
    ASSERT_EQ(static_cast<std::uint32_t>(width), small.width);
    ASSERT_EQ(static_cast<std::uint32_t>(height), small.height);
    expect_alike(small, stored, name);
    stbi_image_free(stored);
}

TEST_F(ViewerTest, ShowsEveryOverlay)
{
    auto viewer = viewer_of(Backend::cpu);
    viewer->open(std::string(test::project_folder) + "/tests/data/viewer_cloth.json");
    viewer->view().panel = false;
    run(*viewer, 40);
    viewer->session().paused = true;
    std::vector<Image> seen{picture_of(*viewer)};
    expect_picture(seen.front(), "plain");
    EXPECT_GT(viewer->session().simulation().report().solver.active_last, 0u)
        << "nothing for `active` to show";
    for (const Overlay overlay : {Overlay::strain, Overlay::springs, Overlay::active, Overlay::multipliers,
                                  Overlay::contacts, Overlay::normals, Overlay::wireframe}) {
        viewer->view().overlays = {overlay};
        seen.push_back(picture_of(*viewer));
        const std::string name = overlay_names[static_cast<std::size_t>(overlay)];
        expect_picture(seen.back(), name);
        for (std::size_t k = 0; k + 1 < seen.size(); ++k) EXPECT_NE(seen[k].rgba, seen.back().rgba) << name;
    }
    viewer->open("inflate");
    viewer->view().panel = false;
    run(*viewer, 30);
    viewer->session().paused = true;
    viewer->view().overlays = {Overlay::volume};
    expect_picture(picture_of(*viewer), "volume");
    const Image without = picture_of(*viewer);
    viewer->view().panel = true;
    run(*viewer, 2);  // what is in it changes with the clock, so that there is no stored picture of it
    EXPECT_NE(picture_of(*viewer).rgba, without.rgba);
    EXPECT_EQ(viewer->screen().device()->validation_messages(), 0u);
}

TEST_F(ViewerTest, ShowsTheSameFromCpuAndVulkan)
{
    std::vector<std::vector<Image>> seen;
    for (const Backend backend : {Backend::cpu, Backend::vulkan}) {
        auto viewer = viewer_of(backend, 200, 120);
        viewer->open("parity");
        viewer->view().panel = false;
        viewer->session().speed = 0.75;  // so that what is seen lies between two states
        run(*viewer, 6);
        EXPECT_LT(viewer->session().blend(), 1.0f);
        auto& pictures = seen.emplace_back();
        for (const Overlay overlay : {Overlay::strain, Overlay::contacts, Overlay::normals}) {
            viewer->view().overlays = {overlay};
            pictures.push_back(picture_of(*viewer));
        }
        EXPECT_EQ(viewer->screen().device()->validation_messages(), 0u);
    }
    for (std::size_t k = 0; k < seen[0].size(); ++k) EXPECT_EQ(seen[0][k].rgba, seen[1][k].rgba) << k;
}

TEST_F(ViewerTest, AllocatesNothingInAFrame)
{
    EXPECT_EQ(allocations > 0, counts_allocations);
    const auto check = [](Backend backend, const std::string& scene) {
        // The validation layer allocates by these operators, too.
        auto viewer = viewer_of(backend, 160, 90, false);
        viewer->open(scene);
        run(*viewer, 45);  // programs are made, vectors have grown, and passes were timed twice
        const long long before = allocations;
        run(*viewer, 25);
        EXPECT_EQ(allocations - before, 0) << name_of(backend) << ' ' << scene;
        EXPECT_TRUE(viewer->session().report().finite);
    };
    const std::string small = std::string(test::project_folder) + "/tests/data/viewer_cloth.json";
    check(Backend::cpu, "parity");
    check(Backend::cpu, "inflate");
    check(Backend::cpu, small);
    check(Backend::vulkan, "incline_rest");
}

/// What changes in a viewer that somebody plays with, the k-th time.
void change_everything(Viewer& viewer, int k)
{
    const char* scenes[] = {"chain", "incline_rest", "incline_slide"};
    viewer.handle({.kind = Kind::scene, .text = scenes[k % 3]});
    viewer.handle({.kind = Kind::resize, .x = 64.0 + k % 5 * 16, .y = 48.0 + k % 7 * 8});
    viewer.view().overlays = {static_cast<Overlay>(k % 8)};
    viewer.frame(1 / script_frame_rate, 1e9);
}

TEST_F(ViewerTest, LeavesNothingBehindWhenScenesAndSizesChange)
{
    // Without the validation layer, which allocates by these operators, too, and keeps some of it.
    auto viewer = viewer_of(Backend::cpu, 96, 64, false);
    const auto alive_in_the_end = [&] {
        change_everything(*viewer, 0);
        run(*viewer, 2);
        return alive.load();
    };
    for (int k = 0; k < 24; ++k) change_everything(*viewer, k);
    const long long before = alive_in_the_end();
    constexpr int changes = 200;
    for (int k = 0; k < changes; ++k) change_everything(*viewer, k);
    EXPECT_LT(std::abs(alive_in_the_end() - before), changes) << "what leaves one thing behind leaves 200";
    EXPECT_TRUE(viewer->session().notice.empty()) << viewer->session().notice;
}

TEST_F(ViewerTest, ChangesScenesAndSizesWithoutComplaint)
{
    const std::uint64_t messages = vulkan::Device::all_validation_messages();
    {
        auto viewer = viewer_of(Backend::cpu, 96, 64);
        for (int k = 0; k < 24; ++k) change_everything(*viewer, k);
    }
    EXPECT_EQ(vulkan::Device::all_validation_messages(), messages);
}

TEST_F(ViewerTest, GoesOnWhenMinimised)
{
    auto viewer = viewer_of(Backend::cpu, 96, 64);
    viewer->open("hanging");
    run(*viewer, 2);
    viewer->handle({.kind = Kind::resize});
    const double time = viewer->session().simulation().time();
    run(*viewer, 3);
    EXPECT_NEAR(viewer->session().simulation().time(), time + 3.0 / 60, 1e-9);
    viewer->handle({.kind = Kind::resize, .x = 80, .y = 60});
    run(*viewer, 1);
    EXPECT_EQ(picture_of(*viewer).width, 80u);
}

TEST_F(ViewerTest, StaysResponsiveWhenTheSimulationIsSlow)
{
    auto viewer = viewer_of(Backend::cpu, 96, 64);
    viewer->open("hanging");
    viewer->session().most_steps = 3;
    viewer->frame(0.25, 1e9);  // 15 frames of the simulation are due
    EXPECT_NEAR(viewer->session().simulation().time(), 3.0 / 60, 1e-9);
    EXPECT_TRUE(viewer->session().is_behind());
    viewer->frame(1.0 / 60, 1e9);  // what could not be done is not owed
    EXPECT_NEAR(viewer->session().simulation().time(), 4.0 / 60, 1e-9);
    EXPECT_FALSE(viewer->session().is_behind());
}

TEST_F(ViewerTest, AnswersWhileAStepRuns)
{
    auto viewer = viewer_of(Backend::cpu, 96, 64);
    viewer->open("cloth_sphere");  // frames of a tenth of a second and more
    viewer->view().panel = false;
    Session& session = viewer->session();
    int frames_beside_a_step = 0;
    for (int k = 0; k < 1000 && frames_beside_a_step < 3; ++k) {
        const bool busy = !session.is_idle();
        viewer->frame(1 / script_frame_rate, 0);  // waits for no step
        frames_beside_a_step += busy && !session.is_idle();
    }
    EXPECT_EQ(frames_beside_a_step, 3) << "pictures wait for steps";
    // What is done meanwhile counts when the step has ended, in order, and nothing of it is lost.
    viewer->handle({.kind = Kind::set, .text = "gravity=[0,0,0]"});
    viewer->handle({.kind = Kind::key, .code = 'P', .down = true});
    viewer->handle({.kind = Kind::scene, .text = "chain"});
    viewer->handle({.kind = Kind::key, .code = ' ', .down = true});
    viewer->frame(1 / script_frame_rate, 1e9);
    viewer->frame(1 / script_frame_rate, 1e9);
    EXPECT_EQ(session.simulation().scene().name, "chain");
    EXPECT_TRUE(session.paused);
    EXPECT_EQ(session.simulation().time(), 0.0);
    EXPECT_EQ(viewer->screen().device()->validation_messages(), 0u);
}

TEST_F(ViewerTest, StepsTheSameOnItsThreadAsWithoutAViewer)
{
    auto viewer = viewer_of(Backend::cpu, 96, 64);
    viewer->open("hanging");
    Session& session = viewer->session();
    while (session.report().frames < 12) viewer->frame(1 / script_frame_rate, 0);  // by whatever clock
    session.paused = true;
    viewer->frame(0, 1e9);
    Simulation alone(session.scene(), {.backend = Backend::cpu, .threads = 1});
    while (alone.report().frames < session.simulation().report().frames) alone.advance(1.0 / 60);
    EXPECT_EQ(session.simulation().state_hash(), alone.state_hash());
}

TEST_F(ViewerTest, TellsWhatCannotBeAndGoesOn)
{
    auto viewer = viewer_of(Backend::cpu, 96, 64);
    viewer->open("inflate");
    viewer->handle({.kind = Kind::method, .text = "constraint"});  // bodies are not stepped by it
    run(*viewer, 1);
    EXPECT_NE(viewer->session().notice.find("mass_spring and volume"), std::string::npos);
    EXPECT_EQ(viewer->session().scene().method, Method::volume);
    viewer->handle({.kind = Kind::drop, .text = "no_such_file.json"});
    EXPECT_NE(viewer->session().notice.find("no_such_file"), std::string::npos);
    EXPECT_EQ(viewer->session().opened(), "inflate");
    viewer->handle({.kind = Kind::set, .text = "bodies[0].no_such_field=1"});
    EXPECT_NE(viewer->session().notice.find("no_such_field"), std::string::npos);
    run(*viewer, 1);
}

TEST(OrbitCameraTest, RaysGoWherePointsAreSeen)
{
    Camera given;
    given.position = {1, 2, 3};
    given.target = {0.2, 0.4, -0.1};
    const OrbitCamera camera(given);
    const double width = 640, height = 360;
    const Camera now = camera.camera();
    EXPECT_NEAR(length(now.position - given.position), 0, 1e-12);
    const Matrix4 clip = clip_from_world(now, width / height);
    for (const Vec3d point : {Vec3d{0.3, 0.1, 0.2}, Vec3d{-0.4, 0.6, 0}, Vec3d{0, 0, 0.9}}) {
        const Vec3d seen = seen_at(clip, point, width, height);
        const Ray ray = camera.ray(seen.x, seen.y, width, height);
        EXPECT_NEAR(length(cross(point - ray.origin, ray.direction)), 0, 1e-9) << "the ray passes the point";
    }
}

TEST(OrbitCameraTest, TurnsAboutItsCentre)
{
    OrbitCamera camera{Camera{}};
    const double distance = camera.distance();
    camera.orbit(200, -30, 400);
    EXPECT_NEAR(length(camera.camera().position - camera.centre()), distance, 1e-12);
    EXPECT_EQ(camera.centre(), Camera{}.target);
    camera.dolly(2);
    EXPECT_NEAR(camera.distance(), 0.81 * distance, 1e-12);
    camera.frame({1, 1, 1}, 0.5, 1.5);
    EXPECT_EQ(camera.centre(), (Vec3d{1, 1, 1}));
}

TEST(Label, IsReadInTheCornerOfItsPart)
{
    const Image plain{480, 270, std::vector<std::uint8_t>(std::size_t{4} * 480 * 270, 128)};
    const auto changed = [&](const Image& image, std::uint32_t left, std::uint32_t right) {
        std::size_t count = 0;
        for (std::size_t y = 0; y < plain.height; ++y)
            for (std::size_t x = left; x < right; ++x)
                count += image.rgba[4 * (y * plain.width + x)] != plain.rgba[0];
        return count;
    };
    Image one = plain, other = plain, narrow = plain;
    write_label(one, 240, "mass_spring");
    EXPECT_EQ(changed(one, 0, 240), 0u);
    EXPECT_GT(changed(one, 240, 330), 500u);
    EXPECT_EQ(changed(one, 330, 480), 0u);
    write_label(other, 240, "constraint");
    EXPECT_NE(one.rgba, other.rgba);
    write_label(narrow, 470, "constraint");  // is cut off
    EXPECT_GT(changed(narrow, 470, 480), 20u);
}

TEST(Script, NamesWhatIsWrong)
{
    const auto file =
        std::filesystem::temp_directory_path() / ("pliant_script_" + std::to_string(::getpid()) + ".json");
    const auto reads = [&](const char* text) {
        std::ofstream(file) << text;
        return read_script(file.string());
    };
    const auto events = reads(R"({"events": [{"at": 0.5, "key": "space"}, {"at": 0, "move": [3, 4]}]})");
    ASSERT_EQ(events.size(), 3u);
    EXPECT_EQ(events[0].event.kind, Kind::move);
    EXPECT_EQ(events[1].frame, 30u);
    EXPECT_FALSE(events[2].event.down);
    EXPECT_ERROR(reads("{"), bad_input, "is not JSON");
    EXPECT_ERROR(reads("{\"event\": []}"), bad_input, "the list 'events'");
    EXPECT_ERROR(reads(R"({"events": [{"key": "space"}]})"), bad_input, "events[0].at");
    EXPECT_ERROR(reads(R"({"events": [{"at": 1, "key": "hyper"}]})"), bad_input, "'hyper'");
    EXPECT_ERROR(reads(R"({"events": [{"at": 1, "click": "left"}]})"), bad_input, "'click'");
    EXPECT_ERROR(reads(R"({"events": [{"at": 1, "press": "first"}]})"), bad_input, "left, right or middle");
    std::filesystem::remove(file);
    EXPECT_ERROR(read_script(file.string()), bad_input, "cannot be read");
}

}  // namespace
}  // namespace pliant::tool

// The content of pictures.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "pliant/scene.hpp"
#include "render/renderer.hpp"
#include "render/scene_drawing.hpp"
#include "test_cloths.hpp"
#include "test_errors.hpp"

namespace pliant {
namespace {

/// A sheet at a moment.
struct Sheet {
    std::uint32_t rows, columns;
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;

    ClothTopology topology() const
    {
        return {triangles, static_cast<std::uint32_t>(positions.size()), rows, columns};
    }
    HostCloth host() const { return {positions}; }
    Vec3d node(std::uint32_t row, std::uint32_t column) const
    {
        return to_double(positions[row * columns + column]);
    }
};

/// One metre square at a height, sagging by `sag` along a parabola in x.
Sheet make_sheet(std::uint32_t rows, std::uint32_t columns, double height, double sag = 0)
{
    Sheet sheet{rows, columns, {}, {}};
    for (std::uint32_t i = 0; i < rows; ++i)
        for (std::uint32_t j = 0; j < columns; ++j) {
            const double x = double(j) / (columns - 1) - 0.5, z = double(i) / (rows - 1) - 0.5;
            sheet.positions.push_back(to_float(Vec3d{x, height + sag * (4 * x * x - 1), z}));
        }
    for (std::uint32_t i = 0; i + 1 < rows; ++i)
        for (std::uint32_t j = 0; j + 1 < columns; ++j) {
            const std::uint32_t a = i * columns + j, b = a + 1, c = a + columns, d = c + 1;
            sheet.triangles.push_back({a, c, b});
            sheet.triangles.push_back({b, c, d});
        }
    return sheet;
}

Scene scene_for(const Sheet& sheet, double height)
{
    Scene scene;
    auto cloth = scene.add(Cloth::sheet({.rows = sheet.rows, .columns = sheet.columns}));
    cloth->position = {0, height, 0};
    scene.add(Plane{});
    scene.camera.width = 320;
    scene.camera.height = 180;
    return scene;
}

struct Pixel {
    int r = 0, g = 0, b = 0;
    int sum() const { return r + g + b; }
    friend bool operator==(const Pixel&, const Pixel&) = default;
};

/// The pixel that shows a point of the world if nothing is in front of it.
Pixel pixel_at(const Image& image, const Camera& camera, Vec3d point)
{
    const auto clip = clip_from_world(camera, double(image.width) / image.height) * to_point(point);
    const auto x = static_cast<long>(std::floor((clip[0] / clip[3] + 1) / 2 * image.width));
    const auto y = static_cast<long>(std::floor((clip[1] / clip[3] + 1) / 2 * image.height));
    EXPECT_TRUE(x >= 0 && y >= 0 && x < long(image.width) && y < long(image.height))
        << "outside of the picture";
    const std::uint8_t* pixel =
        &image.rgba.at(4 * (static_cast<std::size_t>(y) * image.width + static_cast<std::size_t>(x)));
    return {pixel[0], pixel[1], pixel[2]};
}

class Picture : public testing::Test {
protected:
    void SetUp() override
    {
        if (vulkan::list_physical_devices().empty()) GTEST_SKIP() << "there is no Vulkan device";
        device = test::shared_device();
        if (!device->can_draw()) GTEST_SKIP() << "the device cannot draw";
    }
    void TearDown() override
    {
        if (device) {
            EXPECT_EQ(device->validation_messages(), 0u);
        }
    }

    Image draw(const Scene& scene, const Sheet& sheet, double time = 0)
    {
        const std::vector<ClothTopology> topologies{sheet.topology()};
        const std::vector<ClothFrame> frames{sheet.host()};
        return Renderer(device, scene, topologies).draw(time, frames);
    }
    /// The same scene, light and camera without visible cloth.
    Image draw_without_cloth(const Scene& scene, Sheet sheet)
    {
        sheet.triangles.clear();
        return draw(scene, sheet);
    }

    std::shared_ptr<vulkan::Device> device;
};

TEST_F(Picture, shows_the_cloth_where_its_nodes_are)
{
    for (const double sag : {0.0, 0.3}) {
        const Sheet sheet = make_sheet(17, 23, 0.5, sag);
        Scene scene = scene_for(sheet, 0.5);
        scene.camera.position = {0.8, 2.2, 2};  // no part of it is seen edge-on
        const Image with = draw(scene, sheet), without = draw_without_cloth(scene, sheet);
        ASSERT_EQ(with.rgba.size(), 4u * 320 * 180);
        for (std::uint32_t row = 1; row + 1 < sheet.rows; ++row)
            for (std::uint32_t column = 1; column + 1 < sheet.columns; ++column)
                EXPECT_NE(pixel_at(with, scene.camera, sheet.node(row, column)),
                          pixel_at(without, scene.camera, sheet.node(row, column)))
                    << row << ", " << column;
        // and not where they are not
        std::size_t same = 0;
        for (std::size_t i = 0; i < with.rgba.size(); i += 4) same += with.rgba[i] == without.rgba[i];
        EXPECT_GT(same, with.rgba.size() / 4 / 2);
    }
}

TEST_F(Picture, has_up_above_and_right_at_the_right)
{
    // Without the projection matrix with which all other tests find their pixels.
    const Sheet sheet = make_sheet(9, 9, 0.5);
    const auto differences = [&](Vec3d moved) {
        Scene scene = scene_for(sheet, 0.5);
        scene.camera.position = {0, 0.5, 3};
        scene.camera.target = {0, 0.5, 0};
        Sheet there = sheet;
        for (Vec3& x : there.positions)
            x = to_float(Vec3d{0.3 * x.x, 0.5 + 0.3 * x.z, 0} + moved);  // stands, and faces the camera
        const Image with = draw(scene, there), without = draw_without_cloth(scene, there);
        std::array<std::size_t, 4> changed{};  // in the upper, lower, left and right half
        for (std::size_t i = 0; i < with.rgba.size() / 4; ++i) {
            const std::size_t x = i % 320, y = i / 320;
            const bool is_other = with.rgba[4 * i] != without.rgba[4 * i];
            changed[y < 90 ? 0 : 1] += is_other;
            changed[x < 160 ? 2 : 3] += is_other;
        }
        return changed;
    };
    const auto above = differences({0, 0.5, 0}), right = differences({0.8, 0, 0});
    EXPECT_GT(above[0], 200u);
    EXPECT_GT(above[0], 2 * above[1]);  // its shadow
    EXPECT_GT(right[3], 200u);
    EXPECT_GT(right[3], 2 * right[2]);
}

TEST_F(Picture, is_the_same_from_host_and_device_and_every_time)
{
    const Sheet sheet = make_sheet(33, 31, 0.6, 0.2);
    const Scene scene = scene_for(sheet, 0.6);
    std::vector<float> packed;
    for (const Vec3& x : sheet.positions) packed.insert(packed.end(), {x.x, x.y, x.z, 7.0f});
    const auto position =
        device->make_buffer(packed.size() * sizeof(float), vk::BufferUsageFlagBits::eStorageBuffer,
                            vulkan::Memory::device, "positions");
    device->write(position, packed.data(), packed.size() * sizeof(float));
    const std::vector<ClothTopology> topologies{sheet.topology()};
    const std::vector<ClothFrame> on_host{sheet.host()};
    const std::vector<ClothFrame> on_device{DeviceCloth{*position, 33 * 31}};
    Renderer renderer(device, scene, topologies);
    const Image first = renderer.draw(0, on_device);
    EXPECT_EQ(renderer.draw(0, on_host).rgba, first.rgba);
    EXPECT_EQ(renderer.draw(0, on_device).rgba, first.rgba);
    Image kept;
    renderer.draw(0, on_host, kept);
    const auto* memory = kept.rgba.data();
    renderer.draw(0, on_host, kept);
    EXPECT_EQ(kept.rgba, first.rgba);
    EXPECT_EQ(kept.rgba.data(), memory);
}

TEST_F(Picture, shows_nothing_of_the_picture_before)
{
    // A renderer redraws what cloths, colliders and their shadows cover now or covered before, and nothing
    // else.
    Sheet sheet = make_sheet(17, 17, 0.8);
    Scene scene = scene_for(sheet, 0.8);
    scene.camera.position = {0.5, 2.2, 3};
    for (const bool with_plane : {true, false}) {
        if (!with_plane) scene.colliders.clear();
        scene.add(
            Sphere{.centre = {-1, 0.3, 0}, .radius = 0.1, .keyframes = {{0, {}, {}}, {1, {2, 0.5, 0}, {}}}});
        scene.add(Capsule{.start = {0.6, 0.1, -0.5}, .end = {0.9, 0.3, -0.5}, .radius = 0.05});
        const std::vector<ClothTopology> topologies{sheet.topology()};
        Renderer renderer(device, scene, topologies);
        for (int k = 0; k < 6; ++k) {
            const double time = 0.2 * k, shrink = k == 4 ? 0.2 : 1;
            std::vector<Vec3> positions;
            for (const Vec3& x : sheet.positions)
                positions.push_back(to_float(Vec3d{shrink * double{x.x} - 0.6 + 0.3 * k,
                                                   double{x.y} - 0.12 * k, shrink * double{x.z} + 0.1 * k}));
            const std::vector<ClothFrame> frames{HostCloth{positions}};
            PictureState state{.camera = scene.camera, .time = time, .frames = frames};
            if (k == 3) state.camera.position.x -= 0.7;
            Image alone, after;
            Renderer(device, scene, topologies).draw(state, alone);
            renderer.draw(state, after);
            EXPECT_EQ(after.rgba, alone.rgba) << k;
        }
    }
}

TEST_F(Picture, knows_what_it_touches)
{
    const Sheet sheet = make_sheet(9, 9, 0.5);
    const Scene scene = scene_for(sheet, 0.5);
    const Stage stage = make_stage(scene);
    const ShapeMeshes meshes = make_shape_meshes();
    std::vector<PlacedCollider> ground{placed_at(Plane{}, 0)};
    const auto area_of = [&](std::span<const Vec3> points) {
        TouchedArea touched(stage, scene.camera, 320, 180, stage.shadow_extent / 2048, ground, meshes);
        touched.include(points);
        return touched.area();
    };
    const std::optional<PixelArea> area = area_of(sheet.positions);
    ASSERT_TRUE(area);
    EXPECT_LT(area->width() * area->height(), 320u * 180 / 2);
    EXPECT_TRUE(area_of({})->empty());
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const Vec3 point : {Vec3{nan, 0, 0}, Vec3{0, nan, 0}, Vec3{1.7f, 1.3f, 2.4f}})  // behind the camera
        EXPECT_FALSE(area_of(std::array{point})) << point.x;
    ground[0].moves = true;
    EXPECT_FALSE(area_of(sheet.positions));
}

TEST_F(Picture, takes_uploads_while_others_are_on_their_way)
{
    // Prepares as many pictures as there are slots before drawing the first: a shared slot would show the
    // last upload, and a wait would never end.
    constexpr unsigned slots = 3;
    const vk::Extent2D size{160, 90};
    std::vector<Sheet> sheets;
    for (unsigned k = 0; k < slots; ++k) sheets.push_back(make_sheet(17, 17, 0.3 + 0.2 * k, 0.1 * k));
    Scene scene = scene_for(sheets[0], 0.5);
    std::tie(scene.camera.width, scene.camera.height) = std::pair(size.width, size.height);
    const std::vector<ClothTopology> topologies{sheets[0].topology()};
    std::vector<std::unique_ptr<vulkan::OffscreenTarget>> targets;
    for (unsigned k = 0; k < slots; ++k)
        targets.push_back(std::make_unique<vulkan::OffscreenTarget>(*device, size));
    const auto kit = std::make_shared<vulkan::PictureKit>(device, targets[0]->target().passes);
    vulkan::SceneDrawing drawing(kit, scene, topologies, slots);
    std::vector<vk::raii::CommandBuffer> commands;
    for (unsigned k = 0; k < slots; ++k) {
        const std::vector<ClothFrame> frames{sheets[k].host()};
        drawing.prepare({.camera = scene.camera, .frames = frames}, size, k);
        commands.push_back(device->make_commands());
        commands[k].begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
        drawing.begin(commands[k], targets[k]->target(), k);
        drawing.end(commands[k]);
        targets[k]->record_copy(commands[k]);
        commands[k].end();
    }
    for (unsigned k = 0; k < slots; ++k) {
        const vk::CommandBuffer handle = *commands[k];
        device->submit(vk::SubmitInfo({}, {}, handle));
    }
    device->wait_idle();
    for (unsigned k = 0; k < slots; ++k) {
        Image image;
        targets[k]->read(image);
        EXPECT_EQ(image.rgba, draw(scene, sheets[k]).rgba) << k;
    }
}

TEST_F(Picture, has_any_size)
{
    const Sheet sheet = make_sheet(5, 4, 0.5);
    Scene scene = scene_for(sheet, 0.5);
    for (const auto& [width, height] : {std::pair{333u, 217u}, {1u, 1u}, {64u, 700u}}) {
        scene.camera.width = width;
        scene.camera.height = height;
        const Image image = draw(scene, sheet);
        EXPECT_EQ(image.width, width);
        EXPECT_EQ(image.height, height);
        ASSERT_EQ(image.rgba.size(), std::size_t{4} * width * height);
        for (std::size_t i = 3; i < image.rgba.size(); i += 4) ASSERT_EQ(image.rgba[i], 255);
    }
}

/// Linear light of sRGB.
double light(std::uint8_t value)
{
    const double v = value / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// The root mean square difference, of 255, between a picture and the downsampled `large` one, `scale` times
/// as large, over pixels where that has an edge.
double error_at_edges(const Image& image, const Image& large, std::uint32_t scale)
{
    double sum = 0;
    int edges = 0;
    for (std::uint32_t y = 0; y < image.height * 7 / 8; ++y)  // below lies the legend of the large one
        for (std::uint32_t x = 0; x < image.width; ++x) {
            double mean = 0, least = 1, most = 0;
            for (std::uint32_t k = 0; k < scale * scale; ++k) {
                const std::size_t row = y * scale + k / scale, column = x * scale + k % scale;
                const double value = light(large.rgba[4 * (row * large.width + column)]);
                mean += value / (scale * scale);
                least = std::min(least, value), most = std::max(most, value);
            }
            if (most - least < 0.1) continue;
            const double seen = light(image.rgba[4 * (std::size_t{y} * image.width + x)]);
            sum += (seen - mean) * (seen - mean);
            ++edges;
        }
    EXPECT_GT(edges, 150);
    return 255 * std::sqrt(sum / edges);
}

TEST_F(Picture, has_smooth_edges)
{
    const auto error = [&](Scene scene, const Sheet& sheet) {
        constexpr std::uint32_t scale = 8;
        scene.camera.colour = ClothColour::strain;  // one colour
        const Image image = draw(scene, sheet);
        scene.camera.width *= scale, scene.camera.height *= scale;
        return error_at_edges(image, draw(scene, sheet), scale);
    };
    // Outlines: of a sheet, its folds, and shapes.
    Scene scene = scene_for(make_sheet(2, 2, 0.5), 0.5);
    scene.colliders.clear();
    scene.camera.position = {0.6, 1.0, 2.2};
    scene.add(Sphere{.centre = {0.2, 1.0, -0.3}, .radius = 0.25});
    scene.add(Capsule{.start = {-0.8, 0.2, 0}, .end = {-0.6, 0.9, 0.1}, .radius = 0.1});
    scene.add(Box{.centre = {0.9, 0.8, -0.6}, .size = {0.4, 0.5, 0.3}, .rotation = {20, 30, 10}});
    EXPECT_LT(error(scene, make_sheet(33, 31, 0.5, 0.4)), 10);  // jagged outlines: 26

    // Where surfaces cut through each other.
    scene.colliders.clear();
    scene.add(Plane{});
    scene.add(Sphere{.centre = {0.1, 0.05, 0.1}, .radius = 0.4});
    scene.add(Sphere{.centre = {-0.5, 0.1, 0.1}, .radius = 0.3});
    EXPECT_LT(error(scene, make_sheet(33, 31, 0.2, 0.3)), 6.5);  // jagged there: 7.7
}

TEST_F(Picture, darkens_the_ground_in_the_shadow_of_the_cloth)
{
    const Sheet sheet = make_sheet(9, 9, 1.0);
    Scene scene = scene_for(sheet, 1.0);
    scene.camera.position = {0.6, 2.6, 3.6};
    const Vec3d to_light = make_stage(scene).to_light;
    const auto shadow_of = [&](Vec3d node) { return node - to_light * (node.y / to_light.y); };
    const Image with = draw(scene, sheet), without = draw_without_cloth(scene, sheet);
    int compared = 0;
    for (std::uint32_t row = 1; row < 8; ++row)
        for (std::uint32_t column = 1; column < 8; ++column) {
            const Vec3d ground = shadow_of(sheet.node(row, column));
            // Does the sheet, at height 1, stand between the ground and the camera?
            const Vec3d eye = scene.camera.position, at_sheet = ground + (eye - ground) * (1.0 / eye.y);
            if (std::max(std::abs(at_sheet.x), std::abs(at_sheet.z)) < 0.55) continue;
            EXPECT_LT(pixel_at(with, scene.camera, ground).sum(),
                      0.8 * pixel_at(without, scene.camera, ground).sum());
            ++compared;
        }
    EXPECT_GE(compared, 10);
    // A hand's breadth outside of the shadow nothing changes.
    for (const Vec3d outside : {Vec3d{-0.65, 1, 0}, Vec3d{0.65, 1, 0}, Vec3d{0, 1, 0.65}})
        EXPECT_EQ(pixel_at(with, scene.camera, shadow_of(outside)),
                  pixel_at(without, scene.camera, shadow_of(outside)));
}

TEST_F(Picture, lets_shadows_fall_on_colliders_and_cloth)
{
    const Sheet sheet = make_sheet(9, 9, 1.2);
    Scene scene = scene_for(sheet, 1.2);
    scene.add(Sphere{.centre = {0, 0.4, 0}, .radius = 0.3});
    scene.camera.position = {0, 0.6, 3.5};
    const Stage stage = make_stage(scene);
    const Vec3d lit_side = Vec3d{0, 0.4, 0} + normalized(stage.to_light + Vec3d{0, 0, 1}, {}) * 0.3;
    const Vec3d at_sheet = lit_side + stage.to_light * ((1.2 - lit_side.y) / stage.to_light.y);
    // The sheet, wherever it must be to stand in the light of the sphere.
    Sheet above = sheet;
    for (Vec3& node : above.positions)
        node.x += static_cast<float>(at_sheet.x), node.z += static_cast<float>(at_sheet.z);
    const Pixel shaded = pixel_at(draw(scene, above), scene.camera, lit_side);
    const Pixel lit = pixel_at(draw_without_cloth(scene, above), scene.camera, lit_side);
    EXPECT_GT(lit.sum(), 500);
    EXPECT_LT(shaded.sum(), 0.8 * lit.sum());

    // A box between the sun and the sheet.
    Scene below = scene_for(sheet, 1.2);
    below.camera.position = {0, 3.5, 2.5};
    const Vec3d centre = sheet.node(4, 4), hidden = centre + stage.to_light * 1.0;
    const Image open = draw(below, sheet);
    below.add(Box{.centre = hidden, .size = {0.2, 0.2, 0.2}});
    EXPECT_LT(pixel_at(draw(below, sheet), below.camera, centre).sum(),
              0.8 * pixel_at(open, below.camera, centre).sum());
}

TEST_F(Picture, has_no_speckles_where_the_sun_is_free)
{
    // One colour from end to end: a speckle anywhere would be the surface shadowing itself.
    Sheet sheet = make_sheet(33, 33, 0.5);
    Scene scene = scene_for(sheet, 0.5);
    scene.camera.colour = ClothColour::strain;
    scene.camera.position = {0, 2.5, 0.8};
    const Image image = draw(scene, sheet);
    for (std::uint32_t row = 1; row < 32; ++row)
        for (std::uint32_t column = 1; column < 31; ++column)
            EXPECT_NEAR(pixel_at(image, scene.camera, sheet.node(row, column)).sum(),
                        pixel_at(image, scene.camera, sheet.node(row, column + 1)).sum(), 8);
}

TEST_F(Picture, has_a_checker_with_two_sides)
{
    const Sheet sheet = make_sheet(65, 65, 0.8);  // four nodes a square
    Scene scene = scene_for(sheet, 0.8);
    scene.camera.target = {0, 0.8, 0};
    scene.camera.position = {0, 3, 0.5};
    const Image above = draw(scene, sheet);
    const auto square = [&](const Image& image, std::uint32_t row, std::uint32_t column) {
        return pixel_at(image, scene.camera, sheet.node(4 * row + 2, 4 * column + 2));
    };
    for (std::uint32_t i = 0; i < 15; ++i) {
        EXPECT_GT(std::abs(square(above, 7, i).sum() - square(above, 7, i + 1).sum()), 150);
        EXPECT_GT(std::abs(square(above, i, 7).sum() - square(above, i + 1, 7).sum()), 150);
        EXPECT_NEAR(square(above, i, i).sum(), square(above, i + 1, i + 1).sum(), 40);
    }
    // The dark squares are blue in front and red behind.
    const auto dark = [&](const Image& image) {
        const Pixel a = square(image, 7, 7), b = square(image, 7, 8);
        return a.sum() < b.sum() ? a : b;
    };
    EXPECT_GT(dark(above).b, dark(above).r + 20);
    scene.camera.position = {0, 0.1, 1.5};
    const Image below = draw(scene, sheet);
    EXPECT_GT(dark(below).r, dark(below).b + 20);
}

TEST_F(Picture, shades_a_sheet_as_the_mesh_that_it_is)
{
    // At its four corners, where a single quadrant gives the normal; a mesh's normals come from triangles.
    // The border is bent up, so that cells are flat and corners steeper than their neighbours.
    Sheet sheet = make_sheet(5, 5, 0.5);
    for (Vec3& x : sheet.positions)
        x.y += (std::abs(x.x) > 0.4f ? 0.2f : 0.0f) + (std::abs(x.z) > 0.4f ? 0.2f : 0.0f);
    Scene scene = scene_for(sheet, 0.5);
    scene.camera.position = {0.1, 3.6, 0.9};
    scene.camera.colour = ClothColour::strain;  // one colour
    const Image as_sheet = draw(scene, sheet);
    Sheet mesh = sheet;
    mesh.rows = mesh.columns = 0;
    const Image as_mesh = draw(scene, mesh);
    for (const std::uint32_t row : {0u, 4u})
        for (const std::uint32_t column : {0u, 4u}) {
            const Vec3d corner = sheet.node(row, column),
                        inside = sheet.node(row == 0 ? 1 : 3, column == 0 ? 1 : 3);
            const Vec3d seen = corner * 0.85 + inside * 0.15;
            const Pixel a = pixel_at(as_sheet, scene.camera, seen), b = pixel_at(as_mesh, scene.camera, seen);
            EXPECT_NEAR(a.sum(), b.sum(), 3) << row << ", " << column;
        }
}

TEST_F(Picture, shows_strain_as_colour)
{
    Sheet sheet = make_sheet(9, 9, 0.5);
    Scene scene = scene_for(sheet, 0.5);
    scene.camera.position = {0, 2.5, 0.8};
    // Springs whose length at rest makes the sheet's stretch what is wanted.
    const auto middle = [&](float strain) {
        const std::vector<ClothTopology> topologies{sheet.topology()};
        const std::vector<ClothFrame> frames{sheet.host()};
        Renderer renderer(device, scene, topologies);
        std::vector<DrawnSpring> springs;
        for (std::uint32_t node = 0; node + 1 < 81; ++node)
            if (node % 9 < 8)
                springs.push_back({node, node + 1, SpringKind::structural, 0.125f / (1 + strain)});
        springs.push_back({38, 40, SpringKind::bend, 0.001f});  // does not count
        renderer.set_springs(0, springs);
        return pixel_at(renderer.draw(0, frames), scene.camera, sheet.node(4, 4) + Vec3d{0.03, 0, 0.03});
    };
    EXPECT_EQ(middle(0.0f), middle(0.1f));  // the checker does not care
    scene.camera.colour = ClothColour::strain;
    const Pixel none = middle(0), half = middle(0.05f), full = middle(0.1f);
    EXPECT_GT(none.b, none.g + 30);  // violet
    EXPECT_TRUE(half.g > half.r + 30 && half.g > half.b)
        << half.r << ' ' << half.g << ' ' << half.b;              // green
    EXPECT_TRUE(full.r > full.b + 100 && full.g > full.b + 100);  // yellow
    EXPECT_EQ(middle(0.5f), full);                                // beyond the range
    EXPECT_EQ(middle(-0.5f), none);
    // without springs
    EXPECT_EQ(pixel_at(draw(scene, sheet), scene.camera, sheet.node(4, 4) + Vec3d{0.03, 0, 0.03}), none);
}

TEST_F(Picture, shows_colliders_where_they_are_at_the_time)
{
    const Sheet sheet = make_sheet(2, 2, 0.02);
    const auto expect_moving = [&](Collider collider, Vec3d seen) {
        Scene scene = scene_for(sheet, 0.02);
        const Image empty = draw(scene, sheet);
        std::visit(
            [](auto& shape) {
                shape.keyframes = {{0, {}, {}}, {1, {0, 0, -0.8}, {0, 45, 0}}};
            },
            collider);
        scene.add(collider);
        const Image at_start = draw(scene, sheet, 0), at_end = draw(scene, sheet, 1);
        EXPECT_NE(pixel_at(at_start, scene.camera, seen), pixel_at(empty, scene.camera, seen));
        EXPECT_NE(at_start.rgba, at_end.rgba);
    };
    expect_moving(Sphere{.centre = {0.3, 0.5, 0}, .radius = 0.2}, {0.3, 0.6, 0.1});
    expect_moving(Box{.centre = {0.3, 0.5, 0}, .size = {0.3, 0.3, 0.3}}, {0.3, 0.5, 0.15});
    expect_moving(Capsule{.start = {-0.4, 0.4, 0}, .end = {0.4, 0.6, 0}, .radius = 0.1}, {0.3, 0.6, 0.08});
    expect_moving(Plane{.point = {0, 0.4, -0.3}, .normal = {0, 1, 1}}, {0, 0.4, -0.3});
    expect_moving(
        TaperedCapsule{
            .start = {-0.4, 0.4, 0}, .end = {0.4, 0.6, 0}, .start_radius = 0.05, .end_radius = 0.1},
        {0.3, 0.6, 0.08});
}

TEST_F(Picture, covers_a_sphere_that_a_coarse_cloth_lies_on)
{
    // The middle of a cell of 0.1 m is deeper than the sphere's surface; it must still hide the sphere.
    Sheet sheet = make_sheet(11, 11, 0);
    const Vec3d centre{0, 0.5, 0};
    for (std::size_t i = 0; i < sheet.positions.size(); ++i) {
        const Vec3 flat = sheet.positions[i];
        const double x = 0.6 * flat.x, z = 0.6 * flat.z;
        const Vec3d out = normalized(Vec3d{x, std::sqrt(0.25 - x * x - z * z), z}, {});
        sheet.positions[i] = to_float(centre + out * 0.5005);
    }
    Scene scene = scene_for(sheet, 1);
    scene.camera.position = {0, 3, 1};
    scene.camera.colour = ClothColour::strain;
    scene.add(Sphere{.centre = centre, .radius = 0.5});
    const Image image = draw(scene, sheet);
    for (std::uint32_t row = 0; row < 10; ++row)
        for (std::uint32_t column = 0; column < 10; ++column) {
            const Vec3d cell = (sheet.node(row, column) + sheet.node(row + 1, column + 1)) * 0.5;
            const Pixel pixel = pixel_at(image, scene.camera, cell);
            EXPECT_GT(pixel.b, pixel.g + 20) << row << ", " << column;  // violet, and not porcelain
        }
}

TEST_F(Picture, refuses_what_does_not_fit)
{
    const Sheet sheet = make_sheet(3, 3, 0.5);
    Scene scene = scene_for(sheet, 0.5);
    const std::vector<ClothTopology> topologies{sheet.topology()};
    Renderer renderer(device, scene, topologies);
    EXPECT_ERROR(renderer.draw(0, {}), bad_usage, "1 cloths, and 0");
    const Sheet other = make_sheet(3, 4, 0.5);
    const std::vector<ClothFrame> wrong{other.host()};
    EXPECT_ERROR(renderer.draw(0, wrong), bad_usage, "9 nodes was given 12 positions");
    const std::vector<ClothFrame> right{sheet.host()};
    EXPECT_EQ(renderer.draw(0, right).width, 320u);  // and goes on afterwards

    EXPECT_ERROR(Renderer(device, scene, {}), bad_usage, "it has 1, and 0");
    const std::vector<Triangle> outside{{0, 1, 9}};
    const std::vector<ClothTopology> torn{{outside, 9, 3, 3}}, short_of_nodes{{sheet.triangles, 9, 3, 4}};
    EXPECT_ERROR(Renderer(device, scene, torn), bad_usage, "the node 9 of 9");
    EXPECT_ERROR(Renderer(device, scene, short_of_nodes), bad_usage, "3 x 4");
    EXPECT_ERROR(Renderer(nullptr, scene, topologies), bad_usage, "device");
    scene.camera.width = 1u << 20;
    EXPECT_ERROR(Renderer(device, scene, topologies), device_failure, "1048576 x 180");
}

TEST(PictureLife, leaves_nothing_behind)
{
    if (vulkan::list_physical_devices().empty()) GTEST_SKIP() << "there is no Vulkan device";
    // The validation layer reports a device that is destroyed before its objects.
    testing::internal::CaptureStderr();
    {
        const auto device = std::make_shared<vulkan::Device>(vulkan::DeviceOptions{.validation = true});
        const Sheet sheet = make_sheet(3, 3, 0.5);
        Scene scene = scene_for(sheet, 0.5);
        scene.camera.colour = ClothColour::strain;
        const std::vector<ClothTopology> topologies{sheet.topology()};
        const std::vector<ClothFrame> frames{sheet.host()};
        for (int i = 0; i < 5; ++i) Renderer(device, scene, topologies).draw(0, frames);
    }
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_EQ(said.find("validation"), std::string::npos) << said;
}

}  // namespace
}  // namespace pliant

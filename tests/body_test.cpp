// Cloths made ready for stepping, and colliders in motion.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "body/cloth_model.hpp"
#include "body/collider_motion.hpp"
#include "test_cloths.hpp"

namespace pliant {
namespace {

ClothModel model_of(const Cloth& cloth)
{
    Scene scene;
    scene.add(cloth);
    return ClothModel(scene.cloth(0), scene);
}

TEST(Sheet, HasTheSpringsOfThePaper)
{
    // errata: 34 x 34 has 6,598 springs with all classes, 32 x 32 has 5,826.
    EXPECT_EQ(model_of(test::flat_sheet(34, 34)).springs.count, 6598u);
    EXPECT_EQ(model_of(test::flat_sheet(32, 32)).springs.count, 5826u);
    EXPECT_EQ(model_of(test::flat_sheet(34, 34)).springs.measured_count, 4422u);
    EXPECT_EQ(model_of(test::flat_sheet(2, 2)).springs.count, 6u);
}

TEST(Sheet, ListsExactlyTheSpringsItCounts)
{
    for (const auto& [rows, columns] : {std::pair{2u, 2u}, {2u, 9u}, {9u, 2u}, {3u, 3u}, {31u, 33u}}) {
        Cloth cloth = test::flat_sheet(rows, columns);
        cloth.formulation = Formulation::spring_list;
        const ClothModel model = model_of(cloth);
        EXPECT_EQ(model.springs.list.size(), model.springs.count);
        EXPECT_EQ(model.springs.neighbours.entries.size(), 2 * model.springs.count);
        for (std::size_t s = 1; s < model.springs.list.size(); ++s)
            EXPECT_LT(std::pair(model.springs.list[s - 1].i, model.springs.list[s - 1].j),
                      std::pair(model.springs.list[s].i, model.springs.list[s].j));
        for (const Spring& spring : model.springs.list) {
            const Vec3d d =
                to_double(model.shape.positions[spring.i]) - to_double(model.shape.positions[spring.j]);
            EXPECT_NEAR(std::sqrt(dot(d, d)), spring.rest_length, 1e-6);
        }
    }
}

TEST(Sheet, SharesItsMass)
{
    const ClothModel model =
        model_of(Cloth::sheet({.rows = 7, .columns = 5, .width = 2, .height = 3, .density = 0.3}));
    EXPECT_NEAR(std::accumulate(model.masses.kg.begin(), model.masses.kg.end(), 0.0), 0.3 * 6, 1e-6);
    EXPECT_EQ(model.masses.kg.front(), model.masses.kg.back());
    EXPECT_NEAR(model_of(Cloth::sheet({.rows = 2, .columns = 2, .node_mass = 0.25})).masses.kg[3], 0.25, 0);
}

TEST(Sheet, PinsCornersEdgesIndicesAndRegions)
{
    Cloth cloth = test::flat_sheet(4, 5);
    cloth.pin(Corner::bottom_right).pin(Edge::left).pin(2u).pin(Region{{-1, -1, -0.6}, {1, 1, -0.4}});
    const ClothModel model = model_of(cloth);
    for (std::uint32_t r = 0; r < 4; ++r)
        for (std::uint32_t c = 0; c < 5; ++c)
            EXPECT_EQ(model.masses.inverse(5 * r + c) == 0, (r == 3 && c == 4) || c == 0 || r == 0)
                << r << ", " << c;
}

TEST(Sheet, RefusesAPinThatHoldsNothing)
{
    Cloth cloth = test::flat_sheet(4, 5);
    cloth.pin(Corner::top_left).pin(Region{{5, 5, 5}, {6, 6, 6}});
    try {
        model_of(cloth);
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("pins[1]"), std::string::npos) << error.what();
    }
}

TEST(Sheet, LiesWhereItIsPut)
{
    Cloth cloth = test::flat_sheet(3, 3, 2, 4);
    cloth.position = {1, 2, 3};
    cloth.rotation = {90, 0, 0};  // about x: z turns to -y, so that row 0 ("top") is up
    const ClothModel model = model_of(cloth);
    EXPECT_NEAR(model.shape.positions[0].x, 0, 1e-6);
    EXPECT_NEAR(model.shape.positions[0].y, 4, 1e-6);
    EXPECT_NEAR(model.shape.positions[0].z, 3, 1e-6);
    EXPECT_NEAR(model.shape.positions[8].y, 0, 1e-6);
}

TEST(Sheet, TrianglesCoverItFacingUp)
{
    const ClothModel model = model_of(test::flat_sheet(4, 6, 2, 3));
    ASSERT_EQ(model.shape.triangles().size(), model.shape.triangle_count());
    double area = 0;
    for (const Triangle& t : model.shape.triangles()) {
        const Vec3d a = to_double(model.shape.positions[t[0]]), b = to_double(model.shape.positions[t[1]]),
                    c = to_double(model.shape.positions[t[2]]);
        const Vec3d n = cross(b - a, c - a);
        EXPECT_GT(n.y, 0);
        area += 0.5 * n.y;
    }
    EXPECT_NEAR(area, 6, 1e-5);
}

TEST(Mesh, EdgesAreStructuralAndOppositeVerticesBend)
{
    SurfaceMesh quad{{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}}, {{0, 2, 1}, {1, 2, 3}}};
    const ClothModel model = model_of(Cloth::mesh(quad, {.density = 0.6}));
    ASSERT_EQ(model.springs.list.size(), 6u);
    const std::vector<std::uint32_t>& node = model.shape.node_of_vertex;
    int bends = 0;
    for (const Spring& spring : model.springs.list)
        if (spring.spring_class == SpringClass::bend) {
            ++bends;
            EXPECT_EQ(std::minmax(node[0], node[3]), std::minmax(spring.i, spring.j));
            EXPECT_LT(spring.i, spring.j);
            EXPECT_NEAR(spring.rest_length, std::sqrt(2.0), 1e-12);
        }
    EXPECT_EQ(bends, 1);
    EXPECT_NEAR(model.masses.kg[node[0]], 0.1, 1e-7);  // a third of half the square
    EXPECT_NEAR(model.masses.kg[node[1]], 0.2, 1e-7);
    EXPECT_EQ(model.springs.measured_count, 5u);
}

TEST(Mesh, ADiscIsAMesh)
{
    const ClothModel model = model_of(Cloth::disc({.radius = 0.5, .rings = 12, .density = 0.4}));
    EXPECT_FALSE(model.shape.is_sheet());
    EXPECT_EQ(model.node_count(), 1 + 3u * 12 * 13);
    EXPECT_EQ(model.shape.triangle_count(), 6u * 12 * 12);
    double mass = 0;
    for (const double m : model.masses.kg) mass += m;
    EXPECT_NEAR(mass, 0.4 * 0.5 * 72 * 0.25 * std::sin(2 * std::numbers::pi / 72),
                1e-6);                                                         // a 72-sided polygon
    EXPECT_NEAR(model.shape.positions[model.node_count() - 72].x, 0.5, 1e-7);  // where the hem begins
}

TEST(Mesh, RefusesAVertexWithoutMass)
{
    SurfaceMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {5, 5, 5}}, {{0, 2, 1}}};
    try {
        model_of(Cloth::mesh(mesh, {.density = 0.6}));
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind, ErrorKind::bad_input);
        EXPECT_NE(std::string(error.what()).find("vertex 3"), std::string::npos) << error.what();
    }
    EXPECT_EQ(model_of(Cloth::mesh(mesh, {.node_mass = 0.1})).node_count(), 4u);
}

TEST(Stability, IsGershgorinsBound)
{
    // Two springs of k at each node of a triangle: omega^2 <= 2 * 2 k / m.
    SurfaceMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 2, 1}}};
    Cloth cloth = Cloth::mesh(mesh, {.node_mass = 0.5});
    cloth.springs = {{100, 0}, {0, 0}, {0, 0}};
    cloth.damping = 0;
    EXPECT_NEAR(model_of(cloth).stable_step(), 2 / std::sqrt(2 * 200 / 0.5), 1e-12);
    cloth.springs.structural = {0, 3};
    EXPECT_NEAR(model_of(cloth).stable_step(), 2 / (2 * 6 / 0.5), 1e-12);
    cloth.springs.structural = {0, 0};
    EXPECT_EQ(model_of(cloth).stable_step(), std::numeric_limits<double>::infinity());
}

TEST(Motion, InterpolatesAndKnowsItsVelocity)
{
    const std::vector<Keyframe> keyframes = {{1, {0, 0, 0}, {0, 0, 0}}, {3, {0, 4, 0}, {0, 360, 0}}};
    EXPECT_EQ(motion_at(keyframes, 0).offset, (Vec3d{0, 0, 0}));
    EXPECT_EQ(motion_at(keyframes, 0).velocity, (Vec3d{0, 0, 0}));
    const RigidMotion half = motion_at(keyframes, 2);
    EXPECT_NEAR(half.offset.y, 2, 1e-12);
    EXPECT_NEAR(half.velocity.y, 2, 1e-12);
    EXPECT_NEAR(half.spin.y, std::numbers::pi, 1e-12);
    EXPECT_NEAR(half.rotation[0].x, -1, 1e-12);
    EXPECT_EQ(motion_at(keyframes, 9).offset.y, 4);
}

TEST(Motion, SpinIsTheDerivativeOfTheRotation)
{
    const std::vector<Keyframe> keyframes = {{0, {}, {10, -20, 30}}, {2, {}, {100, 45, -60}}};
    constexpr double t = 0.7, h = 1e-5;
    const RigidMotion now = motion_at(keyframes, t), before = motion_at(keyframes, t - h),
                      after = motion_at(keyframes, t + h);
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3d moved = (after.rotation[k] - before.rotation[k]) * (0.5 / h);  // error of order h^2
        const Vec3d error = moved - cross(now.spin, now.rotation[k]);
        EXPECT_NEAR(std::sqrt(dot(error, error)), 0, 1e-8);
    }
}

TEST(Placement, KeepsShapes)
{
    const PlacedCollider plane = placed_at(Plane{.point = {0, 1, 0}, .normal = {3, 4, 0}}, 0);
    EXPECT_NEAR(plane.axes[1].x, 0.6, 1e-15);
    EXPECT_NEAR(plane.axes[1].y, 0.8, 1e-15);
    const PlacedCollider capsule = placed_at(Capsule{.start = {0, 0, 0}, .end = {0, 0, 2}, .radius = 0.3}, 0);
    EXPECT_EQ(capsule.centre, (Vec3d{0, 0, 1}));
    EXPECT_NEAR(capsule.axes[1].z, 1, 1e-15);
    EXPECT_EQ(capsule.half_size.y, 1);
    const PlacedCollider box = placed_at(Box{.centre = {}, .size = {2, 4, 6}, .rotation = {0, 0, 90}}, 0);
    EXPECT_NEAR(box.axes[0].y, 1, 1e-15);
    EXPECT_EQ(box.half_size.z, 3);
}

}  // namespace
}  // namespace pliant

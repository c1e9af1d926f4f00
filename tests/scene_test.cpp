// Scenes: the built-in ones, the builders and overrides. What is refused is in scene_refusal_test.cpp.
#include <limits>
#include <type_traits>

#include "test_errors.hpp"
#include "test_scenes.hpp"

namespace pliant::test {
namespace {

TEST(Scene, EveryBuiltInSceneIsReadByNameAndFromItsFile)
{
    const auto listings = list_scenes();
    EXPECT_GE(listings.size(), 11U);
    for (const SceneListing& listing : listings) {
        const Scene built_in = read_scene(listing.name);
        EXPECT_EQ(built_in.name, listing.name);
        EXPECT_EQ(built_in.description, listing.description);
        EXPECT_FALSE(built_in.checks.empty()) << listing.name;
        const Scene from_file = read_scene((root / listing.file).string());
        EXPECT_EQ(from_file.name, listing.name);
        EXPECT_EQ(from_file.cloth_count(), built_in.cloth_count());
    }
}

TEST(Scene, FieldsArriveWhereTheyBelong)
{
    const Scene scene = read_scene("moving_sphere");
    const Cloth& cloth = scene.cloth(0);
    EXPECT_EQ(std::get<SheetOptions>(cloth.shape).rows, 24U);
    EXPECT_EQ(cloth.density, 0.3);
    EXPECT_EQ(cloth.position, (Vec3d{0, 0.5, 0}));
    EXPECT_EQ(std::get<Edge>(cloth.pins.at(1).where), Edge::right);
    const auto& sphere = std::get<Sphere>(scene.colliders.at(0));
    EXPECT_EQ(sphere.radius, 0.15);
    EXPECT_EQ(sphere.keyframes.at(2).time, 2);
    EXPECT_EQ(sphere.keyframes.at(2).rotation, (Vec3d{0, 90, 0}));
    EXPECT_EQ(scene.gravity, (Vec3d{0, -9.81, 0}));
}

TEST(Scene, EveryKindOfPinAndColliderIsRead)
{
    const Scene scene = scene_of(R"({"pliant": 1, "cloths": [{"sheet": {"rows": 3, "columns": 3}, "pins": [
        {"index": 8}, {"corner": "bottom_right"}, {"edge": "bottom"},
        {"box": {"min": [0, 0, 0], "max": [1, 2, 3]}}]}],
        "colliders": [{"plane": {}}, {"capsule": {"start": [0, 0, 0], "end": [0, 1, 0], "radius": 0.2}},
        {"box": {"centre": [0, 0, 0], "size": [1, 2, 3], "response": "paper"}}]})");
    const auto& pins = scene.cloth(0).pins;
    EXPECT_EQ(std::get<std::uint32_t>(pins.at(0).where), 8U);
    EXPECT_EQ(std::get<Corner>(pins.at(1).where), Corner::bottom_right);
    EXPECT_EQ(std::get<Edge>(pins.at(2).where), Edge::bottom);
    EXPECT_EQ(std::get<Region>(pins.at(3).where).max, (Vec3d{1, 2, 3}));
    EXPECT_EQ(std::get<Plane>(scene.colliders.at(0)).normal, (Vec3d{0, 1, 0}));
    EXPECT_EQ(std::get<Capsule>(scene.colliders.at(1)).radius, 0.2);
    EXPECT_EQ(std::get<Box>(scene.colliders.at(2)).response, ContactResponse::paper);
}

TEST(Scene, TheOptionsOfMethodsAreRead)
{
    const Scene scene = scene_of(R"({"pliant": 1, "method": "constraint", "solver": "paper",
        "newton_multigrid": {"newton_iterations": 7, "newton_tolerance": 0.01, "linear_iterations": 9,
            "linear_tolerance": 0.2, "step_cuts": 1, "smoothing": 2, "order": 2, "resists": "both", "contact_stiffness": 2e4,
            "friction_speed": 0.01},
        "paper": {"tolerance": 1e-5, "max_iterations": 300, "compliance": 1e-8},
        "acad": {"activate_at": 0.2, "deactivate_at": 0.1, "compression": true, "target": "rest",
            "compliance": 1e-5},
        "cloths": [{"sheet": {"rows": 3, "columns": 3}, "springs": {
            "structural": {"role": "constraint", "limit": 0.01, "compliance": 1e-7},
            "shear": {"role": "spring"}, "bend": {"role": "off"}}}]})");
    EXPECT_EQ(scene.method, Method::constraint);
    EXPECT_EQ(scene.solver, Solver::paper);
    EXPECT_EQ(scene.newton_multigrid.newton_iterations, 7U);
    EXPECT_EQ(scene.newton_multigrid.newton_tolerance, 0.01);
    EXPECT_EQ(scene.newton_multigrid.linear_iterations, 9U);
    EXPECT_EQ(scene.newton_multigrid.linear_tolerance, 0.2);
    EXPECT_EQ(scene.newton_multigrid.step_cuts, 1U);
    EXPECT_EQ(scene.newton_multigrid.smoothing, 2U);
    EXPECT_EQ(scene.newton_multigrid.resists, Resists::both);
    EXPECT_EQ(scene.newton_multigrid.contact_stiffness, 2e4);
    EXPECT_EQ(scene.newton_multigrid.friction_speed, 0.01);
    EXPECT_EQ(scene.newton_multigrid.order, 2U);
    EXPECT_EQ(scene.paper.tolerance, 1e-5);
    EXPECT_EQ(scene.paper.max_iterations, 300U);
    EXPECT_EQ(scene.paper.compliance, 1e-8);
    EXPECT_EQ(scene.acad.activate_at, 0.2);
    EXPECT_EQ(scene.acad.deactivate_at, 0.1);
    EXPECT_TRUE(scene.acad.compression);
    EXPECT_EQ(scene.acad.target, AcadTarget::rest);
    EXPECT_EQ(scene.acad.compliance, 1e-5);
    const Springs& springs = scene.cloth(0).springs;
    EXPECT_EQ(springs.structural.role, SpringRole::constraint);
    EXPECT_EQ(springs.structural.limit, 0.01);
    EXPECT_EQ(springs.structural.compliance, 1e-7);
    EXPECT_EQ(springs.structural.stiffness, 1000);
    EXPECT_EQ(springs.shear.role, SpringRole::spring);
    EXPECT_EQ(springs.bend.role, SpringRole::off);

    // A copy, as each simulation makes one, has them all, too.
    const Scene copy = scene;  // NOLINT(performance-unnecessary-copy-initialization)
    EXPECT_EQ(copy.method, Method::constraint);
    EXPECT_EQ(copy.solver, Solver::paper);
    EXPECT_EQ(copy.newton_multigrid.newton_iterations, 7U);
    EXPECT_EQ(copy.paper.max_iterations, 300U);
    EXPECT_EQ(copy.acad.deactivate_at, 0.1);
}

TEST(Scene, MethodsAndSolversHaveTheNamesThatFilesGiveThem)
{
    for (const Method method : {Method::mass_spring, Method::constraint, Method::acad})
        EXPECT_EQ(read_scene("hanging", {std::string("method=") + name_of(method)}).method, method);
    for (const Solver solver : {Solver::newton_multigrid, Solver::paper})
        EXPECT_EQ(read_scene("hanging", {std::string("solver=") + name_of(solver)}).solver, solver);
    EXPECT_STREQ(name_of(Method::acad), "acad");
    EXPECT_STREQ(name_of(Solver::newton_multigrid), "newton_multigrid");
}

TEST(Scene, PinsMayMove)
{
    const Scene scene = scene_of(R"({"pliant": 1, "cloths": [{"sheet": {"rows": 3, "columns": 3}, "pins": [
        {"edge": "left"},
        {"corner": "top_right", "keyframes": [{"time": 0},
            {"time": 2, "position": [0.1, 0, 0], "rotation": [0, 90, 0]}]}]}]})");
    const auto& pins = scene.cloth(0).pins;
    EXPECT_TRUE(pins.at(0).keyframes.empty());
    EXPECT_EQ(std::get<Corner>(pins.at(1).where), Corner::top_right);
    ASSERT_EQ(pins.at(1).keyframes.size(), 2U);
    EXPECT_EQ(pins.at(1).keyframes[1].time, 2);
    EXPECT_EQ(pins.at(1).keyframes[1].position, (Vec3d{0.1, 0, 0}));
    EXPECT_EQ(pins.at(1).keyframes[1].rotation, (Vec3d{0, 90, 0}));
}

TEST(Scene, EverythingThatPinsIsAnAttachment)
{
    Cloth cloth = Cloth::sheet({.rows = 3, .columns = 3});
    const Pin corner = Corner::top_right;
    cloth.pin(corner).pin(Edge::top).pin(std::uint32_t{4}).pin(Region{{0, 0, 0}, {1, 1, 1}});
    cloth.pin({Edge::left, {{.time = 0}, {.time = 2, .position = {0.1, 0, 0}}}});
    cloth.pins.push_back(Edge::bottom);
    cloth.pins.emplace_back(corner);
    Attachment attachment = cloth.pins.at(4);
    cloth.pin(attachment);  // not const: a copy, and no attempt to make a Pin of it
    ASSERT_EQ(cloth.pins.size(), 8U);
    EXPECT_EQ(std::get<Corner>(cloth.pins[0].where), Corner::top_right);
    EXPECT_EQ(std::get<std::uint32_t>(cloth.pins[2].where), 4U);
    EXPECT_EQ(std::get<Edge>(cloth.pins[4].where), Edge::left);
    EXPECT_EQ(cloth.pins[4].keyframes.at(1).position, (Vec3d{0.1, 0, 0}));
    EXPECT_EQ(cloth.pins[7].keyframes.size(), 2U);
    static_assert(!std::is_constructible_v<Attachment, const char*> &&
                  !std::is_constructible_v<Attachment, double>);
}

TEST(Scene, DtSetsTheFrameRate)
{
    const Scene scene = scene_of(R"({"pliant": 1, "time": {"dt": 0.001, "substeps": 20},
                                     "cloths": [{"sheet": {"rows": 2, "columns": 2}}]})");
    EXPECT_DOUBLE_EQ(scene.time.frame_rate, 50);
    EXPECT_EQ(scene.time.substeps, 20U);
}

TEST(Scene, MeshFilesAreRelativeToTheScene)
{
    const TemporaryFile mesh("v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n", ".obj");
    const TemporaryFile scene(R"({"pliant": 1, "cloths": [{"mesh": {"file": ")" +
                              mesh.path.filename().string() + R"(", "scale": 2}, "pins": [{"index": 2}]}]})");
    const Scene read = read_scene(scene.path.string());
    EXPECT_EQ(std::get<SurfaceMesh>(read.cloth(0).shape).triangles.size(), 1U);
    EXPECT_EQ(read.cloth(0).scale, 2);
    EXPECT_EQ(read.name, scene.path.stem().string());
}

TEST(Scene, ReadsADisc)
{
    const Scene scene = scene_of(R"({"pliant": 1, "cloths": [
        {"disc": {"radius": 0.25, "rings": 5}, "density": 0.2, "pins": [{"index": 90}]}, {"disc": {"rings": 1}}]})");
    const auto& disc = std::get<DiscOptions>(scene.cloth(0).shape);
    EXPECT_EQ(disc.radius, 0.25);
    EXPECT_EQ(disc.rings, 5U);
    EXPECT_EQ(scene.cloth(0).density, 0.2);
    EXPECT_EQ(std::get<DiscOptions>(scene.cloth(1).shape).radius, 0.5);
    const Cloth built = Cloth::disc({.radius = 0.25, .rings = 5, .density = 0.2});
    EXPECT_EQ(std::get<DiscOptions>(built.shape).rings, 5U);
    EXPECT_EQ(built.density, 0.2);
}

TEST(Scene, WhatIsGivenBesideAMaterialGoesBeforeIt)
{
    const Scene scene = scene_of(R"({"pliant": 1, "cloths": [
        {"sheet": {"rows": 3, "columns": 3}, "material": "denim"},
        {"sheet": {"rows": 3, "columns": 3}, "density": 0.123, "material": "denim", "springs": {"bending_stiffness": 1e-5}}]})");
    const Cloth denim = Cloth::sheet({}).make_of(Material::denim);
    EXPECT_EQ(scene.cloth(0).density, denim.density);
    EXPECT_NE(denim.density, 0.123);
    EXPECT_EQ(scene.cloth(1).density, 0.123);
    EXPECT_EQ(scene.cloth(1).springs.bending_stiffness, 1e-5);
    EXPECT_EQ(scene.cloth(1).springs.structural.stiffness, denim.springs.structural.stiffness);
}

TEST(Scene, OverridesChangeTheDocumentBeforeItIsRead)
{
    const Scene scene =
        read_scene("cloth_sphere", {"time.duration=2", "cloths[0].springs.structural.stiffness=2000",
                                    "cloths[0].sheet.rows=64", "air.density=1.2", "name=renamed",
                                    "gravity[1]=-1.62", "cloths[0].density=null", "cloths[0].node_mass=1e-4",
                                    "cloths[0].pins[0]={\"corner\": \"top_left\"}", "colliders[2].plane={}"});
    EXPECT_EQ(scene.time.duration, 2);
    EXPECT_EQ(scene.cloth(0).springs.structural.stiffness, 2000);
    EXPECT_EQ(std::get<SheetOptions>(scene.cloth(0).shape).rows, 64U);
    EXPECT_EQ(scene.air.density, 1.2);
    EXPECT_EQ(scene.name, "renamed");
    EXPECT_EQ(scene.gravity.y, -1.62);
    EXPECT_FALSE(scene.cloth(0).density);
    EXPECT_EQ(scene.cloth(0).node_mass, 1e-4);
    EXPECT_EQ(scene.cloth(0).pins.size(), 1U);
    EXPECT_EQ(scene.colliders.size(), 3U);
}

TEST(Scene, BuildersFillAScene)
{
    Scene scene;
    auto cloth = scene.add(Cloth::sheet({.rows = 128, .columns = 64, .width = 2.0, .density = 0.4}));
    cloth.pin(Corner::top_left).pin(Corner::top_right);
    scene.add(Sphere{.centre = {0, 0.4, 0}, .radius = 0.3, .friction = 0.4});
    auto second = scene.add(
        Cloth::mesh({{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 1, 2}}}, {.node_mass = 0.1, .scale = 3}));
    cloth->name = "first";  // the handle survived a further add()
    validate(scene);

    EXPECT_EQ(second.index(), 1U);
    EXPECT_EQ(scene.cloth(0).name, "first");
    EXPECT_EQ(scene.cloth(0).density, 0.4);
    EXPECT_EQ(scene.cloth(0).pins.size(), 2U);
    EXPECT_EQ(scene.cloth(1).node_mass, 0.1);
    EXPECT_EQ(scene.cloth(1).scale, 3);

    Scene copy = scene;
    copy.cloth_handle(0)->name = "copied";
    EXPECT_EQ(scene.cloth(0).name, "first");
    scene = copy;
    EXPECT_EQ(scene.cloth(0).name, "copied");
    EXPECT_EQ(scene.colliders.size(), 1U);
}

}  // namespace
}  // namespace pliant::test

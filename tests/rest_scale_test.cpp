// Springs whose rest lengths are not those of the shape at the start.
#include <gtest/gtest.h>

#include <cmath>

#include "pliant/pliant.hpp"
#include "test_cloths.hpp"
#include "test_runners.hpp"

namespace pliant {
namespace {

struct RestCase {
    const char* name;
    Cloth (*cloth)();
};

const RestCase cases[] = {
    {"grid", [] { return test::flat_sheet(9, 13, 1.2, 0.8); }},
    {"list",
     [] {
         Cloth cloth = test::flat_sheet(9, 13, 1.2, 0.8);
         cloth.formulation = Formulation::spring_list;
         return cloth;
     }},
    {"half_border",
     [] {
         Cloth cloth = test::flat_sheet(9, 13, 1.2, 0.8);
         std::get<SheetOptions>(cloth.shape).border = SheetBorder::half;
         return cloth;
     }},
    {"mesh", [] { return Cloth::mesh(test::irregular_mesh(7, 9)); }},
    {"disc", [] { return Cloth::disc({.radius = 0.5, .rings = 6}); }},
};

class RestScale : public testing::TestWithParam<RestCase> {};
INSTANTIATE_TEST_SUITE_P(Cloths, RestScale, testing::ValuesIn(cases),
                         [](const auto& of) { return of.param.name; });

double distance(Vec3 a, Vec3 b)
{
    const Vec3d d = to_double(b) - to_double(a);
    return std::sqrt(dot(d, d));
}

TEST_P(RestScale, MultipliesTheRestLengthsOfEachClass)
{
    Scene scene;
    Cloth cloth = GetParam().cloth();
    cloth.springs.structural.rest_scale = 0.8;
    cloth.springs.shear.rest_scale = 0.9;
    cloth.springs.bend.rest_scale = 1.1;
    scene.add(cloth);
    for (const Backend backend : test::backends()) {
        Simulation simulation(scene, test::on(backend));
        const auto x = simulation.positions();
        bool bends = false;
        for (const SpringListing& spring : simulation.springs()) {
            const double scale = spring.kind == SpringKind::structural ? 0.8
                                 : spring.kind == SpringKind::shear    ? 0.9
                                                                       : 1.1;
            // Positions are rounded to floats: 2^-24 of 1 m, twice, against springs of 5 cm and more.
            EXPECT_NEAR(spring.rest_length / distance(x[spring.i], x[spring.j]), scale, 5e-6);
            bends |= spring.kind == SpringKind::bend;
        }
        EXPECT_TRUE(bends);
        // What the kernels measure at the start: 1 / 0.8 - 1.
        EXPECT_NEAR(simulation.report().measures.max_stretch, 0.25, 1e-5) << name_of(backend);
    }
}

/// A flat cloth all of whose springs are at rest at 0.8 times their length becomes one of 0.8 times the size.
void expect_to_shrink(Scene scene, const Cloth& cloth, double damping, double within)
{
    scene.gravity = {};
    Cloth shrinking = cloth;
    for (SpringParameters* of :
         {&shrinking.springs.structural, &shrinking.springs.shear, &shrinking.springs.bend})
        of->rest_scale = 0.8;
    shrinking.damping = damping;
    shrinking.position = {0.5, 0.2, 0};
    scene.add(shrinking);
    Simulation simulation(scene, test::on(Backend::cpu));
    const State start = simulation.state();
    for (int frame = 0; frame < 180; ++frame) simulation.advance(1.0 / 60);
    EXPECT_TRUE(simulation.report().finite);
    if (scene.method == Method::constraint) {
        EXPECT_TRUE(simulation.report().solver.last_is_solved()) << simulation.report().solver.residual_last;
        EXPECT_LE(simulation.report().solver.frames_cut, 2u);  // the first, in which all happens
    }
    const auto x = simulation.positions();
    const std::size_t last = x.size() - 1;
    EXPECT_NEAR(
        distance(x[0], x[last]) / distance(start.cloths[0].positions[0], start.cloths[0].positions[last]),
        0.8, within);
    EXPECT_NEAR(simulation.report().measures.max_stretch, 0, within);
}

TEST_P(RestScale, ShrinksAClothBySprings)
{
    // Strong damping: a mesh that shrinks faster folds.
    expect_to_shrink({}, GetParam().cloth(), 200, 1e-3);
}

TEST_P(RestScale, ShrinksAClothByConstraints)
{
    Scene scene;
    scene.method = Method::constraint;
    scene.newton_multigrid.resists = Resists::both;
    expect_to_shrink(scene, GetParam().cloth(), 5, 2e-3);
}

TEST(RestScale, IsRefusedOutOfRange)
{
    Scene scene;
    Cloth cloth = test::flat_sheet(3, 3);
    cloth.springs.shear.rest_scale = 0.05;
    scene.add(cloth);
    try {
        validate(scene);
        FAIL() << "not refused";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("cloths[0].springs.shear.rest_scale"), std::string::npos)
            << error.what();
    }
}

}  // namespace
}  // namespace pliant

// How far limits that remember let a cloth stretch, over sizes, masses and steps: at most 1 %, and 2 % in
// single frames of an impact. docs/physics.md ("Constraints") says why, and what is beyond it.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "pliant/simulation.hpp"
#include "test_runners.hpp"

namespace pliant {
namespace {

struct Size {
    std::uint32_t rows = 0, columns = 0;
};

/// A sheet whose longer side is 1 m.
Scene sheet_of(Size size, double density, double rate)
{
    Scene scene;
    scene.method = Method::constraint;
    scene.time.frame_rate = rate;
    const double across = std::max(size.rows, size.columns) - 1;
    scene.add(Cloth::sheet({.rows = size.rows,
                            .columns = size.columns,
                            .width = (size.columns - 1) / across,
                            .height = (size.rows - 1) / across,
                            .density = density}));
    scene.cloth_handle(0)->position = {0, 1.2, 0};
    // The 1e-6 m/N of a spring is seen in fine and heavy cloth: at springs of 5 mm, 50 N stretch one by 1 %.
    scene.cloth_handle(0)->springs.structural.compliance = 1e-9;
    scene.cloth_handle(0)->springs.shear.compliance = 1e-9;
    return scene;
}

struct Case {
    std::string name;
    std::function<void(Scene&)> set_up;
    /// What a frame may stretch it by, and how many frames may go beyond the 1 %: impacts, which change
    /// forces all at once.
    double most = 0.01;
    std::size_t impacts = 0;
};

const std::vector<Case>& cases()
{
    static const std::vector<Case> all = {
        {"hung", [](Scene& s) { s.cloth_handle(0)->pin(Corner::top_left).pin(Corner::top_right); }},
        {"thrown",
         [](Scene& s) {
             s.cloth_handle(0)->pin(Edge::top);
             s.cloth_handle(0)->velocity = {0, 5, 0};
         },
         0.02, 2},
        {"on a sphere",
         [](Scene& s) {
             s.add(Sphere{.centre = {0, 0.7, 0}, .radius = 0.3});
             s.add(Plane{});
         },
         0.012, 2},
        {"pulled by a fast pin",
         [](Scene& s) {
             s.cloth_handle(0)->pin(
                 {Corner::top_left,
                  {{.time = 0.3}, {.time = 0.4, .position = {0.7, 0.6, 0}}, {.time = 0.5}}});
             s.cloth_handle(0)->pin(Corner::top_right);
         },
         0.03, 6},
        {"thrown onto a sphere",
         [](Scene& s) {
             s.add(Sphere{.centre = {0, 0.6, 0}, .radius = 0.3});
             s.cloth_handle(0)->velocity = {0, -10, 0};
         },
         0.02, 1},
    };
    return all;
}

void expect_no_stretch(const std::vector<Size>& sizes, const std::vector<double>& densities,
                       const std::vector<double>& rates, double room)
{
    for (const Case& of : cases())
        for (const Size size : sizes)
            for (const double density : densities)
                for (const double rate : rates) {
                    Scene scene = sheet_of(size, density, rate);
                    of.set_up(scene);
                    Simulation simulation(scene, test::on(Backend::cpu));
                    double most = 0;
                    std::size_t beyond = 0;
                    for (int k = 0; k < static_cast<int>(rate); ++k) {
                        simulation.advance(1 / rate);
                        const double stretch = simulation.report().measures.max_stretch;
                        most = std::max(most, stretch);
                        beyond += stretch > room * 0.01 ? 1 : 0;
                    }
                    const std::string which = of.name + ", " + std::to_string(size.rows) + " x " +
                                              std::to_string(size.columns) + ", " + std::to_string(density) +
                                              " kg/m2, " + std::to_string(rate) + " steps/s";
                    EXPECT_LE(most, room * of.most) << which;
                    EXPECT_LE(beyond, of.impacts) << which;
                }
}

TEST(Stretch, OfSmallSheetsIsAPerCent) { expect_no_stretch({{16, 16}, {12, 31}}, {0.1, 3}, {30, 60}, 1); }

// What a limit's force changes by in a step is over less length in finer cloth, and 1/30 s are long for it.
TEST(LargeSheets, StretchByAPerCentAndAHalf)
{
    expect_no_stretch({{32, 32}, {64, 64}}, {0.1, 3}, {30, 60}, 1.5);
}

}  // namespace
}  // namespace pliant

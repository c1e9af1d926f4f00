// Whole sheets of ACAD: soft ones, and ones with steps so long that they are implicit. They must fall, lose
// energy, keep to their threshold and come to rest as with springs alone.
#include <gtest/gtest.h>

#include "pliant/pliant.hpp"
#include "test_cloths.hpp"
#include "test_differences.hpp"

namespace pliant {
namespace {

/// Square, 1 m, 1 kg, hung by two corners over a plane.
Scene hung_sheet(std::uint32_t n, double stiffness, std::uint32_t substeps, double damping)
{
    Scene scene;
    scene.method = Method::acad;
    scene.time.substeps = substeps;
    SheetOptions sheet;
    sheet.rows = sheet.columns = n;
    sheet.density = 1;
    auto cloth = scene.add(Cloth::sheet(sheet));
    cloth->position = {0, 1, 0};
    cloth->springs.structural = {stiffness, 0.01};
    cloth->springs.shear = {stiffness / 2, 0.01};
    cloth->damping = damping;
    cloth.pin(Corner::top_left).pin(Corner::top_right);
    scene.add(Plane{});
    return scene;
}

struct SheetRun {
    double longest = 0, most_gained = 0;  ///< over all frames: strain, and gain of energy in a frame, J
    double first_energy = 0, energy = 0;  ///< J
    FrameMeasures last;
    SolverReport solver;
};

double energy_of(const FrameMeasures& m) { return m.kinetic_energy + m.elastic_energy + m.potential_energy; }

SheetRun run(const Scene& scene, int frames)
{
    Simulation simulation(scene, test::on(Backend::cpu));
    test::Largest longest, gained;
    SheetRun result;
    result.first_energy = result.energy = energy_of(simulation.report().measures);
    for (int frame = 0; frame < frames; ++frame) {
        simulation.advance(1 / 60.0);
        result.last = simulation.report().measures;
        longest.add(result.last.max_stretch);
        gained.add(energy_of(result.last) - result.energy);
        result.energy = energy_of(result.last);
    }
    result.longest = longest.value();
    result.most_gained = gained.value();
    result.solver = simulation.report().solver;
    return result;
}

TEST(AcadSheet, SoftOnesLoseEnergyAndKeepToTheirThreshold)
{
    // Stiffness, N/m, and steps per frame: corrected ones, and an implicit one. With mass_spring all of them
    // stretch by several times the threshold of 10 %.
    struct Case {
        double stiffness;
        std::uint32_t substeps;
    };
    for (const Case& c : {Case{10, 0}, Case{10, 4}, Case{10, 1}, Case{100, 1}}) {
        const SheetRun sheet = run(hung_sheet(24, c.stiffness, c.substeps, 0.5), 150);
        SCOPED_TRACE(testing::Message() << c.stiffness << " N/m, substeps " << c.substeps);
        EXPECT_LE(sheet.longest, 0.12);
        EXPECT_GT(sheet.longest, 0.1 - 1e-4);  // the threshold is reached
        // Steps with springs alone are symplectic: energy oscillates slightly about its mean. A jittering
        // sheet gained 1.6 J of 9.8 J in a frame.
        EXPECT_LE(sheet.most_gained, 1e-3 * sheet.first_energy);
        EXPECT_LT(sheet.energy, 0.7 * sheet.first_energy);
        EXPECT_GT(sheet.solver.active_max, 0U);
        EXPECT_LE(sheet.solver.residual_max, 1);
    }
}

TEST(AcadSheet, InLongStepsRestsAsSpringsAloneDo)
{
    // The default springs in one step of 1/60 s, 18 times the longest stable explicit step.
    Scene scene = hung_sheet(20, Springs{}.structural.stiffness, 1, 1);
    Scene springs = scene;
    springs.method = Method::mass_spring;
    springs.time.substeps = 0;
    const SheetRun sheet = run(scene, 480), alone = run(springs, 480);
    EXPECT_NEAR(sheet.last.mean_stretch, alone.last.mean_stretch, 0.01 * 0.1);
    EXPECT_NEAR(sheet.last.max_stretch, alone.last.max_stretch, 0.03);
    EXPECT_LT(sheet.last.max_speed, 0.05);  // a trembling free hem of implicit steps has 1 m/s
    EXPECT_LE(sheet.longest, 0.12);
    EXPECT_LT(sheet.energy, 0.7 * sheet.first_energy);
}

}  // namespace
}  // namespace pliant

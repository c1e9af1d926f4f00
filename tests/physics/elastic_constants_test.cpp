// What stiffness in its plane a sheet of springs has. Row "square lattice" (docs/verification.md): with shear
// springs of half the structural stiffness nu = 1/3 and E2D = 4/3 k.
#include <gtest/gtest.h>

#include <cmath>

#include "physics/backends.hpp"
#include "physics/measured.hpp"
#include "physics/strips.hpp"
#include "solve/frame.hpp"
#include "test_runners.hpp"

namespace pliant {
namespace {

/// Elastic energy, J, of a square sheet of side 1 that is strained as a whole.
double energy_of_strain(SheetBorder border, std::uint32_t n, double along, double across, double shear)
{
    Cloth cloth = Cloth::sheet({.rows = n, .columns = n, .border = border, .density = 1});
    cloth.springs = {{1000, 0}, {500, 0}, {0, 0}};
    Scene scene;
    scene.add(cloth);
    ClothModel model(scene.cloth(0), scene);
    for (Vec3& x : model.shape.positions) {
        const Vec3d a = to_double(x);
        x = to_float({a.x * (1 + along) + shear / 2 * a.z, 0, a.z * (1 + across) + shear / 2 * a.x});
    }
    const auto runner = make_reference_runner({&model, 1});
    Program program{1, {}, 0};
    append_frame({&model, 1}, 1, 0, program.calls);
    runner->run(program, {1e-12, 0, {}, true});  // too short to move anything
    return runner->measures(0).elastic_energy;
}

TEST(Lattice, HasTheConstantsOfTheContinuumAtEveryResolution)
{
    // E = 1/2 C : e : e per area. With C11 = k + k_d, C12 = C66 = k_d of diagonals k_d = k/2: E2D = C11 -
    // C12^2 / C11. Strains of 1e-3: stretch is quadratic in them beyond first order, and positions are
    // rounded to 1e-7.
    constexpr double e = 1e-3;
    for (const std::uint32_t n : {2u, 5u, 20u}) {
        const auto half = [n](double a, double b, double c) {
            return 2 * energy_of_strain(SheetBorder::half, n, a, b, c) / (e * e);
        };
        const double c11 = half(e, 0, 0), c22 = half(0, e, 0), both = half(e, e, 0), c66 = half(0, 0, e);
        const double c12 = (both - c11 - c22) / 2;
        test::measured("lattice, nu at n " + std::to_string(n), c12 / c11, 1.0 / 3);
        test::measured("lattice, E2D over k at n " + std::to_string(n), (c11 - c12 * c12 / c22) / 1000,
                       4.0 / 3);
        EXPECT_NEAR(c12 / c11, 1.0 / 3, 0.01 / 3) << n;

        EXPECT_NEAR(c11 - c12 * c12 / c22, 4.0 / 3 * 1000, 0.01 * 4.0 / 3 * 1000) << n;
        EXPECT_NEAR(c66, 500, 5) << n;
        EXPECT_NEAR(c66, (c11 - c12) / 2, 0.01 * c66) << n;  // isotropic
        EXPECT_NEAR(c11, c22, 1e-3 * c11) << n;
        // With springs of full stiffness along the border a sheet is stiffer, the more so the coarser it is:
        // of n rows of springs n - 1 are its due.
        const double full = 2 * energy_of_strain(SheetBorder::full, n, e, 0, 0) / (e * e);
        EXPECT_NEAR(full - c11, 1000 / (n - 1.0), 15) << n;
    }
}

TEST(Lattice, AHangingStripStretchesAndNarrowsAsItsConstantsSay)
{
    // The same by a simulation: a strip hangs by its upper edge. Halfway down, five widths from where it is
    // held, its stress is the weight below alone. Strains of 3e-3 leave 3e-3 for what is not linear in them.
    constexpr std::uint32_t rows = 61, columns = 7;
    constexpr double length = 1, width = 0.1, density = 0.8, k = 1000, g = 9.81;
    Scene scene;
    scene.add(test::hanging_strip(rows, columns, width, length, density, k, k / 2));
    test::seek_rest(scene);
    const auto x = test::at_rest(scene, 8);
    const auto at = [&](std::uint32_t row, std::uint32_t column) { return x[row * columns + column]; };
    const double strain = density * g * length / 2 / (4.0 / 3 * k);
    const double along = (at(24, 3).y - at(36, 3).y) / (0.2 * length) - 1;
    const double across = (at(30, columns - 1).x - at(30, 0).x) / width - 1;
    test::measured("hanging lattice, strain", along, strain);
    test::measured("hanging lattice, nu", -across / along, 1.0 / 3);
    EXPECT_NEAR(along, strain, 0.01 * strain);

    EXPECT_NEAR(-across / along, 1.0 / 3, 0.01 / 3);
}

}  // namespace
}  // namespace pliant

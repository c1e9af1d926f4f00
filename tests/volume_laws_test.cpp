// Laws of the volume constraint against closed forms.
#include "test_laws.hpp"

namespace pliant::test {
namespace {

TEST(Volume, GradientOfAnOctahedronIsAThirdOfTheAreaVectorsAroundANode)
{
    // The corner (a, 0, 0) of an octahedron: V = 4/3 a b c, so that dV/da of one of its two ends is 2/3 b c.
    const double a = 0.7, b = 0.5, c = 0.9;
    const VD corner{a, 0, 0}, ring[] = {{0, b, 0}, {0, 0, c}, {0, -b, 0}, {0, 0, -c}};
    VD gradient{0, 0, 0};
    for (int k = 0; k < 4; ++k)
        gradient = D::ring_add(gradient, ring[k] - corner, ring[(k + 1) % 4] - corner);
    EXPECT_NEAR(gradient.x, 6 * 2.0 / 3 * b * c, 1e-12);
    EXPECT_NEAR(gradient.y, 0, 1e-12);
    EXPECT_NEAR(gradient.z, 0, 1e-12);
}

TEST(Volume, ANodeOnOnePlateIsFreeToSlideAndBetweenTwoItIsNot)
{
    const VD a{1, 2, 3};
    D::Blocked held = D::blocked_by_nothing();
    EXPECT_EQ(D::free_part(a, held).y, 2);
    held.normal = {0, 1, 0};
    held.count = 1;
    EXPECT_EQ(D::free_part(a, held).x, 1);
    EXPECT_EQ(D::free_part(a, held).y, 0);
    EXPECT_EQ(D::free_part(a, held).z, 3);
    held.count = 2;
    EXPECT_EQ(D::free_part(a, held).x, 0);
    EXPECT_EQ(D::free_part(a, held).z, 0);
}

TEST(Volume, CubicOfAFanIsTheVolumeOfTheMovedFan)
{
    RandomVectors random;
    for (int round = 0; round < 1000; ++round) {
        const VD centre = to_double(random.vector(1)), apex = to_double(random.vector(1)),
                 moved_apex = to_double(random.vector(0.1f));
        VD x[5], d[5];
        for (int k = 0; k < 5; ++k) x[k] = to_double(random.vector(1)), d[k] = to_double(random.vector(0.1f));
        D::FanSums fan = D::fan_of_nothing();
        for (int k = 0; k < 4; ++k)
            fan = D::fan_add(fan, x[k] - apex, x[k + 1] - apex, d[k] - moved_apex, d[k + 1] - moved_apex);
        const D::VolumeCubic cubic = D::fan_cubic(fan, apex - centre, moved_apex);
        for (const double s : {0.0, 0.3, -1.7, 4.0}) {
            double sum = 0;
            const VD a = apex - moved_apex * s - centre;
            for (int k = 0; k < 4; ++k)
                sum += D::dot3(a, D::cross3(x[k] - d[k] * s - centre, x[k + 1] - d[k + 1] * s - centre));
            EXPECT_NEAR(D::volume_excess(cubic, 0.0, s), sum, 1e-12 * 4 * 27);
        }
    }
}

TEST(Volume, RootIsTheCubesOwn)
{
    // A cube that shrinks by s on every side: 6 (1 - s)^3 = 6 (0.9)^3 has the root 0.1.
    D::VolumeCubic cube{6, 0, 18, 18, 6, {0, 0, 0}};
    EXPECT_NEAR(D::volume_root(cube, 6 * 0.9 * 0.9 * 0.9), 0.1, 1e-14);
    EXPECT_NEAR(D::volume_root(cube, 6 * 1.2 * 1.2 * 1.2), -0.2, 1e-14);
    EXPECT_EQ(D::volume_root(cube, 6), 0);
    cube.first = 0;  // nothing moves along a direction that changes no volume
    EXPECT_EQ(D::volume_root(cube, 5), 0);
    const F::VolumeCubic single{6, 0, 18, 18, 6, {0, 0, 0}};
    EXPECT_NEAR(double{F::volume_root(single, 5.4f)}, 1 - std::cbrt(0.9), 4 * float_rounding);
}

TEST(Volume, SumsKeepWhatTheyRoundOff)
{
    // 2^20 numbers of about 0.1 in float: the sum with its lost digits is as good as each number.
    RandomVectors random;
    F::VolumeCubic sum = F::volume_cubic_of_nothing();
    double exact = 0;
    for (int k = 0; k < 1 << 20; ++k) {
        F::VolumeCubic one = F::volume_cubic_of_nothing();
        one.volume = random.number(0.05f, 0.15f);
        exact += static_cast<double>(one.volume);
        sum = F::volume_cubic_merge(sum, one);
    }
    EXPECT_NEAR((static_cast<double>(sum.volume) + static_cast<double>(sum.low)) / exact, 1,
                2 * float_rounding);
}

TEST(Volume, MultiplierTakesTheExcessAwayAndBlockedNodesStay)
{
    RandomVectors random;
    for (int round = 0; round < 1000; ++round) {
        VD g[3], v[3];
        double w[3], weight[3], sum_of_weights = 0;
        D::Blocked held[3] = {D::blocked_by_nothing(), {{0, 1, 0}, 1}, {{1, 0, 0}, 2}};
        D::VolumeRate sums = D::volume_rate_of_nothing();
        for (int k = 0; k < 3; ++k) {
            g[k] = to_double(random.vector(1)), v[k] = to_double(random.vector(1));
            w[k] = static_cast<double>(random.number(0.5f, 2)),
            weight[k] = static_cast<double>(random.number(0.1f, 1));
            sum_of_weights += weight[k];
            sums = D::volume_rate_merge(sums, D::volume_rate_of(g[k], v[k], w[k], weight[k], held[k]));
        }
        const VD mean = D::volume_mean(sums, 1 / sum_of_weights);
        const double excess = 0.02, dt = 0.01;
        const double q = D::volume_multiplier(sums, mean, excess, 1 / dt);
        double rate = 0;
        VD thrust{0, 0, 0};
        for (int k = 0; k < 3; ++k) {
            const VD d = D::volume_direction(g[k], mean, w[k], weight[k], held[k]);
            rate += D::dot3(D::free_part(g[k], held[k]), v[k]) - q * D::dot3(g[k], d);
            thrust = thrust + (g[k] - mean) * weight[k];
            if (k == 1) {
                EXPECT_NEAR(d.y, 0, 1e-15);
            }
            if (k == 2) {
                EXPECT_EQ(length(d), 0);
            }
        }
        if (q != 0) {
            EXPECT_NEAR(excess + dt * rate, 0, 1e-10 * std::max(1.0, std::abs(q)));
        }
        EXPECT_NEAR(length(thrust), 0, 1e-14);
    }
}

}  // namespace
}  // namespace pliant::test

// Laws of springs, steps and measures against analytic references, in double and float, and in SIMD bit by
// bit. Those of contact and air, and of volume, are in contact_laws_test.cpp and volume_laws_test.cpp.
#include <bit>
#include <cmath>
#include <limits>

#include "backend/cpu/pack.hpp"
#include "test_differences.hpp"
#include "test_laws.hpp"

namespace pliant::test {
namespace {

std::uint32_t bits(float a) { return std::bit_cast<std::uint32_t>(a); }

// --- inverse square root
// ---------------------------------------------------------------------------------------------

TEST(InverseSqrt, FloatErrorIsAtMost1_8e_7OverAllNormalNumbers)
{
    // All mantissas of the two binades that differ, since the error repeats every factor of four; then every
    // exponent.
    Largest worst;
    const auto look = [&](float a) {
        const double exact = 1 / std::sqrt(static_cast<double>(a));
        worst.add(std::abs(F::inverse_sqrt(a) - exact) / exact);
    };
    for (std::uint32_t b = bits(1.0f); b < bits(4.0f); b += 3) look(std::bit_cast<float>(b));
    for (std::uint32_t exponent = 1; exponent < 255; ++exponent)
        for (std::uint32_t mantissa = 0; mantissa < 1u << 23; mantissa += 99991)
            look(std::bit_cast<float>(exponent << 23 | mantissa));
    EXPECT_LE(worst.value(), 1.8e-7);
}

TEST(InverseSqrt, DoubleReachesRounding)
{
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<double> exponent(-300, 300);
    for (int k = 0; k < 100000; ++k) {
        const double a = std::exp2(exponent(engine)), exact = 1 / std::sqrt(a);
        EXPECT_NEAR(D::inverse_sqrt(a) / exact, 1, 4 * std::numeric_limits<double>::epsilon());
    }
}

TEST(InverseSqrt, NothingHasNoDirection)
{
    EXPECT_EQ(F::inverse_sqrt(0.0f) * 0.0f, 0.0f);
    const VF n = F::direction({0, 0, 0});
    EXPECT_EQ(n.x, 0);
    EXPECT_EQ(n.y, 0);
    EXPECT_EQ(n.z, 0);
}

// --- springs
// ----------------------------------------------------------------------------------------------------------

TEST(Spring, PullsWithStiffnessTimesExtension)
{
    // 0.25 m longer than at rest, closing at 2 m/s: 100 * 0.25 - 3 * 2 towards the other node.
    const VD f = D::spring_force({0, 0, 0}, {0, 1.25, 0}, {0, 1, 0}, {5, -1, 0}, 1.0, 100.0, 3.0);
    EXPECT_NEAR(f.y, 25 - 6, 1e-12);
    EXPECT_EQ(f.x, 0);
    EXPECT_EQ(f.z, 0);
}

TEST(Spring, IsExactlyOppositeOnTheOtherNode)
{
    RandomVectors random;
    for (int k = 0; k < 10000; ++k) {
        const VF xi = random.vector(1), xj = random.vector(1), vi = random.vector(3), vj = random.vector(3);
        const float l0 = random.number(0.01f, 1), s = random.number(0, 1e4f), c = random.number(0, 10);
        const VF a = F::spring_force(xi, xj, vi, vj, l0, s, c), b = F::spring_force(xj, xi, vj, vi, l0, s, c);
        EXPECT_EQ(bits(a.x), bits(-b.x));
        EXPECT_EQ(bits(a.y), bits(-b.y));
        EXPECT_EQ(bits(a.z), bits(-b.z));
    }
}

TEST(Spring, PushesNowhereWhenNodesCoincide)
{
    const VF f = F::spring_force({1, 2, 3}, {1, 2, 3}, {0, 0, 0}, {1, 0, 0}, 0.5f, 1000, 1);
    EXPECT_EQ(f.x, 0);
    EXPECT_EQ(f.y, 0);
    EXPECT_EQ(f.z, 0);
}

TEST(Spring, FloatFollowsDoubleToRounding)
{
    // Scaled error: about a dozen roundings, of positions as large as 1 m next to lengths of 0.1 m at least.
    RandomVectors random;
    for (int k = 0; k < 100000; ++k) {
        const VF xi = random.vector(1), xj = random.vector(1), vi = random.vector(3), vj = random.vector(3);
        const float l0 = random.number(0.1f, 1), s = random.number(0, 1e4f), c = random.number(0, 10);
        const VD d = to_double(xj) - to_double(xi);
        if (length(d) < 0.1) continue;
        const VD exact =
            D::spring_force(to_double(xi), to_double(xj), to_double(vi), to_double(vj), l0, s, c);
        const VF f = F::spring_force(xi, xj, vi, vj, l0, s, c);
        const double scale = s * (length(d) + l0) + c * length(to_double(vj) - to_double(vi));
        EXPECT_LE(length(to_double(f) - exact), 40 * float_rounding * scale);
    }
}

TEST(Spring, StretchAndEnergy)
{
    EXPECT_NEAR(D::spring_stretch({0, 0, 0}, {3, 4, 0}, 4.0), 0.25, 1e-14);
    EXPECT_NEAR(D::spring_energy({0, 0, 0}, {3, 4, 0}, 4.0, 100.0), 50, 1e-12);
}

TEST(Spring, BendingIsASpringOfNoLength)
{
    const VD force = D::bending_force({1, 2, 3}, {2, 0, 3}, -4.0);
    EXPECT_EQ(force.x, -4);
    EXPECT_EQ(force.y, 8);
    EXPECT_EQ(force.z, 0);
    EXPECT_EQ(D::bending_energy({1, 2, 3}, {2, 0, 3}, -4.0), -10);
}

// --- springs with limits ---

const D::LimitCurve limit_curves[] = {
    {0, 50, 0.02, 4000, 4000, 0, 0, 0.02, 1},  // a stiffness below the limit, resisting both ways beyond it
    {0, 0, 0.01, 4000, 0, 0, 0, -1, 0.3},      // tension alone
    {1, 70, 0, 0, 0, 0, 0, 0, 1},              // a plain spring
    {2, 0, 0, 4000, 0, 0, 0, -1, 1},           // a thread that does not give
    {0, 50, 0.02, 4000, 4000, 0, 0.004, 0.02, 1},  // those that remember a force
    {2, 0, 0, 4000, 0, 0, 0.004, -1, 0.3},
};

TEST(Limit, ForceIsTheSlopeOfTheEnergyAndMultiplierWhatTheLimitAdds)
{
    constexpr double rest = 0.5, h = 1e-6;  // m
    const auto state = [](const D::LimitCurve& curve, double l) {
        return D::spring_state(curve, l * l, 1 / l, rest);
    };
    for (const D::LimitCurve& curve : limit_curves)
        for (const double l : {0.4, 0.488, 0.499, 0.503, 0.5075, 0.53, 0.7}) {
            // No kink of the energy's slope lies within h, so that the difference quotient is off by rounding
            // alone.
            const double slope = (state(curve, l + h).energy - state(curve, l - h).energy) / (2 * h);
            EXPECT_NEAR(state(curve, l).force, slope, 1e-6 * (1 + std::abs(slope)))
                << curve.kind << ", " << l;
            EXPECT_NEAR(state(curve, l).multiplier, state(curve, l).force - curve.below * (l - rest), 1e-9);
            EXPECT_GE(state(curve, l).across, 0);
        }
}

TEST(Limit, KindsAreTheGeneralLawWhereTheRestOfItIsZero)
{
    for (const D::LimitCurve& curve : limit_curves)
        for (const double l : {0.3, 0.49, 0.5, 0.51, 0.8}) {
            D::LimitCurve general = curve;
            general.kind = 0;
            const auto a = D::spring_state(curve, l * l, 1 / l, 0.5),
                       b = D::spring_state(general, l * l, 1 / l, 0.5);
            EXPECT_DOUBLE_EQ(a.force, b.force);
            EXPECT_DOUBLE_EQ(a.along, b.along);
            EXPECT_DOUBLE_EQ(a.across, b.across);
            EXPECT_DOUBLE_EQ(a.energy, b.energy);
            EXPECT_DOUBLE_EQ(a.multiplier, b.multiplier);
        }
}

TEST(Limit, KeepsAPartOfItsStiffnessInTheHessianWhereItIsSlack)
{
    for (const int kind : {0, 2}) {
        const D::LimitCurve curve{kind, 0, 0, 4000, 0, 0, 0.004, -1, 0.3};
        const auto along = [&](double l) { return D::spring_state(curve, l * l, 1 / l, 0.5).along; };
        EXPECT_DOUBLE_EQ(along(0.497), 4000) << kind;  // 4 mm are remembered
        EXPECT_DOUBLE_EQ(along(0.496 - 3e-6), 4000) << kind;
        EXPECT_DOUBLE_EQ(along(0.496 - 5e-6), 1200) << kind;
        EXPECT_DOUBLE_EQ(along(0.495), 1200) << kind;
        EXPECT_DOUBLE_EQ(along(0.3), 1200) << kind;
    }
}

TEST(Limit, ThatRemembersItsForceHasItsCompliance)
{
    // A weight hangs on a thread, and every step ends where the force of the limit is the weight.
    constexpr double rest = 0.5, weight = 3, softest = 100, stiffest = 2000, compliance = 1e-4;
    D::LimitCurve curve{2, 0, 0, softest / (1 + softest * compliance), 0, 0, 0, -1, 1};
    double length = 0;
    for (int step = 0; step < 40; ++step) {
        length = rest + weight / curve.beyond - curve.slip;
        const auto state = D::spring_state(curve, length * length, 1 / length, rest);
        EXPECT_NEAR(state.multiplier, weight, 1e-9);
        const auto memory = D::renewed_limit(state.multiplier, length / rest - 1, curve.beyond, compliance,
                                             softest, stiffest);
        EXPECT_LE(memory.stiffness, stiffest);
        // The stiffness may be another, the force is not.
        EXPECT_NEAR(memory.slip * memory.stiffness / (1 - memory.stiffness * compliance), weight, 1e-9);
        curve.slip = memory.slip;
        curve.beyond = memory.stiffness;
    }
    EXPECT_NEAR(length, rest + weight * compliance, 1e-9);
}

TEST(Limit, ThatIsExceededGrowsStifferAndElseSoftens)
{
    const auto stiffness = [](double strain, double now) {
        return D::renewed_limit(1, strain, now, 0, 100, 2000).stiffness;
    };
    EXPECT_NEAR(stiffness(0.002, 500), 1000, 1e-5);  // its constants are floats  // twice a thousandth
    EXPECT_NEAR(stiffness(0.05, 500), 2000, 1e-5);   // four times, and no more than that at once
    EXPECT_NEAR(stiffness(0.05, 1500), 2000, 1e-5);  // the stiffest
    EXPECT_NEAR(stiffness(0.0005, 500), 450, 1e-5);  // an eighth of the way back
    EXPECT_NEAR(stiffness(-0.3, 100), 100, 1e-5);
}

// --- integration ---

TEST(Integration, VelocityFirst)
{
    // f / m + g = 2 * 3 - 10 = -4; half of the velocity decays; x uses the new velocity.
    const VD v = D::velocity_step({0, 8, 0}, {0, 3, 0}, 2.0, {0, -10, 0}, 0.5, 0.25);
    EXPECT_EQ(v.y, 8 * 0.5 - 4 * 0.25);
    EXPECT_EQ(D::position_step({0, 1, 0}, v, 0.25).y, 1 + 3 * 0.25);
}

TEST(Integration, WhatIsSlowerThanTwoMillimetresInABillionYearsRests)
{
    EXPECT_EQ(F::settled(5e-20f), 0.0f);
    EXPECT_EQ(F::settled(-5e-20f), 0.0f);
    EXPECT_EQ(F::settled(6e-20f), 6e-20f);
    EXPECT_EQ(F::velocity_step({3e-20f, 1, 0}, {0, 0, 0}, 1, {0, 0, 0}, 1, 0.5f).x, 0.0f);
}

TEST(Integration, PinnedNodeStays)
{
    const VD v = D::velocity_step({1, 2, 3}, {0, 3, 0}, 0.0, {0, -10, 0}, 1.0, 0.25);
    EXPECT_EQ(length(v), 0);
}

TEST(Integration, GrabbedNodeTakesTheSpringOfTheHandImplicitly)
{
    // m v' = m v + dt (f + m g + k (t - x - dt v') - c v'), solved for v': the law, with the mass m' in the
    // step.
    const double m = 0.3, k = 50, c = 2, dt = 0.125, g = -10, f = 1.5, x = 0.25, v = -0.75, t = 2;
    const double heavier = m + c * dt + k * dt * dt;
    const VD begun = D::grabbed_velocity({0, x, 0}, {0, v, 0}, {0, t, 0}, {0, g, 0}, k * dt / heavier,
                                         (c * dt + k * dt * dt) / heavier, dt);
    const VD next = D::velocity_step(begun, {0, f, 0}, 1 / heavier, {0, g, 0}, 1.0, dt);
    const double expected = (m * v + dt * (f + m * g + k * (t - x))) / heavier;
    EXPECT_NEAR(next.y, expected, 1e-14 * std::abs(expected) * 16);  // some roundings of a double
    EXPECT_EQ(next.x, 0);
}

TEST(Integration, StagesAreEulersAndRungeKuttasSchemes)
{
    // y' = -y by one step of 0.5: Euler 1/2, Runge-Kutta 1 - h + h^2/2 - h^3/6 + h^4/24. The weight 1/6 is
    // that of float.
    const double h = 0.5;
    const VD start{1, 0, 0}, none{0, 0, 0};
    EXPECT_EQ(D::stage_next(0, start, none, start * -h).x, 1 - h);
    VD y = start, sum = none;
    for (int stage = 1; stage <= 4; ++stage) {
        const VD change = y * -h;
        sum = D::stage_sum(stage, sum, change);
        y = D::stage_next(stage, start, sum, change);
    }
    EXPECT_NEAR(y.x, 1 - h + h * h / 2 - h * h * h / 6 + h * h * h * h / 24, 2e-8);
}

TEST(Integration, ChangeOfVelocityIsWhatTheStepAdds)
{
    const VD v{1, 8, -2}, f{2, 3, 1}, gravity{0, -10, 0};
    const VD change = D::velocity_change(v, f, 2.0, gravity, 0.5, 0.25);
    const VD next = D::velocity_step(v, f, 2.0, gravity, 0.5, 0.25);
    EXPECT_NEAR(length(v + change - next), 0, 1e-14);
    EXPECT_EQ(length(D::velocity_change(v, f, 0.0, gravity, 0.5, 0.25)), 0);
}

// --- normals and measures
// -----------------------------------------------------------------------------------------------

TEST(Normal, QuadrantIsTheSumOfItsTwoTriangles)
{
    const VD n = D::quadrant_normal({0, 0, 0}, {0, 0, 2}, {3, 0, 2}, {3, 0, 0});  // z then x: up
    EXPECT_EQ(n.x, 0);
    EXPECT_EQ(n.y, 12);
    EXPECT_EQ(n.z, 0);
}

TEST(Measure, CountsWhatIsNotFinite)
{
    const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    const VF good{1, 2, 3}, gravity{0, -1, 0};
    EXPECT_EQ(F::measure_node(F::measure_of_nothing(), good, good, 1, gravity).non_finite, 0);
    EXPECT_EQ(F::measure_node(F::measure_of_nothing(), {1, nan, 3}, good, 1, gravity).non_finite, 1);
    EXPECT_EQ(F::measure_node(F::measure_of_nothing(), good, {inf, 0, 0}, 1, gravity).non_finite, 1);
}

TEST(Measure, OfTwoIsTheLargerOfEach)
{
    D::Measure a = D::measure_of_nothing(), b = a;
    a.max_stretch = 0.1, a.max_penetration = 0.2, a.max_speed2 = 3;
    b.max_stretch = 0.4, b.max_penetration = 0.5, b.max_speed2 = 6;
    for (const auto& m : {D::measure_merge(a, b), D::measure_merge(b, a)}) {
        EXPECT_EQ(m.max_stretch, 0.4);
        EXPECT_EQ(m.max_penetration, 0.5);
        EXPECT_EQ(m.max_speed2, 6);
    }
}

TEST(Measure, NodeHasKineticEnergyAndHeight)
{
    const auto m = D::measure_node(D::measure_of_nothing(), {1, 2, 3}, {3, 4, 0}, 2.0, {0, -1, 0});
    EXPECT_EQ(m.kinetic_energy, 25);
    EXPECT_EQ(m.height_moment, 4);
    EXPECT_EQ(m.max_speed2, 25);
}

// --- the same bits in SIMD
// ------------------------------------------------------------------------------------------------

TEST(Simd, GivesTheBitsOfScalarFloat)
{
    // The baseline width; the wider ones are compared through whole passes in pass_test.
    constexpr int W = 4;
    using P = Pack<W>;
    using S = Laws<P>;
    RandomVectors random;
    const auto lanes = [](const VF(&a)[W]) {
        Vector3<P> r;
        for (int k = 0; k < W; ++k) r.x.lanes[k] = a[k].x, r.y.lanes[k] = a[k].y, r.z.lanes[k] = a[k].z;
        return r;
    };
    const auto pack = [](VF v) { return Vector3<P>{P(v.x), P(v.y), P(v.z)}; };
    for (int round = 0; round < 5000; ++round) {
        VF a[W], b[W], c[W], d[W];
        for (int k = 0; k < W; ++k)
            a[k] = random.vector(1), b[k] = random.vector(1), c[k] = random.vector(2),
            d[k] = random.vector(2);
        const float l0 = random.number(0.1f, 1), s = random.number(0, 1e4f), mu = random.number(0, 1);
        const auto spring = S::spring_force(lanes(a), lanes(b), lanes(c), lanes(d), P(l0), P(s), P(mu));
        const auto bent = S::bending_force(lanes(a), lanes(b), P(s));
        const auto change =
            S::velocity_change(lanes(c), lanes(d), P(l0), pack({0, -9.81f, 0}), P(mu), P(0.01f));
        const auto staged = S::stage_next(4, lanes(a), S::stage_sum(3, lanes(b), lanes(c)), lanes(d));
        const auto wind = S::wind_force(lanes(a), lanes(b), lanes(c), lanes(d), lanes(a), lanes(b), lanes(c),
                                        P(l0), P(s), P(mu));
        S::Collider box_pack{};
        F::Collider box_float{};
        box_float.kind = 2;
        box_float.centre = a[0];
        box_float.axis_x = {0.6f, 0.8f, 0};
        box_float.axis_y = {-0.8f, 0.6f, 0};
        box_float.axis_z = {0, 0, 1};
        box_float.half_size = {0.5f, 0.6f, 0.7f};
        box_float.friction = mu;
        box_pack.kind = 2;
        box_pack.response = 0;
        box_pack.centre = pack(a[0]);
        box_pack.axis_x = pack(box_float.axis_x);
        box_pack.axis_y = pack(box_float.axis_y);
        box_pack.axis_z = pack(box_float.axis_z);
        box_pack.half_size = pack(box_float.half_size);
        box_pack.radius = P(0.0f);
        box_pack.friction = P(mu);
        box_pack.velocity = box_pack.spin = pack({0, 0, 0});
        const auto motion = S::contact_step({lanes(a), lanes(c)}, {lanes(b), lanes(d)}, box_pack, P(0.01f),
                                            P(1.0f), P(0.01f));
        for (int k = 0; k < W; ++k) {
            const VF f = F::spring_force(a[k], b[k], c[k], d[k], l0, s, mu);
            EXPECT_EQ(bits(spring.x.lanes[k]), bits(f.x));
            EXPECT_EQ(bits(spring.y.lanes[k]), bits(f.y));
            EXPECT_EQ(bits(spring.z.lanes[k]), bits(f.z));
            EXPECT_EQ(bits(bent.y.lanes[k]), bits(F::bending_force(a[k], b[k], s).y));
            EXPECT_EQ(bits(change.y.lanes[k]),
                      bits(F::velocity_change(c[k], d[k], l0, {0, -9.81f, 0}, mu, 0.01f).y));
            EXPECT_EQ(bits(staged.x.lanes[k]),
                      bits(F::stage_next(4, a[k], F::stage_sum(3, b[k], c[k]), d[k]).x));
            const VF w = F::wind_force(a[k], b[k], c[k], d[k], a[k], b[k], c[k], l0, s, mu);
            EXPECT_EQ(bits(wind.x.lanes[k]), bits(w.x));
            EXPECT_EQ(bits(wind.z.lanes[k]), bits(w.z));
            const auto m = F::contact_step({a[k], c[k]}, {b[k], d[k]}, box_float, 0.01f, 1.0f, 0.01f);
            EXPECT_EQ(bits(motion.position.x.lanes[k]), bits(m.position.x));
            EXPECT_EQ(bits(motion.position.y.lanes[k]), bits(m.position.y));
            EXPECT_EQ(bits(motion.velocity.x.lanes[k]), bits(m.velocity.x));
            EXPECT_EQ(bits(motion.velocity.z.lanes[k]), bits(m.velocity.z));
        }
    }
}

}  // namespace
}  // namespace pliant::test

// Laws of contact and of air against closed forms.
#include <random>

#include "solve/step_constants.hpp"
#include "test_laws.hpp"

namespace pliant::test {
namespace {

// --- contact
// ----------------------------------------------------------------------------------------------------------

D::Collider box(VD centre, VD half)
{
    D::Collider c{};
    c.kind = 2;
    c.centre = centre;
    c.axis_x = {1, 0, 0};
    c.axis_y = {0, 1, 0};
    c.axis_z = {0, 0, 1};
    c.half_size = half;
    return c;
}

TEST(Gap, Sphere)
{
    const auto outside = D::gap_sphere({3, 4, 0}, {0, 0, 0}, 2.0);
    EXPECT_NEAR(outside.w, 3, 1e-14);
    EXPECT_NEAR(outside.x, 0.6, 1e-15);
    EXPECT_NEAR(D::gap_sphere({0.5, 0, 0}, {0, 0, 0}, 2.0).w, -1.5, 1e-14);
    const auto centre = D::gap_sphere({1, 1, 1}, {1, 1, 1}, 2.0);
    EXPECT_NEAR(centre.w, -2, 1e-14);
    EXPECT_NEAR(length({centre.x, centre.y, centre.z}), 1, 1e-14);
}

TEST(Gap, Plane)
{
    const auto gap = D::gap_plane({5, 3, 7}, {0, 1, 0}, {0, 1, 0});
    EXPECT_EQ(gap.w, 2);
}

TEST(Gap, Capsule)
{
    EXPECT_NEAR(D::gap_capsule({1, 0.3, 0}, {0, 0, 0}, {0, 1, 0}, 0.5, 0.2).w, 0.8, 1e-14);  // beside
    EXPECT_NEAR(D::gap_capsule({0, 2, 0}, {0, 0, 0}, {0, 1, 0}, 0.5, 0.2).w, 1.3, 1e-14);    // beyond the end
    EXPECT_NEAR(D::gap_capsule({0, -0.6, 0}, {0, 0, 0}, {0, 1, 0}, 0.5, 0.2).w, -0.1,
                1e-14);  // within the lower cap
}

/// The least gap to the spheres along the axis, by trying many of them.
double tapered_gap_by_search(const PlacedCollider& capsule, VD p)
{
    const double half = capsule.half_size.y;
    double least = 1e30;
    for (int k = 0; k <= 20000; ++k) {
        const double t = half * (k / 10000.0 - 1);
        const Vec3d d = Vec3d{p.x, p.y, p.z} - capsule.centre - capsule.axes[1] * t;
        least = std::min(least, std::sqrt(dot(d, d)) - capsule.radius - capsule.half_size.z * t);
    }
    return least;
}

TEST(Gap, TaperedCapsule)
{
    const TaperedCapsule shape{
        .start = {0.1, -0.2, 0.3}, .end = {0.5, 0.4, 0.2}, .start_radius = 0.3, .end_radius = 0.1};
    const PlacedCollider placed = placed_at(shape, 0);
    const auto collider = make_collider<double>(placed);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-0.5, 0.8);
    // The search is off by the curvature of the gap, at most 1 / distance, times half a step squared.
    const double step = placed.half_size.y / 10000;
    int beside = 0, inside = 0;
    for (int k = 0; k < 300; ++k) {
        const VD p{place(random), place(random), place(random)};
        const auto gap = D::collider_gap(collider, p);
        EXPECT_NEAR(gap.w, tapered_gap_by_search(placed, p), 10 * step * step)
            << p.x << " " << p.y << " " << p.z;
        inside += gap.w < 0;
        // The normal is the gradient.
        constexpr double h = 1e-6;
        const auto slope = [&](VD to) {
            const auto moved = [&](double s) { return VD{p.x + s * to.x, p.y + s * to.y, p.z + s * to.z}; };
            return (D::collider_gap(collider, moved(h)).w - D::collider_gap(collider, moved(-h)).w) / (2 * h);
        };
        const bool on_axis = std::abs(gap.w) < 1e-3;
        if (!on_axis) {
            EXPECT_NEAR(gap.x, slope({1, 0, 0}), 1e-7);
            EXPECT_NEAR(gap.y, slope({0, 1, 0}), 1e-7);
            EXPECT_NEAR(gap.z, slope({0, 0, 1}), 1e-7);
        }
        // On the cone, the normal leans by the sine of half the angle at its tip.
        const double along = gap.x * placed.axes[1].x + gap.y * placed.axes[1].y + gap.z * placed.axes[1].z;
        beside += std::abs(along + placed.half_size.z) < 1e-12;
    }
    EXPECT_GT(beside, 30);
    EXPECT_LT(beside, 270);
    EXPECT_GT(inside, 10);
    // On the axis beyond an end, and with equal ends, where it is a capsule.
    EXPECT_NEAR(
        D::gap_tapered_capsule({0, 2, 0}, {0, 0, 0}, {0, 1, 0}, 0.5, 0.2, 0.1, 0.1 / std::sqrt(0.99)).w,
        1.5 - 0.25, 1e-14);
    EXPECT_NEAR(D::gap_tapered_capsule({0, -0.3, 0}, {0, 0, 0}, {0, 1, 0}, 0.5, 0.2, 0, 0).w, -0.2, 1e-14);
}

TEST(Gap, TaperedCapsuleOfWhichOneSphereContainsTheOtherIsThatSphere)
{
    const TaperedCapsule shape{
        .start = {0, 0, 0}, .end = {0.1, 0, 0}, .start_radius = 0.4, .end_radius = 0.3};
    const auto collider = make_collider<double>(placed_at(shape, 0));
    for (const VD p : {VD{1, 0, 0}, VD{-1, 0.3, 0}, VD{0.05, 0, 0.1}, VD{0, 0, 0}})
        EXPECT_NEAR(D::collider_gap(collider, p).w, length(p) - 0.4, 1e-14);
}

TEST(Gap, BoxFaceEdgeCornerAndInside)
{
    const auto c = box({1, 0, 0}, {1, 2, 3});
    const auto face = D::collider_gap(c, {1, 5, 0});
    EXPECT_NEAR(face.w, 3, 1e-14);
    EXPECT_NEAR(face.y, 1, 1e-14);
    const auto corner = D::collider_gap(c, {2 + 2, -2 - 1, 3 + 2});  // (2, -1, 2) from the corner
    EXPECT_NEAR(corner.w, 3, 1e-14);
    EXPECT_NEAR(corner.y, -1.0 / 3, 1e-14);
    const auto inside = D::collider_gap(c, {0.25, 0.5, 0});  // 0.25 m from the face at x = 0
    EXPECT_NEAR(inside.w, -0.25, 1e-14);
    EXPECT_NEAR(inside.x, -1, 1e-14);
}

TEST(Gap, TheWayOutOfABoxLeadsThroughItsNearestFace)
{
    const auto c = box({0, 0, 0}, {1, 2, 3});
    const struct {
        VD at, normal;
    } cases[] = {{{0.9, 0.3, 0.2}, {1, 0, 0}}, {{-0.9, 0.3, 0.2}, {-1, 0, 0}},
                 {{0.1, 1.9, 0.2}, {0, 1, 0}}, {{0.1, -1.9, 0.2}, {0, -1, 0}},
                 {{0.1, 0.3, 2.9}, {0, 0, 1}}, {{0.1, 0.3, -2.9}, {0, 0, -1}}};
    for (const auto& way : cases) {
        const auto gap = D::collider_gap(c, way.at);
        EXPECT_NEAR(gap.w, -0.1, 1e-14);
        EXPECT_EQ(gap.x, way.normal.x);
        EXPECT_EQ(gap.y, way.normal.y);
        EXPECT_EQ(gap.z, way.normal.z);
    }
}

TEST(Gap, RotatedBox)
{
    auto c = box({0, 0, 0}, {1, 2, 3});
    c.axis_x = {0, 1, 0};  // a quarter turn about z
    c.axis_y = {-1, 0, 0};
    EXPECT_NEAR(D::collider_gap(c, {0, 2.5, 0}).w, 1.5, 1e-14);
    EXPECT_NEAR(D::collider_gap(c, {2.5, 0, 0}).w, 0.5, 1e-14);
}

TEST(Contact, RemovesTheApproachAndTakesFrictionFromTheRest)
{
    // Falling at 2 m/s while sliding at 3 m/s, mu = 0.5: sliding loses 0.5 * 2.
    const VD v = D::contact_velocity({3, -2, 0}, {0, 0, 0}, {0, 1, 0}, 0.5);
    EXPECT_NEAR(v.x, 2, 1e-14);
    EXPECT_NEAR(v.y, 0, 1e-14);
}

TEST(Contact, SticksWhenFrictionSuffices)
{
    const VD v = D::contact_velocity({0.9, -2, 0}, {0, 0, 0}, {0, 1, 0}, 0.5);
    EXPECT_NEAR(length(v), 0, 1e-14);
}

TEST(Contact, LeavesADepartingNodeAlone)
{
    const VD v = D::contact_velocity({3, 2, 1}, {0, 0, 0}, {0, 1, 0}, 0.5);
    EXPECT_NEAR(length(v - VD{3, 2, 1}), 0, 1e-14);
}

TEST(Contact, MovesWithTheSurface)
{
    // A sphere spinning about y at 2 rad/s: its surface at x = 0.5 moves at -1 m/s along z.
    D::Collider c{};
    c.kind = 0;
    c.radius = 0.5;
    c.spin = {0, 2, 0};
    c.velocity = {0, 0, 3};
    EXPECT_NEAR(D::collider_surface_velocity(c, {0.5, 0, 0}).z, 2, 1e-14);
    const VD stuck = D::contact_velocity({-1, 0, 2}, {0, 0, 2}, {1, 0, 0}, 10.0);
    EXPECT_NEAR(length(stuck - VD{0, 0, 2}), 0, 1e-14);
}

TEST(Contact, StepPutsTheNodeOnTheSurfaceAndDoesNotLetItCreep)
{
    D::Collider plane{};
    plane.kind = 1;
    plane.axis_y = {0.6, 0.8, 0};  // tilted by less than friction holds
    plane.friction = 2;
    const double dt = 0.01, thickness = 0.125;
    const VD at_rest = VD{0.6, 0.8, 0} * thickness;
    D::Motion now{at_rest, {0, 0, 0}}, next;
    next.velocity = {0, -10 * dt, 0};
    next.position = now.position + next.velocity * dt;
    const D::Motion after = D::contact_step(now, next, plane, thickness, 1.0, dt);
    EXPECT_NEAR(length(after.position - at_rest), 0, 1e-15);
    EXPECT_NEAR(length(after.velocity), 0, 1e-15);
    const D::Motion pinned = D::contact_step(now, next, plane, thickness, 0.0, dt);
    EXPECT_EQ(length(pinned.position - next.position), 0);
}

TEST(Contact, LetsASunkNodeRise)
{
    D::Collider plane{};
    plane.kind = 1;
    plane.axis_y = {0, 1, 0};
    plane.response = 2;
    const double dt = 1e-4, g = 9.81;
    const auto stepped = [&](double height, double speed, double inverse_mass = 1) {
        D::Motion now{{0, height, 0}, {0, speed, 0}}, next;
        next.velocity = {0, speed - g * dt, 0};
        next.position = now.position + next.velocity * dt;
        return D::contact_step(now, next, plane, 0.0, inverse_mass, dt);
    };
    // Accelerates from rest by 1000 m/s2 less gravity, and moves at that speed.
    const D::Motion first = stepped(-0.5, 0);
    EXPECT_NEAR(first.velocity.y, (1000 - g) * dt, 1e-12);
    EXPECT_NEAR(first.position.y, -0.5 + first.velocity.y * dt, 1e-12);
    // Up to 1 m/s, and 8 times a second the depth.
    EXPECT_NEAR(stepped(-0.5, 1).velocity.y, 1, 1e-12);
    EXPECT_NEAR(stepped(-0.01, 0.08).velocity.y, 0.08, 8 * 0.08 * dt);
    EXPECT_NEAR(stepped(-0.5, 3).velocity.y, 3 - g * dt, 1e-12);  // a faster node keeps its speed
    EXPECT_NEAR(stepped(-0.5, -3).velocity.y, 0, 1e-12);          // nothing sinks deeper
    EXPECT_EQ(stepped(-0.5, 0, 0).velocity.y, -g * dt);           // a pin
    // Depths that contact leaves, up to a millimetre, are projected onto the surface as usual, and so is a
    // node that came from outside.
    EXPECT_NEAR(stepped(-0.0009, 0).position.y, 0, 1e-12);
    EXPECT_NEAR(stepped(-0.0009, 0).velocity.y, 0, 1e-12);
    EXPECT_NEAR(stepped(0.001, -30).position.y, 0, 1e-12);
    // Over many steps it arrives without speed.
    D::Motion m{{0, -0.25, 0}, {0, 0, 0}};
    double fastest = 0;
    for (int k = 0; k < 20000; ++k)
        m = stepped(m.position.y, m.velocity.y), fastest = std::max(fastest, m.velocity.y);
    EXPECT_NEAR(m.position.y, 0, 1e-12);
    EXPECT_LE(fastest, 1 + 1e-9);
    EXPECT_NEAR(m.velocity.y, 0, 1e-12);
}

TEST(Contact, PaperResponseIsAlgorithm4AsPrinted)
{
    // 3 m/s of sliding with 1 m/s outward becomes |n + v / |v||, which is not a velocity (see errata).
    D::Collider sphere{};
    sphere.kind = 0;
    sphere.radius = 1;
    sphere.response = 1;
    D::Motion now{{0, 1.01, 0}, {3, 0, 0}}, next{{0, 0.99, 0}, {3, 0, 0}};
    const D::Motion after = D::contact_step(now, next, sphere, 0.0, 1.0, 0.01);
    EXPECT_NEAR(length(after.velocity), std::sqrt(2.0), 1e-14);
    EXPECT_NEAR(after.position.y, 1, 1e-14);
    next.velocity = {0, 0, 0};  // as printed a division by zero
    EXPECT_NEAR(length(D::contact_step(now, next, sphere, 0.0, 1.0, 0.01).velocity - VD{0, 1, 0}), 0, 1e-14);
}

// --- air
// --------------------------------------------------------------------------------------------------------------

TEST(Wind, OnAPlateHeadOnIsDragAlone)
{
    // Area 0.5 m2, 4 m/s head on: rho C_d A u^2 / 2 over the three corners; lift has no direction to go.
    const VD zero{0, 0, 0};
    const VD f = D::wind_force({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, zero, zero, zero, {0, 0, 4}, 1.2, 1.5, 0.7);
    EXPECT_NEAR(3 * f.z, 0.5 * 1.2 * 1.5 * 0.5 * 16, 1e-6);  // a third is rounded to float in the law
    EXPECT_NEAR(f.x, 0, 1e-14);
}

TEST(Wind, BothSidesFeelTheSame)
{
    const VD a{0, 0, 0}, b{1, 0, 0.3}, c{0, 1, 0.2}, v{0.1, 0.2, 0.3}, wind{3, -1, 4};
    const VD f = D::wind_force(a, b, c, v, v, v, wind, 1.2, 1.5, 0.7);
    const VD g = D::wind_force(a, c, b, v, v, v, wind, 1.2, 1.5, 0.7);
    EXPECT_NEAR(length(f - g), 0, 1e-14 * length(f));
}

TEST(Wind, AlongAPlateDoesNothingAndMovingWithTheAirNeither)
{
    const VD zero{0, 0, 0}, wind{0, 0, 4};
    EXPECT_NEAR(
        length(D::wind_force({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, zero, zero, zero, {4, 1, 0}, 1.2, 1, 1)), 0,
        1e-14);
    EXPECT_NEAR(length(D::wind_force({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, wind, wind, wind, wind, 1.2, 1, 1)), 0,
                1e-6);
}

TEST(Wind, LiftIsAcrossTheWind)
{
    const VD zero{0, 0, 0}, u{3, 0, 4};
    const VD lift = D::wind_force({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, zero, zero, zero, u, 1.2, 0, 1);
    EXPECT_NEAR(D::dot3(lift, u), 0, 1e-12 * length(lift));
    EXPECT_GT(length(lift), 0.1);
}

}  // namespace
}  // namespace pliant::test

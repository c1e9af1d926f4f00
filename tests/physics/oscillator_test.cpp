// A mass on a spring.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "physics/measured.hpp"
#include "test_cloths.hpp"
#include "test_differences.hpp"

namespace pliant {
namespace {

constexpr double spring_stiffness = 50, oscillating_mass = 0.125;  // N/m, kg
const double omega = std::sqrt(spring_stiffness / oscillating_mass);

/// A triangle flat to a line: node 0 is free between nodes 1 and 2, which are pinned at both sides of it. Two
/// springs on one line pull together with their sum.
Scene oscillator(double dt, double start_speed, double damping = 0)
{
    SurfaceMesh mesh{{{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}}, {{0, 1, 2}}};
    Cloth cloth = Cloth::mesh(mesh, {.node_mass = oscillating_mass});
    cloth.springs = {{spring_stiffness / 2, damping / 2}, {0, 0}, {0, 0}};
    cloth.damping = 0;
    cloth.velocity = {start_speed, 0, 0};
    cloth.pin(1u).pin(2u);
    Scene scene;
    scene.gravity = {0, 0, 0};
    scene.time = {.duration = 1, .frame_rate = 1 / dt, .substeps = 1};
    scene.add(cloth);
    return scene;
}

struct Swing {
    double period = 0;     ///< s, from when the mass passes its rest length upwards, by linear interpolation
    double amplitude = 0;  ///< m, the farthest that it came
};
Swing measured_swing(double dt, int periods)
{
    Simulation simulation(oscillator(dt, 0.5), test::on(Backend::reference));
    double before = 0, first = -1, last = -1;
    int crossings = 0;
    test::Largest farthest;
    for (int n = 1; crossings <= periods && simulation.report().finite; ++n) {
        simulation.advance(dt);
        const double x = simulation.positions()[0].x;
        if (before < 0 && x >= 0) {
            const double t = (n - 1 + before / (before - x)) * dt;
            if (crossings++ == 0) first = t;
            last = t;
        }
        before = x;
        farthest.add(std::abs(x));
    }
    return {(last - first) / periods, farthest.value()};
}

TEST(Oscillator, PeriodAndAmplitudeHaveTheErrorsOfSymplecticEuler)
{
    // omega_num = (2 / dt) asin(omega dt / 2): the period is short by (omega dt)^2 / 24. From rest at speed
    // v_0 the scheme gives x_n = v_0 dt / sin(theta) sin(n theta), theta = omega_num dt, so that the
    // amplitude is v_0 / omega over sqrt(1 - (omega dt / 2)^2), long by (omega dt)^2 / 8. Both are of second
    // order, over five refinements; the next terms of these series are 3 % of them at omega dt = 0.32.
    double dt_before = 0, period_before = 0, amplitude_before = 0;
    for (const double dt : {0.016, 0.012, 0.008, 0.006, 0.004, 0.002}) {
        const double numerical = std::numbers::pi * dt / std::asin(omega * dt / 2),
                     squared = omega * omega * dt * dt;
        const Swing swing = measured_swing(dt, 200);
        // Positions are reported as float; 200 periods average the crossing times to 1e-6 of a period.
        EXPECT_NEAR(swing.period / numerical, 1, 1e-5) << dt;
        const double period = 1 - swing.period / (2 * std::numbers::pi / omega);
        const double amplitude = swing.amplitude / (0.5 / omega) - 1;
        EXPECT_NEAR(period, squared / 24, 0.05 * squared / 24) << dt;
        EXPECT_NEAR(amplitude, squared / 8, 0.05 * squared / 8) << dt;
        if (dt_before > 0) {
            const double refined = std::log(dt_before / dt);
            test::measured("oscillator, order of the period", std::log(period_before / period) / refined, 2);
            test::measured("oscillator, order of the amplitude",
                           std::log(amplitude_before / amplitude) / refined, 2);
            EXPECT_NEAR(std::log(period_before / period) / refined, 2, 0.1) << dt;
            EXPECT_NEAR(std::log(amplitude_before / amplitude) / refined, 2, 0.1) << dt;
        }
        dt_before = dt;
        period_before = period;
        amplitude_before = amplitude;
    }
}

TEST(Oscillator, KeepsItsFrequencyAndAmplitudeOverAMillionSteps)
{
    // Row "spring oscillator": omega_num = (2/dt) asin(omega dt / 2), and no drift of the amplitude. From
    // rest the scheme gives x_n = v_0 sin(n theta) dt / sin(theta) with theta = omega_num dt, and keeps v^2 +
    // omega^2 x^2 - omega^2 dt x v. After 1e6 steps of omega dt = 0.02 the phase is 2e4 rad, so that 1e-6 of
    // the amplitude in x is 1e-10 in the frequency. In float the state is rounded a million times: a random
    // walk of sqrt(1e6) half ulps, and four of those.
    for (const Backend backend : {Backend::reference, Backend::cpu}) {
        const double dt = 0.001, speed = 0.5, theta = 2 * std::asin(omega * dt / 2);
        Simulation simulation(oscillator(dt, speed), test::on(backend));
        const double tolerance = backend == Backend::reference ? 1e-6 : 4 * 1e3 * 0x1p-24 * 10;
        for (unsigned part = 1; part <= 10; ++part) {
            simulation.advance(1e5 * dt);
            ASSERT_EQ(simulation.report().steps, part * 100'000u);
            const double x = simulation.positions()[0].x, v = simulation.velocities()[0].x;
            const double kept = v * v + omega * omega * x * x - omega * omega * dt * x * v;
            if (part == 10)
                test::measured(std::string("oscillator, kept energy after 1e6 steps, ") + name_of(backend),
                               kept / (speed * speed), 1);
            EXPECT_NEAR(kept / (speed * speed), 1, 2 * tolerance) << name_of(backend);
            if (backend == Backend::reference) {
                EXPECT_NEAR(x, speed * dt / std::sin(theta) * std::sin(part * 1e5 * theta),
                            1e-6 * speed / omega);
            }
        }
    }
}

TEST(Oscillator, DampingTakesTheAmplitudeAsTheSchemeSays)
{
    // z^2 - (2 - gamma dt - omega^2 dt^2) z + 1 - gamma dt = 0, so that |z|^2 = 1 - gamma dt; x_n = Im z^n
    // v_0 dt / Im z.
    const double dt = 0.001, speed = 0.5, c = 0.2, gamma = c / oscillating_mass;
    const double half = 1 - (gamma * dt + omega * omega * dt * dt) / 2;
    const std::complex<double> z(half, std::sqrt(1 - gamma * dt - half * half));
    Simulation simulation(oscillator(dt, speed, c), test::on(Backend::reference));
    for (int part = 1; part <= 5; ++part) {
        simulation.advance(200 * dt);
        // The first step damps the speed that the scene gives, which is none of the scheme's: v_1 = (1 -
        // gamma dt) v_0.
        const double first = speed * (1 - gamma * dt) * dt;
        EXPECT_NEAR(simulation.positions()[0].x, first * std::pow(z, 200 * part).imag() / z.imag(),
                    1e-6 * speed / omega)
            << part;
    }
}

}  // namespace
}  // namespace pliant

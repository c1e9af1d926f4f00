// Which buffer of a cloth has which place in the shaders, and which of them a pass binds: layouts for passes
// of a kind, so that none has more than devices of phones and headsets can bind at once.
#pragma once

#include <cstdint>
#include <span>

#include "solve/pass.hpp"

namespace pliant::vulkan {

/// Bindings of shaders/*.glsl.
enum class Binding : std::uint32_t {
    parameters = 0,
    position_in = 1,
    velocity_in = 2,
    position_out = 3,
    velocity_out = 4,
    external_force = 5,
    colliders = 6,
    springs = 7,
    spring_rest_class = 8,
    neighbour_start = 9,
    neighbours = 10,
    triangles = 11,
    triangle_start = 12,
    node_triangles = 13,
    spring_force = 14,
    normal = 15,
    strain = 16,
    measures = 17,
    solver = 18,
    solver_arena = 19,
    solver_scalars = 20,
    solver_parts = 21,
    solver_topology = 22,
    multiplier = 23,
    body_topology = 24,
    gradient = 25,
    direction = 26,
    blocked = 27,
    body_sums = 28,
    slopes = 29,
};

/// All other bindings are storage buffers.
constexpr bool is_uniform(Binding binding)
{
    return binding == Binding::parameters || binding == Binding::solver;
}

/// What passes bind, by name.
enum class PassLayout : std::uint32_t {
    nodes,        ///< what every cloth has, and sheets
    springs,      ///< passes over lists of springs
    list_steps,   ///< steps of what has such lists
    triangles,    ///< passes over the triangles around a node
    body_forces,  ///< soft bodies: up to the rates of volume
    body_volume,  ///< and from there on
    solver,       ///< solvers: what works on their own numbers
    solver_ends,  ///< and what brings the state there and back
};
constexpr std::uint32_t layout_count = 8;

/// What a layout binds, in ascending order. Every shader finds there what it uses
/// (tests/device_limits_test.cpp).
std::span<const Binding> bindings_of(PassLayout layout);
PassLayout layout_of(Pass pass);

}  // namespace pliant::vulkan

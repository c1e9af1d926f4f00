// Which buffer of a cloth has which place in the shaders.
#pragma once

#include <cstdint>

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
constexpr std::uint32_t binding_count = static_cast<std::uint32_t>(Binding::slopes) + 1;

/// All other bindings are storage buffers.
constexpr bool is_uniform(Binding binding)
{
    return binding == Binding::parameters || binding == Binding::solver;
}

/// What every pipeline binds, and so what a device must be able to bind at once.
constexpr std::uint32_t storage_buffer_count()
{
    std::uint32_t count = 0;
    for (std::uint32_t b = 0; b < binding_count; ++b)
        if (!is_uniform(static_cast<Binding>(b))) ++count;
    return count;
}

}  // namespace pliant::vulkan

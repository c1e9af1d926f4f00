// The binding of each buffer of a cloth, and the bindings of each pass. Passes share a few layouts, small
// enough for the limits of phones and headsets.
#pragma once

#include <cstdint>
#include <span>

#include "solve/pass.hpp"

namespace pliant::vulkan {

enum class Binding : std::uint32_t {
#define UNIFORM_BLOCK(name, number) name = number,
#define STORAGE(name, number) name = number,
#include "backend/vulkan/shaders/bindings.glsl"
#undef UNIFORM_BLOCK
#undef STORAGE
};

/// All other bindings are storage buffers.
constexpr bool is_uniform(Binding binding)
{
    return binding == Binding::parameters || binding == Binding::solver;
}

/// The layouts of passes.
enum class PassLayout : std::uint32_t {
    nodes,        ///< data of every cloth, and sheets
    springs,      ///< passes over lists of springs
    list_steps,   ///< steps from lists of springs
    triangles,    ///< passes over the triangles around a node
    body_forces,  ///< soft bodies: up to the rates of volume
    body_volume,  ///< soft bodies: from there on
    solver,       ///< solvers: passes on their own data
    solver_ends,  ///< solvers: passes that read or write the state
};
constexpr std::uint32_t layout_count = 8;

/// The bindings of a layout, in ascending order. They include all that its shaders use
/// (tests/device_limits_test.cpp).
std::span<const Binding> bindings_of(PassLayout layout);
PassLayout layout_of(Pass pass);

}  // namespace pliant::vulkan

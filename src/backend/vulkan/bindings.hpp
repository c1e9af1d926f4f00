// Which buffer of a cloth has which place in the shaders, and which of them a pass binds: layouts for passes
// of a kind, so that none has more than devices of phones and headsets can bind at once.
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

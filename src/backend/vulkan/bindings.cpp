#include "backend/vulkan/bindings.hpp"

#include <array>

namespace pliant::vulkan {

std::span<const Binding> bindings_of(PassLayout layout)
{
    using enum Binding;
    // At most ten storage buffers per layout.
    static constexpr std::array nodes{parameters,     position_in, velocity_in, position_out, velocity_out,
                                      external_force, colliders,   normal,      strain,       measures};
    static constexpr std::array springs_{
        parameters,      position_in, velocity_in,  colliders, springs, spring_rest_class,
        neighbour_start, neighbours,  spring_force, strain,    measures};
    static constexpr std::array list_steps{parameters,   position_in,    velocity_in, position_out,
                                           velocity_out, external_force, colliders,   neighbour_start,
                                           neighbours,   spring_force,   slopes};
    static constexpr std::array triangles_{parameters, position_in,    velocity_in,    external_force,
                                           triangles,  triangle_start, node_triangles, normal};
    static constexpr std::array body_forces{parameters,   position_in,    velocity_in, position_out,
                                            velocity_out, external_force, colliders,   body_topology,
                                            gradient,     blocked,        body_sums};
    static constexpr std::array body_volume{parameters,   position_in, velocity_in,   position_out,
                                            velocity_out, colliders,   body_topology, gradient,
                                            direction,    blocked,     body_sums};
    static constexpr std::array solver_{parameters,   position_out,    colliders,
                                        solver,       solver_arena,    solver_scalars,
                                        solver_parts, solver_topology, multiplier};
    static constexpr std::array solver_ends{parameters,   position_in,    velocity_in,  position_out,
                                            velocity_out, external_force, colliders,    solver,
                                            solver_arena, solver_scalars, solver_parts, solver_topology};
    switch (layout) {
        case PassLayout::nodes: return nodes;
        case PassLayout::springs: return springs_;
        case PassLayout::list_steps: return list_steps;
        case PassLayout::triangles: return triangles_;
        case PassLayout::body_forces: return body_forces;
        case PassLayout::body_volume: return body_volume;
        case PassLayout::solver: return solver_;
        case PassLayout::solver_ends: return solver_ends;
    }
    return {};
}

PassLayout layout_of(Pass pass)
{
    switch (pass) {
#define CLOTH_PASS(name, unit, layout, ...) \
    case Pass::name: {                      \
        return PassLayout::layout;          \
    }
#define BODY_PASS(name, unit, layout, ...) CLOTH_PASS(name, unit, layout, )
#define PASS(name, ...) \
    case Pass::name: {  \
        break;          \
    }
#include "solve/passes.def"
    }
    // A solver's layout. The next state is bound even for reading: it has the positions to which pins move.
    for (const Resource resource : description_of(pass).reads)
        if (resource == Resource::position || resource == Resource::velocity ||
            resource == Resource::next_velocity || resource == Resource::external_force)
            return PassLayout::solver_ends;
    for (const Resource resource : description_of(pass).writes)
        if (resource == Resource::next_position) return PassLayout::solver_ends;
    return PassLayout::solver;
}

}  // namespace pliant::vulkan

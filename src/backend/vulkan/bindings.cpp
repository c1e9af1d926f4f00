#include "backend/vulkan/bindings.hpp"

#include <array>

namespace pliant::vulkan {

std::span<const Binding> bindings_of(Family family)
{
    using enum Binding;
    // At most ten storage buffers in a row.
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
    switch (family) {
        case Family::nodes: return nodes;
        case Family::springs: return springs_;
        case Family::list_steps: return list_steps;
        case Family::triangles: return triangles_;
        case Family::body_forces: return body_forces;
        case Family::body_volume: return body_volume;
        case Family::solver: return solver_;
        case Family::solver_ends: return solver_ends;
    }
    return {};
}

Family family_of(Pass pass)
{
    switch (pass) {
        case Pass::spring_force:
        case Pass::list_measure:
        case Pass::list_strain: return Family::springs;
        case Pass::list_step:
        case Pass::stage_step: return Family::list_steps;
        case Pass::mesh_wind:
        case Pass::mesh_normal: return Family::triangles;
        case Pass::load_force:
        case Pass::ring_step:
        case Pass::volume_gather: return Family::body_forces;
        case Pass::step_begin:
        case Pass::step_end:
        case Pass::acad_begin:
        case Pass::acad_end:
        case Pass::paper_begin:
        case Pass::paper_gather:
        case Pass::paper_step: return Family::solver_ends;
        default: break;
    }
    return is_body_pass(pass) ? Family::body_volume : is_solver_pass(pass) ? Family::solver : Family::nodes;
}

}  // namespace pliant::vulkan

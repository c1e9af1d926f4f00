// Which way the triangles of a mesh face, and which way they should.
#pragma once

#include <span>

#include "mesh/mesh_topology.hpp"

namespace pliant {

/// How to turn the triangles of a mesh so that they agree.
struct OrientationPlan {
    std::vector<bool> turn;   ///< for each triangle: neighbours agree, and each component faces as it should
    bool orientable = false;  ///< false when some edge with two triangles disagrees whatever is turned
    std::size_t inward_components = 0;  ///< components that agree in themselves but face the wrong way
};

/// Neighbours are made to agree across edges with two triangles. Then each closed component is made to face
/// outward, or inward when it lies in an odd number of others (a cavity). A component that is open or has no
/// volume keeps the side that most of its triangles have.
OrientationPlan plan_orientation(const SurfaceMesh& mesh, std::span<const EdgeUse> uses);

/// Turns the triangles of the plan round, and returns their number.
std::size_t turn_triangles(SurfaceMesh& mesh, const std::vector<bool>& turn);

}  // namespace pliant

// The orientation of a mesh's triangles: present and consistent.
#pragma once

#include <span>

#include "mesh/mesh_topology.hpp"

namespace pliant {

/// Which triangles of a mesh to turn so that all agree.
struct OrientationPlan {
    std::vector<bool> turn;   ///< by triangle: afterwards neighbours agree, and components face the right way
    bool orientable = false;  ///< false if some edge with two triangles disagrees for any choice
    std::size_t inward_components = 0;  ///< components that are consistent but face the wrong way
};

/// Neighbours agree across edges with two triangles. Each closed component faces outward, or inward if it is
/// inside an odd number of others (a cavity). A component that is open or has no volume keeps the orientation
/// of most of its triangles.
OrientationPlan plan_orientation(const SurfaceMesh& mesh, std::span<const EdgeUse> uses);

/// Turns the triangles of the plan, and returns their number.
std::size_t turn_triangles(SurfaceMesh& mesh, const std::vector<bool>& turn);

}  // namespace pliant

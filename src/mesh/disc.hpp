// A round piece of cloth as an irregular triangle mesh.
#pragma once

#include <cstdint>

#include "pliant/api.hpp"
#include "pliant/mesh.hpp"

namespace pliant {

constexpr std::uint64_t disc_node_count(std::uint32_t rings) { return 1 + 3ull * rings * (rings + 1ull); }

/// A disc in the x-z plane around the origin, facing up (+y): node 0 in the middle, and around it `rings`
/// rings, the k-th with 6 k nodes. Nodes inside the hem are moved by up to a fifth of the distance between
/// rings, the same way in every run.
PLIANT_INSIDE SurfaceMesh make_disc(double radius, std::uint32_t rings);

}  // namespace pliant

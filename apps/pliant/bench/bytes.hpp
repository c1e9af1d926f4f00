// Bytes per node and step between memory and processor if each value is read once and written once: counted
// from the layouts of the backends (docs/performance.md). Reads for write-allocation are not counted, nor
// savings by time blocking, so the number is the same for all versions.
#pragma once

#include "body/cloth_model.hpp"
#include "pliant/simulation.hpp"

namespace pliant::tool {

/// For the method mass_spring or volume. `backend` must not be automatic.
double bytes_per_node_and_step(const ClothModel& model, Backend backend);

}  // namespace pliant::tool

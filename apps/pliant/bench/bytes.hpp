// Bytes that have to move between memory and the machine for a node and a step, when each value is fetched
// once and stored once: counted from the layouts of the backends (docs/performance.md). A store that fetches
// its line first is not counted, nor what blocking in time saves, so that these are the bytes of the same
// work in every version.
#pragma once

#include "body/cloth_model.hpp"
#include "pliant/simulation.hpp"

namespace pliant::tool {

/// Of the method mass_spring or volume. `backend` must not be automatic.
double bytes_per_node_and_step(const ClothModel& model, Backend backend);

}  // namespace pliant::tool

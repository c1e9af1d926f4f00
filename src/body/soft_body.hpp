// What a soft body has beyond a cloth, made from its shape and masses.
#pragma once

#include <utility>

#include "body/body_model.hpp"
#include "body/node_masses.hpp"
#include "body/spring_set.hpp"
#include "body/stepping_plan.hpp"

namespace pliant {

/// Springs along the edges and through the inside, rings, fans, blocks, weights and loads. Throws
/// Error(bad_input) where nothing could keep the volume, or a load has no node.
std::pair<SpringSet, BodyModel> make_soft_body(const Cloth& cloth, const SteppingPlan& plan,
                                               const ClothShape& shape, const NodeMasses& masses);

}  // namespace pliant

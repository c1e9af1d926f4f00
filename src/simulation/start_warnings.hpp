// Warnings about a scene's start that its author hardly intends, and colliders that contain nodes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "body/cloth_model.hpp"
#include "pliant/scene.hpp"

namespace pliant {

/// m: contact leaves nodes at most this deep in a collider and the thickness around it; equals the limit in
/// `sunk_depth` of laws/contact.law.glsl.
constexpr double deepest_contact = 0x1p-10;

/// By collider: 1 if a free node of a model is deeper in it than contact leaves nodes.
void find_sunk(const Scene& scene, const ClothModel& model, std::span<const Vec3> positions, double time,
               std::vector<std::uint8_t>& sunk);

/// A sentence for each collider in which free nodes of the cloth start.
std::vector<std::string> starts_inside(const Scene& scene, const Cloth& cloth, const ClothModel& model);

/// Sentences about targets of a soft body's volume that change too fast for it.
std::vector<std::string> fast_targets(const Cloth& body);

}  // namespace pliant

// A scene of Pliant as the serial baselines take it: the same nodes, masses, springs and colliders, so that
// both do the same work.
#pragma once

#include "pliant/scene.hpp"
#include "serial_cloth.hpp"
#include "serial_volume.hpp"

namespace pliant::serial {

/// The scene's first cloth. Nodes are numbered as in its mesh, or row by row; springs are sorted by their
/// nodes. Throws Error(bad_input) when the scene has what the baseline does not know: moving air, moving pins
/// or colliders, boxes, capsules, another method than mass_spring, more than one cloth.
Cloth cloth_of(const Scene& scene);
/// The same of a scene with one soft body, of method volume (a target that does not move, no weights, no
/// loads).
Body body_of(const Scene& scene);

}  // namespace pliant::serial

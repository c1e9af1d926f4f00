// The baseline of `pliant bench` for soft bodies: mass-spring with one volume constraint as the volume paper
// has it (Va, Choi, Hong 2022, algorithms 1 and 2), with its gradient put right (eq. 10 is misprinted) and
// nothing else: no exact correction after the linearised one, no blocked directions. One thread, plain
// floats; only the three sums over the whole body are doubles, since as floats they lose more of the volume
// than the constraint does.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "serial_cloth.hpp"

namespace pliant::serial {

struct Body {
    Cloth skin;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< closed, counter-clockwise seen from outside
    double wanted_volume = 0;                             ///< m3
    std::vector<Vector> jacobian = {};                    ///< m2, dV/dx by node; made by `step`
};

/// m3, of the triangles as they are: eq. (7).
double volume_of(const Body& body);
/// One step of `dt` s: spring forces, the force of the constraint (eq. 14), integration, colliders.
void step(Body& body, float dt);

}  // namespace pliant::serial

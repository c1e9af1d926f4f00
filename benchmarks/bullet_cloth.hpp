// Another engine's step of the same cloth, to compare with: btSoftBody of Bullet, when it was there as this
// was built.
#pragma once

#include <memory>

#include "serial_cloth.hpp"

namespace pliant::bullet {

class SoftBody {
public:
    virtual ~SoftBody() = default;
    virtual void step(float dt) = 0;                              ///< s
    virtual serial::Vector position(std::size_t node) const = 0;  ///< m
};

/// The nodes and springs of a cloth as nodes and links of full stiffness, which Bullet projects once in each
/// step (one position iteration, the least it does; more cost more). Colliders are left out. Null without
/// Bullet.
std::unique_ptr<SoftBody> soft_body_of(const serial::Cloth& cloth);

}  // namespace pliant::bullet

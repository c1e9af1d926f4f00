// Soft bodies that tests of the volume share.
#pragma once

#include "pliant/mesh_generators.hpp"
#include "test_cloths.hpp"

namespace pliant::test {

constexpr double volume_bar = 1e-4;  ///< of the volume, that may be lost or won: 0.01 %

/// A sphere of 1 m across, of springs that are stiff and damped.
inline Cloth ball(std::uint32_t frequency = 8, const BodyOptions& options = {})
{
    Cloth cloth =
        Cloth::soft_body(icosphere_mesh({.radius = 0.5, .frequency = frequency}), options, {.node_mass = 1});
    cloth.springs.structural = {5000, 200};
    cloth.damping = 0;
    return cloth;
}

/// A body alone, without weight, 10 steps a frame of 1 ms.
inline Scene free_scene(const Cloth& body)
{
    Scene scene;
    scene.method = Method::volume;
    scene.gravity = {0, 0, 0};
    scene.time = {.duration = 1, .frame_rate = 1000, .substeps = 10};
    scene.add(body);
    return scene;
}

}  // namespace pliant::test

// Soft bodies that tests of the volume share.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

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

/// A closed mesh as a scanner leaves it: its vertices moved at random by up to 0.45 of the shortest edge
/// around, so that some edges are a tenth of others and some triangles are slivers, and numbered at random.
inline SurfaceMesh as_scanned(const SurfaceMesh& mesh, unsigned seed = 7)
{
    std::mt19937 engine(seed);
    const auto random = [&] { return static_cast<float>(engine()) / 2147483648.0f - 1; };  // -1 to 1
    const std::size_t count = mesh.vertices.size();
    std::vector<float> reach(count, 1e30f);
    for (const Triangle& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 a = mesh.vertices[t[k]], b = mesh.vertices[t[(k + 1) % 3]];
            const float edge = std::hypot(b.x - a.x, b.y - a.y, b.z - a.z);
            for (const std::uint32_t end : {t[k], t[(k + 1) % 3]}) reach[end] = std::min(reach[end], edge);
        }
    std::vector<std::uint32_t> name(count);
    std::iota(name.begin(), name.end(), 0u);
    for (std::size_t i = count - 1; i > 0; --i) std::swap(name[i], name[engine() % (i + 1)]);
    SurfaceMesh scanned = mesh;
    for (std::size_t i = 0; i < count; ++i) {
        Vec3d way{double{random()}, double{random()}, double{random()}};
        way = way * (1 / std::max(1.0, std::sqrt(dot(way, way))));  // in a ball
        scanned.vertices[name[i]] = to_float(to_double(mesh.vertices[i]) + way * (0.45 * double{reach[i]}));
    }
    for (Triangle& t : scanned.triangles)
        for (std::uint32_t& corner : t) corner = name[corner];
    return scanned;
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

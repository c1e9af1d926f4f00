#include "mesh/disc.hpp"

#include <cmath>
#include <numbers>

#include "mesh/scattering.hpp"

namespace pliant {
SurfaceMesh make_disc(double radius, std::uint32_t rings)
{
    constexpr double jitter = 0.2;  // of the distance between rings; triangles flip from about 0.4 on
    constexpr double turn = 2 * std::numbers::pi;
    const double spacing = radius / rings;
    SurfaceMesh mesh;
    mesh.vertices.reserve(disc_node_count(rings));
    mesh.vertices.push_back({0, 0, 0});
    for (std::uint32_t ring = 1; ring <= rings; ++ring)
        for (std::uint32_t k = 0; k < 6 * ring; ++k) {
            // Minus: from +x towards -z, counter-clockwise seen from above.
            const double angle = -turn * k / (6.0 * ring);
            double x = spacing * ring * std::cos(angle), z = spacing * ring * std::sin(angle);
            if (ring < rings) {  // the hem stays round
                const auto index = static_cast<std::uint32_t>(mesh.vertices.size());
                const Scatter moved = scatter(index, jitter * spacing);
                x += moved.x;
                z += moved.y;
            }
            mesh.vertices.push_back({static_cast<float>(x), 0, static_cast<float>(z)});
        }

    // Each sixth of a ring connects `ring` edges of its own with `ring` - 1 of the ring inside.
    mesh.triangles.reserve(6ull * rings * rings);
    for (std::uint32_t ring = 1; ring <= rings; ++ring) {
        const auto outer = static_cast<std::uint32_t>(disc_node_count(ring - 1));
        const auto inner = ring > 1 ? static_cast<std::uint32_t>(disc_node_count(ring - 2)) : 0;
        const std::uint32_t inner_count = ring > 1 ? 6 * (ring - 1) : 1;
        for (std::uint32_t sixth = 0; sixth < 6; ++sixth)
            for (std::uint32_t k = 0; k < ring; ++k) {
                const std::uint32_t a = outer + sixth * ring + k;
                const std::uint32_t b = outer + (sixth * ring + k + 1) % (6 * ring);
                const std::uint32_t c = inner + (sixth * (ring - 1) + k) % inner_count;
                mesh.triangles.push_back({c, a, b});
                if (k + 1 < ring)
                    mesh.triangles.push_back({c, b, inner + (sixth * (ring - 1) + k + 1) % inner_count});
            }
    }
    return mesh;
}

}  // namespace pliant

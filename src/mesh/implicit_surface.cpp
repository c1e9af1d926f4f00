// Surface nets (Gibson, Constrained Elastic Surface Nets, MICCAI 1998), the dual of marching cubes: one
// vertex in each cell that the surface crosses, one quad for each lattice edge that it crosses. Then vertices
// are relaxed along the surface, and edges flipped towards Delaunay.
#include "mesh/implicit_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "mesh/triangle_relaxation.hpp"
#include "pliant/error.hpp"

namespace pliant {
namespace {

constexpr std::uint32_t no_cell = std::numeric_limits<std::uint32_t>::max();
constexpr double steepest = 1.25;  // maximum slope of a field

class SurfaceNet {
public:
    SurfaceNet(Field field, const Bounds& bounds, double spacing) : field_(field), h_(spacing)
    {
        const Vec3d size = bounds.max - bounds.min;
        const auto cells = [&](double length) { return static_cast<std::size_t>(length / h_) + 3; };
        nx_ = cells(size.x), ny_ = cells(size.y), nz_ = cells(size.z);
        // Centred, so that a symmetric field has a symmetric lattice; at least one cell outside.
        const auto begin = [&](double low, double length, std::size_t n) {
            return low - (static_cast<double>(n) * h_ - length) / 2;
        };
        origin_ = {begin(bounds.min.x, size.x, nx_), begin(bounds.min.y, size.y, ny_),
                   begin(bounds.min.z, size.z, nz_)};
    }

    /// Layer by layer, so that memory grows with the surface instead of the volume.
    SurfaceMesh build()
    {
        std::vector<double> low = corner_layer(0), high;
        std::vector<std::uint32_t> below(nx_ * ny_, no_cell), cells;
        for (std::size_t z = 0; z < nz_; ++z) {
            high = corner_layer(z + 1);
            cells = cell_layer(low, high, z);
            for (std::size_t y = 1; y < ny_; ++y)
                for (std::size_t x = 1; x < nx_; ++x) add_quads(low, high, below, cells, x, y);
            below = cells;
            low = high;
        }
        return std::move(mesh_);
    }

private:
    std::size_t corner(std::size_t x, std::size_t y) const { return y * (nx_ + 1) + x; }
    std::size_t cell(std::size_t x, std::size_t y) const { return y * nx_ + x; }
    Vec3d place(double x, double y, double z) const { return origin_ + Vec3d{x, y, z} * h_; }

    /// Field values at the corners of one layer, row by row of y.
    std::vector<double> corner_layer(std::size_t z) const
    {
        std::vector<double> values((nx_ + 1) * (ny_ + 1));
        for (std::size_t y = 0; y <= ny_; ++y)
            for (std::size_t x = 0; x <= nx_;) {
                const double value = field_(place(double(x), double(y), double(z))).value;
                // Values are not needed while neither a corner nor its neighbours can have the other sign.
                const double steps = std::abs(value) / (steepest * h_) - 1;
                const std::size_t end =
                    std::min(nx_ + 1, x + std::max<std::size_t>(1, std::size_t(std::max(0.0, steps))));
                for (; x < end; ++x) values[corner(x, y)] = value;
            }
        return values;
    }

    /// A vertex for each cell that the surface crosses: the mean of the points where its edges cross the
    /// surface.
    std::vector<std::uint32_t> cell_layer(const std::vector<double>& low, const std::vector<double>& high,
                                          std::size_t z)
    {
        std::vector<std::uint32_t> cells(nx_ * ny_, no_cell);
        for (std::size_t y = 0; y < ny_; ++y)
            for (std::size_t x = 0; x < nx_; ++x) {
                std::array<double, 8> value;
                for (std::size_t c = 0; c < 8; ++c)
                    value[c] = (c & 4 ? high : low)[corner(x + (c & 1), y + (c >> 1 & 1))];
                Vec3d sum;
                int crossings = 0;
                for (std::size_t c = 0; c < 8; ++c)
                    for (const std::size_t bit : {1u, 2u, 4u}) {
                        if (c & bit || (value[c] < 0) == (value[c | bit] < 0)) continue;
                        const double t = value[c] / (value[c] - value[c | bit]);
                        sum = sum + Vec3d{double(c & 1), double(c >> 1 & 1), double(c >> 2)} +
                              Vec3d{bit == 1 ? t : 0, bit == 2 ? t : 0, bit == 4 ? t : 0};
                        ++crossings;
                    }
                if (crossings == 0) continue;
                cells[cell(x, y)] = static_cast<std::uint32_t>(mesh_.vertices.size());
                const Vec3d mean = sum * (1.0 / crossings);
                mesh_.vertices.push_back(
                    to_float(place(double(x) + mean.x, double(y) + mean.y, double(z) + mean.z)));
            }
        return cells;
    }

    /// The quads of the three lattice edges from corner (x, y) of the lower layer to +x, +y, +z.
    void add_quads(const std::vector<double>& low, const std::vector<double>& high,
                   const std::vector<std::uint32_t>& below, const std::vector<std::uint32_t>& here,
                   std::size_t x, std::size_t y)
    {
        const bool inside = low[corner(x, y)] < 0;
        const std::size_t a = cell(x, y), left = cell(x - 1, y), down = cell(x, y - 1);
        const auto quad = [&](bool other_inside, std::array<std::uint32_t, 4> q) {
            if (inside == other_inside) return;
            if (!inside) std::swap(q[1], q[3]);
            mesh_.triangles.push_back({q[0], q[1], q[2]});
            mesh_.triangles.push_back({q[0], q[2], q[3]});
        };
        quad(low[corner(x + 1, y)] < 0, {below[down], below[a], here[a], here[down]});
        quad(low[corner(x, y + 1)] < 0, {below[left], here[left], here[a], below[a]});
        quad(high[corner(x, y)] < 0, {here[cell(x - 1, y - 1)], here[down], here[a], here[left]});
    }

    Field field_;
    double h_;
    std::size_t nx_ = 0, ny_ = 0, nz_ = 0;
    Vec3d origin_;
    SurfaceMesh mesh_;
};

bool is_one_ball(const SurfaceMesh& mesh)
{
    const MeshReport report = inspect_mesh(mesh);
    return report.closed && report.oriented && report.components == 1 && report.euler_characteristic == 2 &&
           report.volume > 0;
}

}  // namespace

SurfaceMesh implicit_surface_mesh(const char* name, Field field, const Bounds& bounds,
                                  std::uint32_t vertex_count)
{
    const Vec3d size = bounds.max - bounds.min;
    double spacing = std::max({size.x, size.y, size.z}) / 24;
    SurfaceMesh mesh = SurfaceNet(field, bounds, spacing).build();
    for (int round = 0; round < 12; ++round) {
        const double ratio = static_cast<double>(mesh.vertices.size()) / vertex_count;
        // On a coarse lattice the count jumps with the spacing: the tolerance grows with each round.
        const bool near = std::abs(ratio - 1) < std::min(0.05, 0.01 * (round + 1));
        // A lattice may cut a thin part so that the net is not a manifold: then another spacing is tried.
        if (near && is_one_ball(mesh)) {
            relax_triangles(mesh, field, spacing);
            return mesh;
        }
        spacing *= near ? 0.995 : std::sqrt(ratio);
        mesh = SurfaceNet(field, bounds, spacing).build();
    }
    throw Error(ErrorKind::bad_input,
                std::string(name) + " is " + std::to_string(vertex_count) +
                    ", but no closed mesh of about so many vertices was found; ask for another number, a "
                    "larger one where the shape has thin parts");
}

}  // namespace pliant

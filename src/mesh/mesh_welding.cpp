#include "mesh/mesh_welding.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <vector>

namespace pliant {
namespace {

constexpr std::uint32_t no_vertex = std::numeric_limits<std::uint32_t>::max();

/// A cell of a grid. Its coordinates are whole numbers that may exceed any integer type.
struct Cell {
    double x, y, z;
    friend bool operator==(const Cell&, const Cell&) = default;
};

struct CellHash {
    std::size_t operator()(const Cell& cell) const
    {
        std::uint64_t hash = 0;
        for (const double value : {cell.x, cell.y, cell.z}) {
            hash = (hash ^ std::bit_cast<std::uint64_t>(value + 0.0)) * 0x9E37'79B9'7F4A'7C15u;  // -0 is 0
            hash ^= hash >> 32;
        }
        return hash;
    }
};

/// The remaining vertices, found by position.
class Kept {
public:
    Kept(const std::vector<Vec3>& vertices, double tolerance)
        : vertices_(vertices),
          tolerance_(tolerance),
          size_(cell_size(vertices, tolerance)),
          next_(vertices.size(), no_vertex)
    {
        firsts_.reserve(vertices.size());
    }

    /// The first remaining vertex within the tolerance of vertex i; none if there is none.
    std::uint32_t near(std::uint32_t i) const
    {
        const Cell cell = cell_of(i);
        std::uint32_t best = no_vertex;
        const int reach = size_ > 0 ? 1 : 0;
        for (int x = -reach; x <= reach; ++x)
            for (int y = -reach; y <= reach; ++y)
                for (int z = -reach; z <= reach; ++z) {
                    const auto found = firsts_.find({cell.x + x, cell.y + y, cell.z + z});
                    if (found == firsts_.end()) continue;
                    for (std::uint32_t k = found->second; k != no_vertex; k = next_[k])
                        if (within(i, k)) best = std::min(best, k);
                }
        return best;
    }

    void keep(std::uint32_t i)
    {
        const auto [found, is_new] = firsts_.try_emplace(cell_of(i), i);
        if (is_new) return;
        next_[i] = found->second;
        found->second = i;
    }

private:
    /// At least large enough that neighbouring cells differ in double precision.
    static double cell_size(const std::vector<Vec3>& vertices, double tolerance)
    {
        if (tolerance == 0) return 0;  // each position is its own cell
        double furthest = 0;
        for (const Vec3 v : vertices)
            for (const float value : {v.x, v.y, v.z}) furthest = std::max(furthest, std::abs(double(value)));
        return std::max(tolerance, furthest * 1e-9);
    }

    Cell cell_of(std::uint32_t i) const
    {
        const Vec3d v = to_double(vertices_[i]);
        if (size_ == 0) return {v.x, v.y, v.z};
        return {std::floor(v.x / size_), std::floor(v.y / size_), std::floor(v.z / size_)};
    }

    bool within(std::uint32_t i, std::uint32_t k) const
    {
        const Vec3d way = to_double(vertices_[i]) - to_double(vertices_[k]);
        return dot(way, way) <= tolerance_ * tolerance_;
    }

    const std::vector<Vec3>& vertices_;
    double tolerance_, size_;
    std::unordered_map<Cell, std::uint32_t, CellHash> firsts_;  // the first vertex in each cell's list
    std::vector<std::uint32_t> next_;
};

/// Removes unused vertices, and renumbers the others in the triangles.
void renumber(SurfaceMesh& mesh, std::vector<std::uint32_t>& stands_for)
{
    std::vector<std::uint32_t> numbers(mesh.vertices.size(), no_vertex);
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i)
        if (stands_for[i] == i) {
            numbers[i] = count;
            mesh.vertices[count++] = mesh.vertices[i];
        }
    mesh.vertices.resize(count);
    for (Triangle& triangle : mesh.triangles)
        for (std::uint32_t& vertex : triangle) vertex = numbers[stands_for[vertex]];
}

}  // namespace

std::size_t weld_vertices(SurfaceMesh& mesh, double tolerance)
{
    const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
    std::vector<std::uint32_t> stands_for(count);
    Kept kept(mesh.vertices, tolerance);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t earlier = kept.near(i);
        stands_for[i] = earlier == no_vertex ? i : earlier;
        if (earlier == no_vertex) kept.keep(i);
    }
    renumber(mesh, stands_for);
    return count - mesh.vertices.size();
}

std::size_t drop_isolated_vertices(SurfaceMesh& mesh)
{
    const std::size_t count = mesh.vertices.size();
    std::vector<std::uint32_t> stands_for(count, no_vertex);
    for (const Triangle& triangle : mesh.triangles)
        for (const std::uint32_t vertex : triangle) stands_for[vertex] = vertex;
    renumber(mesh, stands_for);
    return count - mesh.vertices.size();
}

}  // namespace pliant

// Pieces of cloth with hems: an irregular rectangle, a tube, a T-shirt.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "mesh/generator_options.hpp"
#include "mesh/scattering.hpp"
#include "pliant/mesh_generators.hpp"

namespace pliant {
namespace {

constexpr double jitter = 0.2;  // of a square's side; triangles flip from about 0.4 on

double distance2(const SurfaceMesh& mesh, std::uint32_t a, std::uint32_t b)
{
    const Vec3d d = to_double(mesh.vertices[a]) - to_double(mesh.vertices[b]);
    return dot(d, d);
}

/// The corners of a square, counter-clockwise seen from its front; and whether it is cut from a to c or from
/// b to d.
struct Square {
    std::uint32_t a, b, c, d;
    bool along_ac;
};
std::array<Triangle, 2> halves_of(const Square& s)
{
    if (s.along_ac) return {{{s.a, s.b, s.c}, {s.a, s.c, s.d}}};
    return {{{s.a, s.b, s.d}, {s.b, s.c, s.d}}};
}

/// A T-shirt on a lattice of squares of side 1: i from the middle to the wearer's left, j from the shoulders
/// down. The front's vertices come first, then the back's, without those on seams.
class Shirt {
public:
    explicit Shirt(int n, double side) : n_(n), side_(side)
    {
        for (const bool front : {true, false}) add_panel(front);
    }
    SurfaceMesh mesh;

private:
    bool inside(int i, int j) const  // in both panels; for a square, (i, j) is its least corner
    {
        return j >= 0 && j <= 13 * n_ && std::abs(i) <= (j <= 4 * n_ ? 9 * n_ : 5 * n_);
    }
    bool has_square(int i, int j) const
    {
        return inside(i, j) && inside(i + 1, j) && inside(i, j + 1) && inside(i + 1, j + 1);
    }
    bool is_neck(int i, int j) const { return std::abs(i) + j < 2 * n_; }
    bool is_seam(int i, int j) const
    {
        const int across = std::abs(i);
        return (j == 0 && across >= 2 * n_) || (j == 4 * n_ && across >= 5 * n_) ||
               (across == 5 * n_ && j >= 4 * n_);
    }
    bool is_rim(int i, int j, bool front) const
    {
        const bool neck = front ? std::abs(i) + j == 2 * n_ : j == 0;
        return is_seam(i, j) || neck || j == 13 * n_ || std::abs(i) == 9 * n_;
    }

    /// Distance to the nearest seam, in sides.
    double from_seam(double i, double j) const
    {
        const double n = n_, across = std::abs(i);
        const auto beyond = [](double x, double least, double most) {
            return std::max({least - x, x - most, 0.0});
        };
        return std::min({std::hypot(beyond(across, 2 * n, 9 * n), j),
                         std::hypot(beyond(across, 5 * n, 9 * n), j - 4 * n),
                         std::hypot(across - 5 * n, beyond(j, 4 * n, 13 * n))});
    }

    void add_panel(bool front)
    {
        const int hem = 13 * n_, cuff = 9 * n_;
        for (int j = 0; j <= hem; ++j)
            for (int i = -cuff; i <= cuff; ++i) {
                if (!inside(i, j) || (front && is_neck(i, j)) || (!front && is_seam(i, j))) continue;
                add_vertex(i, j, front);
            }
        for (int j = 0; j < hem; ++j)
            for (int i = -cuff; i < cuff; ++i)
                if (has_square(i, j)) add_square(i, j, front);
    }

    void add_vertex(int i, int j, bool front)
    {
        const auto number = static_cast<std::uint32_t>(mesh.vertices.size());
        double x = i, y = j;
        if (!is_rim(i, j, front)) {
            const Scatter moved = scatter(number, jitter);
            x += moved.x;
            y += moved.y;
        }
        // Slope 1 at a seam, level from a distance of 2 n on: an edge is at most sqrt 2 times as long as in
        // the flat panel.
        const double reach = n_, from = std::min(from_seam(x, y), 2 * reach);
        const double depth = from - from * from / (4 * reach);
        (front ? front_ : back_)[{i, j}] = number;
        mesh.vertices.push_back(
            to_float({side_ * x, side_ * (6.5 * n_ - y), side_ * (front ? depth : -depth)}));
    }

    std::uint32_t at(int i, int j, bool front) const
    {
        const auto& own = front ? front_ : back_;
        const auto found = own.find({i, j});
        return found != own.end() ? found->second : front_.at({i, j});
    }

    void add_square(int i, int j, bool front)
    {
        const auto sum = [&](int di, int dj) { return std::abs(i + di) + j + dj; };
        const auto cut_away = [&](int di, int dj) { return front && sum(di, dj) < 2 * n_; };
        const auto corner = [&](int di, int dj) { return at(i + di, j + dj, front); };
        const std::array<std::pair<int, int>, 4> around{{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
        // The neck is cut along diagonals: of a square there, half remains, or nothing.
        std::vector<std::uint32_t> left;
        for (const auto& [di, dj] : around)
            if (!cut_away(di, dj)) left.push_back(corner(di, dj));
        if (left.size() < 3) return;
        if (!front) std::reverse(left.begin(), left.end());
        if (left.size() == 3) {
            mesh.triangles.push_back({left[0], left[1], left[2]});
            return;
        }
        const bool along_ac = distance2(mesh, left[0], left[2]) < distance2(mesh, left[1], left[3]);
        for (const Triangle& half : halves_of({left[0], left[1], left[2], left[3], along_ac}))
            mesh.triangles.push_back(half);
    }

    int n_;
    double side_;
    std::map<std::pair<int, int>, std::uint32_t> front_, back_;
};

}  // namespace

SurfaceMesh irregular_sheet_mesh(const SheetMeshOptions& options)
{
    SurfaceMesh mesh = sheet_mesh(options);
    const std::uint32_t rows = options.rows, columns = options.columns;
    const double across = options.width / (columns - 1), along = options.height / (rows - 1);
    for (std::uint32_t row = 1; row + 1 < rows; ++row)
        for (std::uint32_t column = 1; column + 1 < columns; ++column) {
            const std::uint32_t i = row * columns + column;
            const Scatter moved = scatter(i, jitter);
            const Vec3d x = to_double(mesh.vertices[i]);
            mesh.vertices[i] = to_float({x.x + across * moved.x, 0, x.z + along * moved.y});
        }
    mesh.triangles.clear();
    for (std::uint32_t row = 0; row + 1 < rows; ++row)
        for (std::uint32_t column = 0; column + 1 < columns; ++column) {
            const std::uint32_t a = row * columns + column, b = a + columns;
            const bool along_ac = distance2(mesh, a, b + 1) < distance2(mesh, b, a + 1);
            for (const Triangle& half : halves_of({a, b, b + 1, a + 1, along_ac}))
                mesh.triangles.push_back(half);
        }
    return mesh;
}

SurfaceMesh tube_mesh(const TubeOptions& options)
{
    require_length("tube.radius", options.radius);
    require_length("tube.length", options.length);
    require_count("tube.rows", options.rows, 2, 4096);
    require_count("tube.segments", options.segments, 3, 8192);
    const std::uint32_t rows = options.rows, around = options.segments;
    require_vertex_count("tube", std::uint64_t{rows} * around);
    SurfaceMesh mesh;
    mesh.vertices.reserve(std::size_t{rows} * around);
    mesh.triangles.reserve(2 * std::size_t{rows - 1} * around);
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t k = 0; k < around; ++k) {
            // Minus: from +x towards -z, counter-clockwise seen from above.
            const double angle = -2 * std::numbers::pi * (k + 0.5 * (row % 2)) / around;
            mesh.vertices.push_back(
                to_float({options.radius * std::cos(angle), options.length * (0.5 - double(row) / (rows - 1)),
                          options.radius * std::sin(angle)}));
        }
    const auto at = [&](std::uint32_t row, std::uint32_t k) { return row * around + k % around; };
    for (std::uint32_t row = 0; row + 1 < rows; ++row)
        for (std::uint32_t k = 0; k < around; ++k) {
            const bool above_is_ahead = row % 2 == 1;
            for (const Triangle& half :
                 halves_of({at(row, k), at(row + 1, k), at(row + 1, k + 1), at(row, k + 1), above_is_ahead}))
                mesh.triangles.push_back(half);
        }
    return mesh;
}

SurfaceMesh shirt_mesh(const ShirtOptions& options)
{
    require_length("shirt.width", options.width);
    require_count("shirt.squares", options.squares, 1, 200);
    return std::move(Shirt(static_cast<int>(options.squares), options.width / (10.0 * options.squares)).mesh);
}

}  // namespace pliant

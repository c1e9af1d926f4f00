// Generators of parametric shapes. Each vertex is created once: a ring closes by its index, without a second
// vertex at the same place.
#include "pliant/mesh_generators.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "mesh/generator_options.hpp"

namespace pliant {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

/// The four corners counter-clockwise seen from the front, cut from a to c.
void add_quad(SurfaceMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d)
{
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
}

/// A circle around the y axis.
struct Parallel {
    double radius, y;
};

/// A closed surface of revolution: a pole at `top`, circles downward, a pole at `bottom`.
SurfaceMesh lathe(double top, const std::vector<Parallel>& circles, double bottom, std::uint32_t segments)
{
    const auto rows = static_cast<std::uint32_t>(circles.size());
    SurfaceMesh mesh;
    mesh.vertices.reserve(2 + std::size_t{rows} * segments);
    mesh.triangles.reserve(2 * std::size_t{rows} * segments);
    mesh.vertices.push_back(to_float({0, top, 0}));
    for (const Parallel& circle : circles)
        for (std::uint32_t k = 0; k < segments; ++k) {
            // Minus: from +x towards -z, counter-clockwise seen from above.
            const double angle = -full_turn * k / segments;
            mesh.vertices.push_back(
                to_float({circle.radius * std::cos(angle), circle.y, circle.radius * std::sin(angle)}));
        }
    mesh.vertices.push_back(to_float({0, bottom, 0}));

    const auto at = [&](std::uint32_t row, std::uint32_t k) { return 1 + row * segments + k % segments; };
    const std::uint32_t south = 1 + rows * segments;
    for (std::uint32_t k = 0; k < segments; ++k) mesh.triangles.push_back({0, at(0, k), at(0, k + 1)});
    for (std::uint32_t row = 0; row + 1 < rows; ++row)
        for (std::uint32_t k = 0; k < segments; ++k)
            add_quad(mesh, at(row, k), at(row + 1, k), at(row + 1, k + 1), at(row, k + 1));
    for (std::uint32_t k = 0; k < segments; ++k)
        mesh.triangles.push_back({at(rows - 1, k + 1), at(rows - 1, k), south});
    return mesh;
}

/// The vertices on the surface of a lattice of (n + 1)^3 points, numbered in the order of their first use.
class BoxLattice {
public:
    explicit BoxLattice(std::uint32_t n) : side_(n + 1), numbers_(6 * std::size_t{side_} * side_, none) {}

    /// The number of a lattice point; calls `make` if it is new.
    template <class Make>
    std::uint32_t number(std::array<std::uint32_t, 3> point, Make make)
    {
        std::uint32_t& found = numbers_[place(point)];
        if (found == none) {
            found = count_++;
            make();
        }
        return found;
    }

private:
    static constexpr std::uint32_t none = 0xFFFF'FFFFu;

    /// A point is numbered with the first of the sides that it is on.
    std::size_t place(std::array<std::uint32_t, 3> point) const
    {
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t end = 0; end < 2; ++end)
                if (point[axis] == (end == 0 ? 0 : side_ - 1))
                    return ((2 * axis + end) * side_ + point[(axis + 1) % 3]) * side_ + point[(axis + 2) % 3];
        return 0;  // not on the surface
    }

    std::size_t side_;
    std::vector<std::uint32_t> numbers_;
    std::uint32_t count_ = 0;
};

}  // namespace

SurfaceMesh uv_sphere_mesh(const UvSphereOptions& options)
{
    require_length("uv_sphere.radius", options.radius);
    require_count("uv_sphere.rings", options.rings, 2, 4096);
    require_count("uv_sphere.segments", options.segments, 3, 8192);
    require_vertex_count("uv_sphere", 2 + (options.rings - 1ull) * options.segments);
    std::vector<Parallel> circles;
    for (std::uint32_t ring = 1; ring < options.rings; ++ring) {
        const double angle = std::numbers::pi * ring / options.rings;  // from the north pole
        circles.push_back({options.radius * std::sin(angle), options.radius * std::cos(angle)});
    }
    return lathe(options.radius, circles, -options.radius, options.segments);
}

SurfaceMesh capsule_mesh(const CapsuleOptions& options)
{
    require_length("capsule.radius", options.radius);
    require_length("capsule.length", options.length);
    require_count("capsule.cap_rings", options.cap_rings, 1, 4096);
    require_count("capsule.bands", options.bands, 1, 4096);
    require_count("capsule.segments", options.segments, 3, 8192);
    require_vertex_count("capsule", 2 + options.segments * (2ull * options.cap_rings + options.bands - 1));
    const double half = options.length / 2;
    std::vector<Parallel> circles;
    for (std::uint32_t ring = 1; ring < options.cap_rings; ++ring) {
        const double angle = std::numbers::pi / 2 * ring / options.cap_rings;
        circles.push_back({options.radius * std::sin(angle), half + options.radius * std::cos(angle)});
    }
    for (std::uint32_t band = 0; band <= options.bands; ++band)
        circles.push_back({options.radius, half - options.length * band / options.bands});
    for (std::uint32_t ring = options.cap_rings - 1; ring > 0; --ring) {
        const double angle = std::numbers::pi / 2 * ring / options.cap_rings;
        circles.push_back({options.radius * std::sin(angle), -half - options.radius * std::cos(angle)});
    }
    return lathe(half + options.radius, circles, -half - options.radius, options.segments);
}

SurfaceMesh torus_mesh(const TorusOptions& options)
{
    require_length("torus.major_radius", options.major_radius);
    require_length("torus.minor_radius", options.minor_radius);
    if (options.minor_radius >= options.major_radius)
        throw Error(ErrorKind::bad_input, "torus.minor_radius is " + number_text(options.minor_radius) +
                                              " m, but must be below torus.major_radius, which is " +
                                              number_text(options.major_radius) + " m");
    require_count("torus.major_segments", options.major_segments, 3, 8192);
    require_count("torus.minor_segments", options.minor_segments, 3, 8192);
    const std::uint32_t around = options.major_segments, tube = options.minor_segments;
    require_vertex_count("torus", std::uint64_t{around} * tube);

    SurfaceMesh mesh;
    mesh.vertices.reserve(std::size_t{around} * tube);
    mesh.triangles.reserve(2 * std::size_t{around} * tube);
    for (std::uint32_t i = 0; i < around; ++i)
        for (std::uint32_t j = 0; j < tube; ++j) {
            const double along = -full_turn * i / around, across = full_turn * j / tube;
            const double distance = options.major_radius + options.minor_radius * std::cos(across);
            mesh.vertices.push_back(
                to_float({distance * std::cos(along), options.minor_radius * std::sin(across),
                          distance * std::sin(along)}));
        }
    const auto at = [&](std::uint32_t i, std::uint32_t j) { return i % around * tube + j % tube; };
    for (std::uint32_t i = 0; i < around; ++i)
        for (std::uint32_t j = 0; j < tube; ++j)
            add_quad(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    return mesh;
}

SurfaceMesh box_mesh(const BoxOptions& options)
{
    require_length("box.size.x", options.size.x);
    require_length("box.size.y", options.size.y);
    require_length("box.size.z", options.size.z);
    require_count("box.faces", options.faces, 1, 1024);
    const std::uint32_t n = options.faces;
    const std::array<double, 3> size = {options.size.x, options.size.y, options.size.z};

    SurfaceMesh mesh;
    mesh.vertices.reserve(6 * std::size_t{n} * n + 2);
    mesh.triangles.reserve(12 * std::size_t{n} * n);
    BoxLattice lattice(n);
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const bool far : {false, true})
            for (std::uint32_t i = 0; i < n; ++i)
                for (std::uint32_t j = 0; j < n; ++j) {
                    const auto corner = [&](std::uint32_t u, std::uint32_t v) {
                        std::array<std::uint32_t, 3> point{};
                        point[axis] = far ? n : 0;
                        point[(axis + 1) % 3] = i + u;
                        point[(axis + 2) % 3] = j + v;
                        return lattice.number(point, [&] {
                            const auto along = [&](std::size_t a) {
                                return size[a] * (double(point[a]) / n - 0.5);
                            };
                            mesh.vertices.push_back(to_float({along(0), along(1), along(2)}));
                        });
                    };
                    // The axes of a side turn counter-clockwise about its outer normal at the far end,
                    // clockwise at the near end.
                    const std::uint32_t a = corner(0, 0), b = far ? corner(1, 0) : corner(0, 1),
                                        c = corner(1, 1), d = far ? corner(0, 1) : corner(1, 0);
                    if ((i + j) % 2 == 0)
                        add_quad(mesh, a, b, c, d);
                    else
                        add_quad(mesh, b, c, d, a);
                }
    return mesh;
}

SurfaceMesh sheet_mesh(const SheetMeshOptions& options)
{
    require_length("sheet.width", options.width);
    require_length("sheet.height", options.height);
    require_count("sheet.rows", options.rows, 2, 4096);
    require_count("sheet.columns", options.columns, 2, 4096);
    SurfaceMesh mesh;
    mesh.vertices.reserve(std::size_t{options.rows} * options.columns);
    mesh.triangles.reserve(2 * std::size_t{options.rows - 1} * (options.columns - 1));
    for (std::uint32_t row = 0; row < options.rows; ++row)
        for (std::uint32_t column = 0; column < options.columns; ++column)
            mesh.vertices.push_back(to_float({options.width * (double(column) / (options.columns - 1) - 0.5),
                                              0, options.height * (double(row) / (options.rows - 1) - 0.5)}));
    for (std::uint32_t row = 0; row + 1 < options.rows; ++row)
        for (std::uint32_t column = 0; column + 1 < options.columns; ++column) {
            const std::uint32_t a = row * options.columns + column, b = a + options.columns;
            add_quad(mesh, a, b, b + 1, a + 1);
        }
    return mesh;
}

}  // namespace pliant

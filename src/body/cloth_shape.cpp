#include "body/cloth_shape.hpp"

#include <algorithm>
#include <cmath>

#include "body/body_model.hpp"
#include "body/renumbering.hpp"
#include "mesh/disc.hpp"

namespace pliant {
namespace {

/// The origin of a body's coordinates: near its middle, on a grid as wide as the body, so that equal bodies
/// at points of that grid are stepped with equal bits.
Vec3d origin_of(Vec3d least, Vec3d most)
{
    const double extent = std::max({most.x - least.x, most.y - least.y, most.z - least.z, 1e-30});
    const double grid = std::exp2(std::ceil(std::log2(extent)));
    const auto snapped = [&](double a) { return std::round(a / grid) * grid; };
    const Vec3d middle = (least + most) * 0.5;
    return {snapped(middle.x), snapped(middle.y), snapped(middle.z)};
}

}  // namespace

ClothShape::ClothShape(const Cloth& cloth)
{
    if (const auto* options = std::get_if<SheetOptions>(&cloth.shape))
        build_sheet(cloth, *options);
    else if (const auto* disc = std::get_if<DiscOptions>(&cloth.shape))
        build_mesh(cloth, make_disc(disc->radius, disc->rings));
    else if (const auto& mesh = std::get<SurfaceMesh>(cloth.shape); cloth.body)
        build_body(cloth, mesh);
    else
        build_mesh(cloth, mesh);
    velocities.assign(positions.size(), to_float(cloth.velocity));
}

void ClothShape::build_sheet(const Cloth& cloth, const SheetOptions& options)
{
    const double dx = options.width / (options.columns - 1), dz = options.height / (options.rows - 1);
    sheet = SheetShape{options.rows, options.columns, {dx, dz}};
    const Rotation rotation = rotation_from_degrees(cloth.rotation);
    positions.reserve(std::size_t{options.rows} * options.columns);
    for (std::uint32_t row = 0; row < options.rows; ++row)
        for (std::uint32_t column = 0; column < options.columns; ++column) {
            const Vec3d flat = {column * dx - 0.5 * options.width, 0, row * dz - 0.5 * options.height};
            positions.push_back(to_float(cloth.position + rotate(rotation, flat)));
        }
}

void ClothShape::build_mesh(const Cloth& cloth, const SurfaceMesh& mesh)
{
    const VertexPlacement placed(cloth);
    positions.reserve(mesh.vertices.size());
    for (const Vec3& vertex : mesh.vertices) positions.push_back(to_float(placed(vertex)));
    triangles_ = mesh.triangles;
    list_node_triangles();
}

void ClothShape::build_body(const Cloth& cloth, const SurfaceMesh& mesh)
{
    const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
    require_closed(mesh, mesh.file.empty() ? cloth.name : mesh.file.string());

    const std::vector<std::uint32_t> order = node_order(mesh);
    node_of_vertex = inverse_of(order);
    for (const Triangle& t : mesh.triangles)
        triangles_.push_back({node_of_vertex[t[0]], node_of_vertex[t[1]], node_of_vertex[t[2]]});

    const VertexPlacement placed(cloth);
    std::vector<Vec3d> places;
    places.reserve(count);
    Vec3d least{1e30, 1e30, 1e30}, most{-1e30, -1e30, -1e30};
    for (const std::uint32_t vertex : order) {
        const Vec3d p = placed(mesh.vertices[vertex]);
        least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.z, p.z)};
        most = {std::max(most.x, p.x), std::max(most.y, p.y), std::max(most.z, p.z)};
        places.push_back(p);
    }
    origin = origin_of(least, most);
    for (const Vec3d p : places) positions.push_back(to_float(p - origin));
    list_node_triangles();
}

void ClothShape::list_node_triangles()
{
    node_triangles.start.assign(positions.size() + 1, 0);
    for (const Triangle& t : triangles_)
        for (const std::uint32_t node : t) ++node_triangles.start[node + 1];
    for (std::size_t i = 0; i < positions.size(); ++i) node_triangles.start[i + 1] += node_triangles.start[i];
    node_triangles.entries.resize(triangles_.size() * 3);
    std::vector<std::uint32_t> next(node_triangles.start.begin(), node_triangles.start.end() - 1);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
        for (const std::uint32_t node : triangles_[t]) node_triangles.entries[next[node]++] = t;
}

std::uint64_t ClothShape::triangle_count() const
{
    return is_sheet() ? 2ull * (sheet->rows - 1) * (sheet->columns - 1) : triangles_.size();
}

std::span<const Triangle> ClothShape::triangles() const
{
    if (is_sheet() && triangles_.empty()) {
        triangles_.reserve(triangle_count());
        for (std::uint32_t row = 0; row + 1 < sheet->rows; ++row)
            for (std::uint32_t column = 0; column + 1 < sheet->columns; ++column) {
                const std::uint32_t a = row * sheet->columns + column, b = a + 1;
                const std::uint32_t c = a + sheet->columns, d = c + 1;
                triangles_.push_back({a, c, b});
                triangles_.push_back({b, c, d});
            }
    }
    return triangles_;
}

double ClothShape::longest_side() const
{
    double side = 0;
    for (const float Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
        const auto [least, most] = std::minmax_element(positions.begin(), positions.end(),
                                                       [&](Vec3 a, Vec3 b) { return a.*axis < b.*axis; });
        if (least != positions.end()) side = std::max(side, double{*most.*axis} - double{*least.*axis});
    }
    return side;
}

void ClothShape::become_mesh()
{
    (void)triangles();
    list_node_triangles();
    sheet.reset();
}

void ClothShape::renumber(std::span<const std::uint32_t> order)
{
    node_of_vertex = inverse_of(order);
    reorder(positions, order);
    reorder(velocities, order);
    for (Triangle& triangle : triangles_)
        for (std::uint32_t& node : triangle) node = node_of_vertex[node];
    reorder_rows(node_triangles, order);
}

void ClothShape::append(const ClothShape& other, Vec3d shift)
{
    const auto node = static_cast<std::uint32_t>(positions.size());
    const auto triangle = static_cast<std::uint32_t>(triangles_.size());
    for (const Vec3& x : other.positions) positions.push_back(to_float(to_double(x) + shift));
    pliant::append(velocities, other.velocities);
    for (const Triangle& t : other.triangles_) triangles_.push_back({t[0] + node, t[1] + node, t[2] + node});
    append_rows(node_triangles, other.node_triangles, [&](std::uint32_t t) { return t + triangle; });
}

void ClothShape::forget_start()
{
    std::vector<Vec3>().swap(positions);
    std::vector<Vec3>().swap(velocities);
}

}  // namespace pliant

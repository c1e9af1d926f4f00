#include "render/cloth_pattern.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/disc.hpp"

namespace pliant {
namespace {

using Place = std::array<float, 2>;

std::vector<Place> sheet_pattern(const Cloth& cloth, std::uint32_t rows, std::uint32_t columns)
{
    double width = 1, height = 1;
    if (const auto* sheet = std::get_if<SheetOptions>(&cloth.shape))
        width = sheet->width, height = sheet->height;
    const double edge = std::min(width, height) / pattern_squares;
    // Whole squares in both directions, so that the pattern ends at the hem.
    const double across = std::max(1.0, std::round(width / edge)),
                 along = std::max(1.0, std::round(height / edge));
    std::vector<Place> places;
    places.reserve(std::size_t{rows} * columns);
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column)
            places.push_back({static_cast<float>(across * column / std::max(1u, columns - 1)),
                              static_cast<float>(along * row / std::max(1u, rows - 1))});
    return places;
}

std::vector<Place> mesh_pattern(const std::vector<Vec3>& vertices)
{
    std::array<float, 3> min{1e30f, 1e30f, 1e30f}, max{-1e30f, -1e30f, -1e30f};
    const auto coordinates = [](const Vec3& v) { return std::array<float, 3>{v.x, v.y, v.z}; };
    for (const Vec3& vertex : vertices)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            min[axis] = std::min(min[axis], coordinates(vertex)[axis]);
            max[axis] = std::max(max[axis], coordinates(vertex)[axis]);
        }
    std::array<std::size_t, 3> axes{0, 1, 2};
    const auto extent = [&](std::size_t axis) { return max[axis] - min[axis]; };
    std::stable_sort(axes.begin(), axes.end(),
                     [&](std::size_t a, std::size_t b) { return extent(a) > extent(b); });
    const float edge = extent(axes[1]) > 0 ? extent(axes[1]) / static_cast<float>(pattern_squares) : 1.0f;
    std::vector<Place> places;
    places.reserve(vertices.size());
    for (const Vec3& vertex : vertices)
        places.push_back({(coordinates(vertex)[axes[0]] - min[axes[0]]) / edge,
                          (coordinates(vertex)[axes[1]] - min[axes[1]]) / edge});
    return places;
}

}  // namespace

std::vector<std::array<float, 2>> cloth_pattern(const Cloth& cloth, std::uint32_t rows, std::uint32_t columns,
                                                std::uint32_t node_count)
{
    std::vector<Place> places;
    if (rows > 0 && columns > 0)
        places = sheet_pattern(cloth, rows, columns);
    else if (const auto* mesh = std::get_if<SurfaceMesh>(&cloth.shape))
        places = mesh_pattern(mesh->vertices);
    else if (const auto* disc = std::get_if<DiscOptions>(&cloth.shape))
        places = mesh_pattern(make_disc(disc->radius, disc->rings).vertices);
    places.resize(node_count, {0.5f, 0.5f});  // nodes that are not in the scene get no pattern
    return places;
}

}  // namespace pliant

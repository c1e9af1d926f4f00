#include "render/touched_area.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pliant {
namespace {

/// Projects along the sun's rays onto a floor.
Matrix4 shadow_on_floor(Vec3d to_light, double height)
{
    const double x = to_light.x / to_light.y, z = to_light.z / to_light.y;
    return {{1, 0, 0, 0}, {-x, 0, -z, 0}, {0, 0, 1, 0}, {x * height, height, z * height, 1}};
}

}  // namespace

PixelArea united(const PixelArea& a, const PixelArea& b)
{
    if (a.empty()) return b;
    if (b.empty()) return a;
    return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right),
            std::max(a.bottom, b.bottom)};
}

TouchedArea::TouchedArea(const Stage& stage, const Camera& camera, std::uint32_t width, std::uint32_t height,
                         double shadow_texel, std::span<const PlacedCollider> colliders,
                         const ShapeMeshes& meshes)
    : width_(width), height_(height), inset_(stage.inset), nearest_(0.05 * stage.view_distance)
{
    const double half_angle = camera.field_of_view * std::numbers::pi / 360;
    // Surfaces are offset by 2.5 texels, the filter extends by 2.6, and floors are lit at an angle.
    constexpr double spread = 8;  // texels
    blur_ = spread * shadow_texel / stage.to_light.y * height_ / (2 * std::tan(half_angle));
    const Matrix4 view = clip_from_world(camera, width_ / height_);
    views_.push_back(view);
    for (const PlacedCollider& collider : colliders)
        if (is_ground(collider)) {
            views_.push_back(view * shadow_on_floor(stage.to_light, collider.centre.y));
            unknown_ |= collider.moves;
        }
    if (!stage.has_plane) views_.push_back(view * shadow_on_floor(stage.to_light, stage.floor_height));
    for (const PlacedCollider& collider : colliders)
        if (!is_ground(collider)) include(collider, meshes);
}

void TouchedArea::include(const PlacedCollider& collider, const ShapeMeshes& meshes)
{
    const ShapePlacement placement = placement_of(collider, inset_);
    const ShapeMeshes::Range range = mesh_of(collider, meshes);
    const std::span indices(meshes.indices.data() + range.first_index, range.index_count);
    const auto [first, last] = std::ranges::minmax(indices);
    for (std::uint32_t i = first; i <= last; ++i) include(placed_corner(placement, meshes.vertices[i]));
}

void TouchedArea::include(std::span<const Vec3> points)
{
    for (const Vec3& point : points) include(to_double(point));
}

void TouchedArea::include(Vec3d point)
{
    for (const Matrix4& view : views_) {
        const auto at = view * to_point(point);
        if (!(at[3] > nearest_)) {  // also for NaN
            unknown_ = true;
            return;
        }
        const double x = (at[0] / at[3] + 1) / 2 * width_, y = (at[1] / at[3] + 1) / 2 * height_,
                     reach = 2 + blur_ / at[3];
        unknown_ |= !(std::abs(x) < 1e9 && std::abs(y) < 1e9);
        left_ = std::min(left_, x - reach), right_ = std::max(right_, x + reach);
        top_ = std::min(top_, y - reach), bottom_ = std::max(bottom_, y + reach);
    }
}

std::optional<PixelArea> TouchedArea::area() const
{
    if (unknown_) return std::nullopt;
    // Whole blocks of pixels, the granularity of rasterisers.
    constexpr double block = 16;
    const auto inside = [](double at, double most) {
        return static_cast<std::uint32_t>(std::clamp(at, 0.0, most));
    };
    return PixelArea{inside(block * std::floor(left_ / block), width_),
                     inside(block * std::floor(top_ / block), height_),
                     inside(block * std::ceil(right_ / block), width_),
                     inside(block * std::ceil(bottom_ / block), height_)};
}

}  // namespace pliant

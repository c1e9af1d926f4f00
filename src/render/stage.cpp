#include "render/stage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pliant {
namespace {

constexpr double radians_per_degree = std::numbers::pi / 180;
constexpr double sun_height = 52, sun_side = 48;  // degrees above the floor, and to the left of the camera
constexpr double cloth_reach = 1.6;               // how far a cloth moves from its start, in its own radii

/// The bounding ball of a cloth at rest.
Ball ball_around(const Cloth& cloth)
{
    Bounds local;
    if (const auto* sheet = std::get_if<SheetOptions>(&cloth.shape)) {
        local.include({-sheet->width / 2, 0, -sheet->height / 2});
        local.include({sheet->width / 2, 0, sheet->height / 2});
    } else if (const auto* disc = std::get_if<DiscOptions>(&cloth.shape)) {
        local.include({-disc->radius, 0, -disc->radius});
        local.include({disc->radius, 0, disc->radius});
    } else {
        for (const Vec3& vertex : std::get<SurfaceMesh>(cloth.shape).vertices)
            local.include(to_double(vertex) * cloth.scale);
    }
    if (local.empty()) return {cloth.position, 0};
    const Vec3d middle = (local.min + local.max) * 0.5;
    return {cloth.position + rotate(rotation_from_degrees(cloth.rotation), middle),
            length(local.max - middle)};
}

/// The diagonal of a typical cell, m.
double cell_diagonal(const Cloth& cloth, const Ball& ball)
{
    if (const auto* sheet = std::get_if<SheetOptions>(&cloth.shape))
        return std::hypot(sheet->width / std::max(1u, sheet->columns - 1),
                          sheet->height / std::max(1u, sheet->rows - 1));
    if (const auto* disc = std::get_if<DiscOptions>(&cloth.shape))
        return std::sqrt(2.0) * disc->radius / std::max(1u, disc->rings);
    const auto vertices = std::get<SurfaceMesh>(cloth.shape).vertices.size();
    return vertices > 0 ? 4 * ball.radius / std::sqrt(static_cast<double>(vertices)) : 0;
}

void include_collider(Bounds& bounds, const PlacedCollider& placed)
{
    if (placed.is<Plane>()) return;  // without bounds
    for (const Ball& ball : balls_around(placed)) bounds.include(ball.centre, ball.radius);
}

/// Includes a collider at its keyframes and half-way between.
void include_journey(Bounds& bounds, const Collider& collider)
{
    const auto& keyframes = std::visit(
        [](const auto& shape) -> const auto& { return shape.keyframes; }, collider);
    include_collider(bounds, placed_at(collider, 0));
    for (std::size_t i = 0; i < keyframes.size(); ++i) {
        include_collider(bounds, placed_at(collider, keyframes[i].time));
        if (i > 0)
            include_collider(bounds, placed_at(collider, 0.5 * (keyframes[i - 1].time + keyframes[i].time)));
    }
}

/// From above and the left of the camera, so that shapes have a light and a dark side.
Vec3d light_direction(const Camera& camera)
{
    const Vec3d back = camera.position - camera.target;
    const double azimuth = std::atan2(back.x, back.z) - sun_side * radians_per_degree;
    const double height = sun_height * radians_per_degree;
    return {std::cos(height) * std::sin(azimuth), std::sin(height), std::cos(height) * std::cos(azimuth)};
}

void aim_light(Stage& stage, const Bounds& room)
{
    const Matrix4 light_from_world = look_along({}, stage.to_light * -1);
    Bounds box;
    for (int corner = 0; corner < 8; ++corner) {
        const auto at = light_from_world *
                        to_point({corner & 1 ? room.min.x : room.max.x, corner & 2 ? room.min.y : room.max.y,
                                  corner & 4 ? room.min.z : room.max.z});
        box.include({at[0], at[1], at[2]});
    }
    const Vec3d middle = (box.min + box.max) * 0.5, half = (box.max - box.min) * 0.5;
    const double edge =
        1.02 * std::max({half.x, half.y, 1e-3});  // square texels: equal blur in both directions
    // Depth extends beyond the room, for cloth that flies higher than expected.
    const double depth = half.z + edge;
    stage.shadow_extent = 2 * edge;
    stage.shadow_from_world =
        unit_box(middle - Vec3d{edge, edge, depth}, middle + Vec3d{edge, edge, depth}) * light_from_world;
}

}  // namespace

void Bounds::include(Vec3d point, double radius)
{
    min = {std::min(min.x, point.x - radius), std::min(min.y, point.y - radius),
           std::min(min.z, point.z - radius)};
    max = {std::max(max.x, point.x + radius), std::max(max.y, point.y + radius),
           std::max(max.z, point.z + radius)};
}

void Bounds::clip(const Bounds& other)
{
    min = {std::max(min.x, other.min.x), std::max(min.y, other.min.y), std::max(min.z, other.min.z)};
    max = {std::min(max.x, other.max.x), std::min(max.y, other.max.y), std::min(max.z, other.max.z)};
}

Stage make_stage(const Scene& scene)
{
    Stage stage;
    stage.centre = scene.camera.target;
    stage.view_distance = std::max(length(scene.camera.position - scene.camera.target), 1e-2);
    stage.to_light = light_direction(scene.camera);

    Bounds things, room;  // bounds of the objects at the start, and of their expected motion
    double cell = 0, ground = -1e30;
    for (std::size_t i = 0; i < scene.cloth_count(); ++i) {
        const Ball ball = ball_around(scene.cloth(i));
        things.include(ball.centre, ball.radius);
        room.include(ball.centre, cloth_reach * ball.radius);
        cell = std::max(cell, cell_diagonal(scene.cloth(i), ball));
    }
    for (const Collider& collider : scene.colliders) {
        include_journey(things, collider);
        const PlacedCollider placed = placed_at(collider, 0);
        if (!placed.is<Plane>()) continue;
        stage.has_plane = true;
        if (is_ground(placed)) ground = std::max(ground, placed.centre.y);
    }
    if (things.empty()) things.include(stage.centre, 0.5);
    stage.floor_height = std::min(things.min.y, room.empty() ? things.min.y : room.min.y) - 0.02;
    room.include(things.min);
    room.include(things.max);
    const double floor = ground > -1e30 ? ground : stage.floor_height;
    if (ground > -1e30 || !stage.has_plane) {  // from the floor up
        room.include({stage.centre.x, floor, stage.centre.z});
        room.min.y = floor;
    }

    // Objects far outside the picture would only reduce the resolution of shadows.
    Bounds seen;
    seen.include(stage.centre, 2 * stage.view_distance);
    room.clip(seen);
    if (room.min.x >= room.max.x || room.min.y > room.max.y || room.min.z >= room.max.z) room = seen;
    aim_light(stage, room);

    // The middle of a chord of length c is c^2 / (8 r) below the arc; placement_of limits this for small
    // radii.
    double least_radius = 1e30;
    for (const Collider& collider : scene.colliders)
        if (const double radius = placed_at(collider, 0).radius; radius > 0)
            least_radius = std::min(least_radius, radius);
    stage.inset = cell * cell / (8 * least_radius);
    return stage;
}

GroundPlacement ground_at(const Stage& stage, double height, bool collider)
{
    const Vec3 centre = to_float(Vec3d{stage.centre.x, height, stage.centre.z});
    // 0.1 m for a scene of metres, scaled by powers of ten for others.
    const double spacing = std::pow(10.0, std::floor(std::log10(stage.view_distance)) - 1);
    return {{centre.x, centre.y, centre.z, static_cast<float>(10 * stage.view_distance)},
            static_cast<float>(spacing),
            collider ? 1.0f : 0.55f};
}

Matrix4 clip_from_world(const Camera& camera, double width_by_height)
{
    const Vec3d direction = camera.target - camera.position;
    const double distance = std::max(length(direction), 1e-2);
    return perspective(camera.field_of_view * radians_per_degree, width_by_height, 0.01 * distance,
                       60 * distance) *
           look_along(camera.position, direction);
}

FrameUniforms frame_uniforms(const Stage& stage, const Camera& camera, std::uint32_t width,
                             std::uint32_t height, std::uint32_t shadow_map_size)
{
    FrameUniforms frame{};
    const double w = width, h = height;
    frame.clip_from_world = to_float(clip_from_world(camera, w / h));
    frame.shadow_from_world = to_float(stage.shadow_from_world);
    const Vec3 eye = to_float(camera.position), to_light = to_float(stage.to_light);
    frame.eye = {eye.x, eye.y, eye.z, 1};
    frame.to_light = {to_light.x, to_light.y, to_light.z, 0};
    frame.picture = {static_cast<float>(w), static_cast<float>(h), static_cast<float>(1 / w),
                     static_cast<float>(1 / h)};
    frame.shadow_texel = static_cast<float>(stage.shadow_extent / shadow_map_size);
    frame.value_high = 1;
    frame.blend = 1;
    return frame;
}

}  // namespace pliant

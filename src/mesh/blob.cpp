// The figure of blob_mesh: tapered limbs joined by a smooth minimum (Quilez, "smooth minimum", the quadratic
// polynomial). Only +, -, *, / and sqrt, so that it is the same on every machine.
#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/generator_options.hpp"
#include "mesh/implicit_surface.hpp"
#include "pliant/mesh_generators.hpp"

namespace pliant {
namespace {

/// A ball swept from one point to another while its radius changes.
struct Limb {
    Vec3d from;
    double from_radius;
    Vec3d to;
    double to_radius;
    double blend;  ///< m, distance of smooth blending with the limbs before
};

// The figure is about 1 m tall, with its feet at y = 0.
constexpr std::array limbs = {
    Limb{{0, 0.27, 0}, 0.190, {0, 0.50, 0}, 0.150, 0},                    // body
    Limb{{0, 0.76, 0.01}, 0.165, {0, 0.79, 0.01}, 0.160, 0.10},           // head
    Limb{{0, 0.73, 0.14}, 0.070, {0, 0.73, 0.17}, 0.060, 0.06},           // snout
    Limb{{-0.12, 0.91, 0}, 0.055, {-0.14, 0.94, 0}, 0.055, 0.05},         // ears
    Limb{{0.12, 0.91, 0}, 0.055, {0.14, 0.94, 0}, 0.055, 0.05},           //
    Limb{{-0.15, 0.53, 0}, 0.075, {-0.37, 0.40, 0.07}, 0.068, 0.07},      // arms
    Limb{{0.15, 0.53, 0}, 0.075, {0.37, 0.40, 0.07}, 0.068, 0.07},        //
    Limb{{-0.11, 0.19, 0.01}, 0.105, {-0.17, 0.085, 0.10}, 0.085, 0.07},  // legs
    Limb{{0.11, 0.19, 0.01}, 0.105, {0.17, 0.085, 0.10}, 0.085, 0.07},    //
};
constexpr Bounds figure_bounds = {{-0.46, -0.02, -0.22}, {0.46, 1.02, 0.26}};

FieldSample limb_distance(const Limb& limb, Vec3d point)
{
    const Vec3d axis = limb.to - limb.from, way = point - limb.from;
    const double squared = dot(axis, axis), t = std::clamp(dot(way, axis) / squared, 0.0, 1.0);
    const Vec3d away = way - axis * t;
    const double distance = std::sqrt(dot(away, away)), growth = limb.to_radius - limb.from_radius;
    Vec3d gradient = distance > 0 ? away * (1 / distance) : Vec3d{0, 1, 0};
    if (t > 0 && t < 1) gradient = gradient - axis * (growth / squared);
    return {distance - (limb.from_radius + growth * t), gradient};
}

FieldSample smooth_minimum(const FieldSample& a, const FieldSample& b, double blend)
{
    const bool a_less = a.value < b.value;
    const FieldSample &less = a_less ? a : b, &more = a_less ? b : a;
    const double overlap = std::max(0.0, 1 - (more.value - less.value) / blend);
    const double share = overlap / 2;
    return {less.value - overlap * overlap * blend / 4, less.gradient * (1 - share) + more.gradient * share};
}

FieldSample figure(Vec3d point)
{
    FieldSample sample = limb_distance(limbs[0], point);
    for (std::size_t i = 1; i < limbs.size(); ++i)
        sample = smooth_minimum(sample, limb_distance(limbs[i], point), limbs[i].blend);
    return sample;
}

}  // namespace

SurfaceMesh blob_mesh(const BlobOptions& options)
{
    require_length("blob.height", options.height);
    require_count("blob.vertices", options.vertices, 1000, 500'000);
    SurfaceMesh mesh = implicit_surface_mesh("blob.vertices", figure, figure_bounds, options.vertices);

    const MeshReport report = inspect_mesh(mesh);
    const Vec3d middle = (report.bounds_min + report.bounds_max) * 0.5;
    const double scale = options.height / (report.bounds_max.y - report.bounds_min.y);
    for (Vec3& vertex : mesh.vertices) vertex = to_float((to_double(vertex) - middle) * scale);
    return mesh;
}

}  // namespace pliant

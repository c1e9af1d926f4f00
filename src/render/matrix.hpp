// Views and projections for rendering: GLM's matrices in Vulkan's conventions, in double until they are
// uploaded.
#pragma once

#include <array>
#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/mat4x4.hpp>

#include "pliant/vec3.hpp"

namespace pliant {

using Matrix4 = glm::dmat4;

inline glm::dvec3 to_glm(Vec3d a) { return {a.x, a.y, a.z}; }
/// In homogeneous coordinates.
inline glm::dvec4 to_point(Vec3d a) { return {a.x, a.y, a.z, 1}; }

/// Column by column, as GLSL has it.
inline std::array<float, 16> to_float(const Matrix4& matrix)
{
    std::array<float, 16> result{};
    for (int i = 0; i < 16; ++i)
        result[static_cast<std::size_t>(i)] = static_cast<float>(matrix[i / 4][i % 4]);
    return result;
}

inline double length(Vec3d a) { return std::sqrt(dot(a, a)); }

inline Vec3d normalized(Vec3d a, Vec3d otherwise)
{
    const double size = length(a);
    return size > 0 ? a * (1 / size) : otherwise;
}

/// View matrix of a frame at `eye` that looks along its own -z, with the world's y upwards if possible.
inline Matrix4 look_along(Vec3d eye, Vec3d direction)
{
    const Vec3d ahead = normalized(direction, {0, 0, -1});
    const Vec3d up = std::abs(ahead.y) < 0.9999 ? Vec3d{0, 1, 0} : Vec3d{0, 0, -1};
    return glm::lookAtRH(to_glm(eye), to_glm(eye + ahead), to_glm(up));
}

/// Vulkan's clip space: y downwards, depth from 0 (near) to 1 (far).
inline Matrix4 perspective(double vertical_angle, double width_by_height, double near, double far)
{
    Matrix4 matrix = glm::perspectiveRH_ZO(vertical_angle, width_by_height, near, far);
    matrix[1][1] *= -1;
    return matrix;
}

/// Orthographic projection of the box [min, max] of a frame that looks along -z onto [0, 1]^3; depth grows
/// along -z.
inline Matrix4 unit_box(Vec3d min, Vec3d max)
{
    const Vec3d size = max - min;
    return glm::scale(Matrix4(1), {1 / size.x, 1 / size.y, -1 / size.z}) *
           glm::translate(Matrix4(1), {-min.x, -min.y, -max.z});
}

}  // namespace pliant

// 4 x 4 matrices for rendering. Column-major, as in GLSL; in double until they are uploaded.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "pliant/vec3.hpp"

namespace pliant {

struct Matrix4 {
    std::array<std::array<double, 4>, 4> column{};

    std::array<double, 4> operator*(const std::array<double, 4>& v) const
    {
        std::array<double, 4> result{};
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t r = 0; r < 4; ++r) result[r] += column[c][r] * v[c];
        return result;
    }
    Matrix4 operator*(const Matrix4& inner) const
    {
        Matrix4 result;
        for (std::size_t c = 0; c < 4; ++c) result.column[c] = *this * inner.column[c];
        return result;
    }
};

inline std::array<float, 16> to_float(const Matrix4& matrix)
{
    std::array<float, 16> result{};
    for (std::size_t i = 0; i < 16; ++i) result[i] = static_cast<float>(matrix.column[i / 4][i % 4]);
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
    const Vec3d back = normalized(direction, {0, 0, -1}) * -1;
    const Vec3d up = std::abs(back.y) < 0.9999 ? Vec3d{0, 1, 0} : Vec3d{0, 0, -1};
    const Vec3d x = normalized(cross(up, back), {1, 0, 0}), y = cross(back, x);
    return {{{{x.x, y.x, back.x, 0},
              {x.y, y.y, back.y, 0},
              {x.z, y.z, back.z, 0},
              {-dot(x, eye), -dot(y, eye), -dot(back, eye), 1}}}};
}

/// Vulkan's clip space: y downwards, depth from 0 (near) to 1 (far).
inline Matrix4 perspective(double vertical_angle, double width_by_height, double near, double far)
{
    const double scale = 1 / std::tan(vertical_angle / 2), depth = 1 / (near - far);
    return {{{{scale / width_by_height, 0, 0, 0},
              {0, -scale, 0, 0},
              {0, 0, far * depth, -1},
              {0, 0, near * far * depth, 0}}}};
}

/// Orthographic projection of the box [min, max] of a frame that looks along -z onto [0, 1]^3; depth grows
/// along -z.
inline Matrix4 unit_box(Vec3d min, Vec3d max)
{
    const Vec3d scale{1 / (max.x - min.x), 1 / (max.y - min.y), -1 / (max.z - min.z)};
    return {{{{scale.x, 0, 0, 0},
              {0, scale.y, 0, 0},
              {0, 0, scale.z, 0},
              {-min.x * scale.x, -min.y * scale.y, -max.z * scale.z, 1}}}};
}

}  // namespace pliant

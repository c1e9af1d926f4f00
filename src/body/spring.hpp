// A spring between two nodes, and its class.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pliant {

enum class SpringClass : std::uint32_t {
    structural = 0,
    shear = 1,  ///< of a soft body: internal springs
    bend = 2
};
constexpr std::size_t spring_class_count = 3;

/// A spring between nodes i < j.
struct Spring {
    std::uint32_t i = 0, j = 0;
    SpringClass spring_class = SpringClass::structural;
    double rest_length = 0;  ///< m
    double scale = 1;        ///< multiplies stiffness and damping of its class
    /// N/m, may be negative: weight in the quadratic bending energy, bending / 2 (x_j - x_i)^2, see
    /// bending.hpp
    double bending = 0;
};

/// The order of lists of springs, and of other pairs of nodes i < j.
inline constexpr auto by_ends = [](const auto& a, const auto& b) {
    return a.i != b.i ? a.i < b.i : a.j < b.j;
};

/// The other end of a spring, seen from a node.
struct Neighbour {
    std::uint32_t node = 0;
    /// Index into SpringSet::list; the sign of its force follows from node order.
    std::uint32_t spring = 0;
};

}  // namespace pliant

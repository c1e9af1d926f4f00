// Numbers of springs that are not those of their class: the quadratic bending energy, and the border of a
// sheet.
//
// Bending. E = B/2 times the integral of (k1 + k2)^2, k1 and k2 being the principal curvatures. For a shape
// that is not stretched the vector of mean curvature is the Laplacian of the position, so that E is quadratic
// in the positions, with weights that depend on the shape at rest alone:
//
//   Bergou, Wardetzky, Harmon, Zorin, Grinspun, "A Quadratic Bending Model for Inextensible Surfaces",
//   Symposium on Geometry Processing 2006.
//
// Its gaussian curvature stays 0, so that k1^2 + k2^2 = |S|^2 is the same density, S being the second
// derivatives of the position: that is the one taken here, since it has no shapes without energy. A quadratic
// form w/2 |sum_a c_a x_a|^2 with sum_a c_a = 0 is the sum over its pairs of -w c_a c_b / 2 |x_a - x_b|^2:
// springs of rest length 0 whose stiffness may be negative. So bending is one number more for each spring,
// and all solvers know it as a coupling.
#pragma once

#include <span>
#include <vector>

#include "body/sheet_shape.hpp"
#include "body/spring.hpp"
#include "pliant/mesh.hpp"

namespace pliant {

/// Of a triangle mesh: the curvature S of each triangle from how its three sides are bent (Grinspun, Gingold,
/// Reisman, Zorin, "Computing discrete shape operators on general meshes", 2006), a side's bend being the
/// form of Bergou et al. That form by itself, squared side by side with their weight 3 / (A_0 + A_1), is not
/// the energy of a cylinder but 3 times it on equilateral triangles, and between 2.25 and 9 times it, by
/// direction, on right ones. B in N m; `springs` in the order of (i, j), which is kept. Pairs that are no
/// springs yet become springs of class bend and scale 0.
void add_bending(std::vector<Spring>& springs, std::span<const Triangle> triangles,
                 const std::vector<Vec3>& positions, double bending_stiffness);

/// Of a sheet: B/2 (|x_uu|^2 + |x_vv|^2 + 2 |x_uv|^2), which for a shape that is not stretched is the same
/// density, by three nodes in a row, three in a column, and the four of a cell; each by the area that belongs
/// to it. Exact to second order of the distance of nodes, up to the border.
void add_bending(std::vector<Spring>& springs, const SheetShape& sheet, double bending_stiffness);

/// Springs along the border of a sheet have cloth on one side alone.
void halve_border(std::vector<Spring>& springs, const SheetShape& sheet);

/// The mass of a sheet by the area around each node: half of an inner one's at the border, a quarter at a
/// corner.
void share_by_area(std::vector<double>& masses, double total, const SheetShape& sheet);

}  // namespace pliant

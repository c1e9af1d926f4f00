// Parameters of single springs: the quadratic bending energy, and the border of a sheet.
//
// Bending. E = B/2 times the integral of (k1 + k2)^2, k1 and k2 being the principal curvatures. Without
// stretch the mean curvature vector is the Laplacian of the position, so E is quadratic in the positions,
// with weights that depend only on the rest shape:
//
//   Bergou, Wardetzky, Harmon, Zorin, Grinspun, "A Quadratic Bending Model for Inextensible Surfaces",
//   Symposium on Geometry Processing 2006.
//
// The Gaussian curvature stays 0, so |S|^2 = k1^2 + k2^2 is the same density, S being the second derivatives
// of the position. |S|^2 is used here because every curved shape has energy under it. A quadratic form w/2
// |sum_a c_a x_a|^2 with sum_a c_a = 0 is the sum over its pairs of -w c_a c_b / 2 |x_a - x_b|^2: springs of
// rest length 0 whose stiffness may be negative. Bending thus adds one number to each spring, and all solvers
// treat it as a coupling.
#pragma once

#include <span>
#include <vector>

#include "body/sheet_shape.hpp"
#include "body/spring.hpp"
#include "pliant/mesh.hpp"

namespace pliant {

/// For a triangle mesh: the curvature S of each triangle from the bends of its three sides (Grinspun,
/// Gingold, Reisman, Zorin, "Computing discrete shape operators on general meshes", 2006). The bend of a side
/// is the form of Bergou et al. Squared for each side with their weight 3 / (A_0 + A_1), that form would
/// overestimate the energy of a cylinder: 3 times on equilateral triangles, between 2.25 and 9 times, by
/// direction, on right ones. B in N m. `springs` is sorted by (i, j) and stays so. Pairs that are not yet
/// springs become springs of class bend and scale 0.
void add_bending(std::vector<Spring>& springs, std::span<const Triangle> triangles,
                 const std::vector<Vec3>& positions, double bending_stiffness);

/// For a sheet: B/2 (|x_uu|^2 + |x_vv|^2 + 2 |x_uv|^2), which is the same density if the shape is not
/// stretched. Second derivatives come from three nodes in a row, three in a column, and the four of a cell,
/// each weighted by its area. Second-order accurate in the distance of nodes, up to the border.
void add_bending(std::vector<Spring>& springs, const SheetShape& sheet, double bending_stiffness);

/// Halves the springs along the border of a sheet, which have cloth on one side only.
void halve_border(std::vector<Spring>& springs, const SheetShape& sheet);

/// Distributes the mass of a sheet by the area around each node: half at the border, a quarter at a corner.
void share_by_area(std::vector<double>& masses, double total, const SheetShape& sheet);

}  // namespace pliant

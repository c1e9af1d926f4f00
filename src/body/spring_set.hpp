// The springs of a cloth: those of a sheet follow from its grid, all others are listed.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "body/cloth_shape.hpp"
#include "body/stepping_plan.hpp"

namespace pliant {

struct SpringSet {
    SpringSet() = default;
    /// Of a cloth that is no soft body. A sheet with graded springs becomes a mesh.
    SpringSet(const Cloth& cloth, const SteppingPlan& plan, ClothShape& shape);
    /// Of a list that is sorted by (i, j), and of rows of neighbours.
    SpringSet(std::vector<Spring> springs, Ragged<Neighbour> rows);

    std::vector<Spring> list;  ///< sorted by (i, j); empty where a sheet goes by its grid
    /// By node, sorted by the other node in the mesh's numbering; for a body see BodyModel::links.
    Ragged<Neighbour> neighbours;
    std::uint64_t count = 0;
    std::uint64_t measured_count = 0;  ///< structural and shear springs: those whose stretch is measured
    double shortest = 0;               ///< m, at rest; infinite without springs
    double across = 1;                 ///< number of structural springs in a row from one end to the other
    double length_across = 1;          ///< m: of the cloth at rest
    /// An upper bound of the eigenvalues of D^-1 A, with the diagonal blocks D of the solver's operator A: a
    /// term that couples n nodes contributes at most n, and a spring couples two.
    double spectrum_end = 2.5;

    void renumber(std::span<const std::uint32_t> order, std::span<const std::uint32_t> node_of_vertex);
    /// Appends the springs of another body, whose first node becomes `first_node`; returns how many
    /// neighbours there were.
    std::uint32_t append(const SpringSet& other, std::uint32_t first_node);

private:
    using RestScales = std::array<double, spring_class_count>;  ///< by class
    void set_rest_lengths(SheetShape& sheet, const RestScales& scales) const;
    void list_sheet(const SheetShape& sheet);
    void list_mesh(const ClothShape& shape, const RestScales& scales);
    void grade(const Cloth& cloth, ClothShape& shape);
    void list_neighbours(std::size_t node_count);
    void count_list();
    void measure(const ClothShape& shape, double structural_scale);
};

}  // namespace pliant

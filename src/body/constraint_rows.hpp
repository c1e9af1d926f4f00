// Sparsity patterns of the paper's solver, computed once from a cloth's topology and pins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pliant {

class ClothModel;

/// The springs that act on a free node, renumbered: those that may be constraints first, in the order of
/// ClothModel::springs. The patterns are J transposed by columns (the springs of a node) and J M^-1 J^T by
/// rows (the constraints that share a free node with one), in a fixed order. They are stored in
/// Hierarchy::topology after a header, the numbers in its arena: see kernels/planes.kernel.glsl.
class ConstraintRows {
public:
    ConstraintRows() = default;
    /// `number_base`: the first free number of the arena.
    ConstraintRows(const ClothModel& cloth, std::size_t number_base);

    /// Count of numbers in the arena.
    std::size_t number_count() const { return number_count_; }
    /// Blocks at a level of the prefix sum over the marks; one invocation each.
    std::size_t scan_blocks(std::size_t level) const;
    std::size_t scan_levels() const { return scan_counts_.size(); }

    std::uint32_t springs = 0;      ///< number of springs
    std::uint32_t constraints = 0;  ///< the first so many of them may be constraints
    std::vector<std::int32_t> topology;
    std::size_t first_number = 0;  ///< offset of `numbers` in the arena
    std::vector<double> numbers;   ///< constants and rest lengths

private:
    void number_springs(const ClothModel& cloth);
    void list_nodes(const ClothModel& cloth);
    void list_matrix(const ClothModel& cloth);
    void place_numbers(const ClothModel& cloth);
    std::int32_t begin(int entry);

    std::vector<std::uint32_t> spring_of_;  ///< index in ClothModel::springs, by new number
    std::vector<std::size_t> scan_counts_;
    std::size_t number_count_ = 0, matrix_size_ = 0;
};

}  // namespace pliant

// The springs of a cloth as the paper's solver works on them: its patterns, made once, from the cloth's
// topology and pins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pliant {

class ClothModel;

/// Springs without those that nothing feels, numbered anew: what may be constraints first, in the order of
/// ClothModel::springs. The patterns are J transposed by columns (the springs of a node) and J M^-1 J^T by
/// rows (the constraints that share a free node with one), in a fixed order. They go into Hierarchy::topology
/// behind a header, the numbers into its arena: kernels/planes.kernel.glsl says how.
class ConstraintRows {
public:
    ConstraintRows() = default;
    /// `number_base`: the first number of the arena that is free.
    ConstraintRows(const ClothModel& cloth, std::size_t number_base);

    /// Numbers of the arena that it takes.
    std::size_t number_count() const { return number_count_; }
    /// Blocks at a level of the prefix sum over the marks, one invocation each.
    std::size_t scan_blocks(std::size_t level) const;
    std::size_t scan_levels() const { return scan_counts_.size(); }

    std::uint32_t springs = 0;      ///< all of them
    std::uint32_t constraints = 0;  ///< the first of them, which may be constraints
    std::vector<std::int32_t> topology;
    std::size_t first_number = 0;  ///< where `numbers` belong
    std::vector<double> numbers;   ///< those that stay: constants, and lengths at rest

private:
    void number_springs(const ClothModel& cloth);
    void list_nodes(const ClothModel& cloth);
    void list_matrix(const ClothModel& cloth);
    void place_numbers(const ClothModel& cloth);
    std::int32_t begin(int entry);

    std::vector<std::uint32_t> spring_of_;  ///< of ClothModel::springs, by new number
    std::vector<std::size_t> scan_counts_;
    std::size_t number_count_ = 0, matrix_size_ = 0;
};

}  // namespace pliant

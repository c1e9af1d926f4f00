// One cloth's constraint solver on the host: its numbers and its passes.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "backend/host/plain_cloth.hpp"
#include "backend/host/solver_context.hpp"
#include "body/hierarchy.hpp"

namespace pliant {

template <class T>
class SolverState {
public:
    /// `hierarchy` must outlive it; if it is empty, there is no solver.
    SolverState(const ClothModel& model, const Hierarchy& hierarchy);

    /// Whether a call's guard skips it.
    bool skips(const Call& call) const
    {
        return call.guard != Guard::none && scalars_[static_cast<std::size_t>(call.guard)] != T(0);
    }
    /// Rows of a sheet, or groups of sum_columns, in a call.
    std::size_t size_of(const Call& call) const;
    /// Nodes in one of them, from which the number of threads follows.
    std::size_t weight_of(const Call& call) const;
    /// The data of a call's kernels; valid until the next call of this function.
    const SolverContext<T>& context(const Call& call, PlainCloth<T>& cloth,
                                    const SolverConstants<T>& constants,
                                    std::span<const typename Laws<T>::Collider> colliders);
    /// Runs a pass of one invocation, or a part of any other pass with the scalar kernels.
    void run(const Call& call, const SolverContext<T>& context, std::size_t begin, std::size_t end) const;

    /// Overwrites numbers of the arena.
    template <class Number>
    void put(std::size_t first, std::span<const Number> values)
    {
        std::transform(values.begin(), values.end(), arena_.data() + first,
                       [](Number a) { return static_cast<T>(a); });
    }
    void put_scalars(std::span<const T> values) { scalars_.assign(values.begin(), values.end()); }
    /// Sets the tables of a mesh for packs; see SolverContext.
    void set_lanes(const MeshLanes* lanes) { context_.lanes = lanes; }
    /// Copies the model's present mass of a node.
    void take_mass(const ClothModel& model, std::size_t node);

    std::span<const T> scalars() const { return scalars_; }
    std::span<const T> arena() const { return {arena_.data(), hierarchy_->number_count}; }
    const Hierarchy& hierarchy() const { return *hierarchy_; }

private:
    /// Springs that a pass of the paper's solver may use.
    std::size_t whole_size_of(const Call& call) const;  ///< whether live or not

    const Hierarchy* hierarchy_;
    bool corrects_steps_;
    AlignedArray<T> arena_;
    std::vector<T> scalars_, parts_;
    std::vector<int> part_counts_;
    int part_stride_ = 0;
    AlignedArray<T> mass_;
    SolverContext<T> context_;
};

extern template class SolverState<double>;
extern template class SolverState<float>;

}  // namespace pliant

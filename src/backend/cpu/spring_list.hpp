// Springs as a list, and the step from their forces, as the kernels of the CPU want them.
#pragma once

#include <vector>

#include "backend/cpu/kernels.hpp"
#include "backend/cpu/state_records.hpp"
#include "backend/host/plain_cloth.hpp"

namespace pliant::cpu {

class SpringList {
public:
    /// Nothing for a cloth that takes its springs from its nodes. Makes room in `cloth.spring_force`.
    explicit SpringList(PlainCloth<float>& cloth);

    static constexpr std::size_t pack = 32;  ///< springs come in two of the widest packs
    std::size_t spring_count() const { return first_.size(); }
    std::size_t slice_count() const { return runs_.size(); }

    /// Springs from `begin` to before `end`, multiples of `pack`; parts may run at once.
    void find_forces(const Call& call, PlainCloth<float>& cloth, const StateRecords& records,
                     const Kernels& kernels, std::size_t begin, std::size_t end) const;
    /// Slices; parts may run at once.
    void step(const Call& call, PlainCloth<float>& cloth, StateRecords& records, const Kernels& kernels,
              const StepConstants<float>& constants, std::span<const Laws<float>::Collider> colliders,
              std::size_t begin, std::size_t end) const;

private:
    std::vector<std::uint32_t> first_, second_;
    std::vector<float> rest_length_, stiffness_, damping_, bending_;
    std::vector<NodeRun> runs_;
    std::vector<std::uint32_t> start_, springs_;
};

}  // namespace pliant::cpu

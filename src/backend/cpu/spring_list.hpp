// A list of springs, and the step from their forces, in the data layout of the CPU kernels.
#pragma once

#include <vector>

#include "backend/cpu/kernels.hpp"
#include "backend/cpu/state_records.hpp"
#include "backend/host/plain_cloth.hpp"

namespace pliant::cpu {

class SpringList {
public:
    /// Empty for node-centric cloths. Allocates `cloth.spring_force`.
    explicit SpringList(PlainCloth<float>& cloth);

    static constexpr std::size_t pack = 32;  ///< springs are padded to two of the widest packs
    std::size_t spring_count() const { return first_.size(); }
    std::size_t slice_count() const { return runs_.size(); }

    /// Springs [begin, end), multiples of `pack`; parts may run concurrently.
    void find_forces(const Call& call, PlainCloth<float>& cloth, const StateRecords& records,
                     const Kernels& kernels, std::size_t begin, std::size_t end) const;
    /// Steps slices; parts may run concurrently.
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

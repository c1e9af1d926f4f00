// A soft body in the data layout of the CPU kernels.
#pragma once

#include <vector>

#include "backend/cpu/kernels.hpp"
#include "backend/cpu/state_records.hpp"
#include "backend/host/plain_cloth.hpp"

namespace pliant::cpu {

class CpuBody {
public:
    /// Empty for a cloth.
    explicit CpuBody(const PlainCloth<float>& cloth);

    static bool has_kernel(Pass pass);
    /// Units of a call for a kernel: blocks of nodes or of fans.
    std::size_t size_of(const Call& call) const;
    /// Merges the sums of each body before the parts of a call run. Single-threaded.
    void prepare(const Call& call, PlainCloth<float>& cloth, const StepConstants<float>& constants);
    /// Runs the blocks [begin, end) of a call; parts may run concurrently.
    void run(const Call& call, PlainCloth<float>& cloth, StateRecords& records, const Kernels& kernels,
             const StepConstants<float>& constants, std::span<const Laws<float>::Collider> colliders,
             std::size_t begin, std::size_t end);

private:
    struct SliceArrays {
        std::vector<std::uint32_t> start{0}, place;
        std::vector<float> rest_length;
        Slices view() const
        {
            return {start.data(), place.data(), rest_length.empty() ? nullptr : rest_length.data()};
        }
    };
    struct Entry {
        std::uint32_t node;
        float rest_length;
    };
    /// Slices of blocks; `row` returns the entries of a node or fan.
    template <class Row>
    static SliceArrays sliced(const std::vector<BodyBlock>& blocks, const NodeLayout& layout, bool springs,
                              Row row);

    SliceArrays ring_, links_, fans_;
    std::vector<BodyNumbers> numbers_;       // by body
    std::vector<LaneSums> sums_;             // by block, of the current pass
    std::vector<std::uint8_t> any_blocked_;  // by block of nodes
    bool has_links_ = false;
};

}  // namespace pliant::cpu

// Vectors of nodes as records, for kernels that gather arbitrary neighbours.
#pragma once

#include "backend/cpu/kernels.hpp"
#include "backend/cpu/pointers.hpp"
#include "backend/host/plain_cloth.hpp"

namespace pliant::cpu {

/// Records of both copies of the state; for bodies with the volume constraint also of the end of a step and
/// the direction of its correction. The planes are authoritative: records are made from them when a pass
/// needs them, unless the pass that wrote the planes wrote the records, too.
class StateRecords {
public:
    static constexpr std::uint32_t ends = 2;  ///< index besides the parities

    explicit StateRecords(const PlainCloth<float>& cloth)
    {
        const ClothModel& model = cloth.model;
        const std::uint32_t count = model.plan.node_centric ? 0 : model.plan.keeps_volume() ? 3 : 2;
        for (std::uint32_t k = 0; k < count; ++k)
            records_[k] = AlignedArray<float>(cloth.layout.size * state_size);
    }
    const float* at(std::uint32_t copy) const { return records_[copy].data(); }
    float* at(std::uint32_t copy) { return records_[copy].data(); }

    /// Whether a call reads records that must be made first.
    bool are_missing(const Call& call) const { return gathers(call.pass) && !agree_[copy_for(call)]; }
    /// The planes to read and the records to make.
    RecordArguments missing(const Call& call, const PlainCloth<float>& cloth)
    {
        const std::uint32_t copy = copy_for(call);
        agree_[copy] = true;
        if (copy == ends)
            return {pointers(cloth.position[1 - call.parity]), pointers(cloth.body.direction), at(copy)};
        return {pointers(cloth.position[copy]), pointers(cloth.velocity[copy]), at(copy)};
    }
    /// Marks all records as outdated.
    void forget() { agree_[0] = agree_[1] = agree_[ends] = false; }
    /// After a call: notes which records are up to date.
    void follow(const Call& call)
    {
        if (records_[0].empty()) return;
        const bool leaves_records =
            call.pass == Pass::list_step || call.pass == Pass::ring_step || call.pass == Pass::volume_correct;
        for (const Resource resource : description_of(call.pass).writes) {
            if (resource == Resource::position || resource == Resource::velocity) agree_[call.parity] = false;
            if (resource == Resource::next_position || resource == Resource::next_velocity) {
                agree_[1 - call.parity] = leaves_records;
                agree_[ends] = call.pass == Pass::volume_step;
            }
        }
    }

private:
    static bool gathers(Pass pass)
    {
        return pass == Pass::spring_force || pass == Pass::ring_step || pass == Pass::volume_gather ||
               pass == Pass::volume_cubic || pass == Pass::volume_measure || pass == Pass::list_measure;
    }
    static std::uint32_t copy_for(const Call& call)
    {
        return call.pass == Pass::volume_cubic ? ends : call.parity;
    }

    AlignedArray<float> records_[3];
    bool agree_[3] = {};
};

}  // namespace pliant::cpu

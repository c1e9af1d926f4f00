// Decides from the table of passes where a program needs barriers.
#pragma once

#include <cstdint>
#include <set>
#include <utility>

#include "solve/pass.hpp"

namespace pliant::vulkan {

/// Asked call by call whether a barrier is needed before it: if it touches what an earlier call wrote, or
/// writes what an earlier one read.
class BarrierPlan {
public:
    bool needed_before(const Call& call)
    {
        const PassDescription& pass = description_of(call.pass);
        std::set<Key> reads, writes;
        for (const Resource r : pass.reads) reads.insert(key(call, r));
        for (const Resource r : pass.writes) writes.insert(key(call, r));
        if (call.guard != Guard::none) reads.insert(key(call, Resource::scalars));
        bool hazard = false;
        for (const Key& k : reads) hazard |= written_.count(k) > 0;
        for (const Key& k : writes) hazard |= written_.count(k) > 0 || read_.count(k) > 0;
        if (hazard) {
            written_.clear();
            read_.clear();
        }
        read_.merge(reads);
        written_.merge(writes);
        return hazard;
    }

private:
    using Key = std::pair<std::uint32_t, std::uint32_t>;  // cloth, physical buffer
    static Key key(const Call& call, Resource resource)
    {
        // The two copies of the state are identified by place, not by role.
        constexpr std::uint32_t copies = 100;
        switch (resource) {
            case Resource::position: return {call.cloth, copies + call.parity};
            case Resource::next_position: return {call.cloth, copies + 1 - call.parity};
            case Resource::velocity: return {call.cloth, copies + 2 + call.parity};
            case Resource::next_velocity: return {call.cloth, copies + 3 - call.parity};
            default: return {call.cloth, static_cast<std::uint32_t>(resource)};
        }
    }
    std::set<Key> written_, read_;
};

}  // namespace pliant::vulkan

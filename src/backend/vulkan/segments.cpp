#include "backend/vulkan/segments.hpp"

#include <algorithm>
#include <map>

namespace pliant::vulkan {

std::vector<Segment> segments_of(std::span<const Call> calls)
{
    const auto count = static_cast<std::uint32_t>(calls.size());
    std::map<std::uint32_t, std::uint32_t> ends;  // by tested call: the first one after its loop
    std::vector<std::uint32_t> cuts{0, count};
    const bool may_idle =
        std::any_of(calls.begin(), calls.end(), [](const Call& c) { return c.guard == Guard::idle; });
    std::uint32_t unseen = 0;  // calls since the last test
    for (std::uint32_t k = 0; k < count; ++k, ++unseen) {
        const Call& call = calls[k];
        const bool begins = k == 0 || calls[k - 1].guard == Guard::none || calls[k - 1].cloth != call.cloth;
        if (call.guard == Guard::none || call.guarded_after + 1 < least_skipped) continue;
        const Pass before = k > 0 ? calls[k - 1].pass : call.pass;
        if (before == Pass::solve_begin && !may_idle) continue;  // there is always work
        const std::uint32_t least = before == Pass::newton_check ? least_skipped : least_between_looks;
        if (!begins && unseen < least) continue;
        ends[k] = k + call.guarded_after + 1;
        cuts.insert(cuts.end(), {k, ends[k]});
        unseen = 0;
    }
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());

    std::vector<Segment> segments;
    const auto segment_at = [&](std::uint32_t call) {
        return static_cast<std::uint32_t>(std::lower_bound(cuts.begin(), cuts.end(), call) - cuts.begin());
    };
    for (std::size_t s = 0; s + 1 < cuts.size(); ++s) {
        const auto look = ends.find(cuts[s]);
        const bool looks = look != ends.end();
        segments.push_back({cuts[s], cuts[s + 1], looks, looks ? segment_at(look->second) : 0});
    }
    return segments;
}

}  // namespace pliant::vulkan

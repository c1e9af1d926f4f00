#include "solve/pass.hpp"

#include <array>

namespace pliant {
namespace {

using enum Resource;

template <class... R>
constexpr std::array<Resource, sizeof...(R)> listed(R... resources)
{
    return {resources...};
}
/// The list, with one more resource if `more`.
template <bool more, std::size_t n>
constexpr std::array<Resource, n + more> with(const std::array<Resource, n>& list, Resource added)
{
    std::array<Resource, n + more> all{};
    for (std::size_t k = 0; k < n; ++k) all[k] = list[k];
    if constexpr (more) all[n] = added;
    return all;
}

constexpr SumSlots slots_of(std::uint32_t first, std::uint32_t count) { return {first, count}; }

// What each pass reads, writes and sums, stored once.
#define READS(...) listed(__VA_ARGS__)
#define WRITES(...) listed(__VA_ARGS__)
#define SUMS(first, count) slots_of(first, count)
#define NO_SUMS slots_of(0, 0)
#define PASS(name, family, unit, reads, writes, slots, loop)                             \
    constexpr auto name##_reads = with<is_live(PassUnit::unit)>(reads, Resource::flags); \
    constexpr auto name##_writes = with<(slots.count > 0)>(writes, Resource::sums);
#include "solve/passes.def"

constexpr PassDescription passes[] = {
#define PASS(name, family, unit, reads, writes, slots, loop) \
    {#name, PassFamily::family, PassUnit::unit, name##_reads, name##_writes, slots},
#include "solve/passes.def"
};

}  // namespace

const PassDescription& description_of(Pass pass) { return passes[static_cast<std::size_t>(pass)]; }

const char* description_of(PassUnit unit)
{
    constexpr const char* texts[] = {
#define UNIT(name, text) text,
#include "solve/passes.def"
    };
    return texts[static_cast<std::size_t>(unit)];
}
const char* name_of(Resource resource)
{
    constexpr const char* names[] = {
#define RESOURCE(name, ...) #name,
#include "solve/passes.def"
    };
    return names[static_cast<std::size_t>(resource)];
}
const char* description_of(Resource resource)
{
    constexpr const char* texts[] = {
#define RESOURCE(name, text) text,
#include "solve/passes.def"
    };
    return texts[static_cast<std::size_t>(resource)];
}

std::span<const PassDescription> all_passes() { return passes; }

// Not inline: files of wide kernels must not define functions that the linker may use elsewhere.
SumSlots sum_slots_of(Pass pass) { return description_of(pass).sums; }

MeasureTree::MeasureTree(std::uint32_t node_count)
{
    const auto blocks = [](std::uint32_t n) { return (n + block_size - 1) / block_size; };
    for (std::uint32_t count = blocks(node_count);; count = blocks(count)) {
        levels.push_back({value_count, count});
        value_count += count;
        if (count <= 1) return;
    }
}

}  // namespace pliant

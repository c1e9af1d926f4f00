#include "solve/pass.hpp"

#include <array>

namespace pliant {
namespace {

using enum Resource;
using enum PassSize;

// READS and WRITES of each pass, stored once.
#define READS(...) std::to_array<Resource>({__VA_ARGS__})
#define WRITES(...) std::to_array<Resource>({__VA_ARGS__})
#define PASS(name, size, reads, writes)  \
    constexpr auto name##_reads = reads; \
    constexpr auto name##_writes = writes;
#include "solve/passes.def"
#undef PASS

constexpr PassDescription passes[] = {
#define PASS(name, size, reads, writes) {#name, size, name##_reads, name##_writes},
#include "solve/passes.def"
#undef PASS
};

}  // namespace

const PassDescription& description_of(Pass pass) { return passes[static_cast<std::size_t>(pass)]; }

std::span<const PassDescription> all_passes() { return passes; }

bool is_of_live_rows(Pass pass)
{
    switch (pass) {
        case Pass::sheet_limits:
        case Pass::mesh_limits:
        case Pass::sheet_marks:
        case Pass::mesh_marks:
        case Pass::sheet_multipliers:
        case Pass::mesh_multipliers: return false;
        default: break;
    }
    switch (description_of(pass).size) {
        case PassSize::level:
        case PassSize::cell:
        case PassSize::edge:
        case PassSize::finer: return !is_paper_pass(pass);
        default: return false;
    }
}

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

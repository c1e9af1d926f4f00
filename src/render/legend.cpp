#include "render/legend.hpp"

#include <algorithm>
#include <string_view>

namespace pliant {
namespace {

constexpr std::string_view letters = "0123456789%strainfocevlumN-.+k";  // in the order of shaders/legend.frag
constexpr std::uint32_t blank = 255;

std::array<std::uint32_t, 4> codes_of(std::string_view text)
{
    std::array<std::uint32_t, 4> codes{};
    for (std::size_t k = 0; k < 16; ++k) {
        const std::size_t at = k < text.size() ? letters.find(text[k]) : std::string_view::npos;
        const std::uint32_t code = at == std::string_view::npos ? blank : static_cast<std::uint32_t>(at);
        codes[k / 4] |= code << (8 * (k % 4));
    }
    return codes;
}

}  // namespace

LegendText legend_text(const ValueScale& scale)
{
    LegendText text{codes_of(scale.title), codes_of(scale.low_text), {}};
    // The upper end is right-aligned in a field of eight letters.
    constexpr std::size_t field = 8;
    const std::string& high = scale.high_text;
    text.high = codes_of(std::string(field - std::min(field, high.size()), ' ') + high);
    return text;
}

}  // namespace pliant

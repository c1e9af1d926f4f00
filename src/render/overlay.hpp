// What a picture can show beside the cloth itself.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace pliant {

enum class Overlay : std::uint8_t {
    strain,       ///< the largest stretch of the structural and shear springs at each node, as colour
    springs,      ///< lines, coloured by class
    active,       ///< springs that a constraint holds, as lines
    multipliers,  ///< the largest force of a constraint at each node, as colour
    contacts,     ///< nodes that touch a collider, as points
    normals,      ///< lines
    volume,       ///< how far the volume of each soft body is from what it should be, as colour
    wireframe,    ///< edges of triangles
};
constexpr std::size_t overlay_count = 8;

/// By the order of the enumeration; also what `--overlay` takes.
constexpr std::array<const char*, overlay_count> overlay_names{"strain",   "springs", "active", "multipliers",
                                                               "contacts", "normals", "volume", "wireframe"};

class OverlaySet {
public:
    constexpr OverlaySet() = default;
    constexpr OverlaySet(std::initializer_list<Overlay> overlays)
    {
        for (const Overlay overlay : overlays) set(overlay, true);
    }
    constexpr bool has(Overlay overlay) const { return bits_ >> static_cast<int>(overlay) & 1; }
    /// Of the three that colour the cloth only one can be seen: the last that was set.
    constexpr void set(Overlay overlay, bool on)
    {
        if (on && is_colour(overlay))
            for (const Overlay other : {Overlay::strain, Overlay::multipliers, Overlay::volume})
                bits_ &= ~(1u << static_cast<int>(other));
        bits_ = (bits_ & ~(1u << static_cast<int>(overlay))) | (on ? 1u : 0u) << static_cast<int>(overlay);
    }
    constexpr void toggle(Overlay overlay) { set(overlay, !has(overlay)); }
    constexpr bool has_colours() const
    {
        return has(Overlay::strain) || has(Overlay::multipliers) || has(Overlay::volume);
    }
    constexpr bool has_lines() const { return has(Overlay::springs) || has(Overlay::active); }
    constexpr bool needs_springs() const { return has_lines() || has(Overlay::strain); }
    friend constexpr bool operator==(OverlaySet, OverlaySet) = default;
    static constexpr bool is_colour(Overlay overlay)
    {
        return overlay == Overlay::strain || overlay == Overlay::multipliers || overlay == Overlay::volume;
    }

private:
    std::uint32_t bits_ = 0;
};

inline std::optional<Overlay> overlay_of(std::string_view name)
{
    for (std::size_t k = 0; k < overlay_count; ++k)
        if (name == overlay_names[k]) return static_cast<Overlay>(k);
    return std::nullopt;
}

/// What the colours of a cloth stand for, and what the legend says of it. Short texts of the characters in
/// `legend_text`.
struct ValueScale {
    float low = 0, high = 0.10f;
    bool diverging = false;  ///< blue below the middle, red above, white in it
    std::string title = "strain", low_text = "0 %", high_text = "10 %";
};

}  // namespace pliant

// Overlays: what a picture can show besides the cloth itself.
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
    strain,       ///< the largest strain of the structural and shear springs at each node, as colour
    springs,      ///< lines, coloured by class
    active,       ///< springs held by a constraint, as lines
    multipliers,  ///< the largest force of a constraint at each node, as colour
    contacts,     ///< nodes in contact with a collider, as points
    normals,      ///< lines
    volume,       ///< deviation of each soft body's volume from its target, as colour
    wireframe,    ///< edges of triangles
};
constexpr std::size_t overlay_count = 8;

/// In the order of the enumeration; the names that `--overlay` accepts.
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
    /// Only one of the three overlays that colour the cloth is visible: the last one set.
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

/// The range of a cloth's colours and the text of its legend. Texts are short and use the characters of
/// `legend_text`.
struct ValueScale {
    float low = 0, high = 0.10f;
    bool diverging = false;  ///< blue below the middle, white in the middle, red above
    std::string title = "strain", low_text = "0 %", high_text = "10 %";
};

}  // namespace pliant

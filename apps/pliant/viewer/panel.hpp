// The panel of a viewer: its readings and controls.
#pragma once

#include <algorithm>
#include <array>

#include "render/overlay.hpp"
#include "viewer/session.hpp"

namespace pliant::tool {

/// Milliseconds of a display frame.
struct FrameCost {
    double whole = 0;       ///< from one frame to the next
    double simulation = 0;  ///< of steps, on their own thread
    double driver = 0;      ///< in the driver and waiting for the screen
    double own = 0;         ///< the viewer itself, see docs/viewer.md
};

/// Medians over the last frames.
class FrameCosts {
public:
    static constexpr std::size_t length = 61;

    void add(const FrameCost& cost)
    {
        costs_[next_] = cost;
        next_ = (next_ + 1) % length;
        count_ = std::min(count_ + 1, length);
    }
    FrameCost median() const
    {
        return {median_of(&FrameCost::whole), median_of(&FrameCost::simulation),
                median_of(&FrameCost::driver), median_of(&FrameCost::own)};
    }

private:
    double median_of(double FrameCost::*part) const
    {
        std::array<double, length> values{};
        for (std::size_t k = 0; k < count_; ++k) values[k] = costs_[k].*part;
        const auto middle = values.begin() + static_cast<long>(count_ / 2);
        std::nth_element(values.begin(), middle, values.begin() + static_cast<long>(count_));
        return count_ > 0 ? *middle : 0;
    }

    std::array<FrameCost, length> costs_{};
    std::size_t next_ = 0, count_ = 0;
};

/// The viewer's state for the panel, besides its session.
struct View {
    OverlaySet overlays;
    bool panel = true, help = false;
    bool recording = false;
    FrameCosts cost;
    bool wants_reset = false;
    std::string wants_scene = {};  ///< to be opened; empty: none
};

class Panel {
public:
    Panel();
    /// Call it within a frame of the interface.
    void draw(Session& session, View& view);

private:
    void draw_state(Session& session, View& view);
    void draw_scene(Session& session, View& view);
    void draw_parameters(Session& session);
    void draw_plots(const Session& session);
    void draw_passes(const Session& session);
    void draw_overlays(View& view);
    void draw_help(View& view);

    std::vector<SceneListing> scenes_;
    std::array<float, History::length> unrolled_{};
};

}  // namespace pliant::tool

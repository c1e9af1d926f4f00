// The panel of a viewer: what can be read and changed.
#pragma once

#include <array>

#include "render/overlay.hpp"
#include "viewer/session.hpp"

namespace pliant::tool {

/// Milliseconds of a frame of the display, means over the last ones.
struct FrameCost {
    double whole = 0;        ///< from one frame to the next
    double simulation = 0;   ///< of it, in steps
    double driver = 0;       ///< of it, waiting for or handing over to the driver and the screen
    double own = 0;          ///< of it, what is left: the viewer itself
    double allocations = 0;  ///< by it, when they are counted
};

/// What of a viewer can be seen and changed, beside its session.
struct View {
    OverlaySet overlays;
    bool panel = true, help = false;
    bool recording = false;
    FrameCost cost;
    bool wants_reset = false;
    std::string wants_scene = {};  ///< to be opened; empty: none
};

class Panel {
public:
    Panel();
    /// Within a frame of the interface.
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

// What pictures of a simulation are made from: frames on the device or the host, and what overlays need.
#pragma once

#include <span>
#include <vector>

#include "pliant/simulation.hpp"
#include "render/scene_drawing.hpp"

namespace pliant::tool {

/// One for each cloth.
std::vector<ClothTopology> topologies_of(const Simulation& simulation);
/// Springs of a cloth, with the stretch at which constraints begin.
std::vector<DrawnSpring> drawn_springs(const Simulation& simulation, std::size_t cloth);

/// Keeps its memory from frame to frame, so that gathering allocates the first time alone.
class PictureSource {
public:
    /// Takes from a simulation what a picture with these overlays needs. What it gives is valid until the
    /// simulation's next step.
    void gather(Simulation& simulation, OverlaySet overlays);
    /// The positions of now are those before the next step, for frames on the host.
    void keep_positions(Simulation& simulation);
    void forget_positions() { before_.clear(); }
    /// Whether frames stay on the device.
    static bool is_direct(Simulation& simulation)
    {
        // The nodes of soft bodies and meshes lie in an order of their own, and bodies against an origin,
        // too.
        for (std::size_t c = 0; c < simulation.scene().cloth_count(); ++c)
            if (!simulation.node_of_vertex(c).empty()) return false;
        return simulation.device_state() != nullptr;
    }

    std::span<const ClothFrame> frames() const { return frames_; }
    std::span<const ClothExtras> extras() const { return extras_; }
    const ValueScale& scale() const { return scale_; }

private:
    void gather_contacts(Simulation& simulation);
    void scale_forces();
    void colour_volumes(const Simulation& simulation);

    std::vector<ClothFrame> frames_;
    std::vector<ClothExtras> extras_;
    std::vector<std::vector<Vec3>> before_;
    std::vector<std::vector<ContactPoint>> contacts_;
    std::vector<std::vector<float>> volume_values_;
    ValueScale scale_;
};

}  // namespace pliant::tool

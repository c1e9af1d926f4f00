// What pictures of a simulation are made from: frames on the device or the host, and what overlays need.
#pragma once

#include <span>
#include <vector>

#include "pliant/simulation.hpp"
#include "render/scene_drawing.hpp"

namespace pliant {

/// One for each cloth.
std::vector<ClothTopology> topologies_of(const Simulation& simulation);
/// Springs of a cloth, as Simulation::springs has them.
std::vector<DrawnSpring> drawn_springs(const Simulation& simulation, std::size_t cloth);

/// What a picture of a simulation at a moment is made from. It holds copies, so that the simulation may go
/// on, and keeps their memory, so that gathering allocates the first time alone.
class PictureSource {
public:
    /// Takes from a simulation what a picture with these overlays needs; no positions where the simulation is
    /// direct, and those of another source where one is given.
    void gather(Simulation& simulation, OverlaySet overlays, const PictureSource* instead = nullptr);
    /// Only what overlays need, of the same state.
    void gather_overlays(Simulation& simulation, OverlaySet overlays);
    /// Whether pictures can be drawn from positions on the device.
    static bool is_direct(Simulation& simulation)
    {
        // The nodes of soft bodies and meshes lie in an order of their own, and bodies against an origin,
        // too.
        for (std::size_t c = 0; c < simulation.scene().cloth_count(); ++c)
            if (!simulation.node_of_vertex(c).empty()) return false;
        return simulation.device_state() != nullptr;
    }

    double time() const { return time_; }  ///< s
    const Report& report() const { return report_; }
    std::span<const Vec3> positions(std::size_t cloth) const { return positions_[cloth]; }
    std::span<const ClothExtras> extras() const { return extras_; }
    const ValueScale& scale() const { return scale_; }

private:
    void gather_contacts(Simulation& simulation);
    void scale_forces();
    void colour_volumes(const Simulation& simulation);

    double time_ = 0;
    Report report_;
    std::vector<ClothExtras> extras_;
    std::vector<std::vector<Vec3>> positions_;
    std::vector<std::vector<ContactPoint>> contacts_;
    std::vector<std::vector<std::uint32_t>> held_;
    std::vector<std::vector<float>> values_;
    ValueScale scale_;
};

/// The cloths of a simulation as they are now: valid until its next step.
std::vector<ClothFrame> frames_of(Simulation& simulation, const PictureSource& source);

}  // namespace pliant

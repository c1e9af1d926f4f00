// The data for pictures of a simulation: frames on the device or the host, and data for overlays.
#pragma once

#include <span>
#include <vector>

#include "pliant/simulation.hpp"
#include "render/scene_drawing.hpp"

namespace pliant {

/// One per cloth.
std::vector<ClothTopology> topologies_of(const Simulation& simulation);
/// The springs of a cloth, in the order of Simulation::springs.
std::vector<DrawnSpring> drawn_springs(const Simulation& simulation, std::size_t cloth);

/// The data for a picture of a simulation at one time. It holds copies, so that the simulation may continue,
/// and reuses their memory, so that only the first call allocates.
class PictureSource {
public:
    /// Copies the data for a picture with these overlays. Omits positions if the simulation is direct; uses
    /// those of `instead` if given.
    void gather(Simulation& simulation, OverlaySet overlays, const PictureSource* instead = nullptr);
    /// Copies only the data for overlays, of the same state.
    void gather_overlays(Simulation& simulation, OverlaySet overlays);
    /// Whether pictures can be drawn from positions on the device.
    static bool is_direct(Simulation& simulation)
    {
        // Nodes of soft bodies and meshes have another order; bodies also have another origin.
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

/// The present cloths of a simulation: valid until its next step.
std::vector<ClothFrame> frames_of(Simulation& simulation, const PictureSource& source);

}  // namespace pliant

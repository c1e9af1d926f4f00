// A cloth, or soft bodies that are stepped as one, made ready for stepping.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "body/body_model.hpp"
#include "body/cloth_shape.hpp"
#include "body/hierarchy.hpp"
#include "body/node_masses.hpp"
#include "body/spring_limits.hpp"
#include "body/spring_set.hpp"
#include "body/stepping_plan.hpp"
#include "pliant/scene.hpp"

namespace pliant {

/// Its parts, each made from those before it. Backends keep it by reference; what changes while a simulation
/// runs are a node's mass and the length of a step.
class ClothModel {
public:
    /// Throws Error(bad_input) for what only a whole cloth shows, as a node without mass.
    ClothModel(const Cloth& cloth, const Scene& scene);

    SteppingPlan plan;
    ClothShape shape;
    NodeMasses masses;
    Attachments attachments;
    ClothParameters parameters;
    SpringLimits limits;
    SpringSet springs;
    std::optional<BodyModel> body;  ///< of a soft body
    Hierarchy hierarchy;            ///< of the constraint methods; otherwise empty

    std::uint32_t node_count() const { return static_cast<std::uint32_t>(masses.kg.size()); }
    bool feels_air() const { return parameters.air_density > 0; }
    /// Whether a step adds external_force to its nodes: wind, or the loads of a body.
    bool has_external_force() const { return feels_air() || (body && !body->loads.empty()); }
    /// The largest step in s that is certainly stable, by Gershgorin's theorem: see docs/physics.md,
    /// "Stability".
    double stable_step() const;

    // Of a soft body: the neighbours around a node, and those across the inside.
    std::span<const Neighbour> ring_of(std::size_t node) const
    {
        const Ragged<Neighbour>& rows = springs.neighbours;
        return {rows.entries.data() + rows.start[node], rows.entries.data() + body->links[node]};
    }
    std::span<const Neighbour> links_of(std::size_t node) const
    {
        const Ragged<Neighbour>& rows = springs.neighbours;
        return {rows.entries.data() + body->links[node], rows.entries.data() + rows.start[node + 1]};
    }

    /// Whether another body can be stepped in the same passes: it has the same material, and is near.
    bool can_take(const ClothModel& other) const;
    /// Appends a body, as the last of `body->parts`.
    void take(const ClothModel& other);

private:
    void step_acad_implicitly();
    void renumber(const std::vector<std::uint32_t>& order);
};

}  // namespace pliant

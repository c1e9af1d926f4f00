// What the nodes of a cloth weigh, and which of them pins hold.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/cloth_shape.hpp"

namespace pliant {

struct NodeMasses {
    NodeMasses() = default;
    /// Throws Error(bad_input) for a node without a mass that single precision can work with.
    NodeMasses(const Cloth& cloth, const ClothShape& shape);

    std::vector<double> kg;
    std::vector<bool> pinned;
    double mean = 0;  ///< kg

    double inverse(std::size_t node) const { return pinned[node] ? 0 : 1 / kg[node]; }  ///< 1/kg; 0 of a pin
    double sum() const;                                                                 ///< kg
    void renumber(std::span<const std::uint32_t> order);
    void append(const NodeMasses& other);
};

/// A node attached to a moving pin.
struct AttachedNode {
    std::uint32_t node = 0;
    std::uint32_t motion = 0;  ///< index into Attachments::motions
    Vec3d arm;                 ///< m, from the centre of the pin's nodes, at the start
};
struct AttachmentMotion {
    Vec3d centre;  ///< m
    std::vector<Keyframe> keyframes;
};

/// The moving pins of a cloth.
struct Attachments {
    std::vector<AttachedNode> nodes;  ///< ascending
    std::vector<AttachmentMotion> motions;

    bool empty() const { return nodes.empty(); }
    /// Positions of the attached nodes at a time, in their order; m.
    void place(double time, std::span<Vec3> places) const;
    void renumber(std::span<const std::uint32_t> node_of_vertex);
    /// Those of a body whose first node becomes `first_node`, moved by `shift` (m).
    void append(const Attachments& other, std::uint32_t first_node, Vec3d shift);
};

/// Marks the nodes that a cloth's pins hold and stops them. Throws Error(bad_input) for a box without nodes.
Attachments pin_nodes(const Cloth& cloth, ClothShape& shape, NodeMasses& masses);

}  // namespace pliant

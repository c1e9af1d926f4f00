// The additional data of a soft body: the ring of neighbours around each node, fans that cover its triangles
// once, and the blocks of both over which sums are taken.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "body/ragged.hpp"
#include "pliant/scene.hpp"

namespace pliant {

/// Up to 256 nodes, or fans, of one body, which one work group sums.
struct BodyBlock {
    static constexpr std::uint32_t most = 256;  ///< of count
    std::uint32_t first = 0, count = 0, body = 0;
};

/// One of the bodies in a model.
struct BodyPart {
    std::uint32_t first_node = 0, node_count = 0;
    std::uint32_t first_block = 0, block_count = 0;          ///< in BodyModel::node_blocks
    std::uint32_t first_fan_block = 0, fan_block_count = 0;  ///< in BodyModel::fan_blocks
    double volume = 0;                                       ///< m3, at rest
    double inverse_weight = 0;  ///< 1 / sum of the weights of free nodes; 0 if all weights are 1
    double inverse_fans = 0;    ///< 1 / number of its fans
    Vec3d centre;               ///< m, mean of its nodes at the start, in the model's coordinates
    VolumeOptions options;      ///< its keyframes and tolerance
};

/// A node on which a force acts: f = force + torque x position, in the model's coordinates.
struct LoadedNode {
    std::uint32_t node = 0;
    Vec3d force;   ///< N
    Vec3d torque;  ///< N/m
};

/// The target of a body in one step, see `BodyModel::goal_at`.
struct VolumeGoal {
    double volume = 0;    ///< 6 V wanted at the end of the step, m3
    double pressure = 0;  ///< a sixth of the pressure, Pa
};

struct BodyModel {
    /// By node: index of the first of its ClothModel::neighbours that is an internal spring. Those before it
    /// are the ring around the node, counter-clockwise seen from outside.
    std::vector<std::uint32_t> links;
    /// Triangles that share a node: the node, then the ring of those around it, one more than there are
    /// triangles.
    Ragged<std::uint32_t> fans;
    std::vector<BodyBlock> node_blocks, fan_blocks;
    std::vector<BodyPart> parts;
    std::vector<float> weights;  ///< by node; empty if all are 1
    std::vector<LoadedNode> loads;
    bool has_pressure = false;

    double weight_of(std::size_t node) const { return weights.empty() ? 1.0 : double{weights[node]}; }
    /// Whether target volumes or pressures change with time.
    bool goals_move() const;
    VolumeGoal goal_at(std::size_t part, double time) const;
    /// Appends another model of `count` nodes: its first becomes `node`, the first entry of its rows of
    /// neighbours `neighbour`, and it is moved by `shift` (m).
    void append(const BodyModel& other, std::uint32_t node, std::uint32_t count, std::uint32_t neighbour,
                Vec3d shift);
};

/// Interpolates keyframes at a time; returns `otherwise` if there are none.
double value_at(const std::vector<TimedValue>& keyframes, double time, double otherwise);

/// V / V0 per second: the fastest change of volume towards the first target.
constexpr double fastest_start = 2;
/// The target that a body follows: it starts at 1, at rest, and changes gradually to the given target.
std::vector<TimedValue> gradual_target(const std::vector<TimedValue>& target);

/// 6 V of triangles, about the first vertex; exact up to rounding of doubles.
double sixfold_volume(std::span<const Vec3> positions, std::span<const Triangle> triangles);

/// An order of a mesh's vertices in which neighbours are close, and rings of equal length are side by side.
/// Element k is the vertex that becomes node k.
std::vector<std::uint32_t> node_order(const SurfaceMesh& mesh);

/// The ring of neighbours around each node of a closed surface, counter-clockwise seen from outside, starting
/// at the neighbour of lowest index.
Ragged<std::uint32_t> rings_of(std::uint32_t node_count, std::span<const Triangle> triangles);

/// Fans that contain each triangle once, in the order of their apexes; within each block of 256 the longest
/// first.
Ragged<std::uint32_t> fans_of(const Ragged<std::uint32_t>& rings);

/// Pairs (i < j) of nodes that internal springs connect, in ascending order.
std::vector<std::pair<std::uint32_t, std::uint32_t>> internal_pairs(std::span<const Vec3> positions,
                                                                    std::span<const Triangle> triangles,
                                                                    const InternalSprings& options);

}  // namespace pliant

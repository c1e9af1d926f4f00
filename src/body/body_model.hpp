// What a soft body has beyond a cloth: the ring of neighbours around each node, fans that cover its triangles
// once, and the blocks of both that sums are made of.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "body/ragged.hpp"
#include "pliant/scene.hpp"

namespace pliant {

/// Up to 256 nodes, or fans, of one body: what one work group sums up.
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
    double inverse_weight = 0;  ///< 1 / sum of the weights of free nodes; 0 where all weights are 1
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

/// What there is to know at one step of a part: see `BodyModel::goal_at`.
struct VolumeGoal {
    double volume = 0;    ///< 6 V that is wanted at the end of the step, m3
    double pressure = 0;  ///< a sixth of the pressure, Pa
};

struct BodyModel {
    /// By node: the first of its SpringSet::neighbours that is across the inside. Those before it are the
    /// ring around it, counter-clockwise seen from outside.
    std::vector<std::uint32_t> links;
    /// Triangles that share a node: the node, and then those around it, one more than there are triangles.
    Ragged<std::uint32_t> fans;
    std::vector<BodyBlock> node_blocks, fan_blocks;
    std::vector<BodyPart> parts;
    std::vector<float> weights;  ///< by node; empty where all are 1
    std::vector<LoadedNode> loads;
    bool constrained = false;  ///< keeps its volume
    bool has_pressure = false;

    double weight_of(std::size_t node) const { return weights.empty() ? 1.0 : double{weights[node]}; }
    /// Volumes and pressures differ from step to step.
    bool goals_move() const;
    VolumeGoal goal_at(std::size_t part, double time) const;
    /// Appends another model of `count` nodes: its first becomes `node`, the first entry of its rows of
    /// neighbours `neighbour`, and it is moved by `shift` (m).
    void append(const BodyModel& other, std::uint32_t node, std::uint32_t count, std::uint32_t neighbour,
                Vec3d shift);
};

/// A value of keyframes at a time; `otherwise` where there are none.
double value_at(const std::vector<TimedValue>& keyframes, double time, double otherwise);

/// V / V0 a second: as fast as a body goes to the volume that it is given to begin with.
constexpr double fastest_start = 2;
/// A target as a body follows it: it starts at 1, at rest, and goes from there to what it is given.
std::vector<TimedValue> gradual_target(const std::vector<TimedValue>& target);

/// 6 V of triangles, exact but for the rounding of doubles, about the first vertex.
double sixfold_volume(std::span<const Vec3> positions, std::span<const Triangle> triangles);

/// The vertices of a mesh in an order in which neighbours are near each other and rings of one length side by
/// side: at place k the vertex that becomes node k.
std::vector<std::uint32_t> node_order(const SurfaceMesh& mesh);

/// The ring of neighbours around each node of a closed surface, counter-clockwise seen from outside, from the
/// neighbour with the lowest index on.
Ragged<std::uint32_t> rings_of(std::uint32_t node_count, std::span<const Triangle> triangles);

/// Fans that hold each triangle once, in the order of their apexes; of each 256 the longest first.
Ragged<std::uint32_t> fans_of(const Ragged<std::uint32_t>& rings);

/// Pairs (i < j) of nodes that internal springs join, in ascending order.
std::vector<std::pair<std::uint32_t, std::uint32_t>> internal_pairs(std::span<const Vec3> positions,
                                                                    std::span<const Triangle> triangles,
                                                                    const InternalSprings& options);

}  // namespace pliant

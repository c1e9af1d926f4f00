// Where the nodes of a cloth or body are at the start, and the triangles between them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "body/collider_motion.hpp"
#include "body/ragged.hpp"
#include "body/sheet_shape.hpp"
#include "pliant/scene.hpp"

namespace pliant {

class ClothShape {
public:
    ClothShape() = default;
    /// Nodes of a soft body are numbered by node_order, and their positions are against an origin near it.
    explicit ClothShape(const Cloth& cloth);

    std::optional<SheetShape> sheet;       ///< of a sheet that is stepped by its grid
    std::vector<Vec3> positions;           ///< m, at the start, against `origin`
    std::vector<Vec3> velocities;          ///< m/s, at the start
    Ragged<std::uint32_t> node_triangles;  ///< of a mesh: per node the triangles around it, ascending
    Vec3d origin;                          ///< m; 0 but for a body
    /// The node of each vertex of the mesh; empty if the order is the same.
    std::vector<std::uint32_t> node_of_vertex;

    bool is_sheet() const { return sheet.has_value(); }
    std::uint32_t node(std::uint32_t vertex) const
    {
        return node_of_vertex.empty() ? vertex : node_of_vertex[vertex];
    }
    std::uint64_t triangle_count() const;
    /// Triangles; a sheet's are made on first use.
    std::span<const Triangle> triangles() const;
    /// m: the longest side of the box around the nodes.
    double longest_side() const;

    /// Drops the grid of a sheet, which is a mesh from then on, with lists of triangles.
    void become_mesh();
    /// order[k] is the vertex that becomes node k.
    void renumber(std::span<const std::uint32_t> order);
    /// Appends the nodes and triangles of another body, whose positions are moved by `shift` (m).
    void append(const ClothShape& other, Vec3d shift);
    /// Frees the initial positions and velocities, once a backend has copied them.
    void forget_start();

private:
    void build_sheet(const Cloth& cloth, const SheetOptions& options);
    void build_mesh(const Cloth& cloth, const SurfaceMesh& mesh);
    void build_body(const Cloth& cloth, const SurfaceMesh& mesh);
    void list_node_triangles();

    mutable std::vector<Triangle> triangles_;
};

/// Where the vertices of a cloth's mesh are put.
class VertexPlacement {
public:
    explicit VertexPlacement(const Cloth& cloth)
        : position_(cloth.position), rotation_(rotation_from_degrees(cloth.rotation)), scale_(cloth.scale)
    {
    }
    Vec3d operator()(Vec3 vertex) const  ///< m
    {
        return position_ + rotate(rotation_, to_double(vertex) * scale_);
    }

private:
    Vec3d position_;
    Rotation rotation_;
    double scale_;
};

}  // namespace pliant

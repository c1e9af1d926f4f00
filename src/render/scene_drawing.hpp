// What is drawn: the cloths, colliders, floor and light of a scene. It knows no target: an off-screen picture
// and a window record the same commands.
#pragma once

#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "backend/vulkan/device_state.hpp"
#include "pliant/scene.hpp"
#include "render/pipelines.hpp"
#include "render/shadow_map.hpp"
#include "render/shapes.hpp"
#include "render/stage.hpp"

namespace pliant {

/// What does not change of a cloth.
struct ClothTopology {
    std::span<const Triangle> triangles;
    std::uint32_t node_count = 0;
    std::uint32_t rows = 0, columns = 0;  ///< of a sheet; 0 for a mesh
};

/// A cloth at a moment, in the memory of the host: one entry for each node.
struct HostCloth {
    std::span<const Vec3> positions;
    std::span<const Vec3> normals;        ///< unit length
    std::span<const float> strains = {};  ///< may be empty, and then counts as zero
};

/// A cloth at a moment: on the host, or where the simulation has it on the device.
using ClothFrame = std::variant<HostCloth, DeviceClothBuffers>;

namespace vulkan {

class SceneDrawing {
public:
    /// Uploads what does not change. Pictures go to targets like this one (its pass and samples, any size).
    SceneDrawing(std::shared_ptr<Device> device, const Scene& scene,
                 std::span<const ClothTopology> topologies, const PictureTarget& target);

    /// Takes the state that the next picture shows, one entry of `frames` for each topology. The commands of
    /// the last picture must have run: what they read is written here. Throws Error(bad_usage) for frames of
    /// another size.
    void prepare(const Camera& camera, vk::Extent2D size, double time, std::span<const ClothFrame> frames);
    /// Records the picture that was prepared.
    void record(const vk::raii::CommandBuffer& commands, const PictureTarget& target) const;

private:
    /// One cloth on the device.
    struct ClothDrawing {
        std::uint32_t node_count = 0, index_count = 0;
        Buffer indices, pattern;
        Buffer positions, normals, strains;  // only for host frames, made with the first of them
        vk::raii::DescriptorSet set{nullptr};
        DeviceClothBuffers bound;  // what the set points to
    };

    ClothDrawing make_cloth(const Cloth& cloth, const ClothTopology& topology) const;
    void bind_frame_set();
    void bind_frame(ClothDrawing& cloth, const ClothFrame& frame) const;
    DeviceClothBuffers upload(ClothDrawing& cloth, const HostCloth& frame) const;
    void record_shadows(const vk::raii::CommandBuffer& commands) const;
    void record_picture(const vk::raii::CommandBuffer& commands, const PictureTarget& target) const;
    void draw_cloths(const vk::raii::CommandBuffer& commands) const;
    void draw_shapes(const vk::raii::CommandBuffer& commands) const;
    void draw_floors(const vk::raii::CommandBuffer& commands) const;
    template <class Constants>
    void push(const vk::raii::CommandBuffer& commands, const Constants& constants) const;

    std::shared_ptr<Device> device_;
    std::vector<Collider> colliders_;
    Stage stage_;
    ShadowMap shadow_map_;
    Pipelines pipelines_;
    Buffer uniforms_;
    vk::raii::DescriptorPool pool_{nullptr};
    vk::raii::DescriptorSet frame_set_{nullptr};
    std::vector<ClothDrawing> cloths_;
    ShapeMeshes shapes_;
    Buffer shape_vertices_, shape_indices_;
    std::vector<PlacedCollider> placed_;  // at the time of the picture
};

}  // namespace vulkan
}  // namespace pliant

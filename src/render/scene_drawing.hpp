// Draws the cloths, colliders, floor and light of a scene. Independent of the target: an off-screen picture
// and a window record the same commands.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "backend/vulkan/device.hpp"
#include "pliant/scene.hpp"
#include "pliant/simulation.hpp"
#include "render/legend.hpp"
#include "render/pipelines.hpp"
#include "render/stage.hpp"
#include "render/touched_area.hpp"

namespace pliant {

/// A spring of a cloth.
struct DrawnSpring {
    std::uint32_t i = 0, j = 0;  ///< nodes
    SpringKind kind = SpringKind::structural;
    float rest_length = 0;  ///< m
};

/// The fixed data of a cloth.
struct ClothTopology {
    std::span<const Triangle> triangles;
    std::uint32_t node_count = 0;
    std::uint32_t rows = 0, columns = 0;  ///< of a sheet; 0 for a mesh
};

/// A cloth at one time, in host memory: one entry per node.
struct HostCloth {
    std::span<const Vec3> positions;    ///< m
    std::span<const Vec3> before = {};  ///< of the previous state; may be empty without blending
};

/// The same on the device: a vec4 per node; w is ignored.
struct DeviceCloth {
    vk::Buffer positions;
    std::uint32_t node_count = 0;
    vk::Buffer before = {};  ///< may be null without blending
};

/// A cloth at one time, on the host or on the device.
using ClothFrame = std::variant<HostCloth, DeviceCloth>;

/// A node in contact with a collider.
struct ContactPoint {
    Vec3 position;    ///< m
    float depth = 0;  ///< m, its penetration
};

/// Data of a cloth for overlays besides its frame, from the host; unused fields may be empty.
struct ClothExtras {
    std::span<const float> values = {};        ///< by node: shown as colour instead of strains
    std::span<const std::uint32_t> held = {};  ///< by spring: 1 if a constraint holds it
    std::span<const ContactPoint> contacts = {};
};

/// The content of a picture.
struct PictureState {
    Camera camera = {};  ///< its size and colours are ignored
    double time = 0;     ///< s, which determines the colliders
    OverlaySet overlays = {};
    const ValueScale* scale = nullptr;  ///< of the colours; null: strains up to 10 %
    std::span<const ClothFrame> frames = {};
    std::span<const ClothExtras> extras = {};  ///< per cloth, or empty
    float blend = 1;                           ///< 0: the previous state, 1: that of `frames`
};

namespace vulkan {

class SceneDrawing {
public:
    /// Uploads the fixed data. Up to `slots` pictures may be in flight.
    SceneDrawing(std::shared_ptr<const PictureKit> kit, const Scene& scene,
                 std::span<const ClothTopology> topologies, unsigned slots = 1);

    /// Uploads the springs of a cloth, for overlays that show springs; without it, strains are 0.
    void set_springs(std::size_t cloth, std::span<const DrawnSpring> springs);
    bool has_springs() const { return !cloths_.empty() && cloths_.front().lines.size > 0; }

    /// Sets the state for the next picture in a slot, one entry of `frames` per topology. Overwrites the
    /// buffers of the slot's last picture, whose commands must have completed. Throws Error(bad_usage) for
    /// frames of another size.
    void prepare(const PictureState& state, vk::Extent2D size, unsigned slot = 0);
    /// The area in which the prepared picture, without overlays, differs from the empty stage. Empty if
    /// unknown: positions on the device are not read.
    std::optional<PixelArea> touched(const PictureState& state, vk::Extent2D size, unsigned slot = 0) const;
    /// Records the prepared picture with its shadows. Leaves the render pass of the picture open, so that
    /// more can be drawn on top; `end` closes it.
    void begin(const vk::raii::CommandBuffer& commands, const PictureTarget& target, unsigned slot = 0) const;
    void end(const vk::raii::CommandBuffer& commands) const { commands.endRenderPass(); }

private:
    /// Buffers of a cloth that a picture in flight reads, so the next picture needs others.
    struct ClothSlot {
        Buffer positions, before;     // only for host frames, made with the first of them
        Buffer values, held, points;  // only for overlays, made with the first of them
        std::uint32_t point_count = 0, stride = 0;
        bool has_values = false, has_held = false;
        vk::raii::DescriptorSet drawn_set{nullptr}, surface_set{nullptr};
        std::array<vk::Buffer, cloth_binding_count> bound{};
    };
    /// One cloth on the device.
    struct ClothDrawing {
        std::uint32_t node_count = 0, rows = 0, columns = 0, index_count = 0, line_count = 0, edge_count = 0;
        Buffer indices, pattern, ring, lines, neighbours, edges;
        Buffer positions, normals, strains;  // visible state, computed by shaders/cloth_surface.comp
        std::vector<ClothSlot> slots;
    };
    struct Slot {
        Buffer uniforms;
        vk::raii::DescriptorSet frame_set{nullptr};
        std::vector<PlacedCollider> placed;  // at the time of the picture
        OverlaySet overlays;
        LegendText legend{};
    };

    template <class T>
    Buffer make_filled(const std::vector<T>& values, const char* name) const;
    ClothDrawing make_cloth(const Cloth& cloth, const ClothTopology& topology, unsigned slots) const;
    Slot make_slot() const;
    void bind_cloth(const ClothDrawing& cloth, ClothSlot& slot, const ClothFrame& frame,
                    const ClothExtras& extras) const;
    void upload(const ClothDrawing& cloth, ClothSlot& slot, const HostCloth& frame) const;
    void take_extras(const ClothDrawing& cloth, ClothSlot& slot, const ClothExtras& extras) const;
    void record_surfaces(const vk::raii::CommandBuffer& commands, unsigned slot) const;
    void record_shadows(const vk::raii::CommandBuffer& commands, unsigned slot) const;
    void record_picture(const vk::raii::CommandBuffer& commands, const PictureTarget& target,
                        unsigned slot) const;
    void draw_outlines(const vk::raii::CommandBuffer& commands, unsigned slot) const;
    void draw_overlays(const vk::raii::CommandBuffer& commands, vk::Extent2D size, unsigned slot) const;
    void draw_cloths(const vk::raii::CommandBuffer& commands, unsigned slot) const;
    void draw_shapes(const vk::raii::CommandBuffer& commands, unsigned slot) const;
    void draw_floors(const vk::raii::CommandBuffer& commands, unsigned slot) const;
    void bind(const vk::raii::CommandBuffer& commands, Drawn drawn) const;
    void bind_set(const vk::raii::CommandBuffer& commands, const ClothSlot& slot) const;
    template <class Constants>
    void push(const vk::raii::CommandBuffer& commands, const Constants& constants) const;

    std::shared_ptr<const PictureKit> kit_;
    std::shared_ptr<Device> device_;
    std::vector<Collider> colliders_;
    Stage stage_;
    vk::raii::DescriptorPool pool_{nullptr};
    Buffer nothing_;  // bound in place of a cloth's missing buffers
    std::vector<Slot> slots_;
    std::vector<ClothDrawing> cloths_;
};

}  // namespace vulkan
}  // namespace pliant

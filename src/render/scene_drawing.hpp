// What is drawn: the cloths, colliders, floor and light of a scene. It knows no target: an off-screen picture
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

/// What does not change of a cloth.
struct ClothTopology {
    std::span<const Triangle> triangles;
    std::uint32_t node_count = 0;
    std::uint32_t rows = 0, columns = 0;  ///< of a sheet; 0 for a mesh
};

/// A cloth at a moment, in the memory of the host: one entry for each node.
struct HostCloth {
    std::span<const Vec3> positions;    ///< m
    std::span<const Vec3> before = {};  ///< of the state before; may be empty without blending
};

/// The same on the device: a vec4 for each node, whose w counts for nothing.
struct DeviceCloth {
    vk::Buffer positions;
    std::uint32_t node_count = 0;
    vk::Buffer before = {};  ///< may be null without blending
};

/// A cloth at a moment: on the host, or where the simulation has it on the device.
using ClothFrame = std::variant<HostCloth, DeviceCloth>;

/// A node that touches a collider.
struct ContactPoint {
    Vec3 position;    ///< m
    float depth = 0;  ///< m, that it has sunk in
};

/// What overlays need of a cloth beside its frame, from the host; what is not needed may be empty.
struct ClothExtras {
    std::span<const float> values = {};        ///< the colour at each node, instead of the strains
    std::span<const std::uint32_t> held = {};  ///< by spring: 1 where a constraint holds it
    std::span<const ContactPoint> contacts = {};
};

/// Everything that a picture shows.
struct PictureState {
    Camera camera = {};  ///< its size and colour count for nothing here
    double time = 0;     ///< s, which places the colliders
    OverlaySet overlays = {};
    const ValueScale* scale = nullptr;  ///< of the colours; null: strains up to 10 %
    std::span<const ClothFrame> frames = {};
    std::span<const ClothExtras> extras = {};  ///< for each cloth, or none at all
    float blend = 1;                           ///< 0: the state before, 1: that of `frames`
};

namespace vulkan {

class SceneDrawing {
public:
    /// Uploads what does not change. Up to `slots` pictures may be on their way at a time.
    SceneDrawing(std::shared_ptr<const PictureKit> kit, const Scene& scene,
                 std::span<const ClothTopology> topologies, unsigned slots = 1);

    /// Uploads the springs of a cloth, for the overlays that show them; without, strains are 0.
    void set_springs(std::size_t cloth, std::span<const DrawnSpring> springs);
    bool has_springs() const { return !cloths_.empty() && cloths_.front().lines.size > 0; }

    /// Takes the state that the next picture of a slot shows, one entry of its frames for each topology. The
    /// commands of the slot's last picture must have run: what they read is written here. Throws
    /// Error(bad_usage) for frames of another size.
    void prepare(const PictureState& state, vk::Extent2D size, unsigned slot = 0);
    /// Where the picture that was prepared, without its overlays, differs from one of the empty stage. None
    /// where that is not known: positions on the device are not looked at.
    std::optional<PixelArea> touched(const PictureState& state, vk::Extent2D size, unsigned slot = 0) const;
    /// Records the picture that was prepared: shadows and the picture itself. The render pass of the picture
    /// is left open, so that more can be drawn over it; `end` closes it.
    void begin(const vk::raii::CommandBuffer& commands, const PictureTarget& target, unsigned slot = 0) const;
    void end(const vk::raii::CommandBuffer& commands) const { commands.endRenderPass(); }

private:
    /// What a picture on its way reads of a cloth, so that the next one must not write it.
    struct ClothSlot {
        Buffer positions, before;     // only for host frames, made with the first of them
        Buffer values, held, points;  // only for overlays, made when one is there
        std::uint32_t point_count = 0, stride = 0;
        bool has_values = false, has_held = false;
        vk::raii::DescriptorSet drawn_set{nullptr}, surface_set{nullptr};
        std::array<vk::Buffer, cloth_binding_count> bound{};
    };
    /// One cloth on the device.
    struct ClothDrawing {
        std::uint32_t node_count = 0, rows = 0, columns = 0, index_count = 0, line_count = 0, edge_count = 0;
        Buffer indices, pattern, ring, lines, neighbours, edges;
        Buffer positions, normals, strains;  // as seen; shaders/cloth_surface.comp makes them
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
    Buffer nothing_;  // bound where a cloth has nothing to show
    std::vector<Slot> slots_;
    std::vector<ClothDrawing> cloths_;
};

}  // namespace vulkan
}  // namespace pliant

// One cloth on the device: one buffer per attribute, and the sets that bind them for either copy of the
// state.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "backend/pass_runner.hpp"
#include "backend/vulkan/bindings.hpp"
#include "backend/vulkan/body_buffers.hpp"
#include "backend/vulkan/device.hpp"
#include "backend/vulkan/solver_buffers.hpp"
#include "body/cloth_model.hpp"
#include "solve/pass.hpp"

namespace pliant::vulkan {

vk::raii::DescriptorSetLayout make_cloth_layout(const Device& device, PassLayout layout);

class ClothBuffers {
public:
    /// With what each PassLayout is on the device.
    ClothBuffers(const Device& device, const ClothModel& model,
                 std::span<const vk::raii::DescriptorSetLayout> layouts);

    const ClothModel& model() const { return *model_; }
    const MeasureTree& tree() const { return tree_; }
    /// Of families whose passes this kind of cloth takes; others have no sets.
    vk::DescriptorSet set(PassLayout layout, std::uint32_t parity) const
    {
        return *sets_[static_cast<std::size_t>(layout)][parity];
    }
    void bind_colliders(const Device& device, const Buffer& colliders);
    /// Normals and strains are kept from the first time on that somebody looks at them. True when that is
    /// now: what was recorded with these sets must then be recorded anew.
    bool make_room_for(const Device& device, Pass pass);
    /// Where the host's rows of a frame begin.
    struct FrameRows {
        std::uint32_t colliders = 0;                ///< in colliders, of this cloth's origin
        std::uint32_t attached = 0;                 ///< in rows of four numbers
        std::uint32_t goals = 0, goals_stride = 0;  ///< in rows of four numbers; from step to step
    };
    void set_parameters(double step_length, std::uint32_t collider_count, bool colliders_rest,
                        const FrameRows& rows, const GrabInput& grab);
    /// See PassRunner.
    void write(const Device& device, std::span<const Vec3> positions, std::span<const Vec3> velocities);
    void take_mass(const Device& device, std::uint32_t node);

    /// The buffer behind a resource; for next_* that of the other parity.
    const Buffer& buffer(Resource resource, std::uint32_t parity) const;
    std::size_t entry_count(Resource resource) const;

    /// Makes room for what a program keeps aside; copies it there, or back again, with the barriers around
    /// it.
    void make_room_for(const Device& device, const Kept& kept);
    void record_keep(const vk::raii::CommandBuffer& commands, const Kept& kept) const;
    void record_put_back(const vk::raii::CommandBuffer& commands, const Kept& kept) const;

    /// Appends the copy of the root of the measures to where the host reads it.
    void record_root_copy(const vk::raii::CommandBuffer& commands) const;
    MeasureTotals totals() const;
    const SolverBuffers& solver() const { return solver_; }
    const BodyBuffers& body() const { return body_; }

private:
    bool takes(PassLayout layout) const;
    void make_sets(const Device& device, std::span<const vk::raii::DescriptorSetLayout> layouts);
    /// In all sets of this parity that have the binding.
    void bind(const Device& device, std::uint32_t parity, Binding binding, const Buffer& buffer);
    /// A piece of a buffer, and where in kept_ it goes.
    struct KeptPiece {
        const Buffer* buffer;
        vk::DeviceSize first, place, size;  ///< bytes
    };
    std::vector<KeptPiece> pieces_of(const Kept& kept) const;
    Buffer filled(const Device& device, const void* data, std::size_t bytes, const char* name) const;

    const ClothModel* model_;
    MeasureTree tree_;
    std::array<Buffer, 2> position_, velocity_;
    Buffer parameters_, external_force_, spring_force_, slopes_, normal_, strain_, measures_, root_;
    Buffer springs_, spring_rest_class_, neighbour_start_, neighbours_, kept_;
    Buffer triangles_, triangle_start_, node_triangles_;
    SolverBuffers solver_;
    BodyBuffers body_;
    vk::raii::DescriptorPool pool_{nullptr};
    std::array<std::vector<vk::raii::DescriptorSet>, layout_count> sets_;  ///< of either parity
};

}  // namespace pliant::vulkan

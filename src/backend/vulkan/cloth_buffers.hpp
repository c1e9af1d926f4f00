// One cloth on the device: one buffer per attribute, and the descriptor sets for either copy of the state.
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
    /// `layouts`: the device's descriptor set layout for each PassLayout.
    ClothBuffers(const Device& device, const ClothModel& model,
                 std::span<const vk::raii::DescriptorSetLayout> layouts);

    const ClothModel& model() const { return *model_; }
    const MeasureTree& tree() const { return tree_; }
    /// Only for layouts that this kind of cloth uses; others have no sets.
    vk::DescriptorSet set(PassLayout layout, std::uint32_t parity) const
    {
        return *sets_[static_cast<std::size_t>(layout)][parity];
    }
    void bind_colliders(const Device& device, const Buffer& colliders);
    /// Allocates normals and strains when they are first read. Returns whether it did: commands recorded with
    /// these sets must then be recorded again.
    bool make_room_for(const Device& device, Pass pass);
    /// Where the host's rows of a frame begin.
    struct FrameRows {
        std::uint32_t colliders = 0;                ///< first row of colliders, for this cloth's origin
        std::uint32_t attached = 0;                 ///< first row, in rows of four numbers
        std::uint32_t goals = 0, goals_stride = 0;  ///< first row, and rows per step
    };
    void set_parameters(double step_length, std::uint32_t collider_count, bool colliders_rest,
                        const FrameRows& rows, const GrabInput& grab);
    /// See PassRunner.
    void write(const Device& device, std::span<const Vec3> positions, std::span<const Vec3> velocities);
    void take_mass(const Device& device, std::uint32_t node);

    /// The buffer of a resource; for next_* that of the other parity.
    const Buffer& buffer(Resource resource, std::uint32_t parity) const;
    std::size_t entry_count(Resource resource) const;

    /// Allocates the copies that a program saves; records the copy there, or back, with its barriers.
    void make_room_for(const Device& device, const Kept& kept);
    void record_keep(const vk::raii::CommandBuffer& commands, const Kept& kept) const;
    void record_put_back(const vk::raii::CommandBuffer& commands, const Kept& kept) const;

    /// Records a copy of the root of the measures to a buffer that the host reads.
    void record_root_copy(const vk::raii::CommandBuffer& commands) const;
    MeasureTotals totals() const;
    const SolverBuffers& solver() const { return solver_; }
    const BodyBuffers& body() const { return body_; }

private:
    bool takes(PassLayout layout) const;
    void make_sets(const Device& device, std::span<const vk::raii::DescriptorSetLayout> layouts);
    /// In all sets of this parity with the binding.
    void bind(const Device& device, std::uint32_t parity, Binding binding, const Buffer& buffer);
    /// A range of a buffer, and its place in kept_.
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
    std::array<std::vector<vk::raii::DescriptorSet>, layout_count> sets_;  ///< by parity
};

}  // namespace pliant::vulkan

#include "backend/vulkan/vulkan_runner.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <set>

#include "backend/vulkan/barrier_plan.hpp"
#include "backend/vulkan/cloth_buffers.hpp"
#include "backend/vulkan/layout.hpp"
#include "backend/vulkan/pass_pipelines.hpp"
#include "backend/vulkan/segments.hpp"
#include "backend/vulkan/sheet_tile.hpp"
#include "solve/frame.hpp"
#include "solve/mass_spring.hpp"

namespace pliant {
namespace {

using namespace vulkan;

ColliderRows pack_collider(const PlacedCollider& placed)
{
    const auto c = make_collider<float>(placed);
    const auto row = [](Vector3<float> a, float w = 0) { return Float4{a.x, a.y, a.z, w}; };
    return {.centre_kind = row(c.centre, static_cast<float>(c.kind)),
            .axis_x_radius = row(c.axis_x, c.radius),
            .axis_y_friction = row(c.axis_y, c.friction),
            .axis_z_response = row(c.axis_z, static_cast<float>(c.response)),
            .half_size = row(c.half_size),
            .velocity = row(c.velocity),
            .spin = row(c.spin),
            .unused = {}};
}

/// The commands of a segment, with a timestamp before, between and after its batches of calls of one pass.
struct Recording {
    struct Stretch {
        Pass pass;
        std::uint64_t calls = 0;
    };
    Segment segment;
    std::uint32_t cloth = 0;  ///< of the first call
    Guard guard = Guard::none;
    vk::raii::CommandBuffer commands{nullptr};
    vk::raii::QueryPool queries{nullptr};
    std::vector<Stretch> stretches;
};

std::shared_ptr<Device> device_for(const SimulationOptions& options)
{
    if (options.shared_device) return options.shared_device;
    return std::make_shared<Device>(DeviceOptions{.index = options.device,
                                                  .validation = options.validation,
                                                  .pipeline_folder = options.pipeline_folder});
}

class Runner final : public VulkanRunner {
public:
    Runner(std::span<const ClothModel> models, const SimulationOptions& options)
        : device_(device_for(options)),
          pipelines_(PassPipelines::of(*device_, options.fast_math)),
          lane_(*device_),
          fast_math_(options.fast_math)
    {
        steps_at_once_ = pipelines_->sheet_steps(options.gpu_substeps);
        pipelines_->make(*device_, dispatches_of(usual_calls(models), steps_at_once_));
        for (const ClothModel& model : models) {
            const auto known = std::find(origins_.begin(), origins_.end(), model.shape.origin);
            origin_of_.push_back(static_cast<std::size_t>(known - origins_.begin()));
            if (known == origins_.end()) origins_.push_back(model.shape.origin);
        }
        cloths_.reserve(models.size());
        for (const ClothModel& model : models) cloths_.emplace_back(*device_, model, pipelines_->sets());
        check_sizes(models);
        reserve_colliders(1);
    }

    void run(const Program& program, const FrameInput& input) override
    {
        // Colliders come first, in the coordinates of each cloth's origin; then positions of attached nodes
        // and targets of bodies, each a row of four numbers.
        const std::size_t placed = input.colliders.size();
        std::size_t rows = rows_of_collider * placed * origins_.size();
        for (const std::vector<Vec3>& places : input.attached) rows += places.size();
        for (const std::vector<VolumeGoal>& goals : input.goals) rows += goals.size();
        for (const ClothBuffers& cloth : cloths_) rows += part_count(cloth);
        reserve_colliders((rows + rows_of_collider - 1) / rows_of_collider);
        for (std::size_t o = 0; o < origins_.size(); ++o)
            for (std::size_t k = 0; k < placed; ++k) {
                const ColliderRows row = pack_collider(seen_from(input.colliders[k], origins_[o]));
                std::memcpy(static_cast<ColliderRows*>(colliders_.mapped) + o * placed + k, &row, sizeof row);
            }
        std::size_t first = rows_of_collider * placed * origins_.size();
        for (std::size_t c = 0; c < cloths_.size(); ++c) {
            ClothBuffers::FrameRows at;
            at.colliders = static_cast<std::uint32_t>(origin_of_[c] * placed);
            at.goals = static_cast<std::uint32_t>(first);
            first += write_goals(c, input, first, at.goals_stride);
            at.attached = static_cast<std::uint32_t>(first);
            cloths_[c].set_parameters(input.step_length, input.collider_count, input.colliders_rest, at,
                                      input.grab_of(c));
            if (input.attached.empty()) continue;
            const auto& nodes = cloths_[c].model().attachments.nodes;
            for (std::size_t k = 0; k < input.attached[c].size(); ++k, ++first) {
                const Vec3 place = input.attached[c][k];
                const Float4 row{place.x, place.y, place.z, static_cast<float>(nodes[k % nodes.size()].node)};
                std::memcpy(static_cast<Float4*>(colliders_.mapped) + first, &row, sizeof row);
            }
        }
        replay(program);
        parity_ = program.parity_after;
    }

    void put_back(const Kept& kept) override
    {
        device_->run([&](const vk::raii::CommandBuffer& commands) {
            cloths_[kept.cloth].record_put_back(commands, kept);
        });
    }

    void read(std::uint32_t cloth, Resource resource, std::uint32_t parity,
              std::vector<float>& values) override
    {
        const ClothBuffers& buffers = cloths_[cloth];
        const std::size_t count = buffers.entry_count(resource);
        const bool drawn = resource == Resource::normal || resource == Resource::strain;
        if (drawn && buffers.buffer(resource, parity).size == 0) {  // not read before
            values.assign((resource == Resource::normal ? 3 : 1) * count, 0.0f);
            return;
        }
        if (resource == Resource::multiplier && buffers.model().hierarchy.empty()) {
            values.assign(count, 0.0f);
            return;
        }
        if (resource == Resource::strain || resource == Resource::multiplier ||
            resource == Resource::measures) {
            values.resize(count * (resource == Resource::measures ? 8 : 1));
            device_->read(buffers.buffer(resource, parity), values.data(), values.size() * sizeof(float));
            return;
        }
        if (const BodyBuffers::Rows rows = buffers.body().rows_of(resource); rows.count > 0) {
            std::vector<Float4>& all = padded_;
            all.resize(rows.first + rows.count);
            device_->read(buffers.buffer(resource, parity), all.data(), all.size() * sizeof(Float4));
            values.clear();
            for (std::size_t k = rows.first; k < all.size(); ++k) {
                values.push_back(all[k].x);
                if (resource != Resource::volumes)
                    values.insert(values.end(), {all[k].y, all[k].z, all[k].w});
            }
            return;
        }
        padded_.resize(count);
        device_->read(buffers.buffer(resource, parity), padded_.data(), count * sizeof(Float4));
        const std::size_t numbers = resource == Resource::blocked ? 4 : 3;
        values.resize(numbers * count);
        for (std::size_t i = 0; i < count; ++i)
            std::memcpy(&values[numbers * i], &padded_[i], numbers * sizeof(float));
    }

    void write(std::uint32_t cloth, std::span<const Vec3> positions,
               std::span<const Vec3> velocities) override
    {
        cloths_[cloth].write(*device_, positions, velocities);
    }
    void take_mass(std::uint32_t cloth, std::uint32_t node) override
    {
        cloths_[cloth].take_mass(*device_, node);
    }

    double volume(std::uint32_t cloth, std::size_t body) override
    {
        return cloths_[cloth].body().volume(body);
    }
    double solver_scalar(std::uint32_t cloth, std::size_t number) override
    {
        return cloths_[cloth].solver().scalar(number);
    }
    void solver_numbers(std::uint32_t cloth, std::size_t first, std::size_t count,
                        std::vector<float>& values) override
    {
        values.resize(count);
        device_->read(cloths_[cloth].solver().arena(), values.data(), count * sizeof(float),
                      first * sizeof(float));
    }
    void write_solver_numbers(std::uint32_t cloth, std::size_t first, std::span<const float> values) override
    {
        device_->write(cloths_[cloth].solver().arena(), values.data(), values.size_bytes(),
                       first * sizeof(float));
    }
    MeasureTotals measures(std::uint32_t cloth) override { return cloths_[cloth].totals(); }
    const PassClock& clock() const override { return clock_; }
    std::string device_name() const override
    {
        return device_->info().name + (fast_math_ ? ", fast math" : "");
    }
    unsigned thread_count() const override { return 0; }
    std::uint64_t validation_messages() const override { return device_->validation_messages(); }

    const std::shared_ptr<Device>& device() const override { return device_; }

    vk::Buffer positions_on_device(std::size_t cloth) const override
    {
        return *cloths_[cloth].buffer(Resource::position, parity_);
    }

    DeviceClothBuffers drawable(std::size_t cloth) override
    {
        // Identities of drawing programs are above those of frames.
        const auto index = static_cast<std::uint32_t>(cloth);
        Program program{~0ull - (2ull * index + parity_), {}, parity_};
        if (recordings_.count(program.id) == 0)
            append_drawing(cloths_[cloth].model(), index, parity_, program.calls);
        replay(program);
        const ClothBuffers& buffers = cloths_[cloth];
        return {*buffers.buffer(Resource::position, parity_), *buffers.buffer(Resource::normal, parity_),
                *buffers.buffer(Resource::strain, parity_), buffers.model().node_count()};
    }

private:
    /// so that a host with varying frame lengths does not fill the memory
    static constexpr std::size_t most_recordings = 64;

    static std::size_t part_count(const ClothBuffers& cloth)
    {
        return cloth.model().body ? cloth.model().body->parts.size() : 0;
    }

    /// Writes the targets of a cloth's bodies from row `first` on; returns the number of rows, and rows per
    /// step.
    std::size_t write_goals(std::size_t c, const FrameInput& input, std::size_t first,
                            std::uint32_t& stride) const
    {
        const std::size_t parts = part_count(cloths_[c]);
        std::vector<VolumeGoal> at_start;
        std::span<const VolumeGoal> goals;
        if (!input.goals.empty()) goals = input.goals[c];
        if (parts > 0 && goals.size() < parts) {
            for (std::size_t k = 0; k < parts; ++k)
                at_start.push_back(cloths_[c].model().body->goal_at(k, 0));
            goals = at_start;
        }
        stride = goals.size() > parts ? static_cast<std::uint32_t>(parts) : 0;
        for (std::size_t k = 0; k < goals.size(); ++k) {
            const Float4 row{static_cast<float>(goals[k].volume), static_cast<float>(goals[k].pressure)};
            std::memcpy(static_cast<Float4*>(colliders_.mapped) + first + k, &row, sizeof row);
        }
        return goals.size();
    }

    Groups groups_of(const Dispatch& dispatch) const
    {
        const Call& call = dispatch.call;
        const ClothBuffers& cloth = cloths_[call.cloth];
        const ClothModel& model = cloth.model();
        if (is_solver_pass(call.pass)) return cloth.solver().groups_of(call);
        if (is_body_pass(call.pass)) return {cloth.body().groups_of(call)};
        const auto groups = [](std::uint64_t n, std::uint64_t size) { return (n + size - 1) / size; };
        if (dispatch.steps > 1) {
            const SheetTile& tile = pipelines_->tile(dispatch.steps);
            return {groups(model.shape.sheet->columns, tile.columns),
                    groups(model.shape.sheet->rows, tile.rows)};
        }
        switch (unit_of(call.pass)) {
            case PassUnit::single: return {1};
            case PassUnit::attached_node: return {groups(model.attachments.nodes.size(), linear_group)};
            case PassUnit::spring: return {groups(model.springs.list.size(), linear_group)};
            case PassUnit::block: return {cloth.tree().levels.front().count};
            case PassUnit::merged_block: return {cloth.tree().levels[call.index].count};
            default: break;
        }
        if (layout_of(call.pass) == PassLayout::nodes)  // of a sheet
            return {groups(model.shape.sheet->columns, sheet_group_columns),
                    groups(model.shape.sheet->rows, sheet_group_rows)};
        return {groups(model.node_count(), linear_group)};
    }

    /// The calls that all frames consist of, so that the first frame need not wait for their pipelines; with
    /// enough steps that every number of steps per dispatch of dispatches_of occurs.
    std::vector<Call> usual_calls(std::span<const ClothModel> models) const
    {
        std::vector<Call> calls;
        append_frame(models, 1, 0, calls);
        if (steps_at_once_ > 1) append_frame(models, 2 * steps_at_once_ + 3, 0, calls);
        return calls;
    }

    /// Checks that the device can run every call of a frame in one dispatch.
    void check_sizes(std::span<const ClothModel> models) const
    {
        const auto most = device_->physical().getProperties().limits.maxComputeWorkGroupCount;
        std::vector<Call> calls;
        append_frame(models, 1, 0, calls);
        for (std::uint32_t c = 0; c < models.size(); ++c) append_drawing(models[c], c, 0, calls);
        for (const Call& call : calls) {
            const Groups groups = groups_of({call});
            for (std::uint32_t axis = 0; axis < 2; ++axis) {
                const std::uint64_t needed = axis == 0 ? groups.x : groups.y;
                if (needed <= most[axis]) continue;
                throw Error(ErrorKind::device_failure,
                            "a cloth of " + std::to_string(models[call.cloth].node_count()) +
                                " nodes is too large for " + device_->info().name +
                                ": its limit maxComputeWorkGroupCount[" + std::to_string(axis) + "] is " +
                                std::to_string(most[axis]) + ", and the pass " +
                                description_of(call.pass).name + " needs " + std::to_string(needed) +
                                "; use fewer nodes or another backend");
            }
        }
    }

    void reserve_colliders(std::size_t count)
    {
        const std::size_t bytes = count * sizeof(ColliderRows);
        if (colliders_.size >= bytes && colliders_.size > 0) return;
        recordings_.clear();  // they refer to the sets that change now
        colliders_ =
            device_->make_buffer(bytes, vk::BufferUsageFlagBits::eStorageBuffer, Memory::upload, "colliders");
        for (ClothBuffers& cloth : cloths_) cloth.bind_colliders(*device_, colliders_);
    }

    void replay(const Program& program)
    {
        auto found = recordings_.find(program.id);
        if (found == recordings_.end()) {
            bool sets_changed = false;
            for (const Call& call : program.calls)
                sets_changed |= cloths_[call.cloth].make_room_for(*device_, call.pass);
            for (const Kept& kept : program.keeps) cloths_[kept.cloth].make_room_for(*device_, kept);
            if (sets_changed || recordings_.size() >= most_recordings) recordings_.clear();
        }
        if (found == recordings_.end()) found = recordings_.emplace(program.id, cut(program)).first;
        std::vector<Recording>& recordings = found->second;
        for (std::size_t s = 0; s < recordings.size();) {
            Recording& recording = recordings[s];
            if (recording.segment.looks && cloths_[recording.cloth].solver().skips(recording.guard)) {
                s = recording.segment.next;
                continue;
            }
            if (!*recording.commands) record(program, recording);
            lane_.run(recording.commands);
            if (*recording.queries) take_times(recording);
            ++s;
        }
    }

    /// The segments of a program, not yet recorded: most of Newton's iterations are rarely needed.
    static std::vector<Recording> cut(const Program& program)
    {
        std::vector<Recording> recordings;
        for (const Segment& segment : segments_of(program.calls)) {
            const Call& call = program.calls[segment.first];
            recordings.emplace_back();
            recordings.back().segment = segment;
            recordings.back().cloth = call.cloth;
            recordings.back().guard = call.guard;
        }
        return recordings;
    }

    void record(const Program& program, Recording& recording) const
    {
        const Segment& segment = recording.segment;
        const std::vector<Dispatch> dispatches = dispatches_of(
            std::span(program.calls).subspan(segment.first, segment.end - segment.first), steps_at_once_);
        pipelines_->make(*device_, dispatches);
        for (const Dispatch& d : dispatches) {
            if (recording.stretches.empty() || recording.stretches.back().pass != d.call.pass)
                recording.stretches.push_back({d.call.pass, 0});
            recording.stretches.back().calls += d.steps;
        }
        const auto query_count = static_cast<std::uint32_t>(recording.stretches.size() + 1);
        if (device_->timestamp_period() > 0 && !recording.stretches.empty())
            recording.queries = {device_->handle(),
                                 vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, query_count)};
        const bool timed = static_cast<bool>(*recording.queries);

        recording.commands = lane_.make_commands();
        const vk::raii::CommandBuffer& commands = recording.commands;
        commands.begin({});
        if (timed) commands.resetQueryPool(*recording.queries, 0, query_count);
        if (segment.first == 0)
            for (const Kept& kept : program.keeps) cloths_[kept.cloth].record_keep(commands, kept);
        // Writes by the host or an earlier submission.
        barrier(commands, vk::PipelineStageFlagBits::eAllCommands, vk::AccessFlagBits::eMemoryWrite,
                vk::PipelineStageFlagBits::eComputeShader,
                vk::AccessFlagBits::eShaderRead | vk::AccessFlagBits::eShaderWrite |
                    vk::AccessFlagBits::eUniformRead);
        BarrierPlan plan;
        std::set<std::uint32_t> measured, solved, volumes;
        std::uint32_t query = 0;
        if (timed)
            commands.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *recording.queries, query++);
        for (std::size_t d = 0; d < dispatches.size(); ++d) {
            const Call& call = dispatches[d].call;
            const bool last = d + 1 == dispatches.size() || dispatches[d + 1].call.pass != call.pass;
            if (plan.needed_before(call))
                barrier(commands, vk::PipelineStageFlagBits::eComputeShader, vk::AccessFlagBits::eShaderWrite,
                        vk::PipelineStageFlagBits::eComputeShader,
                        vk::AccessFlagBits::eShaderRead | vk::AccessFlagBits::eShaderWrite);
            record(commands, dispatches[d]);
            if (timed && last)
                commands.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *recording.queries,
                                        query++);
            if (call.pass == Pass::sheet_measure || call.pass == Pass::list_measure)
                measured.insert(call.cloth);
            if (is_solver_pass(call.pass)) solved.insert(call.cloth);
            if (call.pass == Pass::volume_total) volumes.insert(call.cloth);
        }
        if (!measured.empty() || !volumes.empty() || !solved.empty()) {
            barrier(commands, vk::PipelineStageFlagBits::eComputeShader, vk::AccessFlagBits::eShaderWrite,
                    vk::PipelineStageFlagBits::eTransfer, vk::AccessFlagBits::eTransferRead);
            for (const std::uint32_t cloth : measured) cloths_[cloth].record_root_copy(commands);
            for (const std::uint32_t cloth : volumes) cloths_[cloth].body().record_volume_copy(commands);
            for (const std::uint32_t cloth : solved) cloths_[cloth].solver().record_scalar_copy(commands);
            barrier(commands, vk::PipelineStageFlagBits::eTransfer, vk::AccessFlagBits::eTransferWrite,
                    vk::PipelineStageFlagBits::eHost, vk::AccessFlagBits::eHostRead);
        }
        commands.end();
    }

    void record(const vk::raii::CommandBuffer& commands, const Dispatch& dispatch) const
    {
        const Call& call = dispatch.call;
        const ClothBuffers& cloth = cloths_[call.cloth];
        Push push{};
        push.index = call.index;
        if (call.pass == Pass::measure_merge) {
            const auto from = cloth.tree().levels[call.index - 1];
            push.source_first = from.first;
            push.source_count = from.count;
            push.target_first = cloth.tree().levels[call.index].first;
        }
        if (call.pass == Pass::attach)
            push.source_count = static_cast<std::uint32_t>(cloth.model().attachments.nodes.size());
        push.level = call.level;
        push.detail = call.detail;
        push.guard = static_cast<std::uint32_t>(call.guard);
        const SumSlots slots = sum_slots_of(call.pass);
        push.slot_first = slots.first;
        push.slot_count = slots.count;
        const Groups groups = groups_of(dispatch);
        if (groups.x == 0) return;  // a mesh without springs
        commands.bindPipeline(vk::PipelineBindPoint::eCompute, pipelines_->of(dispatch));
        const PassLayout layout_name = layout_of(call.pass);
        const vk::PipelineLayout layout = pipelines_->layout(layout_name);
        commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, layout, 0,
                                    cloth.set(layout_name, call.parity), {});
        commands.pushConstants<Push>(layout, vk::ShaderStageFlagBits::eCompute, 0, push);
        commands.dispatch(static_cast<std::uint32_t>(groups.x), static_cast<std::uint32_t>(groups.y), 1);
    }

    void take_times(const Recording& recording)
    {
        // Uses the C function: vulkan.hpp would allocate an array in every frame.
        const auto count = static_cast<std::uint32_t>(recording.stretches.size() + 1);
        ticks_.resize(count);
        const VkResult result = recording.queries.getDispatcher()->vkGetQueryPoolResults(
            *device_->handle(), *recording.queries, 0, count, count * sizeof(std::uint64_t), ticks_.data(),
            sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
        if (result != VK_SUCCESS) return;
        for (std::size_t s = 0; s < recording.stretches.size(); ++s) {
            const double nanoseconds = static_cast<double>(device_->ticks_between(ticks_[s], ticks_[s + 1])) *
                                       device_->timestamp_period();
            clock_.add(recording.stretches[s].pass, nanoseconds * 1e-6, recording.stretches[s].calls);
        }
    }

    std::shared_ptr<Device> device_;
    std::shared_ptr<PassPipelines> pipelines_;
    CommandLane lane_;  // its own: the simulation may step on another thread than the drawing one
    std::vector<ClothBuffers> cloths_;
    std::vector<Vec3d> origins_;          ///< the distinct origins of all cloths
    std::vector<std::size_t> origin_of_;  ///< by cloth, index into origins_
    Buffer colliders_;
    std::map<std::uint64_t, std::vector<Recording>> recordings_;
    std::vector<std::uint64_t> ticks_;
    std::vector<Float4> padded_;  ///< the last data read
    PassClock clock_;
    std::uint32_t parity_ = 0;
    bool fast_math_ = false;
    std::uint32_t steps_at_once_ = 1;  ///< steps of a sheet per dispatch
};

}  // namespace

std::unique_ptr<VulkanRunner> make_vulkan_runner(std::span<const ClothModel> cloths,
                                                 const SimulationOptions& options)
{
    if (options.gpu_substeps < 1 || options.gpu_substeps > most_sheet_steps)
        throw Error(ErrorKind::bad_usage, "gpu_substeps is " + std::to_string(options.gpu_substeps) +
                                              ", but must be 1 to " + std::to_string(most_sheet_steps) +
                                              " steps of a sheet per dispatch");
    try {
        return std::make_unique<Runner>(cloths, options);
    } catch (const vk::SystemError& error) {
        throw Error(ErrorKind::device_failure, std::string("the Vulkan device cannot run the passes: ") +
                                                   error.what() +
                                                   "; update its driver, or run with --backend cpu");
    }
}

}  // namespace pliant

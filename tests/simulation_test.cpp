// Whole simulations: backends and threads agree, the public interface works, and long or large runs succeed.
#include <gtest/gtest.h>

#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>

#include "backend/cpu/kernels.hpp"
#include "backend/vulkan/device_state.hpp"
#include "test_cloths.hpp"
#include "test_differences.hpp"
#include "test_errors.hpp"

namespace pliant {
namespace {

struct EndState {
    std::uint64_t hash = 0;
    std::vector<Vec3> positions;
};

EndState end_of(const Scene& scene, const SimulationOptions& options, int frames)
{
    Simulation simulation(scene, options);
    for (int frame = 0; frame < frames; ++frame) simulation.advance(1 / scene.time.frame_rate);
    EXPECT_TRUE(simulation.report().finite);
    EXPECT_EQ(simulation.report().validation_messages, 0u);
    const auto x = simulation.positions();
    return {simulation.state_hash(), {x.begin(), x.end()}};
}

// --- the same state everywhere
// ------------------------------------------------------------------------------------------

TEST(Parity, CpuAndVulkanEndWithTheSameBitsAndFollowTheReference)
{
    const Scene scene = read_scene("parity");
    constexpr int frames = 40;
    const EndState cpu = end_of(scene, test::on(Backend::cpu), frames);
    const EndState vulkan = end_of(scene, test::on(Backend::vulkan), frames);
    const EndState reference = end_of(scene, test::on(Backend::reference), frames);
    EXPECT_EQ(cpu.hash, vulkan.hash);
    // A step rounds positions of 0.5 to 1 m by at most half an ulp, 2^-25 m. Under tension nothing amplifies
    // that, and roundings are nearly independent: over 4,000 steps they add up to sqrt(4,000) of them, 1.9e-6
    // m. The roundings of velocities add as much again.
    constexpr double steps = frames * 100, half_ulp = 0x1p-25;
    const double furthest = test::largest_difference(cpu.positions, reference.positions);
    EXPECT_LE(furthest, 2 * std::sqrt(steps) * half_ulp);
    RecordProperty("furthest_m", std::to_string(furthest));
}

TEST(Runs, RepeatBitByBit)
{
    const Scene scene = read_scene("box_capsule");
    EXPECT_EQ(end_of(scene, test::on(Backend::cpu), 40).hash, end_of(scene, test::on(Backend::cpu), 40).hash);
}

TEST(Runs, MovingCollidersWindAndSeveralClothsAgreeOnCpuAndVulkan)
{
    for (const char* name : {"moving_sphere", "flag", "wind_list", "box_capsule"}) {
        const Scene scene = read_scene(
            name, {"time.substeps=20", "cloths[0].springs.structural.stiffness=20",
                   "cloths[0].springs.shear.stiffness=10", "cloths[0].springs.bend.stiffness=0.1"});
        EXPECT_EQ(end_of(scene, test::on(Backend::cpu), 12).hash,
                  end_of(scene, test::on(Backend::vulkan), 12).hash)
            << name;
    }
    // Free and draped, where rounding decides the folds: the bits must still be equal.
    const Scene draped = read_scene(
        "cloth_sphere", {"method=mass_spring", "cloths[0].sheet.rows=31", "cloths[0].sheet.columns=29"});
    EXPECT_EQ(end_of(draped, test::on(Backend::cpu), 40).hash,
              end_of(draped, test::on(Backend::vulkan), 40).hash);
    Scene scene = read_scene("hanging", {"cloths[0].sheet.rows=9", "cloths[0].sheet.columns=13"});
    scene.air = {.velocity = {1, 2, 3}, .density = 1.2};  // on the mesh, too
    scene.add(Cloth::mesh(test::irregular_mesh(7, 8), {.density = 0.2}));
    scene.add(test::flat_sheet(3, 4));
    EXPECT_EQ(end_of(scene, test::on(Backend::cpu), 6).hash,
              end_of(scene, test::on(Backend::vulkan), 6).hash);
}

// --- the public face
// ------------------------------------------------------------------------------------------------------

Scene small_scene()
{
    Scene scene;
    auto cloth =
        scene.add(Cloth::sheet({.rows = 12, .columns = 10, .width = 1.0, .height = 1.0, .density = 0.3}));
    cloth.pin(Corner::top_left).pin(Corner::top_right);
    scene.add(Sphere{.centre = {0, -0.4, 0}, .radius = 0.3, .friction = 0.4});
    return scene;
}

TEST(Simulation, FollowsTheSnippetOfTheReadme)
{
    Scene scene;
    auto cloth =
        scene.add(Cloth::sheet({.rows = 16, .columns = 16, .width = 1.0, .height = 1.0, .density = 0.3}));
    cloth.pin(Corner::top_left).pin(Corner::top_right);
    scene.add(Sphere{.centre = {0, 0.4, 0}, .radius = 0.3, .friction = 0.4});
    Simulation simulation(scene, {.backend = Backend::automatic});
    while (simulation.time() < 0.5) simulation.advance(1.0 / 60);
    const std::span<const Vec3> x = simulation.positions(cloth);
    ASSERT_EQ(x.size(), 256u);
    EXPECT_EQ(x[0], (Vec3{-0.5f, 0, -0.5f}));
    EXPECT_LT(x[255].y, -0.1f);
    EXPECT_TRUE(simulation.report().finite);
    EXPECT_EQ(simulation.report().frames, 30u);
}

TEST(Simulation, AutomaticStepsAreStable)
{
    Simulation simulation(small_scene(), test::on(Backend::cpu));
    EXPECT_LE(simulation.step_length(), simulation.stable_step() * (1 + 1e-9));
    EXPECT_TRUE(simulation.stability_warning().empty());
    simulation.advance(1.0 / 60);
    EXPECT_EQ(simulation.report().steps, simulation.steps_per_frame());
    EXPECT_NEAR(simulation.time(), 1.0 / 60, 1e-12);
}

TEST(Simulation, ExplicitStepsAreKeptAndWarnedOf)
{
    Scene scene = small_scene();
    scene.time.substeps = 3;
    Simulation simulation(scene, test::on(Backend::cpu));
    EXPECT_EQ(simulation.steps_per_frame(), 3u);
    const std::string warning = simulation.stability_warning();
    EXPECT_NE(warning.find("substeps"), std::string::npos) << warning;
    const auto needed = static_cast<int>(std::ceil(1 / 60.0 / simulation.stable_step()));
    EXPECT_NE(warning.find(std::to_string(needed)), std::string::npos) << warning;
}

TEST(Simulation, WholeStepsAddUpToWhatWasAskedFor)
{
    // 16.67 steps a call, and 0.42 of one.
    for (const std::uint32_t substeps : {40u, 1u}) {
        Scene scene = small_scene();
        scene.time.substeps = substeps;
        scene.time.frame_rate = 60;
        scene.cloth_handle(0)->springs = {.structural = {1, 0}, .shear = {1, 0}, .bend = {1, 0}};
        Simulation simulation(scene, test::on(Backend::cpu));
        const double step = simulation.step_length();
        for (int k = 1; k <= 144; ++k) {
            simulation.advance(1.0 / 144);
            EXPECT_LE(std::abs(simulation.time() - k / 144.0), step * (0.5 + 1e-6));
        }
        EXPECT_EQ(simulation.report().steps, 60 * substeps);
        EXPECT_NEAR(simulation.time(), 1, 1e-12);
    }
}

TEST(Simulation, APutStateOwesNothing)
{
    Scene scene = small_scene();
    scene.time.substeps = 1;
    Simulation simulation(scene, test::on(Backend::cpu));
    const State start = simulation.state();
    simulation.advance(1.4 / 60);
    EXPECT_EQ(simulation.report().steps, 1u);
    simulation.set_state(start);
    simulation.advance(1.4 / 60);  // 0.8 are owed otherwise
    EXPECT_EQ(simulation.report().steps, 2u);
    simulation.advance(1.4 / 60);
    EXPECT_EQ(simulation.report().steps, 4u);
    EXPECT_NEAR(simulation.time(), 3 / 60.0, 1e-12);
}

TEST(Simulation, ALongAdvanceIsTheSameAsItsFrames)
{
    Scene scene = small_scene();
    scene.time.substeps = 100;
    Simulation whole(scene, test::on(Backend::cpu)), frames(scene, test::on(Backend::cpu));
    whole.advance(1.0);  // 6,000 steps, more than one program holds
    for (int frame = 0; frame < 60; ++frame) frames.advance(1.0 / 60);
    EXPECT_EQ(whole.report().steps, 6000u);
    EXPECT_TRUE(whole.report().finite);
    EXPECT_EQ(whole.state_hash(), frames.state_hash());
}

TEST(Simulation, StopsAtANodeThatIsNotFinite)
{
    for (const Backend backend : {Backend::reference, Backend::cpu, Backend::vulkan}) {
        Scene scene = small_scene();
        scene.time.substeps = 1;  // far too few
        Simulation simulation(scene, test::on(backend));
        for (int frame = 0; frame < 2000 && simulation.report().finite; ++frame) simulation.advance(1.0 / 60);
        const Report& report = simulation.report();
        ASSERT_FALSE(report.finite) << name_of(backend);
        EXPECT_EQ(report.bad_frame, report.frames);
        EXPECT_LT(report.bad_node, simulation.node_count());
        const Vec3 x = simulation.positions()[report.bad_node], v = simulation.velocities()[report.bad_node];
        EXPECT_FALSE(std::isfinite(x.x * x.x + x.y * x.y + x.z * x.z) &&
                     std::isfinite(v.x * v.x + v.y * v.y + v.z * v.z));
        const std::uint64_t hash = simulation.state_hash(), frame = report.frames;
        simulation.advance(1.0 / 60);
        EXPECT_EQ(simulation.state_hash(), hash);
        EXPECT_EQ(report.frames, frame);
        while (simulation.time() < 1000) simulation.advance(10);  // ends
    }
}

TEST(Simulation, MeasuresWhatItSays)
{
    Scene scene;
    Cloth cloth = Cloth::sheet({.rows = 2, .columns = 2, .width = 1, .height = 1, .node_mass = 2});
    cloth.velocity = {3, 0, 4};
    cloth.position = {0, 5, 0};
    scene.add(cloth);
    scene.add(Plane{.point = {0, 5.01, 0}});
    for (const Backend backend : {Backend::reference, Backend::cpu, Backend::vulkan}) {
        Simulation simulation(scene, test::on(backend));
        const FrameMeasures& m = simulation.report().measures;
        EXPECT_NEAR(m.kinetic_energy, 4 * 2 * 25 / 2.0, 1e-4);
        EXPECT_NEAR(m.potential_energy, 4 * 2 * 9.81 * 5, 1e-3);
        EXPECT_NEAR(m.max_speed, 5, 1e-5);
        EXPECT_NEAR(m.max_penetration, 0.01 + 0.002, 1e-6);
        EXPECT_NEAR(m.max_stretch, 0, 1e-6);
        EXPECT_NEAR(m.elastic_energy, 0, 1e-9);
        EXPECT_EQ(m.non_finite, 0u);
    }
}

TEST(Simulation, NormalsStrainsAndTrianglesAreThereWhenAsked)
{
    for (const Backend backend : {Backend::reference, Backend::cpu, Backend::vulkan}) {
        Simulation simulation(small_scene(), test::on(backend));
        for (const Vec3& n : simulation.normals()) {
            EXPECT_NEAR(n.y, 1, 1e-6);
            EXPECT_NEAR(n.x, 0, 1e-6);
        }
        EXPECT_EQ(simulation.strains().size(), 120u);
        EXPECT_EQ(simulation.triangles().size(), simulation.triangle_count());
        simulation.advance(0.5);
        test::Largest most;
        for (const float strain : simulation.strains()) most.add(double{strain});
        EXPECT_GT(most.value(), 1e-4);
        EXPECT_NEAR(most.value(), simulation.report().measures.max_stretch, 1e-6);
        EXPECT_LT(simulation.normals()[115].y, 0.999f);  // the free edge hangs down by now
    }
}

/// A host's use of the buffers: its own copy.
void copy_from(const vulkan::Device& device, vk::Buffer source, std::vector<float>& values)
{
    const vk::DeviceSize bytes = values.size() * sizeof(float);
    const auto staging =
        device.make_buffer(bytes, vk::BufferUsageFlagBits::eTransferDst, vulkan::Memory::readback, "copy");
    const auto commands = device.make_commands();
    commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    commands.copyBuffer(source, *staging, vk::BufferCopy(0, 0, bytes));
    commands.end();
    device.run(commands);
    std::memcpy(values.data(), staging.mapped, bytes);
}

TEST(Simulation, LendsItsBuffersOnTheDevice)
{
    EXPECT_FALSE(Simulation(small_scene(), test::on(Backend::cpu)).device_buffers().has_value());
    Simulation simulation(small_scene(), test::on(Backend::vulkan));
    simulation.advance(1.0 / 60);
    const auto before = simulation.device_buffers();
    ASSERT_TRUE(before.has_value());
    EXPECT_EQ(before->node_count, 120u);
    EXPECT_TRUE(before->device && before->instance && before->physical_device);
    EXPECT_TRUE(before->position && before->normal && before->strain);
    for (int frame = 0; frame < 2; ++frame) {
        const auto lent = simulation.device_buffers();
        const DeviceClothBuffers own = simulation.device_state()->drawable(0);
        EXPECT_EQ(lent->position, reinterpret_cast<std::uint64_t>(static_cast<VkBuffer>(own.position)));
        EXPECT_EQ(lent->normal, reinterpret_cast<std::uint64_t>(static_cast<VkBuffer>(own.normal)));
        // The buffer holds what positions() reads: x, y, z and the inverse mass of each node.
        std::vector<float> values(4 * lent->node_count);
        copy_from(*simulation.device_state()->device(), own.position, values);
        for (std::size_t i = 0; i < lent->node_count; ++i)
            EXPECT_EQ((Vec3{values[4 * i], values[4 * i + 1], values[4 * i + 2]}), simulation.positions()[i]);
        EXPECT_EQ(values[3], 0.0f);  // a pinned corner
        simulation.advance(simulation.step_length());
    }
    EXPECT_THROW(simulation.device_buffers(7), std::exception);
}

TEST(Simulation, TimesItsPasses)
{
    for (const Backend backend : {Backend::reference, Backend::cpu, Backend::vulkan}) {
        Simulation simulation(small_scene(), test::on(backend));
        simulation.advance(1.0 / 60);
        bool stepped = false;
        for (const PassTime& pass : simulation.pass_times())
            if (pass.name == "sheet_step") {
                stepped = true;
                EXPECT_EQ(pass.calls, simulation.steps_per_frame());
                EXPECT_GT(pass.milliseconds, 0);
            }
        EXPECT_TRUE(stepped) << name_of(backend);
    }
}

/// A host's own threads: one per task, deliberately inefficient.
class HostJobs final : public JobSystem {
public:
    unsigned thread_count() const override { return 3; }
    void run(unsigned count, void (*task)(void*, unsigned), void* context) override
    {
        ++regions;
        std::vector<std::thread> threads;
        for (unsigned k = 0; k < count; ++k) threads.emplace_back(task, context, k);
        for (std::thread& thread : threads) thread.join();
    }
    int regions = 0;
};

TEST(Simulation, RunsOnTheThreadsOfItsHost)
{
    Scene scene;
    scene.time.substeps = 4;
    scene.add(test::flat_sheet(64, 64))->springs = {{0.1, 0}, {0.05, 0}, {0, 0}};
    HostJobs jobs;
    SimulationOptions options = test::on(Backend::cpu);
    options.job_system = &jobs;
    EXPECT_EQ(end_of(scene, options, 3).hash, end_of(scene, test::on(Backend::cpu), 3).hash);
    EXPECT_GE(jobs.regions, 12);  // steps and measures of three frames
}

TEST(Simulation, RefusesWhatCannotRun)
{
    const auto message_of = [](const auto& make) { return std::string(test::error_of(make).what()); };
    SimulationOptions options = test::on(Backend::cpu);
    options.instruction_set = "avx1024";
    EXPECT_NE(
        message_of([&] { Simulation(small_scene(), options); }).find(cpu::available_kernels().front()->name),
        std::string::npos);
    options = test::on(Backend::vulkan);
    options.shared_device = nullptr;
    options.device = 99;
    EXPECT_NE(message_of([&] { Simulation(small_scene(), options); }).find("device 99"), std::string::npos);
    EXPECT_NE(message_of([&] { Simulation(Scene{}, {}); }).find("cloth"), std::string::npos);
    Scene stiff;
    stiff.add(Cloth::sheet({.rows = 2, .columns = 2, .node_mass = 1e-9}));
    stiff.cloth_handle(0)->springs.structural.stiffness = 1e9;
    EXPECT_NE(message_of([&] { Simulation(stiff, test::on(Backend::cpu)); }).find("100000"),
              std::string::npos);
}

TEST(Simulation, WarnsWhereSinglePrecisionCannotResolveTheSprings)
{
    Scene scene = small_scene();
    EXPECT_EQ(Simulation(scene, test::on(Backend::cpu)).resolution_warning(), "");
    scene.cloth_handle(0)->position = {0, 1e5, 0};  // rounded to 4e-3 m, next to cells of 0.1 m
    const std::string warning = Simulation(scene, test::on(Backend::cpu)).resolution_warning();
    EXPECT_NE(warning.find("origin"), std::string::npos) << warning;
}

TEST(Simulation, OddDurationsDoNoHarm)
{
    Simulation simulation(small_scene(), test::on(Backend::cpu));
    const std::uint64_t hash = simulation.state_hash();
    for (const double duration :
         {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        simulation.advance(duration);
    EXPECT_EQ(simulation.state_hash(), hash);
    EXPECT_EQ(simulation.report().steps, 0u);
    for (int k = 0; k < 100; ++k) simulation.advance(1e-9);
    EXPECT_NEAR(simulation.time(), 1e-7, 1e-12);
}

/// Whose jobs fail.
class BrokenJobs final : public JobSystem {
public:
    unsigned thread_count() const override { return 2; }
    void run(unsigned, void (*)(void*, unsigned), void*) override
    {
        if (++runs > 3) throw std::runtime_error("the host has no threads left");
    }
    int runs = 0;
};

TEST(Simulation, ReportsWhatStoppedIt)
{
    Scene scene;
    scene.add(test::flat_sheet(64, 64))->springs = {{0.1, 0}, {0.05, 0}, {0, 0}};
    BrokenJobs jobs;
    SimulationOptions options = test::on(Backend::cpu);
    options.job_system = &jobs;
    Simulation simulation(scene, options);
    for (int frame = 0; frame < 5; ++frame) simulation.advance(1.0 / 60);
    EXPECT_TRUE(simulation.report().device_lost);
    EXPECT_EQ(simulation.report().failure, "the host has no threads left");
    EXPECT_GT(simulation.time(), 0);
}

TEST(Simulation, ListsDevices)
{
    bool cpu = false, vulkan = false, reference = false;
    for (const DeviceListing& device : list_devices()) {
        cpu |= device.backend == Backend::cpu;
        vulkan |= device.backend == Backend::vulkan;
        reference |= device.backend == Backend::reference;
    }
    EXPECT_TRUE(cpu && vulkan && reference);
}

// --- size
// -------------------------------------------------------------------------------------------------------------------

TEST(Large, SevenMillionNodesRunOnCpuAndVulkan)
{
    // The paper's largest sheet, 2796 x 2796. On llvmpipe a buffer of positions just fits its limit of 128
    // MiB.
    Scene scene;
    scene.add(Cloth::sheet({.rows = 2796, .columns = 2796, .width = 10, .height = 10, .density = 0.3}))
        ->springs = {{0.1, 0}, {0.05, 0}, {0, 0}};
    scene.time.substeps = 2000;
    std::uint64_t hashes[2] = {};
    for (const Backend backend : {Backend::cpu, Backend::vulkan}) {
        SimulationOptions options;
        options.backend = backend;
        Simulation simulation(scene, options);
        EXPECT_EQ(simulation.node_count(), 7817616u);
        simulation.advance(2 * simulation.step_length());
        EXPECT_EQ(simulation.report().steps, 2u);
        EXPECT_TRUE(simulation.report().finite);
        // Positions of 5 m are rounded to 2.4e-7 m: springs of 0.1 N/m on nodes of 3.8e-6 kg add up to 0.1
        // m/s2.
        EXPECT_NEAR(simulation.report().measures.max_speed, 2 * 9.81 * simulation.step_length(),
                    2 * 0.1 * simulation.step_length());
        hashes[backend == Backend::vulkan] = simulation.state_hash();
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace pliant

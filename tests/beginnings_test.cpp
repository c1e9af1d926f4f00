// Which springs the paper's solver treats as constraints, how a model starts, and what a step begins with.
#include <gtest/gtest.h>

#include <algorithm>

#include "backend/cpu/jobs.hpp"
#include "backend/vulkan/shader_code.hpp"
#include "body/cloth_model.hpp"
#include "solve/frame.hpp"
#include "solve/newton_multigrid.hpp"
#include "test_cloths.hpp"

namespace pliant {
namespace {

TEST(ConstraintRows, LeaveOutWhatTwoPinsHold)
{
    Scene scene;
    scene.method = Method::constraint;
    scene.solver = Solver::paper;
    Cloth cloth = test::flat_sheet(4, 5);
    cloth.pin(Edge::top);
    scene.add(cloth);
    const ClothModel model(scene.cloth(0), scene);
    std::size_t held = 0, free = 0;
    for (const Spring& spring : model.springs.list)
        if (spring.spring_class != SpringClass::bend)
            ++(model.masses.inverse(spring.i) > 0 || model.masses.inverse(spring.j) > 0 ? free : held);
    EXPECT_EQ(held, 4u);  // along the edge
    EXPECT_EQ(model.hierarchy.constraints.constraints, free);
    EXPECT_EQ(model.hierarchy.constraints.springs, model.springs.list.size());
}

TEST(ConstraintRows, AreScannedLevelByLevel)
{
    Scene scene;
    scene.method = Method::acad;
    scene.solver = Solver::paper;
    scene.add(test::flat_sheet(20, 20));
    const ClothModel model(scene.cloth(0), scene);
    ASSERT_GT(model.hierarchy.constraints.scan_levels(), 1u);
    std::vector<Call> calls;
    append_frame({&model, 1}, 1, 0, calls);
    std::vector<std::uint32_t> levels;
    for (const Call& call : calls)
        if (call.pass == Pass::paper_scan) levels.push_back(call.detail);
    ASSERT_EQ(levels.size(), model.hierarchy.constraints.scan_levels());
    for (std::uint32_t k = 0; k < levels.size(); ++k) EXPECT_EQ(levels[k], k);
}

TEST(SolverCycle, IsSymmetric)
{
    // Conjugate gradients need a symmetric preconditioner: smoothing after the coarser level must be the
    // reverse of that before it. The pass that writes the residual makes the first smoothing step.
    Scene scene;
    scene.method = Method::constraint;
    scene.newton_multigrid.smoothing = 3;
    scene.add(test::flat_sheet(9, 9));
    const ClothModel model(scene.cloth(0), scene);
    std::vector<Call> calls;
    append_linear_iterations(model, 0, 0, 1, calls);
    std::vector<std::uint32_t> before = {0}, after;
    bool is_back = false;
    for (const Call& call : calls) {
        if (call.level != 0) is_back = true;
        if (call.pass == Pass::level_smooth && call.level == 0)
            (is_back ? after : before).push_back(call.detail >> 1);
    }
    // The coarsest level's solution is in its first copy, others where smoothing left it.
    const auto last = static_cast<std::uint32_t>(model.hierarchy.level_count()) - 1;
    for (const Call& call : calls)
        if (call.pass == Pass::sheet_prolong) {
            EXPECT_EQ(call.detail & 1, call.level == last ? 0u : 1u) << call.level;
        }
    std::reverse(after.begin(), after.end());
    EXPECT_EQ(before, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(after, before);
}

TEST(FloatControls, FlushDenormalsAndRoundToNearest)
{
    const auto code = vulkan::with_float_controls(vulkan::compute_shader(Pass::sheet_step), {true, true});
    std::vector<std::uint32_t> capabilities, modes;
    for (std::size_t at = 5; at < code.size(); at += code[at] >> 16) {
        if ((code[at] & 0xffff) == 17) capabilities.push_back(code[at + 1]);  // OpCapability
        if ((code[at] & 0xffff) == 16 && code[at + 2] > 4000)
            modes.push_back(code[at + 2]);  // OpExecutionMode
    }
    for (const std::uint32_t needed : {4465u, 4467u})  // DenormFlushToZero, RoundingModeRTE
        EXPECT_EQ(std::count(capabilities.begin(), capabilities.end(), needed), 1) << needed;
    EXPECT_EQ(modes, (std::vector<std::uint32_t>{4460, 4462}));  // of the same names
}

TEST(DenormalNumbers, AreFlushedWhereThatIsAskedForAndNotAfterwards)
{
    const auto half = [](float a) {
        volatile float value = a;
        value = value * 0.5f;
        return float{value};
    };
    {
        const cpu::DenormalsFlushed flushed;
        EXPECT_EQ(half(1.2e-38f), 0.0f);  // what comes out
        EXPECT_EQ(half(1.0e-39f), 0.0f);  // and what goes in
    }
    EXPECT_NE(half(1.2e-38f), 0.0f);
}

TEST(StateOfAMesh, IsWhatTheNextStepBeginsWith)
{
    Scene scene;
    scene.add(Cloth::mesh(test::irregular_mesh(9, 7), {.density = 0.3}));
    scene.cloth_handle(0).pin(std::uint32_t{0});
    Simulation simulation(scene, test::on(Backend::cpu));
    const State start = simulation.state();
    for (int k = 0; k < 3; ++k) simulation.advance(1 / 60.0);
    const std::uint64_t expected = simulation.state_hash();
    simulation.set_state(start);
    EXPECT_EQ(simulation.positions()[5], start.cloths[0].positions[5]);  // not what was read before
    for (int k = 0; k < 3; ++k) simulation.advance(1 / 60.0);
    EXPECT_EQ(simulation.state_hash(), expected);
}

TEST(Pins, OfAClothThatIsThrownStandStill)
{
    for (const bool mesh : {false, true}) {
        Scene scene;
        Cloth cloth =
            mesh ? Cloth::mesh(test::irregular_mesh(4, 5), {.density = 0.3}) : test::flat_sheet(4, 5);
        cloth.velocity = {1, 2, 3};
        cloth.pin(std::uint32_t{7});
        scene.add(cloth);
        const ClothModel model(scene.cloth(0), scene);
        for (std::uint32_t vertex = 0; vertex < 20; ++vertex)
            EXPECT_EQ(model.shape.velocities[model.shape.node(vertex)],
                      vertex == 7 ? Vec3{} : (Vec3{1, 2, 3}))
                << vertex;
    }
}

}  // namespace
}  // namespace pliant

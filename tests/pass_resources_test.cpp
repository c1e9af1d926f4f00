// The reads and writes in the table of passes, from which barriers follow: compared with shaders, buffer by
// buffer, and within the solver's arena, which is one buffer, with the effect of each pass.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "backend/pass_runner.hpp"
#include "backend/vulkan/bindings.hpp"
#include "backend/vulkan/shader_code.hpp"
#include "backend/vulkan/shader_needs.hpp"
#include "solve/frame.hpp"
#include "solve/newton_multigrid.hpp"
#include "test_cloths.hpp"
#include "test_runners.hpp"

namespace pliant {
namespace {

using vulkan::Binding;

/// The buffer that a resource lies in. Body sums hold several.
Binding binding_of(Resource resource)
{
    switch (resource) {
        case Resource::position: return Binding::position_in;
        case Resource::velocity: return Binding::velocity_in;
        case Resource::next_position: return Binding::position_out;
        case Resource::next_velocity: return Binding::velocity_out;
        case Resource::external_force: return Binding::external_force;
        case Resource::spring_force: return Binding::spring_force;
        case Resource::slopes: return Binding::slopes;
        case Resource::colliders: return Binding::colliders;
        case Resource::measures: return Binding::measures;
        case Resource::normal: return Binding::normal;
        case Resource::strain: return Binding::strain;
        case Resource::multiplier: return Binding::multiplier;
        case Resource::gradient: return Binding::gradient;
        case Resource::direction: return Binding::direction;
        case Resource::blocked: return Binding::blocked;
        case Resource::rate_sums:
        case Resource::cubic_sums:
        case Resource::bodies:
        case Resource::volumes: return Binding::body_sums;
        case Resource::motion:
        case Resource::vectors:
        case Resource::blocks:
        case Resource::flags: return Binding::solver_arena;
        case Resource::scalars: return Binding::solver_scalars;
        case Resource::sums: return Binding::solver_parts;
    }
    return Binding::parameters;
}

std::set<std::uint32_t> bindings_of(std::span<const Resource> resources)
{
    std::set<std::uint32_t> bindings;
    for (const Resource resource : resources)
        bindings.insert(static_cast<std::uint32_t>(binding_of(resource)));
    return bindings;
}

TEST(PassResources, AreTheBuffersOfTheShaders)
{
    const auto number = [](Binding binding) { return static_cast<std::uint32_t>(binding); };
    // Never written: topology, and data of springs.
    const std::set<std::uint32_t> constant = {
        number(Binding::springs),        number(Binding::spring_rest_class), number(Binding::neighbour_start),
        number(Binding::neighbours),     number(Binding::triangles),         number(Binding::triangle_start),
        number(Binding::node_triangles), number(Binding::solver_topology),   number(Binding::body_topology)};
    for (std::uint32_t p = 0; p < all_passes().size(); ++p) {
        const PassDescription& pass = all_passes()[p];
        for (const bool fast : {false, true}) {
            const auto code = fast ? vulkan::fast_compute_shader(static_cast<Pass>(p))
                                   : vulkan::compute_shader(static_cast<Pass>(p));
            if (code.empty()) continue;
            const vulkan::ShaderNeeds needs = vulkan::needs_of(code);
            const std::set<std::uint32_t> reads = bindings_of(pass.reads), writes = bindings_of(pass.writes);
            for (const std::uint32_t binding : needs.written_buffers) {
                // A pass without sums still contains a loop over zero of them.
                const bool no_sums = binding == number(Binding::solver_parts) && pass.sums.count == 0;
                EXPECT_TRUE(no_sums || writes.count(binding) > 0)
                    << pass.name << " writes buffer " << binding;
            }
            for (const std::uint32_t binding : writes)
                EXPECT_TRUE(std::ranges::count(needs.written_buffers, binding) == 1)
                    << pass.name << " does not write buffer " << binding;
            for (const std::uint32_t binding : needs.read_buffers) {
                // A pass of a solver reads its guard.
                const bool guard =
                    is_solver_pass(static_cast<Pass>(p)) && binding == number(Binding::solver_scalars);
                EXPECT_TRUE(guard || constant.count(binding) > 0 || reads.count(binding) > 0)
                    << pass.name << " reads buffer " << binding;
            }
            for (const std::uint32_t binding : reads)
                EXPECT_TRUE(std::ranges::count(needs.read_buffers, binding) == 1)
                    << pass.name << " does not read buffer " << binding;
        }
    }
}

struct ArenaCase {
    const char* name;
    Method method = Method::constraint;
    Solver solver = Solver::newton_multigrid;
    bool mesh = false, graded = false, stiff_bend = false;
    std::uint32_t order = 1;
    Preconditioner preconditioner = Preconditioner::multigrid;
};
void PrintTo(const ArenaCase& c, std::ostream* out) { *out << c.name; }

const ArenaCase cases[] = {
    {.name = "sheet"},
    {.name = "sheet_stiff_bend", .stiff_bend = true},
    {.name = "sheet_second_order", .order = 2},
    {.name = "sheet_jacobi", .preconditioner = Preconditioner::jacobi},
    {.name = "sheet_plain", .preconditioner = Preconditioner::none},
    {.name = "mesh", .mesh = true},
    {.name = "mesh_graded", .mesh = true, .graded = true},
    {.name = "mesh_second_order", .mesh = true, .order = 2},
    {.name = "acad_sheet", .method = Method::acad},
    {.name = "acad_mesh", .method = Method::acad, .mesh = true},
    {.name = "paper_sheet", .solver = Solver::paper},
    {.name = "paper_acad", .method = Method::acad, .solver = Solver::paper},
};

Scene scene_of(const ArenaCase& c)
{
    Scene scene;
    scene.method = c.method;
    scene.solver = c.solver;
    scene.newton_multigrid.order = c.order;
    scene.newton_multigrid.preconditioner = c.preconditioner;
    scene.newton_multigrid.smoothing = 2;
    scene.newton_multigrid.newton_iterations = 2;
    scene.newton_multigrid.linear_iterations = 2;
    scene.paper.max_iterations = 3;
    scene.acad.activate_at = 1e-4;
    scene.acad.deactivate_at = 1e-5;
    scene.air = {.velocity = {1, 3, 2}, .density = 1.2};
    Cloth cloth =
        c.mesh ? Cloth::mesh(test::irregular_mesh(7, 9), {.density = 0.3}) : test::flat_sheet(7, 9, 1.0, 0.8);
    cloth.springs = {{1000, 0.01}, {500, 0.01}, {1, 0}};
    if (c.stiff_bend) cloth.springs.bend.role = SpringRole::constraint;
    if (c.graded) cloth.springs.bend_model = BendModel::quadratic;
    cloth.pin(std::uint32_t{0});
    scene.add(cloth);
    scene.add(Sphere{.centre = {0.1, -0.2, 0.1}, .radius = 0.1985, .friction = 0.3});
    return scene;
}

/// The resource of each number in a cloth's arena. `colliders` marks numbers that no pass may write.
std::vector<Resource> resources_of_arena(const ClothModel& model)
{
    const Hierarchy& hierarchy = model.hierarchy;
    std::vector<Resource> arena(hierarchy.number_count, Resource::colliders);
    const auto fill = [&](std::int32_t first, std::int32_t count, Resource resource) {
        for (std::int32_t k = std::max(first, 0); k < first + count; ++k)
            arena.at(static_cast<std::size_t>(k)) = resource;
    };
    if (model.plan.solver == Solver::paper) {
        const SolverLevel& cloth = hierarchy.levels.front();
        fill(cloth.base, static_cast<std::int32_t>(hierarchy.number_count) - cloth.base, Resource::vectors);
        const auto& topology = hierarchy.topology;
        const auto at = [&](int entry) { return topology[static_cast<std::size_t>(entry)]; };
        const auto rows = static_cast<int>(hierarchy.constraints.constraints);
        fill(at(rows_matrix), at(at(rows_matrix_start) + rows), Resource::blocks);
        return arena;
    }
    const int first_of_mesh = model.plan.on_grid ? bent_sheet_planes : node_planes;
    for (std::size_t l = 0; l < hierarchy.level_count(); ++l) {
        const SolverLevel& level = hierarchy.levels[l];
        const int planes = l > 0                                 ? level_planes
                           : hierarchy.history_plane > 0         ? hierarchy.history_plane + history_planes
                           : !model.plan.on_grid                 ? node_planes
                           : model.limits.bends_by_constraints() ? bent_sheet_planes
                                                                 : sheet_planes;
        for (int plane = 0; plane < planes; ++plane) {
            const bool history = hierarchy.history_plane > 0 && plane >= hierarchy.history_plane;
            const bool vectors =
                plane < plane_mass || plane == plane_active || (plane >= plane_step && plane < plane_slide);
            const bool blocks = (plane >= plane_block && plane < level_planes) ||
                                (model.plan.on_grid && plane >= plane_bend && plane < first_of_mesh);
            // Of a mesh a plane begins with its one row: planes overlap in the border that they do not have.
            const std::int32_t first = level.base + plane * level.size + level.first_of_plane();
            fill(first, level.size,
                 history   ? Resource::motion
                 : vectors ? Resource::vectors
                 : blocks  ? Resource::blocks
                           : Resource::motion);
        }
        if (level.edge_size == 0) continue;
        for (int plane = 0; plane < (l == 0 ? edge_planes : edge_force); ++plane)
            fill(level.edge_base + plane * level.edge_size, level.edge_size,
                 plane < edge_force  ? Resource::blocks
                 : plane < edge_rest ? Resource::vectors
                                     : Resource::motion);
    }
    const SolverLevel& last = hierarchy.levels.back();
    const std::int32_t unknowns = 3 * last.rows * last.columns;
    fill(hierarchy.bottom_base, unknowns * unknowns, Resource::blocks);
    for (const SolverLevel& level : hierarchy.levels) {
        if (level.live == 0) continue;
        fill(level.live, level.node_units(), Resource::flags);
        fill(level.live_edges, sum_groups(level.edges), Resource::flags);
    }
    return arena;
}

class ArenaResources : public testing::TestWithParam<ArenaCase> {};

/// Each call of a frame runs twice: as it is, and with all numbers of the arena that it does not read set to
/// NaN. Both must give the same result, and write only what the table lists.
TEST_P(ArenaResources, AreWhatPassesDo)
{
    const Scene scene = scene_of(GetParam());
    const ClothModel model = test::shaken_model(scene);
    const std::vector<Resource> arena = resources_of_arena(model);
    const auto runner = make_reference_runner({&model, 1});
    const std::vector<PlacedCollider> colliders{placed_at(scene.colliders[0], 0)};

    std::vector<Call> calls;
    append_frame({&model, 1}, 2, 0, calls);
    append_multipliers(model, 0, 0, calls);
    std::uint64_t id = 0;
    const auto run = [&](const Call& call, bool keeps) {
        Program program{++id, {call}, call.parity};
        const Kept kept{0, 1 - call.parity, true, {{0, arena.size()}}};
        if (keeps) program.keeps = {kept};
        runner->run(program, {1e-3, 1, colliders, true});
        return kept;
    };
    const auto numbers = [&] {
        std::vector<float> values;
        runner->solver_numbers(0, 0, arena.size(), values);
        return values;
    };
    const auto same = [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); };

    std::map<Pass, std::set<Resource>> written;
    std::map<Pass, int> runs;
    for (Call call : calls) {
        if (!is_solver_pass(call.pass)) {
            run(call, false);
            continue;
        }
        if (call.guard != Guard::none && runner->solver_scalar(0, static_cast<std::size_t>(call.guard)) != 0)
            continue;
        // Some of each kind: repetitions prove nothing new.
        const std::string name = description_of(call.pass).name;
        if (++runs[call.pass] > 12) {
            run(call, false);
            continue;
        }
        const PassDescription& pass = description_of(call.pass);
        const std::set<Resource> reads(pass.reads.begin(), pass.reads.end()),
            writes(pass.writes.begin(), pass.writes.end());

        const std::vector<float> before = numbers();
        const Kept kept = run(call, true);
        const std::vector<float> after = numbers();
        runner->put_back(kept);
        std::vector<float> spoilt = before;
        for (std::size_t first = 0; first < arena.size();) {
            std::size_t end = first;
            while (end < arena.size() && arena[end] == arena[first]) ++end;
            if (reads.count(arena[first]) == 0 && arena[first] != Resource::colliders) {
                std::fill(spoilt.begin() + static_cast<std::ptrdiff_t>(first),
                          spoilt.begin() + static_cast<std::ptrdiff_t>(end),
                          std::numeric_limits<float>::quiet_NaN());
                runner->write_solver_numbers(0, first, {spoilt.data() + first, end - first});
            }
            first = end;
        }
        run(call, false);
        const std::vector<float> after_spoilt = numbers();
        std::size_t wrong_write = 0, wrong_read = 0, changed = 0;
        for (std::size_t k = 0; k < arena.size(); ++k) {
            if (!same(after[k], before[k])) {
                ++changed;
                written[call.pass].insert(arena[k]);
                wrong_write += writes.count(arena[k]) == 0;
                wrong_read += !same(after_spoilt[k], after[k]);
            } else if (!same(after_spoilt[k], spoilt[k])) {
                wrong_read += !same(after_spoilt[k], after[k]);  // written, but by what was there
            }
        }
        ASSERT_EQ(wrong_write, 0u) << name << ", level " << call.level << ": of " << changed;
        ASSERT_EQ(wrong_read, 0u) << name << ", level " << call.level << ": of " << changed;
        runner->put_back(kept);
        run(call, false);
    }
    EXPECT_GT(runs.size(), 15u);
    // And vectors that a row names are written by some call.
    for (const auto& [pass, count] : runs) {
        const auto writes = description_of(pass).writes;
        const bool of_vectors = std::ranges::count(writes, Resource::vectors) > 0;
        const bool always = pass != Pass::newton_move;  // it changes steps only where a collider stops them
        if (of_vectors && always && GetParam().solver != Solver::paper) {
            EXPECT_EQ(written[pass].count(Resource::vectors), 1u) << description_of(pass).name;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Cases, ArenaResources, testing::ValuesIn(cases),
                         [](const auto& c) { return std::string(c.param.name); });

}  // namespace
}  // namespace pliant

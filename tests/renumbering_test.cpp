// Renumbered nodes of a mesh: a simulation's results do not show the order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "backend/vulkan/device_state.hpp"
#include "body/cloth_model.hpp"
#include "test_cloths.hpp"

namespace pliant {
namespace {

constexpr std::uint32_t rows = 17, columns = 19, count = rows * columns;

std::uint32_t leaping_name(std::uint32_t row, std::uint32_t column)
{
    return (7 * (row * columns + column) + 3) % count;  // 7 and 323 have no common factor
}
std::uint32_t plain_name(std::uint32_t row, std::uint32_t column) { return row * columns + column; }

/// A patch with coordinates that are exact in binary, its vertices numbered as `name` says.
template <class Name>
SurfaceMesh patch(const Name& name)
{
    SurfaceMesh mesh;
    mesh.vertices.resize(count);
    for (std::uint32_t r = 0; r < rows; ++r)
        for (std::uint32_t c = 0; c < columns; ++c)
            mesh.vertices[name(r, c)] = {static_cast<float>(c) / 16, static_cast<float>(r * c % 5) / 64,
                                         static_cast<float>(r) / 16};
    test::add_cells(mesh, rows, columns, name,
                    [](std::uint32_t r, std::uint32_t c) { return (r + c) % 2 == 1; });
    return mesh;
}

/// With all features of a node: wind, a collider, fixed and moving pins.
template <class Name>
Scene patch_scene(const Name& name, std::uint32_t pin, std::uint32_t moving_pin,
                  Method method = Method::mass_spring)
{
    Cloth cloth = Cloth::mesh(patch(name), {.density = 0.25});
    cloth.springs = {{100, 0.015625}, {}, {1, 0}};
    cloth.damping = 0.5;
    cloth.thickness = 0.0078125;
    cloth.pin(pin);
    cloth.pin(Attachment(moving_pin, {{.time = 0}, {.time = 1, .position = {0.5, 0.25, 0}}}));
    Scene scene;
    scene.method = method;
    scene.time.substeps = 20;
    scene.air = {.velocity = {3, 0.5, -1}, .density = 1.2, .drag = 1, .lift = 0.5};
    scene.add(cloth);
    scene.add(Sphere{.centre = {0.5, -0.5, 0.5}, .radius = 0.25, .friction = 0.25});
    return scene;
}
Scene leaping_scene(Method method = Method::mass_spring) { return patch_scene(leaping_name, 5, 40, method); }

// The hash is from the version before renumbering, which stepped nodes in the order of the mesh.
TEST(Renumbering, LeavesEveryBitAsItIsInTheOrderOfTheMesh)
{
    for (const Backend backend : {Backend::cpu, Backend::vulkan}) {
        Simulation simulation(leaping_scene(), test::on(backend));
        for (int frame = 0; frame < 30; ++frame) simulation.advance(1.0 / 60);
        EXPECT_EQ(simulation.state_hash(), 0x47bc7b2b90d7c826ull) << name_of(backend);
        EXPECT_EQ(simulation.report().validation_messages, 0u);
    }
}

TEST(Renumbering, PutsNeighboursNearEachOther)
{
    for (const Method method : {Method::mass_spring, Method::constraint, Method::acad}) {
        const Scene scene = leaping_scene(method);
        const ClothModel model(scene.cloth(0), scene);
        std::vector<std::uint32_t> vertex_of(count);
        for (std::uint32_t vertex = 0; vertex < count; ++vertex)
            vertex_of[model.shape.node_of_vertex.at(vertex)] = vertex;
        double leaps = 0, leaps_as_given = 0;
        for (const Spring& s : model.springs.list) {
            leaps += s.j - s.i;
            const auto [first, second] = std::minmax(vertex_of[s.i], vertex_of[s.j]);
            leaps_as_given += second - first;
        }
        // Within blocks of 256 nodes the longest rows come first, wherever they are.
        EXPECT_LT(leaps, 0.75 * leaps_as_given) << name_of(method);
    }
}

/// Without features that depend on the order of the mesh's vertices.
template <class Name>
Simulation hanging_patch(const Name& name, Method method)
{
    Cloth cloth = Cloth::mesh(patch(name), {.density = 0.25});
    cloth.springs = {{10, 0}, {}, {1, 0}};
    cloth.springs.structural.compliance = 1e-4;
    cloth.pin(name(0, 0)).pin(name(0, columns - 1));
    Scene scene;
    scene.method = method;
    scene.time.substeps = method == Method::acad ? 20 : 4;
    scene.add(cloth);
    Simulation simulation(scene, test::on(Backend::cpu));
    for (int frame = 0; frame < 20; ++frame) simulation.advance(1.0 / 60);
    return simulation;
}

// newton_multigrid sums in the order of the nodes, which follows from their positions.
TEST(Renumbering, MakesConstraintsIndependentOfTheOrderOfTheMesh)
{
    Simulation leaping = hanging_patch(leaping_name, Method::constraint);
    Simulation plain = hanging_patch(plain_name, Method::constraint);
    const auto x = leaping.positions(), y = plain.positions();
    const auto of_leaping = leaping.multipliers(), of_plain = plain.multipliers();
    EXPECT_GT(*std::max_element(of_plain.begin(), of_plain.end()), 0.1f);  // N
    std::vector<std::uint32_t> place_of(count);
    for (std::uint32_t r = 0; r < rows; ++r)
        for (std::uint32_t c = 0; c < columns; ++c) {
            const std::uint32_t v = leaping_name(r, c), w = plain_name(r, c);
            EXPECT_EQ(x[v], y[w]);
            EXPECT_EQ(of_leaping[v], of_plain[w]);
            place_of[v] = w;
        }
    std::set<std::pair<std::uint32_t, std::uint32_t>> held_of_leaping, held_of_plain;
    const auto springs = leaping.springs(), plain_springs = plain.springs();
    const auto held = leaping.held_springs(), plain_held = plain.held_springs();
    for (std::size_t s = 0; s < springs.size(); ++s) {
        if (held[s] != 0) held_of_leaping.insert(std::minmax(place_of[springs[s].i], place_of[springs[s].j]));
        if (plain_held[s] != 0) held_of_plain.insert({plain_springs[s].i, plain_springs[s].j});
    }
    EXPECT_GT(held_of_plain.size(), 10u);
    EXPECT_EQ(held_of_leaping, held_of_plain);
}

// Marks of acad are found by the springs' nodes, lengths by vertices.
TEST(Renumbering, ShowsHeldSpringsOfAcadWhereTheyAre)
{
    Simulation simulation = hanging_patch(leaping_name, Method::acad);
    const auto springs = simulation.springs();
    const auto held = simulation.held_springs();
    const auto positions = simulation.positions();
    const double limit = 1 + simulation.scene().acad.activate_at;
    std::uint32_t count_held = 0;
    for (std::size_t s = 0; s < springs.size(); ++s) {
        const Vec3d d = to_double(positions[springs[s].j]) - to_double(positions[springs[s].i]);
        const double stretched = std::sqrt(dot(d, d)) / springs[s].rest_length;
        count_held += held[s];
        if (held[s] != 0) {
            EXPECT_GT(stretched, limit) << s;
        } else {
            EXPECT_LT(stretched, limit + 0.005) << s;  // its compliance lets a held one go a little further
        }
    }
    EXPECT_GT(count_held, 0u);
}

TEST(Renumbering, MovesAllOfANodeTogether)
{
    // Against the same patch with its vertices in the order of the nodes, of which nothing moves.
    const Scene scene = leaping_scene();
    const ClothModel model(scene.cloth(0), scene);
    const std::vector<std::uint32_t>& node_of = model.shape.node_of_vertex;
    const Scene in_order =
        patch_scene([&](std::uint32_t r, std::uint32_t c) { return node_of[leaping_name(r, c)]; }, node_of[5],
                    node_of[40]);
    const ClothModel as_given(in_order.cloth(0), in_order);
    const auto same = [](Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; };
    ASSERT_EQ(node_of.size(), as_given.node_count());
    std::vector<std::uint32_t> sorted = node_of, all(node_of.size());
    std::sort(sorted.begin(), sorted.end());
    std::iota(all.begin(), all.end(), 0u);
    EXPECT_EQ(sorted, all);
    ASSERT_EQ(model.springs.list.size(), as_given.springs.list.size());
    for (std::size_t s = 1; s < model.springs.list.size(); ++s)
        EXPECT_LT(std::pair(model.springs.list[s - 1].i, model.springs.list[s - 1].j),
                  std::pair(model.springs.list[s].i, model.springs.list[s].j));
    std::vector<std::uint32_t> vertex_of(node_of.size());
    for (std::uint32_t v = 0; v < node_of.size(); ++v) {
        EXPECT_EQ(as_given.shape.node_of_vertex[v], v);
        vertex_of[node_of[v]] = v;
    }
    for (std::size_t s = 0; s < model.springs.list.size(); ++s) {
        const Spring &mine = model.springs.list[s], &theirs = as_given.springs.list[s];
        EXPECT_LT(mine.i, mine.j);
        EXPECT_EQ(std::pair(mine.i, mine.j), std::pair(theirs.i, theirs.j));
        EXPECT_EQ(mine.spring_class, theirs.spring_class);
        EXPECT_EQ(mine.rest_length, theirs.rest_length);
    }
    for (std::uint32_t n = 0; n < node_of.size(); ++n) {
        EXPECT_TRUE(same(model.shape.positions[n], as_given.shape.positions[n]));
        EXPECT_TRUE(same(model.shape.velocities[n], as_given.shape.velocities[n]));
        EXPECT_EQ(model.masses.kg[n], as_given.masses.kg[n]);
        EXPECT_EQ(model.masses.pinned[n], as_given.masses.pinned[n]);
        const auto row = model.springs.neighbours.row(n);
        ASSERT_EQ(row.size(), as_given.springs.neighbours.row(n).size());
        for (std::size_t k = 0; k < row.size(); ++k) {
            if (k > 0) {  // in the order of the mesh
                EXPECT_LT(vertex_of[row[k - 1].node], vertex_of[row[k].node]);
            }
            const Spring& spring = model.springs.list[row[k].spring];
            EXPECT_EQ(std::minmax(n, row[k].node), std::minmax(spring.i, spring.j));
        }
        const auto around = model.shape.node_triangles.row(n),
                   given_around = as_given.shape.node_triangles.row(n);
        EXPECT_TRUE(std::equal(around.begin(), around.end(), given_around.begin(), given_around.end()));
    }
    ASSERT_EQ(model.attachments.nodes.size(), 1u);
    EXPECT_EQ(model.attachments.nodes[0].node, node_of[40]);
    EXPECT_TRUE(std::equal(model.shape.triangles().begin(), model.shape.triangles().end(),
                           as_given.shape.triangles().begin(), as_given.shape.triangles().end()));
}

TEST(Renumbering, ShowsInNothingThatASimulationGives)
{
    const SurfaceMesh mesh = patch(leaping_name);
    for (const Backend backend : {Backend::cpu, Backend::vulkan, Backend::reference}) {
        Simulation simulation(leaping_scene(), test::on(backend));
        const auto positions = simulation.positions();
        ASSERT_EQ(positions.size(), mesh.vertices.size());
        for (std::size_t v = 0; v < positions.size(); ++v) {
            EXPECT_EQ(positions[v].x, mesh.vertices[v].x);
            EXPECT_EQ(positions[v].z, mesh.vertices[v].z);
        }
        ASSERT_EQ(simulation.triangles().size(), mesh.triangles.size());
        EXPECT_TRUE(std::equal(mesh.triangles.begin(), mesh.triangles.end(), simulation.triangles().begin()));

        const std::vector<PinListing> pins = simulation.pins();
        ASSERT_EQ(pins.size(), 2u);
        EXPECT_EQ(pins[0].node, 5u);
        EXPECT_FALSE(pins[0].moves);
        EXPECT_EQ(pins[1].node, 40u);
        EXPECT_TRUE(pins[1].moves);

        const std::vector<SpringListing> springs = simulation.springs();
        for (std::size_t s = 0; s < springs.size(); ++s) {
            const SpringListing& spring = springs[s];
            EXPECT_LT(spring.i, spring.j);
            if (s > 0) {
                EXPECT_LT(std::pair(springs[s - 1].i, springs[s - 1].j), std::pair(spring.i, spring.j));
            }
            const Vec3d d = to_double(mesh.vertices[spring.j]) - to_double(mesh.vertices[spring.i]);
            EXPECT_NEAR(std::sqrt(dot(d, d)), spring.rest_length, 1e-12);
        }

        // The one node that is lifted is stretched most, and what is set comes back.
        State state = simulation.state();
        state.cloths[0].positions[100].y += 0.25f;
        state.cloths[0].velocities[100] = {1, 2, 3};
        simulation.set_state(state);
        const auto strains = simulation.strains();
        EXPECT_EQ(*std::max_element(strains.begin(), strains.end()), strains[100]);
        EXPECT_EQ(simulation.positions()[100].y, state.cloths[0].positions[100].y);
        EXPECT_EQ(simulation.velocities()[100].z, 3.0f);

        const auto lent = simulation.device_buffers();
        EXPECT_EQ(lent.has_value(), backend == Backend::vulkan);
        if (!lent) continue;
        std::vector<float> on_device(4 * positions.size());
        const DeviceState& device = *simulation.device_state();
        vulkan::Buffer copied = device.device()->make_buffer(on_device.size() * sizeof(float),
                                                             vk::BufferUsageFlagBits::eTransferDst,
                                                             vulkan::Memory::readback, "copy");
        const vk::raii::CommandBuffer commands = device.device()->make_commands();
        commands.begin({});
        commands.copyBuffer(device.positions_on_device(0), *copied, vk::BufferCopy(0, 0, copied.size));
        commands.end();
        device.device()->run(commands);
        std::copy_n(static_cast<const float*>(copied.mapped), on_device.size(), on_device.begin());
        for (std::size_t v = 0; v < positions.size(); ++v)
            EXPECT_EQ(on_device[4 * lent->node_of_vertex[v] + 1], state.cloths[0].positions[v].y);
    }
}

}  // namespace
}  // namespace pliant

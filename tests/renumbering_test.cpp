// Nodes of a mesh in an order of their own: nothing that a simulation gives shows it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "backend/vulkan/device_state.hpp"
#include "body/cloth_model.hpp"
#include "test_cloths.hpp"

namespace pliant {
namespace {

/// A patch whose vertices are numbered in leaps, with coordinates that are exact in binary.
SurfaceMesh leaping_mesh()
{
    constexpr std::uint32_t rows = 17, columns = 19, count = rows * columns;
    const auto name = [](std::uint32_t row, std::uint32_t column) {
        return (7 * (row * columns + column) + 3) % count;  // 7 and 323 have no common factor
    };
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

/// With all that a node may have to do with: wind, a collider, pins that stand and move.
Scene leaping_scene(Method method = Method::mass_spring)
{
    Cloth cloth = Cloth::mesh(leaping_mesh(), {.density = 0.25});
    cloth.springs = {{100, 0.015625}, {}, {1, 0}};
    cloth.damping = 0.5;
    cloth.thickness = 0.0078125;
    cloth.pin(std::uint32_t{5});
    cloth.pin(Attachment(std::uint32_t{40}, {{.time = 0}, {.time = 1, .position = {0.5, 0.25, 0}}}));
    Scene scene;
    scene.method = method;
    scene.time.substeps = 20;
    scene.air = {.velocity = {3, 0.5, -1}, .density = 1.2, .drag = 1, .lift = 0.5};
    scene.add(cloth);
    scene.add(Sphere{.centre = {0.5, -0.5, 0.5}, .radius = 0.25, .friction = 0.25});
    return scene;
}

// The hash is that of the version before nodes were renumbered, which stepped them in the order of the mesh.
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
    const Scene scene = leaping_scene(), in_order = leaping_scene(Method::constraint);
    const ClothModel model(scene.cloth(0), scene), as_given(in_order.cloth(0), in_order);
    EXPECT_TRUE(as_given.node_of_vertex.empty());  // whose solver depends on the order
    const auto mean_leap = [](const ClothModel& of) {
        double sum = 0;
        for (const Spring& s : of.springs) sum += s.j - s.i;
        return sum / static_cast<double>(of.springs.size());
    };
    // Within blocks of 256 nodes the longest rows come first, wherever they are.
    EXPECT_LT(mean_leap(model), 0.75 * mean_leap(as_given));
}

TEST(Renumbering, MovesAllOfANodeTogether)
{
    const Scene scene = leaping_scene(), in_order = leaping_scene(Method::constraint);
    const ClothModel model(scene.cloth(0), scene), as_given(in_order.cloth(0), in_order);
    const std::vector<std::uint32_t>& node_of = model.node_of_vertex;
    const auto same = [](Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; };
    ASSERT_EQ(node_of.size(), as_given.node_count());
    std::vector<std::uint32_t> sorted = node_of, all(node_of.size());
    std::sort(sorted.begin(), sorted.end());
    std::iota(all.begin(), all.end(), 0u);
    EXPECT_EQ(sorted, all);
    ASSERT_EQ(model.springs.size(), as_given.springs.size());
    for (std::size_t s = 1; s < model.springs.size(); ++s)
        EXPECT_LT(std::pair(model.springs[s - 1].i, model.springs[s - 1].j),
                  std::pair(model.springs[s].i, model.springs[s].j));
    for (std::uint32_t v = 0; v < node_of.size(); ++v) {
        const std::uint32_t n = node_of[v];
        EXPECT_TRUE(same(model.positions[n], as_given.positions[v]));
        EXPECT_TRUE(same(model.velocities[n], as_given.velocities[v]));
        EXPECT_EQ(model.masses[n], as_given.masses[v]);
        EXPECT_EQ(model.pinned[n], as_given.pinned[v]);
        const auto row = model.neighbours.row(n), given = as_given.neighbours.row(v);
        ASSERT_EQ(row.size(), given.size());
        for (std::size_t k = 0; k < row.size(); ++k) {  // in the order of the mesh
            EXPECT_EQ(row[k].node, node_of[given[k].node]);
            const Spring &mine = model.springs[row[k].spring], &theirs = as_given.springs[given[k].spring];
            EXPECT_EQ(std::minmax(n, row[k].node), std::minmax(mine.i, mine.j));
            EXPECT_LT(mine.i, mine.j);
            EXPECT_EQ(mine.spring_class, theirs.spring_class);
            EXPECT_EQ(mine.rest_length, theirs.rest_length);
        }
        const auto around = model.node_triangles.row(n), given_around = as_given.node_triangles.row(v);
        EXPECT_TRUE(std::equal(around.begin(), around.end(), given_around.begin(), given_around.end()));
    }
    ASSERT_EQ(model.attached.size(), 1u);
    EXPECT_EQ(model.attached[0].node, node_of[40]);
    for (std::size_t t = 0; t < model.triangles().size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(model.triangles()[t][k], node_of[as_given.triangles()[t][k]]);
}

TEST(Renumbering, ShowsInNothingThatASimulationGives)
{
    const SurfaceMesh mesh = leaping_mesh();
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

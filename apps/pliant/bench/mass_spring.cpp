// Mass-spring steps: sheets from 1,024 to 7.8 million nodes, a mesh as a list of springs, and memory per
// node.
#include <cmath>

#include "bench/memory.hpp"
#include "bench/stepping.hpp"
#include "pliant/mesh_generators.hpp"

namespace pliant::tool {
namespace {

constexpr double structural_stiffness = 1000;  // N/m
constexpr std::uint64_t largest = 7'817'616;
constexpr std::uint64_t most_for_bullet = 300'000;  // nodes; for more a turn takes seconds

/// The same cloth at all sizes, larger instead of finer, so that step lengths are equal and comparable. It is
/// rotated, so that no coordinate is a round number, and hangs from two corners.
Cloth sheet(std::uint32_t n)
{
    constexpr double spacing = 1.0 / 127;
    const double width = spacing * (n - 1);
    Cloth cloth = Cloth::sheet({.rows = n, .columns = n, .width = width, .height = width, .density = 0.3});
    cloth.rotation = {20, 30, 10};
    cloth.pin(Corner::top_left).pin(Corner::top_right);
    return cloth;
}

BenchCase sheet_case(const BenchOptions& options, std::uint64_t nodes, bool with_sphere)
{
    const auto n = static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(nodes))));
    const std::string subject = with_sphere ? "sheet over a sphere" : "sheet";
    return {subject + ", " + with_commas(std::uint64_t{n} * n) + " nodes", [=](BenchTable& table) {
                SteppingCase what;
                what.subject = subject;
                what.stiffness = structural_stiffness;
                what.scene = stepped_scene(sheet(n), Method::mass_spring, options.quick);
                if (with_sphere)
                    what.scene.add(Sphere{.centre = {0, -0.6, 0}, .radius = 0.5, .friction = 0.3});
                const std::uint64_t count = std::uint64_t{n} * n;
                what.one_thread = count <= 1'048'576;
                what.bullet = !with_sphere && count <= most_for_bullet;
                if (with_sphere) return measure_stepping(what, options, table);
                what.faster_than_serial = count >= 262'144 ? 20 : 0;
                what.faster_than_serial_one_thread = count == 1'024 ? 6 : count >= 262'144 ? 10 : 0;
                what.scaling = count == 1'048'576 ? 1.7 : 0;
                what.copy_fraction = count != largest ? 0 : options.simulation.fast_math ? 0.8 : 0.5;
                measure_stepping(what, options, table);
            }};
}

/// Forces by a list of springs: the edges, and a bend spring across every edge.
BenchCase mesh_case(const BenchOptions& options, std::uint32_t vertices)
{
    return {"mesh, spring list, " + with_commas(vertices) + " vertices", [=](BenchTable& table) {
                SteppingCase what;
                what.subject = "mesh, spring list";
                what.stiffness = structural_stiffness;
                Cloth cloth = Cloth::mesh(blob_mesh({.vertices = vertices}), {.density = 0.3});
                cloth.pin(0u);
                what.scene = stepped_scene(std::move(cloth), Method::mass_spring, options.quick);
                what.one_thread = true;
                what.faster_than_serial = vertices == 31'112 ? 8 : 0;
                measure_stepping(what, options, table);
            }};
}

BenchCase backends_case(const BenchOptions& options)
{
    const std::uint32_t n = options.quick ? 12 : 128;
    return {"sheet on every backend", [=](BenchTable& table) {
                const Scene scene = stepped_scene(sheet(n), Method::mass_spring, options.quick);
                measure_backends("sheet", scene, structural_stiffness, options, table);
            }};
}

/// Memory per node: the difference between two sheets.
BenchCase memory_case(const BenchOptions& options)
{
    const std::uint32_t small = options.quick ? 64 : 256, large = options.quick ? 128 : 1024;
    return {"memory of a sheet", [=](BenchTable& table) {
                const auto held = [&](std::uint32_t n) {
                    const std::uint64_t before = memory_in_use();
                    Simulation simulation(stepped_scene(sheet(n), Method::mass_spring, options.quick),
                                          options.simulation);
                    return static_cast<double>(memory_of(simulation, before));
                };
                const double nodes = static_cast<double>(large) * large - static_cast<double>(small) * small;
                const double bytes = (held(large) - held(small)) / nodes;
                Simulation simulation(stepped_scene(sheet(large), Method::mass_spring, options.quick),
                                      options.simulation);
                const BenchRow row = table.row(simulation, "memory of a sheet", structural_stiffness, {});
                table.add(row, "bytes for a node", bytes, "B", at_most(64));
            }};
}

}  // namespace

std::vector<BenchCase> mass_spring_cases(const BenchOptions& options)
{
    std::vector<std::uint64_t> sizes = {1'024, 16'384, 262'144, 1'048'576, largest};
    std::uint32_t vertices = 31'112, over_sphere = 262'144;
    if (options.quick) sizes = {100, 900}, vertices = 1'000, over_sphere = 400;
    if (!options.sizes.empty()) sizes = options.sizes;
    std::vector<BenchCase> cases;
    for (const std::uint64_t nodes : sizes) cases.push_back(sheet_case(options, nodes, false));
    if (!options.sizes.empty()) return cases;
    cases.push_back(sheet_case(options, over_sphere, true));
    cases.push_back(mesh_case(options, vertices));
    cases.push_back(memory_case(options));
    if (options.simulation.backend == Backend::automatic || options.quick)
        cases.push_back(backends_case(options));
    return cases;
}

}  // namespace pliant::tool

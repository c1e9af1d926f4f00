// Soft bodies: a closed figure on the ground, with springs alone and with the volume constraint.
#include <algorithm>
#include <filesystem>
#include <functional>

#include "bench/stepping.hpp"
#include "pliant/mesh_generators.hpp"

namespace pliant::tool {
namespace {

constexpr double body_stiffness = 500;  // N/m
constexpr double paper_step = 1e-4;     // s, of the volume paper
constexpr std::uint32_t usual = 31'112;

Scene figure(SurfaceMesh mesh, Method method, bool quick)
{
    float lowest = 0;
    for (const Vec3& x : mesh.vertices) lowest = std::min(lowest, x.y);
    Cloth body = Cloth::soft_body(std::move(mesh), {}, {.density = 2});
    body.springs.structural = {body_stiffness, 0.01};
    Scene scene = stepped_scene(std::move(body), method, quick, paper_step);
    scene.add(Plane{.point = {0, double{lowest}, 0}, .friction = 0.5});
    return scene;
}

BenchCase figure_case(const BenchOptions& options, const std::string& name, std::uint64_t vertices,
                      const std::function<SurfaceMesh()>& mesh, Method method)
{
    const std::string subject = name + (method == Method::volume ? ", volume" : ", springs alone");
    return {subject + ", " + with_commas(vertices) + " vertices", [=](BenchTable& table) {
                SteppingCase what;
                what.subject = subject;
                what.stiffness = body_stiffness;
                what.scene = figure(mesh(), method, options.quick);
                what.one_thread = true;
                if (method == Method::volume) {
                    what.faster_than_serial = vertices == usual ? 8 : 0;
                    what.steps_per_second = vertices == usual ? 20'000 : vertices == 500'000 ? 2'000 : 0;
                }
                measure_stepping(what, options, table);
            }};
}

}  // namespace

std::vector<BenchCase> volume_cases(const BenchOptions& options)
{
    std::vector<std::uint64_t> sizes = {3'000, usual, 250'000};
    if (options.simulation.backend == Backend::vulkan) sizes.back() = 500'000;  // a million triangles
    if (options.quick) sizes = {1'000};
    if (!options.sizes.empty()) sizes = options.sizes;
    constexpr std::uint64_t least = 1'000, most = 500'000;  // vertices of blob_mesh
    std::erase_if(sizes, [&](std::uint64_t vertices) {
        const bool fits = vertices >= least && vertices <= most;
        if (!fits && options.suite == "volume")
            throw Error(ErrorKind::bad_usage,
                        "--sizes names a body of " + with_commas(vertices) +
                            " vertices: the figure of the suite volume has 1,000 to 500,000");
        return !fits;  // those sizes are for another suite
    });
    std::vector<BenchCase> cases;
    for (const std::uint64_t vertices : sizes)
        for (const Method method : {Method::mass_spring, Method::volume})
            cases.push_back(figure_case(
                options, "figure", vertices,
                [=] { return blob_mesh({.vertices = static_cast<std::uint32_t>(vertices)}); }, method));
    for (const std::string& file : options.meshes) {
        const SurfaceMesh read = read_mesh(file);
        if (options.suite == "all" && !inspect_mesh(read).closed) continue;  // that mesh is for another suite
        const auto count = read.vertices.size();
        for (const Method method : {Method::mass_spring, Method::volume})
            cases.push_back(figure_case(
                options, std::filesystem::path(file).filename().string(), count,
                [=] { return read_mesh(file); }, method));
    }
    return cases;
}

}  // namespace pliant::tool

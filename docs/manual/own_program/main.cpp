// A cape hangs from the shoulders of a figure that walks, in a loop of its own.
#include <cstdio>
#include <exception>
#include <span>
#include <thread>
#include <vector>

#include <pliant/pliant.hpp>
#include <pliant/render.hpp>

// --- a mesh from arrays
pliant::SurfaceMesh cape_mesh(unsigned rows, unsigned columns)
{
    pliant::SurfaceMesh mesh;
    for (unsigned row = 0; row < rows; ++row)
        for (unsigned column = 0; column < columns; ++column) {
            const float across = static_cast<float>(column) / static_cast<float>(columns - 1) - 0.5F;
            const float down = static_cast<float>(row) / static_cast<float>(rows - 1);
            mesh.vertices.push_back({0.5F * across * (1 + down), -0.9F * down, 0});  // m, wider at the hem
        }
    for (unsigned row = 0; row + 1 < rows; ++row)
        for (unsigned column = 0; column + 1 < columns; ++column) {
            const unsigned a = row * columns + column, b = a + columns;
            mesh.triangles.push_back({a, b, a + 1});
            mesh.triangles.push_back({a + 1, b, b + 1});
        }
    return mesh;
}

// --- threads of the host
class HostThreads : public pliant::JobSystem {
public:
    unsigned thread_count() const override { return 2; }
    void run(unsigned count, void (*task)(void*, unsigned), void* context) override
    {
        std::thread other([&] {
            for (unsigned k = 1; k < count; k += 2) task(context, k);
        });
        for (unsigned k = 0; k < count; k += 2) task(context, k);
        other.join();
    }
};

int run()
{
    // --- the scene
    pliant::Scene scene;
    scene.method = pliant::Method::constraint;  // cloth that does not stretch, one step a frame
    auto cape = scene.add(pliant::Cloth::mesh(cape_mesh(25, 21), {.density = 0.3}));
    cape->position = {0, 1.5, -0.16};
    cape->damping = 0.5;
    const std::vector<pliant::Keyframe> walk = {{.time = 0}, {.time = 2, .position = {0, 0, 3}}};
    scene.add(pliant::TaperedCapsule{.start = {0, 0.9, 0},
                                     .end = {0, 1.45, 0},
                                     .start_radius = 0.12,
                                     .end_radius = 0.15,
                                     .friction = 0.3,
                                     .keyframes = walk});
    for (const unsigned vertex : {5U, 15U}) cape.pin({vertex, walk});  // the top row has vertices 0 to 20
    scene.add(pliant::Plane{});
    scene.camera.position = {2.6, 1.5, 4.4};
    scene.camera.target = {0, 1.0, 2.7};
    scene.camera.width = 640;
    scene.camera.height = 360;

    // --- the loop
    HostThreads threads;
    pliant::Simulation simulation(scene, {.backend = pliant::Backend::cpu, .job_system = &threads});
    for (const std::string& warning : simulation.warnings()) std::fprintf(stderr, "%s\n", warning.c_str());
    for (int frame = 0; frame < 120; ++frame) {
        simulation.advance(1.0 / 60);  // never throws
        const pliant::Report& report = simulation.report();
        if (!report.finite) {
            std::fprintf(stderr, "node %llu left the finite numbers in frame %d\n",
                         static_cast<unsigned long long>(report.bad_node), frame);
            return 3;
        }
        // --- the renderer: positions and normals, m, in the order of the mesh's vertices
        const std::span<const pliant::Vec3> positions = simulation.positions(cape);
        const std::span<const pliant::Vec3> normals = simulation.normals(cape.index());
        if (frame == 119)
            std::printf("%zu vertices, %zu normals, the first at (%.2f, %.2f, %.2f) m\n", positions.size(),
                        normals.size(), static_cast<double>(positions[0].x),
                        static_cast<double>(positions[0].y), static_cast<double>(positions[0].z));
    }
    const pliant::Report& report = simulation.report();
    std::printf("stretched by %.2f %% at most, %s\n", 100 * report.measures.max_stretch,
                report.solver.is_solved() ? "every step was solved" : "some steps were not solved");

    // --- files and pictures
    pliant::SurfaceMesh last = cape_mesh(25, 21);
    const auto positions = simulation.positions(cape);
    last.vertices.assign(positions.begin(), positions.end());
    pliant::write_mesh("cape.ply", last);
    try {
        pliant::Painter painter(simulation);
        pliant::write_png("cape.png", painter.draw());
    } catch (const pliant::Error& error) {  // no Vulkan device here can draw
        std::fprintf(stderr, "no picture: %s\n", error.what());
    }
    return 0;
}

int main()
{
    try {
        return run();
    } catch (const std::exception& error) {  // a scene that is not valid, a file that cannot be written
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}

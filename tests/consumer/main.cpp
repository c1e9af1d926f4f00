// A built-in scene and a mesh from a file are stepped and, where a device can draw, drawn.
#include <cmath>
#include <cstdio>
#include <filesystem>

#include <pliant/pliant.hpp>
#include <pliant/render.hpp>

int main()
{
    pliant::Scene scene =
        pliant::read_scene("falling_sheet", {"camera.width=160", "camera.height=90", "time.substeps=0"});
    const std::filesystem::path mesh = std::filesystem::temp_directory_path() / "pliant_consumer.ply";
    pliant::write_mesh(mesh, pliant::icosphere_mesh({.radius = 0.2, .frequency = 4}));
    auto ball = scene.add(pliant::Cloth::mesh(pliant::read_mesh(mesh), {.density = 0.3}));
    ball->position = {0, 2, 0};
    std::filesystem::remove(mesh);

    pliant::Simulation simulation(scene);
    for (int frame = 0; frame < 10; ++frame) simulation.advance(1.0 / 60);
    bool good = simulation.report().finite;
    for (const pliant::Vec3& x : simulation.positions(ball)) good = good && std::isfinite(x.y) && x.y < 2.3F;

    try {
        pliant::read_scene("no_such_scene");
        good = false;
    } catch (const pliant::Error& error) {  // across the border of a library
        good = good && error.kind == pliant::ErrorKind::bad_input;
    }
    try {
        pliant::Painter painter(simulation);
        const pliant::Image& image = painter.draw();
        good = good && image.width == 160 && image.rgba.size() == std::size_t{160} * 90 * 4;
        std::printf("drawn on %s\n", painter.device_name().c_str());
    } catch (const pliant::Error& error) {
        std::printf("not drawn: %s\n", error.what());
    }
    std::printf("%s after %.2f s\n", good ? "good" : "bad", simulation.time());
    return good ? 0 : 1;
}

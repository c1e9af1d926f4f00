// A sheet, held at two corners, swings down past a sphere.
#include <cmath>
#include <cstdio>
#include <span>

#include <pliant/pliant.hpp>

int main()
{
    pliant::Scene scene;
    auto cloth = scene.add(
        pliant::Cloth::sheet({.rows = 16, .columns = 24, .width = 1.0, .height = 1.0, .density = 0.3}));
    cloth->position = {0, 1, 0};
    cloth.pin(pliant::Corner::top_left).pin(pliant::Corner::top_right);
    scene.add(pliant::Sphere{.centre = {0, 0.4, 0}, .radius = 0.3, .friction = 0.4});

    pliant::Simulation simulation(scene, {.backend = pliant::Backend::automatic});
    for (int frame = 0; frame < 30; ++frame) simulation.advance(1.0 / 60);

    float lowest = 1;
    bool finite = simulation.report().finite;
    const std::span<const pliant::Vec3> positions = simulation.positions(cloth);
    for (const pliant::Vec3& x : positions) {
        finite = finite && std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z);
        lowest = std::fmin(lowest, x.y);
    }
    std::printf("after %.2f s on %s, the lowest of %zu nodes is at %.3f m\n", simulation.time(),
                simulation.device_name().c_str(), positions.size(), static_cast<double>(lowest));
    return positions.size() == 16 * 24 && finite && lowest < 0.9F ? 0 : 1;
}

#include "picture_source.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "backend/host/plain_cloth.hpp"
#include "backend/vulkan/device_state.hpp"

namespace pliant::tool {
namespace {

/// 1, 2 or 5 times a power of ten, not below a number.
double round_number_above(double a)
{
    const double power = std::pow(10.0, std::floor(std::log10(a)));
    for (const double step : {1.0, 2.0, 5.0})
        if (step * power >= a * (1 - 1e-9)) return step * power;
    return 10 * power;
}

void set_text(std::string& text, const char* format, double value)
{
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, format, value);
    text = buffer;
}

}  // namespace

std::vector<ClothTopology> topologies_of(const Simulation& simulation)
{
    const Scene& scene = simulation.scene();
    std::vector<ClothTopology> topologies;
    for (std::size_t c = 0; c < scene.cloth_count(); ++c) {
        const auto* sheet = std::get_if<SheetOptions>(&scene.cloth(c).shape);
        topologies.push_back({simulation.triangles(c), simulation.node_count(c), sheet ? sheet->rows : 0,
                              sheet ? sheet->columns : 0});
    }
    return topologies;
}

std::vector<DrawnSpring> drawn_springs(const Simulation& simulation, std::size_t cloth)
{
    const Scene& scene = simulation.scene();
    const Springs& springs = scene.cloth(cloth).springs;
    const auto limit_of = [&](SpringKind kind) {
        if (scene.method == Method::acad)
            return scene.acad.target == AcadTarget::rest ? 0 : scene.acad.activate_at;
        if (scene.method != Method::constraint) return -1.0;
        const SpringParameters& of = kind == SpringKind::structural ? springs.structural
                                     : kind == SpringKind::shear    ? springs.shear
                                                                    : springs.bend;
        const bool constraint = of.role == SpringRole::constraint ||
                                (of.role == SpringRole::automatic && kind != SpringKind::bend);
        return constraint ? of.limit : -1.0;
    };
    std::vector<DrawnSpring> drawn;
    for (const SpringListing& spring : simulation.springs(cloth))
        drawn.push_back({spring.i, spring.j | static_cast<std::uint32_t>(spring.kind) << 30,
                         static_cast<float>(spring.rest_length), static_cast<float>(limit_of(spring.kind))});
    return drawn;
}

void PictureSource::gather(Simulation& simulation, OverlaySet overlays)
{
    const std::size_t count = simulation.scene().cloth_count();
    const bool direct = is_direct(simulation), known = before_.size() == count;
    const bool strained =
        overlays.has(Overlay::strain) || simulation.scene().camera.colour == ClothColour::strain;
    frames_.clear();
    extras_.assign(count, {});
    for (std::size_t c = 0; c < count; ++c) {
        if (direct)
            frames_.emplace_back(simulation.device_state()->drawable(c));
        else
            frames_.emplace_back(
                HostCloth{simulation.positions(c), simulation.normals(c),
                          strained ? simulation.strains(c) : std::span<const float>(),
                          known ? std::span<const Vec3>(before_[c]) : std::span<const Vec3>()});
    }
    if (overlays.has(Overlay::multipliers) || overlays.has(Overlay::active))
        for (std::size_t c = 0; c < count; ++c) extras_[c].forces = simulation.multipliers(c);
    if (overlays.has(Overlay::contacts)) gather_contacts(simulation);
    if (overlays.has(Overlay::multipliers)) {
        scale_forces();
    } else if (overlays.has(Overlay::volume)) {
        colour_volumes(simulation);
    } else {
        scale_.low = 0, scale_.high = 0.10f;
        scale_.diverging = false;
        scale_.title = "strain", scale_.low_text = "0 %", scale_.high_text = "10 %";
    }
}

void PictureSource::keep_positions(Simulation& simulation)
{
    before_.resize(simulation.scene().cloth_count());
    for (std::size_t c = 0; c < before_.size(); ++c) {
        const auto positions = simulation.positions(c);
        before_[c].assign(positions.begin(), positions.end());
    }
}

void PictureSource::gather_contacts(Simulation& simulation)
{
    const Scene& scene = simulation.scene();
    contacts_.resize(scene.cloth_count());
    for (auto& contacts : contacts_) contacts.clear();
    for (const Collider& collider : scene.colliders) {
        const auto shape = make_collider<double>(placed_at(collider, simulation.time()));
        for (std::size_t c = 0; c < scene.cloth_count(); ++c) {
            const double thickness = scene.cloth(c).thickness;
            // A node that rests keeps the thickness as its distance, up to the rounding of positions.
            const double reach = 1.05 * thickness + 1e-5;
            for (const Vec3& x : simulation.positions(c)) {
                const double gap =
                    Laws<double>::collider_gap(shape, {double{x.x}, double{x.y}, double{x.z}}).w;
                if (gap <= reach) contacts_[c].push_back({x, static_cast<float>(0.95 * thickness - gap)});
            }
        }
    }
    for (std::size_t c = 0; c < contacts_.size(); ++c) extras_[c].contacts = contacts_[c];
}

void PictureSource::scale_forces()
{
    float most = 0;
    for (ClothExtras& extra : extras_) {
        extra.values = extra.forces;
        for (const float force : extra.forces) most = std::max(most, force);
    }
    const double end = most > 0 && std::isfinite(most) ? round_number_above(double{most}) : 1;
    scale_.low = 0, scale_.high = static_cast<float>(end);
    scale_.diverging = false;
    scale_.title = "constraint force", scale_.low_text = "0 N";
    set_text(scale_.high_text, "%.3g N", end);
}

void PictureSource::colour_volumes(const Simulation& simulation)
{
    double most = 0;
    for (const BodyMeasures& body : simulation.report().bodies) most = std::max(most, std::abs(body.error));
    const double end = std::isfinite(most) ? round_number_above(std::max(most, 1e-7)) : 1;
    volume_values_.resize(extras_.size());
    for (std::size_t c = 0; c < extras_.size(); ++c) {
        volume_values_[c].assign(simulation.node_count(c), 0.0f);
        for (const BodyMeasures& body : simulation.report().bodies)
            if (body.cloth == c)
                std::fill(volume_values_[c].begin(), volume_values_[c].end(), static_cast<float>(body.error));
        extras_[c].values = volume_values_[c];
    }
    scale_.low = static_cast<float>(-end), scale_.high = static_cast<float>(end);
    scale_.diverging = true;
    scale_.title = "volume error";
    set_text(scale_.low_text, "%.3g %%", -100 * end);
    set_text(scale_.high_text, "+%.3g %%", 100 * end);
}

}  // namespace pliant::tool

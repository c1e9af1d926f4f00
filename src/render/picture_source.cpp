#include "render/picture_source.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "backend/vulkan/device_state.hpp"
#include "pliant/extremes.hpp"
#include "solve/step_constants.hpp"

namespace pliant {
namespace {

/// 1, 2 or 5 times a power of ten, not below a number.
double round_number_above(double a)
{
    const double power = std::pow(10.0, std::floor(std::log10(a)));
    for (const double step : {1.0, 2.0, 5.0})
        if (step * power >= a * (1 - 1e-9)) return step * power;
    return 10 * power;
}

template <class T>
void keep(std::span<const T> from, std::vector<T>& into)
{
    into.assign(from.begin(), from.end());
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
    std::vector<DrawnSpring> drawn;
    for (const SpringListing& spring : simulation.springs(cloth))
        drawn.push_back({spring.i, spring.j, spring.kind, static_cast<float>(spring.rest_length)});
    return drawn;
}

void PictureSource::gather(Simulation& simulation, OverlaySet overlays, const PictureSource* instead)
{
    const std::size_t count = simulation.scene().cloth_count();
    time_ = simulation.time();
    report_ = simulation.report();
    positions_.resize(count);
    const auto other = [&](std::size_t c) {
        return instead && c < instead->positions_.size() &&
               instead->positions_[c].size() == simulation.node_count(c);
    };
    if (!is_direct(simulation))
        for (std::size_t c = 0; c < count; ++c)
            keep(other(c) ? instead->positions(c) : simulation.positions(c), positions_[c]);
    gather_overlays(simulation, overlays);
}

std::vector<ClothFrame> frames_of(Simulation& simulation, const PictureSource& source)
{
    std::vector<ClothFrame> frames;
    for (std::size_t c = 0; c < simulation.scene().cloth_count(); ++c) {
        if (PictureSource::is_direct(simulation))
            frames.emplace_back(
                DeviceCloth{simulation.device_state()->positions_on_device(c), simulation.node_count(c)});
        else
            frames.emplace_back(HostCloth{source.positions(c)});
    }
    return frames;
}

void PictureSource::gather_overlays(Simulation& simulation, OverlaySet overlays)
{
    const std::size_t count = simulation.scene().cloth_count();
    extras_.assign(count, {});
    held_.resize(count);
    values_.resize(count);
    if (overlays.has(Overlay::active))
        for (std::size_t c = 0; c < count; ++c) {
            keep(simulation.held_springs(c), held_[c]);
            extras_[c].held = held_[c];
        }
    if (overlays.has(Overlay::contacts)) gather_contacts(simulation);
    if (overlays.has(Overlay::multipliers)) {
        for (std::size_t c = 0; c < count; ++c) keep(simulation.multipliers(c), values_[c]);
        scale_forces();
    } else if (overlays.has(Overlay::volume)) {
        colour_volumes(simulation);
    } else {
        scale_.low = 0, scale_.high = 0.10f;
        scale_.diverging = false;
        scale_.title = "strain", scale_.low_text = "0 %", scale_.high_text = "10 %";
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
            // A resting node keeps the thickness as its distance, up to rounding of positions.
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
    double most = 0;
    for (std::size_t c = 0; c < extras_.size(); ++c) {
        extras_[c].values = values_[c];
        for (const float force : values_[c]) most = larger(most, force);
    }
    const double end = most > 0 && std::isfinite(most) ? round_number_above(most) : 1;
    scale_.low = 0, scale_.high = static_cast<float>(end);
    scale_.diverging = false;
    scale_.title = "constraint force", scale_.low_text = "0 N";
    set_text(scale_.high_text, "%.3g N", end);
}

void PictureSource::colour_volumes(const Simulation& simulation)
{
    double most = 0;
    for (const BodyMeasures& body : simulation.report().bodies) most = larger(most, std::abs(body.error));
    const double end = std::isfinite(most) ? round_number_above(std::max(most, 1e-7)) : 1;
    for (std::size_t c = 0; c < extras_.size(); ++c) {
        values_[c].assign(simulation.node_count(c), 0.0f);
        for (const BodyMeasures& body : simulation.report().bodies)
            if (body.cloth == c)
                std::fill(values_[c].begin(), values_[c].end(), static_cast<float>(body.error));
        extras_[c].values = values_[c];
    }
    scale_.low = static_cast<float>(-end), scale_.high = static_cast<float>(end);
    scale_.diverging = true;
    scale_.title = "volume error";
    set_text(scale_.low_text, "%.3g %%", -100 * end);
    set_text(scale_.high_text, "+%.3g %%", 100 * end);
}

}  // namespace pliant

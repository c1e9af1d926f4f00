#include "simulation/start_warnings.hpp"

#include <algorithm>
#include <cmath>

#include "body/collider_motion.hpp"
#include "files/formatted.hpp"
#include "solve/step_constants.hpp"

namespace pliant {
namespace {

/// Calls visit(gap), in m, for each free node until it returns false.
template <class Visit>
void visit_gaps(const Collider& collider, const ClothModel& model, std::span<const Vec3> positions,
                double time, const Visit& visit)
{
    const auto shape = make_collider<double>(placed_at(collider, time));
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (!(model.masses.inverse(i) > 0)) continue;
        const Vec3d x = to_double(positions[i]) + model.shape.origin;
        if (!visit(Laws<double>::collider_gap(shape, {x.x, x.y, x.z}).w)) return;
    }
}

}  // namespace

void find_sunk(const Scene& scene, const ClothModel& model, std::span<const Vec3> positions, double time,
               std::vector<std::uint8_t>& sunk)
{
    sunk.resize(scene.colliders.size());
    for (std::size_t k = 0; k < sunk.size(); ++k)
        if (sunk[k] == 0)
            visit_gaps(scene.colliders[k], model, positions, time, [&](double gap) {
                if (model.parameters.thickness - gap > deepest_contact) sunk[k] = 1;
                return sunk[k] == 0;
            });
}

std::vector<std::string> starts_inside(const Scene& scene, const Cloth& cloth, const ClothModel& model)
{
    constexpr double noticeable = 1e-4;  // m; allows for rounding of nodes on a surface
    std::vector<std::string> sentences;
    for (std::size_t k = 0; k < scene.colliders.size(); ++k) {
        std::size_t count = 0;
        double deepest = 0;
        visit_gaps(scene.colliders[k], model, model.shape.positions, 0, [&](double gap) {
            if (-gap > noticeable) {
                ++count;
                deepest = std::max(deepest, -gap);
            }
            return true;
        });
        if (count == 0) continue;
        sentences.push_back((model.plan.is_body() ? "body '" : "cloth '") + cloth.name + "': " +
                            formatted("%zu nodes start inside colliders[%zu], the deepest by %.3g m: they "
                                      "are let out slowly, and stay where springs pull them harder; move "
                                      "the cloth or the collider",
                                      count, k, deepest));
    }
    return sentences;
}

std::vector<std::string> fast_targets(const Cloth& body)
{
    std::vector<std::string> sentences;
    const std::vector<TimedValue>& target = body.body->volume.target;
    if (target.empty()) return sentences;
    const std::string start = "body '" + body.name + "': volume.target ";
    const std::vector<TimedValue> taken = gradual_target(target);
    if (taken.front().value != target.front().value)
        sentences.push_back(start +
                            formatted("begins with %.3g and the body with 1: it is taken there in "
                                      "%.3g s; begin with value 1, and give the time that it may take",
                                      target.front().value, taken[1].time));
    for (std::size_t i = 1; i < target.size(); ++i) {
        const double rate = (target[i].value - target[i - 1].value) / (target[i].time - target[i - 1].time);
        if (!(std::abs(rate) > fastest_start)) continue;
        sentences.push_back(start +
                            formatted("changes by %.3g a second from %.3g s on, and bodies bear about "
                                      "%.3g: the body may be thrown; take more time for it",
                                      rate, target[i - 1].time, fastest_start));
        break;
    }
    return sentences;
}

}  // namespace pliant

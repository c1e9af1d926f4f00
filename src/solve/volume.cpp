#include "solve/volume.hpp"

#include "solve/mass_spring.hpp"

namespace pliant {

void append_body_step(const ClothModel& bodies, std::uint32_t index, std::uint32_t step, std::uint32_t parity,
                      std::vector<Call>& calls)
{
    const auto append = [&](Pass pass) { calls.push_back({pass, index, parity, step}); };
    append_wind(bodies, index, step, parity, calls);
    if (!bodies.body->loads.empty()) append(Pass::load_force);
    if (!bodies.body->constrained) {
        if (bodies.spring_list) append(Pass::spring_force);
        append(bodies.spring_list ? Pass::list_step : Pass::ring_step);
        append_attachments(bodies, index, step, parity, calls);
        return;
    }
    append(Pass::volume_gather);  // forces, the gradient, both sides of eq. (14)
    append(Pass::volume_step);    // the multiplier, integration, contact
    append_attachments(bodies, index, step, parity, calls);
    append(Pass::volume_cubic);  // the volume after contact and pins
    append(Pass::volume_correct);
}

void append_volumes(std::uint32_t index, std::uint32_t parity, std::vector<Call>& calls)
{
    calls.push_back({Pass::volume_measure, index, parity, 0});
    calls.push_back({Pass::volume_total, index, parity, 0});
}

}  // namespace pliant

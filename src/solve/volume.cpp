#include "solve/volume.hpp"

#include "solve/mass_spring.hpp"

namespace pliant {

void append_volume_step(const ClothModel& bodies, std::uint32_t index, std::uint32_t step,
                        std::uint32_t parity, std::vector<Call>& calls)
{
    const auto append = [&](Pass pass) { calls.push_back({pass, index, parity, step}); };
    append_external_forces(bodies, index, step, parity, calls);
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

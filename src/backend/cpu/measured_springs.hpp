// Springs of a mesh in the data layout of the measuring kernel.
#pragma once

#include <vector>

#include "backend/cpu/kernels.hpp"
#include "backend/host/plain_cloth.hpp"

namespace pliant::cpu {

class MeasuredSprings {
public:
    /// Empty for a sheet.
    explicit MeasuredSprings(const PlainCloth<float>& cloth);

    MeasuredSlices view() const
    {
        return {start_.data(),     place_.data(),   rest_length_.data(),
                stiffness_.data(), bending_.data(), counts_.data()};
    }

private:
    std::vector<std::uint32_t> start_, place_;
    std::vector<float> rest_length_, stiffness_, bending_, counts_;
};

}  // namespace pliant::cpu

// What a pass left in its resources, held against what it left elsewhere, bit by bit.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "solve/pass.hpp"

namespace pliant::test {

inline void expect_same_bits(const std::map<Resource, std::vector<float>>& a,
                             const std::map<Resource, std::vector<float>>& b, const std::string& who)
{
    for (const auto& [resource, values] : a) {
        const auto& others = b.at(resource);
        ASSERT_EQ(values.size(), others.size()) << who << ": resource " << static_cast<int>(resource);
        std::size_t differing = 0, first = 0;
        for (std::size_t i = 0; i < values.size(); ++i)
            if (std::bit_cast<std::uint32_t>(values[i]) != std::bit_cast<std::uint32_t>(others[i]) &&
                differing++ == 0)
                first = i;
        EXPECT_EQ(differing, 0u) << who << ": resource " << static_cast<int>(resource) << " differs first at "
                                 << first << ": " << values[first] << " and " << others[first];
    }
}

}  // namespace pliant::test

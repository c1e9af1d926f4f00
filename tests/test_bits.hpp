// What a pass left in its resources, held against what it left elsewhere, bit by bit.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "solve/pass.hpp"
#include "test_differences.hpp"

namespace pliant::test {

inline void expect_same_bits(const std::map<Resource, std::vector<float>>& a,
                             const std::map<Resource, std::vector<float>>& b, const std::string& who)
{
    ASSERT_FALSE(a.empty()) << who;
    ASSERT_EQ(a.size(), b.size()) << who;
    for (const auto& [resource, values] : a) {
        const auto& others = b.at(resource);
        ASSERT_EQ(values.size(), others.size()) << who << ": resource " << static_cast<int>(resource);
        ASSERT_FALSE(values.empty()) << who << ": resource " << static_cast<int>(resource);
        const BitDifferences found = bit_differences(values, others);
        EXPECT_EQ(found.count, 0u) << who << ": resource " << static_cast<int>(resource)
                                   << " differs, or is not finite, first at " << found.first << ": "
                                   << values[found.first] << " and " << others[found.first];
    }
}

}  // namespace pliant::test

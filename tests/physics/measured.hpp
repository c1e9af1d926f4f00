// Says what a test has measured, so that `verification | grep measured` prints the table of
// docs/verification.md.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>

namespace pliant::test {

inline void measured(const std::string& what, double value, double reference)
{
    const double off = reference != 0 ? value / reference - 1 : value;
    std::printf("measured: %s: %.6g, reference %.6g, off by %.2g\n", what.c_str(), value, reference, off);
}

/// A number that has no reference but a bar.
inline void measured(const std::string& what, double value)
{
    std::printf("measured: %s: %.3g\n", what.c_str(), value);
}

}  // namespace pliant::test

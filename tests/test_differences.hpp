// How far states are apart, and the largest and smallest of what a test looks at. What is missing, or is not
// a number, is never good: std::max(0.0, NaN) is 0, and of no numbers at all it is 0, too.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <vector>

#include "pliant/extremes.hpp"
#include "pliant/vec3.hpp"

namespace pliant::test {

/// The extreme of the numbers that it was given, by `larger` or `smaller`. Not a number when one of them is
/// not, or when there was none: then no bound holds, on whichever side it is.
template <double (*more_extreme)(double, double)>
class Extreme {
public:
    void add(double a) { value_ = empty_ ? a : more_extreme(value_, a), empty_ = false; }
    double value() const { return value_; }

private:
    double value_ = std::numeric_limits<double>::quiet_NaN();
    bool empty_ = true;
};
using Largest = Extreme<larger>;
using Smallest = Extreme<smaller>;

inline double distance(Vec3d a, Vec3d b) { return std::sqrt(dot(a - b, a - b)); }
inline double distance(Vec3 a, Vec3 b) { return distance(to_double(a), to_double(b)); }
inline double distance(double a, double b) { return std::abs(a - b); }

/// Of two lists of numbers or places, entry by entry. Infinite when they are not of one size, when they are
/// empty, or when an entry of either is not finite.
template <class A, class B>
double largest_difference(const A& a, const B& b)
{
    if (std::size(a) != std::size(b) || std::empty(a)) return std::numeric_limits<double>::infinity();
    double most = 0;
    for (std::size_t i = 0; i < std::size(a); ++i) {
        const double apart = distance(a[i], b[i]);
        if (!std::isfinite(apart)) return std::numeric_limits<double>::infinity();
        most = larger(most, apart);
    }
    return most;
}

/// Of two lists of floats: how many entries differ in a bit, and the first of them.
struct BitDifferences {
    std::size_t count = 0, first = 0;
};
/// An entry that is not finite differs from everything, and lists of two sizes, or of none, in an entry at
/// least.
inline BitDifferences bit_differences(const std::vector<float>& a, const std::vector<float>& b)
{
    if (a.size() != b.size() || a.empty()) return {1, 0};
    BitDifferences found;
    for (std::size_t i = 0; i < a.size(); ++i)
        if ((std::bit_cast<std::uint32_t>(a[i]) != std::bit_cast<std::uint32_t>(b[i]) ||
             !std::isfinite(a[i])) &&
            found.count++ == 0)
            found.first = i;
    return found;
}

}  // namespace pliant::test

// The larger and the smaller of two numbers, for reported values over frames, cloths and nodes. NaN is kept.
#pragma once

namespace pliant {

/// The larger of two; NaN if either is NaN. (std::max(0.0, NaN) is 0, which would hide a diverged value.)
inline double larger(double a, double b) { return a >= b ? a : b >= a ? b : a + b; }
/// The smaller of two; NaN if either is NaN.
inline double smaller(double a, double b) { return a <= b ? a : b <= a ? b : a + b; }

}  // namespace pliant

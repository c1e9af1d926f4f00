// The larger and the smaller of two numbers, for what is kept over frames, cloths and nodes and then
// reported.
#pragma once

namespace pliant {

/// The larger of two; not a number when one of them is not. std::max(0.0, NaN) is 0, so that what has
/// diverged would be reported as nothing.
inline double larger(double a, double b) { return a >= b ? a : b >= a ? b : a + b; }
/// The smaller of two; not a number when one of them is not.
inline double smaller(double a, double b) { return a <= b ? a : b <= a ? b : a + b; }

}  // namespace pliant

// How the oracle differentiates.
#pragma once

#include <functional>

#include "oracle/implicit_step.hpp"

namespace pliant::oracle {

/// m: of the differences that make forces. It must be small against the distance to a length where a force
/// has a corner, or be left with its stiffness times this. Lengths and gaps are therefore found to 2^-64 of 1
/// m; what is left is the rounding of a term's energy, 2^-53 of some J, over this: 1e-7 N for each J.
constexpr double force_step = 0x1p-30;

using LongPoint = Eigen::Matrix<long double, 3, 1>;
inline LongPoint long_sum(const Point& a, const Point& b)
{
    return a.cast<long double>() + b.cast<long double>();
}

/// Central differences of fourth order.
inline Vector gradient_of(const std::function<double(const Vector&)>& f, Vector x, double h)
{
    Vector gradient(x.size());
    for (Eigen::Index k = 0; k < x.size(); ++k) {
        const double before = x[k];
        const auto f_at = [&](double steps) {
            x[k] = before + steps * h;
            return f(x);
        };
        gradient[k] = (8 * (f_at(1) - f_at(-1)) - (f_at(2) - f_at(-2))) / (12 * h);
        x[k] = before;
    }
    return gradient;
}

inline Matrix hessian_of(const std::function<double(const Vector&)>& f, Vector x, double h)
{
    Matrix hessian(x.size(), x.size());
    for (Eigen::Index k = 0; k < x.size(); ++k) {
        const double before = x[k];
        const auto gradient_at = [&](double steps) {
            x[k] = before + steps * h;
            return gradient_of(f, x, h);
        };
        hessian.col(k) =
            (8 * (gradient_at(1) - gradient_at(-1)) - (gradient_at(2) - gradient_at(-2))) / (12 * h);
        x[k] = before;
    }
    return (hessian + hessian.transpose()) / 2;
}

}  // namespace pliant::oracle

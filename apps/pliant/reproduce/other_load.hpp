// The load by other programs during a measurement.
#pragma once

#include <optional>

namespace pliant::tool::reproduce {

/// The share of processor time that other programs have taken since construction.
class OtherLoad {
public:
    OtherLoad();
    /// 0 to 1; empty if the system does not report it.
    std::optional<double> share() const;

private:
    struct Times {
        double all = 0, busy = 0;  ///< s, of all processors
        double own = 0;            ///< s, of this program
    };
    static std::optional<Times> now();
    std::optional<Times> start_;
};

}  // namespace pliant::tool::reproduce

// What else a machine computes while something is measured.
#pragma once

#include <optional>

namespace pliant::tool::reproduce {

/// Which part of the processors' time other programs took since this was made.
class OtherLoad {
public:
    OtherLoad();
    /// 0 to 1; nothing where the system does not tell.
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

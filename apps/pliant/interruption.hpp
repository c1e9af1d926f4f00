// Handles Ctrl-C and similar signals, for commands that end in an orderly way.
#pragma once

#include <csignal>
#include <iterator>

namespace pliant::tool {

/// During its lifetime, such signals only set a number, which the command tests between frames.
class InterruptGuard {
public:
    InterruptGuard()
    {
        for (std::size_t k = 0; k < std::size(signals); ++k)
            before_[k] = std::signal(signals[k], [](int number) { number_ = number; });
    }
    ~InterruptGuard()
    {
        for (std::size_t k = 0; k < std::size(signals); ++k) std::signal(signals[k], before_[k]);
    }
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    /// The number of the last signal; 0 if there was none.
    static int signal_number() { return number_; }

private:
    static constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP};
    static inline volatile std::sig_atomic_t number_ = 0;
    void (*before_[std::size(signals)])(int);
};

}  // namespace pliant::tool

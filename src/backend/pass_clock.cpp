#include "backend/pass_runner.hpp"

namespace pliant {

PassClock::PassClock()
{
    for (const PassDescription& pass : all_passes()) times_.push_back({pass.name, 0, 0});
}

void PassClock::add(Pass pass, double milliseconds, std::uint64_t calls)
{
    PassTime& time = times_[static_cast<std::size_t>(pass)];
    time.milliseconds += milliseconds;
    time.calls += calls;
}

std::vector<PassTime> PassClock::times() const
{
    std::vector<PassTime> ran;
    for (const PassTime& time : times_)
        if (time.calls > 0) ran.push_back(time);
    return ran;
}

}  // namespace pliant

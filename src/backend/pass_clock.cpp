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

void PassClock::times(std::vector<PassTime>& into) const
{
    std::size_t count = 0;
    for (const PassTime& time : times_) {
        if (time.calls == 0) continue;
        if (count == into.size()) into.emplace_back();
        into[count++] = time;  // reuses the memory of names
    }
    into.resize(count);
}

}  // namespace pliant

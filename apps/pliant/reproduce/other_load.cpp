#include "other_load.hpp"

#include <algorithm>
#include <ctime>
#include <fstream>
#include <string>

#include <unistd.h>

namespace pliant::tool::reproduce {

OtherLoad::OtherLoad() : start_(now()) {}

std::optional<OtherLoad::Times> OtherLoad::now()
{
    // First line of Linux's /proc/stat: ticks in user, nice, system, idle, iowait, irq, softirq, steal.
    std::ifstream stat("/proc/stat");
    std::string word;
    double ticks[8] = {};
    if (!(stat >> word) || word != "cpu") return std::nullopt;
    for (double& each : ticks)
        if (!(stat >> each)) return std::nullopt;
    const double second = static_cast<double>(sysconf(_SC_CLK_TCK));
    timespec own{};
    if (second <= 0 || clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &own) != 0) return std::nullopt;
    Times times;
    for (const double each : ticks) times.all += each / second;
    times.busy = times.all - (ticks[3] + ticks[4]) / second;
    times.own = static_cast<double>(own.tv_sec) + 1e-9 * static_cast<double>(own.tv_nsec);
    return times;
}

std::optional<double> OtherLoad::share() const
{
    const auto end = now();
    if (!start_ || !end) return std::nullopt;
    const double all = end->all - start_->all;
    if (all <= 0) return std::nullopt;
    const double others = end->busy - start_->busy - (end->own - start_->own);
    return std::clamp(others / all, 0.0, 1.0);
}

}  // namespace pliant::tool::reproduce

// Progress of a long job: a bar on a terminal, a plain line now and then elsewhere, nothing when quiet.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace pliant::tool {

class Progress {
public:
    /// `unit` names what is counted.
    Progress(std::uint64_t total, bool quiet, const char* unit = "frame");
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// `done` of `total`; `note` is shown beside.
    void update(std::uint64_t done, const std::string& note);
    /// Clears the bar, so that other lines can be printed.
    void clear();

private:
    using Clock = std::chrono::steady_clock;
    std::uint64_t total_;
    const char* unit_;
    bool quiet_, terminal_, shown_ = false;
    std::uint64_t tenths_said_ = 0;
    Clock::time_point start_, last_;
};

}  // namespace pliant::tool

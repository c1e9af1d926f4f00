// Progress of a long job: a bar on a terminal, occasional lines elsewhere, nothing if quiet.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace pliant::tool {

class Progress {
public:
    /// `unit`: the name of what is counted.
    Progress(std::uint64_t total, bool quiet, const char* unit = "frame");
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// `done` of `total`; `note` is shown after it.
    void update(std::uint64_t done, const std::string& note);
    /// Erases the bar, so that other lines can be printed.
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

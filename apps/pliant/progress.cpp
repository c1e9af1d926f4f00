#include "progress.hpp"

#include <cstdio>

#include <unistd.h>

namespace pliant::tool {

Progress::Progress(std::uint64_t total, bool quiet, const char* unit)
    : total_(total > 0 ? total : 1),
      unit_(unit),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      last_(start_)
{
}

Progress::~Progress() { clear(); }

void Progress::update(std::uint64_t done, const std::string& note)
{
    if (quiet_) return;
    const auto now = Clock::now();
    const double spent = std::chrono::duration<double>(now - start_).count();
    const double left = done > 0 ? spent / static_cast<double>(done) * static_cast<double>(total_ - done) : 0;
    const unsigned percent = static_cast<unsigned>(100 * done / total_);
    if (!terminal_) {
        if (done != total_ && percent / 10 <= tenths_said_) return;
        tenths_said_ = percent / 10;
        std::fprintf(stderr, "%3u %%  %s %llu of %llu  %s\n", percent, unit_,
                     static_cast<unsigned long long>(done), static_cast<unsigned long long>(total_),
                     note.c_str());
        return;
    }
    constexpr std::chrono::milliseconds between(50);
    if (done != total_ && now - last_ < between) return;
    last_ = now;
    constexpr unsigned width = 30;
    std::string bar(width, '.');
    bar.replace(0, width * done / total_, std::string(width * done / total_, '#'));
    std::fprintf(stderr, "\r[%s] %3u %%  %s %llu of %llu  %s  %.0f s left \033[K", bar.c_str(), percent,
                 unit_, static_cast<unsigned long long>(done), static_cast<unsigned long long>(total_),
                 note.c_str(), left);
    std::fflush(stderr);
    shown_ = true;
}

void Progress::clear()
{
    if (!shown_) return;
    std::fprintf(stderr, "\r\033[K");
    std::fflush(stderr);
    shown_ = false;
}

}  // namespace pliant::tool

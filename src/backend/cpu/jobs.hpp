// Pliant's own threads: oneTBB behind the JobSystem interface. OpenMP was measured beside it on parallel
// regions of a few microseconds and took 4 to 37 times as long (docs/performance.md).
#pragma once

#include <memory>

#include "pliant/options.hpp"

namespace pliant::cpu {

/// A job system with that many threads; 0 means one for each core.
std::unique_ptr<JobSystem> make_job_system(unsigned threads);

/// While it lives, the calling thread treats denormal numbers as zero, as every task of the CPU backend does:
/// left alone they are slow, and differ between devices.
class DenormalsFlushed {
public:
    DenormalsFlushed();
    ~DenormalsFlushed();
    DenormalsFlushed(const DenormalsFlushed&) = delete;
    DenormalsFlushed& operator=(const DenormalsFlushed&) = delete;

private:
    unsigned long long before_;
};

}  // namespace pliant::cpu

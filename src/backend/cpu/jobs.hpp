// Pliant's own threads: oneTBB behind the JobSystem interface. For parallel regions of a few microseconds
// OpenMP took 4 to 37 times as long (docs/notes/threads.md).
#pragma once

#include <memory>

#include "pliant/options.hpp"

namespace pliant::cpu {

/// A job system with `threads` threads; 0: one per core.
std::unique_ptr<JobSystem> make_job_system(unsigned threads);

/// During its lifetime the calling thread treats denormal numbers as zero, as every task of the CPU backend
/// does. Denormals are slow, and differ between devices.
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

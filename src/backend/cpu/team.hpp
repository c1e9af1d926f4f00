// Threads that stay together for a frame. A frame of the constraint solver has a thousand regions of a few
// microseconds; handing each to a pool costs as much as the work (docs/notes/threads.md). So the pool is
// asked once: the first thread that arrives leads, the others spin, and a region is one store and one load.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>

#include "pliant/options.hpp"

namespace pliant::cpu {

class Team {
public:
    /// The maximum number of parts of a region.
    static constexpr unsigned most_parts = 64;

    /// Calls `lead` on one thread of `jobs`, while up to `threads` - 1 others help with its regions. All work
    /// gets done even if fewer threads arrive, or late: the leader never waits for a thread that has not
    /// begun.
    void gather(JobSystem& jobs, unsigned threads, const std::function<void()>& lead);

    /// A region: task(context, 0) ... task(context, count - 1), on the threads present. Call it only inside
    /// `gather`, from the leader; `count` is at most most_parts.
    void run(unsigned count, void (*task)(void* context, unsigned index), void* context);

private:
    void come(const std::function<void()>& lead);
    void help(unsigned number);
    /// Takes part `index` of region `region` unless another thread has it.
    bool claim(std::uint32_t region, unsigned index);

    std::atomic<std::uint64_t> open_{0};  ///< number of the region, 32 bits, and its count of parts
    std::array<std::atomic<std::uint32_t>, most_parts>
        claimed_{};                      ///< by part: the last region in which it was taken
    std::atomic<unsigned> finished_{0};  ///< parts that helpers have completed
    std::uint32_t region_ = 0;
    void (*task_)(void*, unsigned) = nullptr;
    void* context_ = nullptr;

    std::atomic<bool> led_{false}, ended_{false};
    std::atomic<unsigned> helpers_{0};
    std::exception_ptr failure_;
};

}  // namespace pliant::cpu

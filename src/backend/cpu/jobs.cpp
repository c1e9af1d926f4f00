#include "backend/cpu/jobs.hpp"

#include <algorithm>
#include <optional>
#include <thread>
#include <vector>

#if PLIANT_TBB
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace pliant::cpu {
namespace {

#if PLIANT_TBB
class OwnJobs final : public JobSystem {
public:
    explicit OwnJobs(unsigned threads) : threads_(threads), arena_(static_cast<int>(threads))
    {
        // A control applies to the host's whole process, so it may only raise the number of threads.
        if (static_cast<int>(threads) > tbb::this_task_arena::max_concurrency())
            control_.emplace(tbb::global_control::max_allowed_parallelism, threads);
    }
    unsigned thread_count() const override { return threads_; }
    void run(unsigned count, void (*task)(void*, unsigned), void* context) override
    {
        arena_.execute([&] {
            tbb::parallel_for(
                0u, count, 1u, [&](unsigned index) { task(context, index); }, tbb::static_partitioner());
        });
    }

private:
    unsigned threads_;
    std::optional<tbb::global_control> control_;
    tbb::task_arena arena_;
};

#else
/// Used without oneTBB, and under ThreadSanitizer, which reports false races in Debian's oneTBB. The tasks
/// are the same, and a frame starts its threads only once (Team).
class OwnJobs final : public JobSystem {
public:
    explicit OwnJobs(unsigned threads) : threads_(threads) {}
    unsigned thread_count() const override { return threads_; }
    void run(unsigned count, void (*task)(void*, unsigned), void* context) override
    {
        std::vector<std::thread> running;
        for (unsigned index = 0; index < count; ++index) running.emplace_back(task, context, index);
        for (std::thread& thread : running) thread.join();
    }

private:
    unsigned threads_;
};
#endif

}  // namespace

std::unique_ptr<JobSystem> make_job_system(unsigned threads)
{
    return std::make_unique<OwnJobs>(threads > 0 ? threads
                                                 : std::max(1u, std::thread::hardware_concurrency()));
}

#if defined(__x86_64__)
DenormalsFlushed::DenormalsFlushed() : before_(_mm_getcsr())
{
    constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
    _mm_setcsr(static_cast<unsigned>(before_) | flush_to_zero | denormals_are_zero);
}
DenormalsFlushed::~DenormalsFlushed() { _mm_setcsr(static_cast<unsigned>(before_)); }
#elif defined(__aarch64__)
DenormalsFlushed::DenormalsFlushed()
{
    constexpr unsigned long long flush_to_zero = 1ull << 24;
    asm volatile("mrs %0, fpcr" : "=r"(before_));
    asm volatile("msr fpcr, %0" : : "r"(before_ | flush_to_zero));
}
DenormalsFlushed::~DenormalsFlushed() { asm volatile("msr fpcr, %0" : : "r"(before_)); }
#else
DenormalsFlushed::DenormalsFlushed() : before_(0) {}
DenormalsFlushed::~DenormalsFlushed() = default;
#endif

}  // namespace pliant::cpu

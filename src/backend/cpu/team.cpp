#include "backend/cpu/team.hpp"

#include <chrono>
#include <thread>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace pliant::cpu {
namespace {

/// Spins for a while, then yields the core, and at last sleeps if allowed.
class Patience {
public:
    explicit Patience(bool may_sleep) : may_sleep_(may_sleep) {}

    void wait()
    {
        constexpr int spins = 2000, yields = 200;  // about 50 us each on an idle machine
        ++waited_;
        if (waited_ > spins + yields && may_sleep_)
            return std::this_thread::sleep_for(std::chrono::microseconds(50));
        if (waited_ > spins) return std::this_thread::yield();
#if defined(__x86_64__)
        _mm_pause();
#elif defined(__aarch64__)
        asm volatile("yield");
#endif
    }
    void renew() { waited_ = 0; }

private:
    bool may_sleep_;
    int waited_ = 0;
};

}  // namespace

void Team::gather(JobSystem& jobs, unsigned threads, const std::function<void()>& lead)
{
    led_ = ended_ = false;
    helpers_ = 0;
    failure_ = nullptr;
    struct Meeting {
        Team& team;
        const std::function<void()>& lead;
    } meeting{*this, lead};
    jobs.run(
        threads,
        [](void* pointer, unsigned) {
            const auto& all = *static_cast<const Meeting*>(pointer);
            all.team.come(all.lead);
        },
        &meeting);
    if (failure_) std::rethrow_exception(failure_);
}

void Team::come(const std::function<void()>& lead)
{
    if (led_.exchange(true)) return help(1 + helpers_.fetch_add(1));
    try {
        lead();
    } catch (...) {
        failure_ = std::current_exception();
    }
    ended_.store(true, std::memory_order_release);
}

bool Team::claim(std::uint32_t region, unsigned index)
{
    std::uint32_t last = claimed_[index].load(std::memory_order_relaxed);
    // A late helper finds the part taken: a region does not end before all its parts are done.
    return static_cast<std::int32_t>(region - last) > 0 &&
           claimed_[index].compare_exchange_strong(last, region, std::memory_order_acq_rel);
}

void Team::run(unsigned count, void (*task)(void*, unsigned), void* context)
{
    task_ = task;
    context_ = context;
    finished_.store(0, std::memory_order_relaxed);
    ++region_;
    claimed_[0].store(region_, std::memory_order_relaxed);
    open_.store(std::uint64_t{region_} << 32 | count, std::memory_order_release);
    task(context, 0);
    unsigned own = 1;
    for (unsigned index = 1; index < count; ++index)  // parts that no helper has begun
        if (claim(region_, index)) {
            task(context, index);
            ++own;
        }
    Patience patience(false);
    while (finished_.load(std::memory_order_acquire) + own < count) patience.wait();
}

/// A helper takes the part of its own number: that data is likely in its caches.
void Team::help(unsigned number)
{
    // The open region may be the first of this frame, and the only one; parts of the last frame's region are
    // taken.
    std::uint64_t seen = 0;
    Patience patience(true);  // the leader runs the parts of sleeping helpers
    while (!ended_.load(std::memory_order_acquire)) {
        const std::uint64_t open = open_.load(std::memory_order_acquire);
        const auto region = static_cast<std::uint32_t>(open >> 32);
        const auto count = static_cast<std::uint32_t>(open);
        if (open == seen || number >= count || !claim(region, number)) {
            patience.wait();
            continue;
        }
        seen = open;
        patience.renew();
        task_(context_, number);
        finished_.fetch_add(1, std::memory_order_release);
    }
}

}  // namespace pliant::cpu

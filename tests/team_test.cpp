// Threads that stay together for a frame: every part is done once, however many come to help.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "backend/cpu/team.hpp"

namespace pliant {
namespace {

class Threads final : public JobSystem {
public:
    explicit Threads(unsigned count) : count_(count) {}
    unsigned thread_count() const override { return count_; }
    void run(unsigned count, void (*task)(void*, unsigned), void* context) override
    {
        std::vector<std::thread> threads;
        for (unsigned k = 0; k < count; ++k) threads.emplace_back(task, context, k);
        for (std::thread& thread : threads) thread.join();
    }

private:
    unsigned count_;
};

/// As a host whose threads are all busy: one task after the other.
class OneAfterTheOther final : public JobSystem {
public:
    unsigned thread_count() const override { return 3; }
    void run(unsigned count, void (*task)(void*, unsigned), void* context) override
    {
        for (unsigned k = count; k-- > 0;) task(context, k);
    }
};

/// Counts in plain numbers: a part that two threads did at once, or that the leader does not see done, is
/// lost.
void count_parts(cpu::Team& team, JobSystem& jobs)
{
    const unsigned threads = jobs.thread_count();
    std::vector<long> done(threads, 0), expected(threads, 0);
    team.gather(jobs, threads, [&] {
        for (unsigned region = 0; region < 3000; ++region) {
            const unsigned parts = 1 + region % threads;
            team.run(
                parts,
                [](void* pointer, unsigned index) { ++(*static_cast<std::vector<long>*>(pointer))[index]; },
                &done);
            for (unsigned k = 0; k < parts; ++k) ASSERT_EQ(done[k], ++expected[k]) << "region " << region;
        }
    });
    EXPECT_EQ(done, expected);
}

TEST(Team, DoesEveryPartOnce)
{
    cpu::Team team;
    for (const unsigned threads : {1U, 2U, 3U, 7U, 2U}) {
        Threads jobs(threads);
        for (int frame = 0; frame < 5; ++frame) count_parts(team, jobs);
    }
}

TEST(Team, NeedsNobodyButItsLeader)
{
    cpu::Team team;
    OneAfterTheOther jobs;
    for (int frame = 0; frame < 3; ++frame) count_parts(team, jobs);
}

TEST(Team, WaitsForWhatAHelperHasBegun)
{
    struct Parts {
        std::atomic<bool> begun{false}, done{false};
    };
    cpu::Team team;
    Threads jobs(2);
    for (int frame = 0; frame < 5; ++frame) {
        Parts parts;
        bool was_done = false;
        team.gather(jobs, 2, [&] {
            team.run(
                2,
                [](void* pointer, unsigned index) {
                    auto& p = *static_cast<Parts*>(pointer);
                    if (index == 0) {
                        while (!p.begun) std::this_thread::yield();  // the leader does not take part 1 itself
                    } else {
                        p.begun = true;
                        std::this_thread::sleep_for(std::chrono::milliseconds(20));
                        p.done = true;
                    }
                },
                &parts);
            was_done = parts.done;
        });
        EXPECT_TRUE(was_done);
    }
}

TEST(Team, TakesNoPartThatSomebodyHas)
{
    // The helper comes while the leader is at part 1, which is the helper's own.
    struct LateHelper final : JobSystem {
        std::atomic<bool> may_come{false};
        unsigned thread_count() const override { return 2; }
        void run(unsigned, void (*task)(void*, unsigned), void* context) override
        {
            std::thread helper([&] {
                while (!may_come) std::this_thread::yield();
                task(context, 1);
            });
            task(context, 0);
            helper.join();
        }
    } jobs;
    struct Parts {
        std::atomic<bool>& may_come;
        std::atomic<int> times{0};
    } parts{jobs.may_come};
    cpu::Team team;
    team.gather(jobs, 2, [&] {
        team.run(
            2,
            [](void* pointer, unsigned index) {
                auto& p = *static_cast<Parts*>(pointer);
                if (index == 0) return;
                ++p.times;
                p.may_come = true;
                std::this_thread::sleep_for(std::chrono::milliseconds(50));
            },
            &parts);
    });
    EXPECT_EQ(parts.times, 1);
}

TEST(Team, PassesOnWhatItsLeaderThrows)
{
    cpu::Team team;
    Threads jobs(3);
    EXPECT_THROW(team.gather(jobs, 3, [] { throw std::runtime_error("no memory"); }), std::runtime_error);
    count_parts(team, jobs);  // and goes on
}

}  // namespace
}  // namespace pliant

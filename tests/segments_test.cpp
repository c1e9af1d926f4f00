// The host skips exactly what the guards of a program skip.
#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "backend/vulkan/segments.hpp"
#include "body/cloth_model.hpp"
#include "pliant/pliant.hpp"
#include "solve/frame.hpp"

namespace pliant {
namespace {

using vulkan::Segment;
using vulkan::segments_of;

std::vector<Call> frame_of(const char* scene_name, std::uint32_t steps)
{
    const Scene scene = read_scene(scene_name);
    std::vector<ClothModel> models;
    for (std::size_t c = 0; c < scene.cloth_count(); ++c) models.emplace_back(scene.cloth(c), scene);
    std::vector<Call> calls;
    append_frame(models, steps, 0, calls, ~0u);
    return calls;
}

/// Calls that run while these guards are set, by the rule of every backend.
std::vector<std::size_t> called(const std::vector<Call>& calls, const std::set<Guard>& set)
{
    std::vector<std::size_t> result;
    for (std::size_t k = 0; k < calls.size(); ++k)
        if (set.count(calls[k].guard) == 0) result.push_back(k);
    return result;
}
/// The same by segments; `submitted` counts the calls in them.
std::vector<std::size_t> called_in_segments(const std::vector<Call>& calls, const std::set<Guard>& set,
                                            std::size_t& submitted)
{
    const std::vector<Segment> segments = segments_of(calls);
    std::vector<std::size_t> result;
    submitted = 0;
    for (std::size_t s = 0; s < segments.size();) {
        const Segment& segment = segments[s];
        if (segment.looks && set.count(calls[segment.first].guard) > 0) {
            EXPECT_GT(segment.next, s);
            s = segment.next;
            continue;
        }
        submitted += segment.end - segment.first;
        for (std::size_t k = segment.first; k < segment.end; ++k)
            if (set.count(calls[k].guard) == 0) result.push_back(k);
        ++s;
    }
    return result;
}

TEST(Segments, LeaveOutWhatGuardsSkipAndNothingElse)
{
    // Newton's loop ends those of linear systems and of the search with it.
    const std::set<Guard> states[] = {{},
                                      {Guard::linear},
                                      {Guard::search},
                                      {Guard::linear, Guard::search},
                                      {Guard::newton, Guard::linear, Guard::search},
                                      {Guard::idle, Guard::newton, Guard::linear, Guard::search}};
    for (const char* scene : {"hanging", "hanging_constraint", "cloth_sphere", "paper_fig10", "many"}) {
        const std::vector<Call> calls = frame_of(scene, 3);
        const std::vector<Segment> segments = segments_of(calls);
        ASSERT_FALSE(segments.empty());
        EXPECT_EQ(segments.front().first, 0u);
        EXPECT_EQ(segments.back().end, calls.size());
        for (std::size_t s = 1; s < segments.size(); ++s) EXPECT_EQ(segments[s].first, segments[s - 1].end);
        for (const std::set<Guard>& set : states) {
            std::size_t submitted = 0;
            EXPECT_EQ(called_in_segments(calls, set, submitted), called(calls, set)) << scene;
        }
    }
}

TEST(Segments, AreOneWithoutLoops)
{
    EXPECT_EQ(segments_of(frame_of("hanging", 4)).size(), 1u);
    EXPECT_TRUE(segments_of({}).empty());
}

TEST(Segments, EndWithTheNewtonIterationThatSolvesAStep)
{
    // Newton's method ends by its second check, of 24 that are recorded. What is submitted are the calls up
    // to there, and those that nothing guards.
    const std::vector<Call> calls = frame_of("hanging_constraint", 1);
    std::size_t solved = 0, checks = 0, unguarded = 0;
    for (std::size_t k = 0; k < calls.size(); ++k) {
        if (calls[k].pass == Pass::newton_check && ++checks == 2) solved = k + 1;
        if (checks >= 2 && k >= solved && calls[k].guard == Guard::none) ++unguarded;
    }
    ASSERT_EQ(checks, 24u);
    std::size_t submitted = 0, waits = 0;
    const std::vector<Segment> segments = segments_of(calls);
    for (std::size_t s = 0; s < segments.size();) {
        waits += segments[s].looks ? 1 : 0;
        if (segments[s].looks && segments[s].first >= solved) {
            s = segments[s].next;
            continue;
        }
        submitted += segments[s].end - segments[s].first;
        ++s;
    }
    EXPECT_EQ(submitted, solved + unguarded);
    EXPECT_EQ(waits, 2u);
}

TEST(Segments, OfAnIdleStepOfAcadAreShort)
{
    const std::vector<Call> calls = frame_of("cloth_sphere", 8);
    std::size_t submitted = 0;
    called_in_segments(calls, {Guard::idle, Guard::newton, Guard::linear, Guard::search}, submitted);
    EXPECT_GT(calls.size(), 8u * 1000u);
    EXPECT_LT(submitted, 8u * 30u);
}

}  // namespace
}  // namespace pliant

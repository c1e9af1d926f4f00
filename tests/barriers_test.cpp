// Barriers between the passes of whole frames: wherever two calls touch the same memory and one of them
// writes, a barrier must be between them. The test checks all pairs of calls.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "backend/vulkan/barrier_plan.hpp"
#include "pliant/mesh_generators.hpp"
#include "solve/frame.hpp"
#include "test_cloths.hpp"

namespace pliant {
namespace {

/// The memory of a resource: each copy of the state is current in every second step.
std::pair<std::uint32_t, std::string> memory_of(const Call& call, Resource resource)
{
    const std::string now = std::to_string(call.parity), next = std::to_string(1 - call.parity);
    switch (resource) {
        case Resource::position: return {call.cloth, "position " + now};
        case Resource::next_position: return {call.cloth, "position " + next};
        case Resource::velocity: return {call.cloth, "velocity " + now};
        case Resource::next_velocity: return {call.cloth, "velocity " + next};
        default: return {call.cloth, std::to_string(static_cast<int>(resource))};
    }
}

bool depend_on_each_other(const Call& a, const Call& b)
{
    const auto memories = [](const Call& call, std::span<const Resource> resources) {
        std::set<std::pair<std::uint32_t, std::string>> result;
        for (const Resource r : resources) result.insert(memory_of(call, r));
        return result;
    };
    const auto reads = [&](const Call& call) {
        auto result = memories(call, description_of(call.pass).reads);
        if (call.guard != Guard::none) result.insert(memory_of(call, Resource::scalars));
        return result;
    };
    const auto writes = [&](const Call& call) { return memories(call, description_of(call.pass).writes); };
    const auto meet = [](const auto& one, const auto& other) {
        return std::any_of(one.begin(), one.end(), [&](const auto& m) { return other.count(m) > 0; });
    };
    return meet(writes(a), reads(b)) || meet(writes(a), writes(b)) || meet(reads(a), writes(b));
}

Scene scene_of(Method method, bool body)
{
    Scene scene;
    scene.method = method;
    Cloth cloth =
        body ? Cloth::soft_body(icosphere_mesh({.radius = 0.4, .frequency = 2})) : test::flat_sheet(5, 4);
    cloth.pin(Attachment(std::uint32_t{1}, {{.time = 0}, {.time = 1, .position = {1, 0, 0}}}));
    scene.add(cloth);
    scene.air = {.velocity = {3, 0.5, -1}, .density = 1.2, .drag = 1.1, .lift = 0.4};
    return scene;
}

class Barriers : public testing::TestWithParam<std::pair<Method, bool>> {};

TEST_P(Barriers, PartAllThatDependsOnEachOtherAndNoMore)
{
    const auto& [method, body] = GetParam();
    const Scene scene = scene_of(method, body);
    std::vector<ClothModel> models;
    for (int k = 0; k < 2; ++k) models.emplace_back(scene.cloth(0), scene);  // which are independent
    std::vector<Call> calls;
    append_frame(models, 3, 0, calls, 0);
    calls.resize(std::min<std::size_t>(calls.size(), 1000));

    vulkan::BarrierPlan plan;
    std::vector<bool> before;
    for (const Call& call : calls) before.push_back(plan.needed_before(call));
    EXPECT_FALSE(before[0]);
    for (std::size_t j = 1, since = 0; j < calls.size(); ++j) {
        bool needed = false;
        for (std::size_t i = since; i < j; ++i) needed |= depend_on_each_other(calls[i], calls[j]);
        EXPECT_EQ(before[j], needed) << j << ": " << description_of(calls[j].pass).name;
        if (before[j]) since = j;
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, Barriers,
                         testing::Values(std::pair{Method::mass_spring, false},
                                         std::pair{Method::constraint, false}, std::pair{Method::acad, false},
                                         std::pair{Method::mass_spring, true},
                                         std::pair{Method::volume, true}),
                         [](const auto& param) {
                             return std::string(name_of(param.param.first)) +
                                    (param.param.second ? "_body" : "");
                         });

TEST(BarrierPlan, PartsWhatFramesDoNotHave)
{
    // In a frame two steps always conflict in more than one resource.
    using Calls = std::vector<Call>;
    const auto last_needs_one = [](const Calls& calls) {
        vulkan::BarrierPlan plan;
        bool needed = false;
        for (const Call& call : calls) needed = plan.needed_before(call);
        return needed;
    };
    const Call draws_0{Pass::sheet_normal, 0, 0}, draws_1{Pass::sheet_normal, 0, 1};
    const Call pins_0{Pass::attach, 0, 0}, pins_1{Pass::attach, 0, 1};
    EXPECT_TRUE(last_needs_one({draws_0, pins_1}));   // writes what was read
    EXPECT_FALSE(last_needs_one({draws_1, pins_1}));  // the other copy
    EXPECT_TRUE(last_needs_one({pins_0, draws_1}));   // reads what was written in another role
    EXPECT_TRUE(last_needs_one({pins_1, draws_0}));
    EXPECT_FALSE(last_needs_one({pins_0, draws_0}));
    EXPECT_TRUE(last_needs_one({draws_0, draws_1}));  // both write normals
    EXPECT_FALSE(last_needs_one({draws_0, {Pass::sheet_strain, 0, 0}}));
    EXPECT_FALSE(last_needs_one({draws_0, {Pass::sheet_normal, 1, 0}}));  // another cloth
}

}  // namespace
}  // namespace pliant

// Built-in scenes, and sheets of odd sizes, have the hashes of golden_hashes.json: on every backend in float,
// with packs of every width, on any number of threads, from every compiler and on every machine. The
// reference has none there: it is double, and pass tests hold it to the others by what rounding allows.
//
//   PLIANT_GOLDEN=all      all frames of the file, and every width with every number of threads; else the
//   first
//                          frame alone, where widths and numbers of threads take turns but for some cases
//   PLIANT_GOLDEN=vulkan   nothing but the Vulkan device (another driver: VK_DRIVER_FILES)
//   PLIANT_UPDATE_HASHES=1 writes the file anew instead. A change of bits is a change of the file, with its
//                          reason in the commit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>

#include <nlohmann/json.hpp>

#include "record/run_record.hpp"
#include "test_paths.hpp"
#include "test_runners.hpp"

namespace pliant {
namespace {

using Json = nlohmann::ordered_json;
const std::string& golden_file()
{
    static const std::string name = std::string(test::project_folder) + "/tests/golden_hashes.json";
    return name;
}

std::string setting(const char* name)
{
    const char* value = std::getenv(name);
    return value ? value : "";
}
bool updates() { return !setting("PLIANT_UPDATE_HASHES").empty(); }

struct Case {
    std::string name, scene;
    std::vector<std::string> overrides;
    bool every_way = false;                       ///< in any run of the test
    std::map<std::uint64_t, std::string> hashes;  ///< after so many frames
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

std::vector<Case>& cases()
{
    static std::vector<Case> all = [] {
        std::vector<Case> read;
        std::ifstream file(golden_file());
        for (const Json& entry : Json::parse(file)) {
            Case c{entry.at("name"), entry.at("scene"), {}, entry.value("every_way", false), {}};
            const Json set = entry.value("set", Json::object());
            for (const auto& [path, value] : set.items()) c.overrides.push_back(path + "=" + value.dump());
            for (const auto& [frames, hash] : entry.at("frames").items())
                c.hashes[std::stoull(frames)] = hash;
            read.push_back(c);
        }
        return read;
    }();
    return all;
}

std::map<std::uint64_t, std::string> hashes_of(const Case& c, const SimulationOptions& options, bool all)
{
    const Scene scene = read_scene(c.scene, c.overrides);
    Simulation simulation(scene, options);
    std::map<std::uint64_t, std::string> hashes;
    std::uint64_t frame = 0;
    for (const auto& [frames, hash] : c.hashes) {
        if (!all && !hashes.empty()) break;
        for (; frame < frames; ++frame) simulation.advance(1 / scene.time.frame_rate);
        hashes[frames] = hash_text(simulation.state_hash());
    }
    EXPECT_TRUE(simulation.report().finite) << c.name;
    return hashes;
}

/// Every width, and every number of threads, but not each with each.
std::vector<test::CpuWay> ways_by_turns()
{
    const std::vector<test::CpuWay> all = test::every_cpu_way();
    const std::size_t sets = test::instruction_sets().size(), threads = all.size() / sets;
    std::vector<test::CpuWay> ways;
    for (std::size_t k = 0; k < sets; ++k) ways.push_back(all[k * threads + (k + 1) % threads]);
    return ways;
}

class Golden : public testing::TestWithParam<Case> {
protected:
    static void TearDownTestSuite()
    {
        if (updates()) write();
    }

private:
    /// A line for each case, so that a change shows whom it concerns.
    static void write()
    {
        std::ifstream before(golden_file());
        Json entries = Json::parse(before);
        std::ofstream file(golden_file());
        const char* separator = "[\n";
        for (Json& entry : entries) {
            const auto found = std::find_if(cases().begin(), cases().end(),
                                            [&](const Case& c) { return c.name == entry.at("name"); });
            entry["frames"] = Json::object();
            for (const auto& [frames, hash] : found->hashes) entry["frames"][std::to_string(frames)] = hash;
            file << separator << entry.dump();
            separator = ",\n";
        }
        file << "\n]\n";
    }
};

TEST_P(Golden, HashesAreThoseOfTheFile)
{
    const std::string golden = setting("PLIANT_GOLDEN");
    const bool all = golden == "all";
    if (updates()) {
        for (Case& c : cases())
            if (c.name == GetParam().name) c.hashes = hashes_of(c, {.backend = Backend::cpu}, true);
        return;
    }
    const auto expect_hashes = [&](const SimulationOptions& options, const std::string& who,
                                   bool to_the_end) {
        for (const auto& [frames, hash] : hashes_of(GetParam(), options, to_the_end))
            EXPECT_EQ(hash, GetParam().hashes.at(frames)) << who << ", after " << frames << " frames";
    };
    if (golden != "vulkan") {
        if (all || GetParam().every_way)
            for (const test::CpuWay& way : test::every_cpu_way())
                expect_hashes(way.options(), testing::PrintToString(way), false);
        if (all || !GetParam().every_way)
            for (const test::CpuWay& way : ways_by_turns())
                expect_hashes(way.options(), testing::PrintToString(way), all);
    }
    if (!test::has_vulkan) return;
    SimulationOptions vulkan = test::on(Backend::vulkan);
    ASSERT_TRUE(vulkan.shared_device) << "there is no Vulkan device";
    expect_hashes(vulkan, vulkan.shared_device->info().name, all);
}

INSTANTIATE_TEST_SUITE_P(Cases, Golden, testing::ValuesIn(cases()),
                         [](const auto& param) { return param.param.name; });

TEST(GoldenFile, HasEveryBuiltInScene)
{
    std::set<std::string> there;
    for (const Case& c : cases())
        if (c.overrides.empty()) there.insert(c.scene);
    for (const SceneListing& scene : list_scenes()) EXPECT_EQ(there.count(scene.name), 1U) << scene.name;
}

}  // namespace
}  // namespace pliant

// Pipelines that are kept between runs: found again, and no harm when the file is not what it was.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "backend/vulkan/device.hpp"
#include "pliant/pliant.hpp"

namespace pliant {
namespace {

namespace fs = std::filesystem;

class PipelineStore : public testing::Test {
protected:
    PipelineStore()
        : folder_(fs::temp_directory_path() /
                  ("pliant_pipelines_" +
                   std::string(testing::UnitTest::GetInstance()->current_test_info()->name())))
    {
        fs::remove_all(folder_);
    }
    ~PipelineStore() override
    {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }
    /// The state after a frame on a device that keeps its pipelines in the folder.
    std::uint64_t run() const
    {
        SimulationOptions options;
        options.backend = Backend::vulkan;
        options.validation = true;
        options.pipeline_folder = folder_;
        Simulation simulation(read_scene("parity"), options);
        simulation.advance(1 / 60.0);
        EXPECT_EQ(simulation.report().validation_messages, 0u);
        return simulation.state_hash();
    }
    fs::path file() const
    {
        for (const auto& entry : fs::directory_iterator(folder_)) return entry.path();
        return {};
    }
    static std::string contents(const fs::path& file)
    {
        std::ifstream stream(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    fs::path folder_;
};

TEST_F(PipelineStore, KeepsPipelinesInAFolderThatItMakes)
{
    const std::uint64_t first = run();
    ASSERT_FALSE(file().empty());
    const std::string kept = contents(file());
    EXPECT_EQ(kept.substr(0, 8), "pliantp1");
    EXPECT_GE(kept.size(), 16u + 32u);  // our header, and at least the driver's
    EXPECT_EQ(run(), first);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}), 1);
}

TEST_F(PipelineStore, IgnoresAFileThatIsDamagedAndReplacesIt)
{
    const std::uint64_t first = run();
    const std::string whole = contents(file());
    for (const auto& damaged : {std::string{}, whole.substr(0, 11), whole.substr(0, whole.size() / 2),
                                std::string(whole.size(), 'x'), whole + "more"}) {
        std::ofstream(file(), std::ios::binary) << damaged;
        EXPECT_EQ(run(), first);
        EXPECT_EQ(contents(file()).size(), whole.size());
    }
    std::string flipped = whole;
    flipped[flipped.size() - 5] ^= 1;
    std::ofstream(file(), std::ios::binary) << flipped;
    EXPECT_EQ(run(), first);
    EXPECT_NE(contents(file()), flipped);
}

TEST_F(PipelineStore, RunsWhereTheFolderCannotBeMade)
{
    std::ofstream(folder_.string()) << "a file in the folder's place";
    run();
    EXPECT_EQ(contents(folder_), "a file in the folder's place");
}

}  // namespace
}  // namespace pliant

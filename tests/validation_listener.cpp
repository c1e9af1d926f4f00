// Linked into every test that opens Vulkan devices: a test fails when the validation layer said anything
// during it, and be it while a device was closed.
#include <gtest/gtest.h>

#include "backend/vulkan/device.hpp"

namespace pliant {
namespace {

class ValidationListener final : public testing::EmptyTestEventListener {
    void OnTestStart(const testing::TestInfo&) override
    {
        before_ = vulkan::Device::all_validation_messages();
    }
    void OnTestEnd(const testing::TestInfo& test) override
    {
        EXPECT_EQ(vulkan::Device::all_validation_messages(), before_)
            << "messages of the Vulkan validation layer in " << test.name();
    }
    std::uint64_t before_ = 0;
};

const bool listening = [] {
    testing::UnitTest::GetInstance()->listeners().Append(new ValidationListener);  // which takes ownership
    return true;
}();

}  // namespace
}  // namespace pliant

// Linked into every test that opens Vulkan devices: a test fails when the validation layer said anything
// during it, and be it while a device was closed. And all of them fail when they do not run on the device
// that PLIANT_EXPECT_DEVICE names a part of: a driver or a layer that was not found is otherwise passed over
// in silence.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "backend/vulkan/device.hpp"
#include "test_cloths.hpp"

namespace pliant {
namespace {

std::shared_ptr<vulkan::Device> kept_device;

class SharedDevice final : public testing::Environment {
    void TearDown() override
    {
        const std::uint64_t before = vulkan::Device::all_validation_messages();
        kept_device.reset();
        EXPECT_EQ(vulkan::Device::all_validation_messages(), before)
            << "messages of the Vulkan validation layer while the device was closed";
    }
};

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

class DeviceCheck final : public testing::Environment {
    void SetUp() override
    {
        const char* expected = std::getenv("PLIANT_EXPECT_DEVICE");
        if (!expected) return;
        const auto devices = vulkan::list_physical_devices();
        ASSERT_FALSE(devices.empty()) << "there is no Vulkan device, instead of " << expected;
        for (const auto& device : devices)
            ASSERT_NE(device.name.find(expected), std::string::npos)
                << device.name << " instead of " << expected;
    }
};

const bool listening = [] {
    testing::AddGlobalTestEnvironment(new SharedDevice);                           // which takes ownership
    testing::AddGlobalTestEnvironment(new DeviceCheck);                            // which takes ownership
    testing::UnitTest::GetInstance()->listeners().Append(new ValidationListener);  // which takes ownership
    return true;
}();

}  // namespace

std::shared_ptr<vulkan::Device> test::shared_device()
{
    if (!kept_device && !vulkan::list_physical_devices().empty())
        kept_device = std::make_shared<vulkan::Device>(vulkan::DeviceOptions{.validation = true});
    return kept_device;
}

}  // namespace pliant

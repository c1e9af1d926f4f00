// Backends below the public face, for tests of passes.
#pragma once

#include <memory>
#include <random>

#include <gtest/gtest.h>

#include "backend/pass_runner.hpp"
#include "backend/vulkan/device.hpp"
#include "backend/vulkan/vulkan_runner.hpp"
#include "test_cloths.hpp"

namespace pliant::test {

inline std::unique_ptr<PassRunner> make_runner(Backend backend, const ClothModel& model)
{
    if (backend == Backend::vulkan) return make_vulkan_runner({&model, 1}, on(backend));
    return backend == Backend::reference ? make_reference_runner({&model, 1})
                                         : make_cpu_runner({&model, 1}, {});
}

/// Tests with one device for all of a suite, so that pipelines are compiled once.
template <class Parameter>
class OnOneDevice : public testing::TestWithParam<Parameter> {
protected:
    static void SetUpTestSuite()
    {
        device = std::make_shared<vulkan::Device>(vulkan::DeviceOptions{.validation = true});
    }
    static void TearDownTestSuite() { device.reset(); }
    static inline std::shared_ptr<vulkan::Device> device;
};

/// A cloth whose nodes are shaken, so that springs are stretched and moving.
inline ClothModel shaken_model(const Scene& scene)
{
    ClothModel model(scene.cloth(0), scene);
    std::mt19937 engine(11);
    std::uniform_real_distribution<float> unit(-1, 1);
    const double length = model.sheet ? model.sheet->rest_lengths[0] : model.springs.front().rest_length;
    const float shake = 0.1f * static_cast<float>(length);
    for (std::size_t i = 0; i < model.positions.size(); ++i) {
        Vec3& x = model.positions[i];
        x = {x.x + shake * unit(engine), x.y + shake * unit(engine), x.z + shake * unit(engine)};
        if (model.inverse_mass(i) > 0) model.velocities[i] = {unit(engine), unit(engine), unit(engine)};
    }
    return model;
}

}  // namespace pliant::test

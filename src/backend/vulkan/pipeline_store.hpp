// Keeps compiled pipelines in a file between runs, so that a driver compiles each shader once.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>

#include <vulkan/vulkan_raii.hpp>

#include "pliant/api.hpp"

namespace pliant::vulkan {

class PLIANT_INSIDE PipelineStore {
public:
    /// Without a file.
    PipelineStore() = default;
    /// Uses a file for this device and driver in `folder`, which is created if needed; with an empty name,
    /// none. A file that is damaged, or of another driver, is ignored; file errors never throw.
    PipelineStore(const vk::raii::PhysicalDevice& physical, const vk::raii::Device& device,
                  const std::filesystem::path& folder);

    /// For the creation of pipelines, which it finds and stores.
    const vk::raii::PipelineCache& cache() const { return cache_; }
    /// Writes the file if there are new pipelines. Thread-safe.
    void keep() noexcept;

private:
    std::unique_ptr<std::mutex> turn_ = std::make_unique<std::mutex>();  // a pointer, so that a store can be
                                                                         // moved
    std::filesystem::path file_;
    std::size_t kept_size_ = 0;  ///< bytes in the file
    vk::raii::PipelineCache cache_{nullptr};
};

}  // namespace pliant::vulkan

// Compiled pipelines that are kept in a file between runs, so that a driver compiles each shader once.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>

#include <vulkan/vulkan_raii.hpp>

#include "pliant/api.hpp"

namespace pliant::vulkan {

class PLIANT_INSIDE PipelineStore {
public:
    /// Keeps nothing between runs.
    PipelineStore() = default;
    /// A file for this device and driver in `folder`, which need not exist yet; without a name, none.
    /// A file that is damaged, or of another driver, is as good as none: nothing here ever throws for a file.
    PipelineStore(const vk::raii::PhysicalDevice& physical, const vk::raii::Device& device,
                  const std::filesystem::path& folder);

    /// For making pipelines; they are found in it, and left in it.
    const vk::raii::PipelineCache& cache() const { return cache_; }
    /// Writes the file if there are more pipelines than it has. Threads take turns.
    void keep() noexcept;

private:
    std::unique_ptr<std::mutex> turn_ = std::make_unique<std::mutex>();  // a store may be moved
    std::filesystem::path file_;
    std::size_t kept_size_ = 0;  ///< bytes of what the file holds
    vk::raii::PipelineCache cache_{nullptr};
};

}  // namespace pliant::vulkan

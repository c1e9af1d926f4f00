#include "backend/vulkan/pipeline_store.hpp"

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "files/atomic_file.hpp"

namespace pliant::vulkan {
namespace {

/// Precedes the driver's data. A driver trusts that data, so it is verified first.
struct FileHeader {
    std::array<char, 8> name{'p', 'l', 'i', 'a', 'n', 't', 'p', '1'};
    std::uint64_t sum = 0;
};

/// FNV-1a.
std::uint64_t sum_of(const std::vector<std::uint8_t>& data)
{
    std::uint64_t sum = 0xcbf29ce484222325ull;
    for (const std::uint8_t byte : data) sum = (sum ^ byte) * 0x100000001b3ull;
    return sum;
}

/// The name includes device and driver: others have their own file.
std::string file_name(const vk::PhysicalDeviceProperties& properties)
{
    std::string name = "pipelines-";
    constexpr char digits[] = "0123456789abcdef";
    for (const std::uint8_t byte : properties.pipelineCacheUUID) {
        name += digits[byte >> 4];
        name += digits[byte & 15];
    }
    return name + ".bin";
}

/// Empty if there is no file, or a damaged one.
std::vector<std::uint8_t> read_file(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    FileHeader header;
    if (!stream.read(reinterpret_cast<char*>(&header), sizeof header) || header.name != FileHeader{}.name)
        return {};
    std::vector<std::uint8_t> data{std::istreambuf_iterator<char>(stream), {}};
    return sum_of(data) == header.sum ? data : std::vector<std::uint8_t>{};
}

}  // namespace

PipelineStore::PipelineStore(const vk::raii::PhysicalDevice& physical, const vk::raii::Device& device,
                             const std::filesystem::path& folder)
{
    std::vector<std::uint8_t> data;
    if (!folder.empty()) {
        file_ = folder / file_name(physical.getProperties());
        data = read_file(file_);
        kept_size_ = data.size();
    }
    cache_ = {device, vk::PipelineCacheCreateInfo({}, data.size(), data.data())};
}

void PipelineStore::keep() noexcept
{
    const std::scoped_lock turn(*turn_);
    if (file_.empty() || !*cache_) return;
    try {
        const std::vector<std::uint8_t> data = cache_.getData();
        if (data.size() <= kept_size_) return;
        kept_size_ = data.size();
        std::filesystem::create_directories(file_.parent_path());
        FileHeader header;
        header.sum = sum_of(data);
        AtomicFile file(file_);
        file.stream().write(reinterpret_cast<const char*>(&header), sizeof header);
        file.stream().write(reinterpret_cast<const char*>(data.data()),
                            static_cast<std::streamsize>(data.size()));
        file.commit();
    } catch (const std::exception&) {
        file_.clear();  // The folder cannot be written: the next run compiles the pipelines again.
    }
}

}  // namespace pliant::vulkan

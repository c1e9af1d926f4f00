// How a simulation runs: where, on how many threads, with whose.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "pliant/api.hpp"

namespace pliant {

namespace vulkan {
class Device;
}

/// Where the passes run.
enum class Backend {
    automatic,  ///< a real GPU when there is one, else cpu
    cpu,        ///< SIMD and threads, float
    vulkan,     ///< compute shaders, float; the same bits as cpu
    reference,  ///< serial, double, plain loops: the oracle
};

/// Lends the simulation the threads of a host, a game engine's for one. Without it Pliant uses its own.
class PLIANT_API JobSystem {
public:
    virtual ~JobSystem() = default;
    /// How many tasks can run at once, >= 1.
    virtual unsigned thread_count() const = 0;
    /// Calls task(context, 0) ... task(context, count - 1), in any order and on any threads; returns when all
    /// are done.
    virtual void run(unsigned count, void (*task)(void* context, unsigned index), void* context) = 0;
};

struct SimulationOptions {
    Backend backend = Backend::automatic;
    int device = -1;       ///< Vulkan: index as listed by `pliant info`; -1 chooses the best
    unsigned threads = 0;  ///< cpu: 0 means one for each core; results do not depend on it
    std::string instruction_set =
        {};  ///< cpu: "sse2", "avx2", "avx512"; empty chooses the widest of this machine
    /// cpu and vulkan: explicit steps with the machine's own inverse square root, and products fused with
    /// sums. The bits then depend on the machine, its driver and the number of threads, and each is as good
    /// as the others (docs/performance.md). The constraint solver's arithmetic stays as it is. Throws
    /// Error(bad_usage) on a CPU without AVX2.
    bool fast_math = false;
    JobSystem* job_system = nullptr;  ///< cpu: borrowed, must outlive the simulation
    bool validation = false;          ///< Vulkan: with the validation layer; its messages count in `report()`
    /// Vulkan: steps of a sheet that are made in one dispatch, 1 to 4, where nothing is between them (no
    /// wind, no moving pin, one cloth). The bits are the same; which number is fastest depends on the device.
    unsigned gpu_substeps = 1;
    /// Vulkan: a folder in which compiled pipelines are kept between runs, made when it is missing; empty
    /// keeps none. What is damaged there, or of another driver, is ignored.
    std::filesystem::path pipeline_folder = {};
    /// Vulkan, for Pliant's own viewer: a device that is open already, instead of `device` and `validation`.
    std::shared_ptr<vulkan::Device> shared_device = nullptr;
};

/// Milliseconds spent in one pass since the start, by the device's own clock.
struct PassTime {
    std::string name;
    double milliseconds = 0;
    std::uint64_t calls = 0;
};

/// A place where passes can run, as `pliant info` lists it.
struct DeviceListing {
    Backend backend = Backend::cpu;
    int index = 0;           ///< for SimulationOptions::device, Vulkan only
    std::string name, kind;  ///< kind: "discrete GPU", "integrated GPU", "software", "avx512", ...
    std::string details;     ///< limits, one line
};
PLIANT_API std::vector<DeviceListing> list_devices();

PLIANT_API const char* name_of(Backend backend);

}  // namespace pliant

// Options of a simulation: backend, device and threads.
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

/// What runs the passes.
enum class Backend {
    automatic,  ///< a hardware GPU if there is one, else cpu
    cpu,        ///< SIMD and threads, float
    vulkan,     ///< compute shaders, float; the same bits as cpu
    reference,  ///< serial, double, plain loops: the oracle
};

/// Runs Pliant's tasks on the threads of a host, for example a game engine. Without it Pliant uses its own.
class PLIANT_API JobSystem {
public:
    virtual ~JobSystem() = default;
    /// How many tasks can run concurrently, >= 1.
    virtual unsigned thread_count() const = 0;
    /// Calls task(context, 0) ... task(context, count - 1), in any order and on any threads; returns when all
    /// are done.
    virtual void run(unsigned count, void (*task)(void* context, unsigned index), void* context) = 0;
};

struct SimulationOptions {
    Backend backend = Backend::automatic;
    int device = -1;       ///< Vulkan: index as listed by `pliant info`; -1 chooses the best
    unsigned threads = 0;  ///< cpu: 0 means one per core; results do not depend on it
    std::string instruction_set =
        {};  ///< cpu: "sse2", "avx2", "avx512"; empty chooses the widest of this machine
    /// cpu and vulkan: explicit steps use the machine's own inverse square root and fused multiply-add. The
    /// bits then depend on the machine, its driver and the number of threads; accuracy does not
    /// (docs/notes/explicit_steps.md). The constraint solver is not affected. Throws Error(bad_usage) on a
    /// CPU without AVX2.
    bool fast_math = false;
    JobSystem* job_system = nullptr;  ///< cpu: not owned, must outlive the simulation
    bool validation = false;          ///< Vulkan: enables the validation layer; `report()` counts its
                                      ///< messages
    /// Vulkan: consecutive steps of a sheet that run in one dispatch, 1 to 4, if nothing runs between them
    /// (no wind, no moving pin, one cloth). The bits are the same; the fastest number depends on the device.
    unsigned gpu_substeps = 1;
    /// Vulkan: a folder in which compiled pipelines are kept between runs, created if missing; empty: not
    /// kept. Files that are damaged, or of another driver, are ignored.
    std::filesystem::path pipeline_folder = {};
    /// Vulkan, for Pliant's own viewer: uses this open device instead of `device` and `validation`.
    std::shared_ptr<vulkan::Device> shared_device = nullptr;
};

/// Milliseconds spent in one pass since the start, by the clock of the device.
struct PassTime {
    std::string name;
    double milliseconds = 0;
    std::uint64_t calls = 0;
};

/// A device on which passes can run, as `pliant info` lists it.
struct DeviceListing {
    Backend backend = Backend::cpu;
    int index = 0;           ///< for SimulationOptions::device, Vulkan only
    std::string name, kind;  ///< kind: "discrete GPU", "integrated GPU", "software", "avx512", ...
    std::string details;     ///< limits, one line
};
PLIANT_API std::vector<DeviceListing> list_devices();

PLIANT_API const char* name_of(Backend backend);

}  // namespace pliant

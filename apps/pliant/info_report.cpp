#include "info_report.hpp"

#include <chrono>
#include <cstdio>
#include <map>
#include <set>
#include <thread>

#include <sys/utsname.h>

#include <nlohmann/json.hpp>

#include "backend/cpu/kernels.hpp"
#include "backend/vulkan/device_report.hpp"
#include "files/atomic_file.hpp"
#include "pliant/error.hpp"
#include "pliant/simulation.hpp"
#include "pliant/version.hpp"
#include "processor.hpp"
#include "progress.hpp"
#include "record/run_record.hpp"

namespace pliant::tool {
namespace {

using Json = nlohmann::ordered_json;

struct ReportScene {
    const char* name;
    std::uint64_t frames;
};
// A sheet, a list of springs, a mesh of constraints, the paper's solver, and a body with volume: together
// nearly all passes, with few frames, so that a slow device takes only minutes.
constexpr ReportScene scenes[] = {
    {"parity", 3}, {"wind_list", 3}, {"tablecloth", 1}, {"paper_fig15", 2}, {"twist", 3}};

std::uint64_t frames_of_all()
{
    std::uint64_t frames = 0;
    for (const ReportScene& scene : scenes) frames += scene.frames;
    return frames;
}

double seconds_since(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

/// Contains nothing that identifies a person or a place.
Json describe_machine()
{
    Json machine;
    utsname system{};
    uname(&system);
    machine["system"] = std::string(system.sysname) + " " + system.release;
    machine["architecture"] = system.machine;
    machine["processor"] = text_or_null(processor_name());
    machine["threads"] = std::thread::hardware_concurrency();
    Json sets = Json::array();
    for (const cpu::Kernels* kernels : cpu::available_kernels()) sets.push_back(kernels->name);
    machine["instruction_sets"] = std::move(sets);
    machine["compiler"] = __VERSION__;
    return machine;
}

Json describe_device(const vulkan::DeviceReport& device)
{
    Json d;
    d["backend"] = "vulkan";
    d["index"] = device.info.index;
    d["name"] = device.info.name;
    d["kind"] = device.info.kind;
    d["vulkan"] = device.version;
    d["driver"] = text_or_null(device.driver);
    d["driver_version"] = device.driver_version;
    d["vendor_id"] = device.vendor_id;
    d["device_id"] = device.device_id;
    d["memory_bytes"] = device.info.memory;
    Json limits = Json::object();
    for (const auto& [name, value] : device.limits) limits[name] = value;
    d["limits"] = std::move(limits);
    d["flushes_denormals"] = device.info.float_controls.flush_denormals;
    d["rounds_to_nearest"] = device.info.float_controls.round_to_nearest;
    d["promise"] = device.info.promise();
    return d;
}

/// The hash after each scene's frames, and the time taken; the error of a device that fails.
class Runs {
public:
    explicit Runs(std::size_t places) : progress_(places * frames_of_all(), false) {}

    Json on(const SimulationOptions& options, const std::string& where)
    {
        Json runs = Json::array();
        for (const ReportScene& scene : scenes) {
            Json run;
            run["scene"] = scene.name;
            run["frames"] = scene.frames;
            const std::uint64_t end = done_ + scene.frames;
            try {
                run_scene(scene, options, where, run);
            } catch (const Error& error) {
                run["error"] = error.what();
            }
            done_ = end;
            runs.push_back(std::move(run));
        }
        return runs;
    }
    /// Scenes whose hashes differ.
    std::vector<std::string> differing() const
    {
        std::vector<std::string> names;
        for (const auto& [scene, hashes] : hashes_)
            if (hashes.size() > 1) names.push_back(scene);
        return names;
    }

private:
    void run_scene(const ReportScene& scene, const SimulationOptions& options, const std::string& where,
                   Json& run)
    {
        progress_.update(done_, std::string(scene.name) + " on " + where);
        auto start = std::chrono::steady_clock::now();
        const Scene read = read_scene(scene.name);
        Simulation simulation(read, options);
        run["nodes"] = simulation.node_count();
        run["steps_per_frame"] = simulation.steps_per_frame();
        run["start_seconds"] = seconds_since(start);  // on a device mostly the compilation of shaders
        Json times = Json::array();
        for (std::uint64_t frame = 0; frame < scene.frames; ++frame) {
            start = std::chrono::steady_clock::now();
            simulation.advance(1 / read.time.frame_rate);
            times.push_back(seconds_since(start));
            if (simulation.report().device_lost)
                throw Error(ErrorKind::device_failure, simulation.report().failure);
            progress_.update(++done_, std::string(scene.name) + " on " + where);
        }
        run["frame_seconds"] = std::move(times);
        run["finite"] = simulation.report().finite;
        run["state_hash"] = hash_text(simulation.state_hash());
        hashes_[scene.name].insert(hash_text(simulation.state_hash()));
    }

    Progress progress_;
    std::uint64_t done_ = 0;
    std::map<std::string, std::set<std::string>> hashes_;
};

}  // namespace

int write_machine_report(const std::string& file)
{
    AtomicFile target(file);  // fails before minutes of work, not after
    const auto devices = vulkan::report_devices();
    const auto sets = cpu::available_kernels();

    Json report;
    report["machine_report"] = 1;
    report["pliant"] = PLIANT_VERSION;
    report["machine"] = describe_machine();
    Json places = Json::array(), refused = Json::array();
    std::size_t usable = sets.size();
    for (const vulkan::DeviceReport& device : devices)
        if (device.info.refusal.empty()) ++usable;
    std::vector<std::string> differing;
    {
        Runs runs(usable);
        for (const cpu::Kernels* kernels : sets) {
            Json place = {{"backend", "cpu"}, {"instruction_set", kernels->name}};
            SimulationOptions options;
            options.backend = Backend::cpu;
            options.instruction_set = kernels->name;
            place["runs"] = runs.on(options, kernels->name);
            places.push_back(std::move(place));
        }
        for (const vulkan::DeviceReport& device : devices) {
            Json place = describe_device(device);
            if (!device.info.refusal.empty()) {
                place.erase("index");
                place["refusal"] = device.info.refusal;
                refused.push_back(std::move(place));
                continue;
            }
            SimulationOptions options;
            options.backend = Backend::vulkan;
            options.device = device.info.index;
            place["runs"] = runs.on(options, device.info.name);
            places.push_back(std::move(place));
        }
        differing = runs.differing();
    }
    report["places"] = std::move(places);
    report["refused"] = std::move(refused);
    report["differing"] = differing;
    target.stream() << report.dump(2) << '\n';
    target.commit();

    std::printf("wrote %s: %zu scenes on %zu devices and instruction sets\n", file.c_str(), std::size(scenes),
                usable);
    if (differing.empty())
        std::printf("every scene has the same hash everywhere\n");
    else
        for (const std::string& name : differing)
            std::printf("the scene %s has different hashes on different devices\n", name.c_str());
    return 0;
}

}  // namespace pliant::tool

#include "pliant/simulation.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "kernels/planes.hpp"
#include "simulation/implementation.hpp"

namespace pliant {
namespace {

/// FNV-1a, 64 bit, over the bytes of floats.
class StateHash {
public:
    void add(std::span<const Vec3> values)
    {
        for (const Vec3& v : values)
            for (const float number : {v.x, v.y, v.z}) {
                std::uint32_t bits = 0;
                std::memcpy(&bits, &number, sizeof bits);
                for (int byte = 0; byte < 4; ++byte)
                    hash_ = (hash_ ^ (bits >> (8 * byte) & 0xff)) * 0x100000001b3ull;
            }
    }
    std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_ = 0xcbf29ce484222325ull;
};

}  // namespace

Simulation::Simulation(const Scene& scene, const SimulationOptions& options)
    : implementation_(std::make_unique<Implementation>(scene, options))
{
}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

void Simulation::advance(double duration) noexcept
{
    Report& report = implementation_->report;
    if (!(duration > 0) || !std::isfinite(duration)) return;
    if (!report.finite || report.device_lost) {
        implementation_->idle_seconds += duration;
        return;
    }
    try {
        implementation_->advance(duration);
    } catch (const std::exception& error) {
        implementation_->stop(error.what());
    } catch (...) {
        implementation_->stop("a job system threw what is no std::exception");
    }
}

bool SolverReport::is_solved() const noexcept { return residual_max <= double{solved_residual}; }
bool SolverReport::last_is_solved() const noexcept { return residual_last <= double{solved_residual}; }

double Simulation::time() const
{
    return implementation_->report.simulated_seconds + implementation_->idle_seconds;
}
const Report& Simulation::report() const { return implementation_->report; }
std::vector<PassTime> Simulation::pass_times() const
{
    std::vector<PassTime> times;
    pass_times(times);
    return times;
}
void Simulation::pass_times(std::vector<PassTime>& into) const
{
    implementation_->runner->clock().times(into);
}

void Simulation::grab(std::size_t cloth, std::size_t node, Vec3d target, double stiffness, double damping)
{
    implementation_->grab(cloth, node, target, stiffness, damping);
}
void Simulation::release() noexcept
{
    try {
        implementation_->release();
    } catch (const std::exception& error) {
        implementation_->stop(error.what());  // for example if the device is lost
    }
}
State Simulation::state() { return implementation_->state(); }
void Simulation::set_state(const State& state) { implementation_->set_state(state); }

std::vector<PinListing> Simulation::pins(std::size_t cloth) const
{
    const auto& place = implementation_->places.at(cloth);
    const ClothModel& model = implementation_->models[place.model];
    std::vector<PinListing> listing;
    for (std::uint32_t k = 0; k < place.node_count; ++k) {
        const auto node = static_cast<std::uint32_t>(place.node(k));
        if (model.masses.inverse(node) > 0) continue;
        const bool moves = std::any_of(model.attachments.nodes.begin(), model.attachments.nodes.end(),
                                       [&](const AttachedNode& a) { return a.node == node; });
        listing.push_back({k, moves});
    }
    return listing;
}

std::vector<SpringListing> Simulation::springs(std::size_t cloth) const
{
    return implementation_->springs(cloth);
}

std::span<const Vec3> Simulation::positions(const ClothHandle& cloth) { return positions(cloth.index()); }
std::span<const Vec3> Simulation::positions(std::size_t cloth)
{
    return implementation_->values(cloth, Resource::position);
}
std::span<const Vec3> Simulation::velocities(const ClothHandle& cloth) { return velocities(cloth.index()); }
std::span<const Vec3> Simulation::velocities(std::size_t cloth)
{
    return implementation_->values(cloth, Resource::velocity);
}
std::span<const Vec3> Simulation::normals(std::size_t cloth)
{
    return implementation_->values(cloth, Resource::normal);
}
std::span<const float> Simulation::strains(std::size_t cloth) { return implementation_->strains(cloth); }
std::span<const Triangle> Simulation::triangles(std::size_t cloth) const
{
    if (const auto* mesh = std::get_if<SurfaceMesh>(&scene().cloth(cloth).shape)) return mesh->triangles;
    return implementation_->models[implementation_->places.at(cloth).model].shape.triangles();
}

std::span<const float> Simulation::multipliers(std::size_t cloth)
{
    return implementation_->multipliers(cloth);
}

std::span<const std::uint32_t> Simulation::held_springs(std::size_t cloth)
{
    return implementation_->held_springs(cloth);
}

std::uint64_t Simulation::state_hash()
{
    StateHash hash;
    for (std::size_t c = 0; c < implementation_->places.size(); ++c) hash.add(positions(c));
    for (std::size_t c = 0; c < implementation_->places.size(); ++c) hash.add(velocities(c));
    return hash.value();
}

const Scene& Simulation::scene() const { return implementation_->scene; }
Backend Simulation::backend() const { return implementation_->backend; }
std::string Simulation::device_name() const { return implementation_->runner->device_name(); }
unsigned Simulation::thread_count() const { return implementation_->runner->thread_count(); }
std::uint64_t Simulation::node_count() const
{
    std::uint64_t sum = 0;
    for (const ClothModel& model : implementation_->models) sum += model.node_count();
    return sum;
}
std::uint32_t Simulation::node_count(std::size_t cloth) const
{
    return implementation_->places.at(cloth).node_count;
}
std::size_t Simulation::body_count() const { return implementation_->report.bodies.size(); }
std::uint64_t Simulation::spring_count() const
{
    return implementation_->total([](const ClothModel& model) { return model.springs.count; });
}
std::uint64_t Simulation::triangle_count() const
{
    return implementation_->total([](const ClothModel& model) { return model.shape.triangle_count(); });
}

double Simulation::step_length() const
{
    return implementation_->steps_of(1 / scene().time.frame_rate).second;
}
std::uint32_t Simulation::steps_per_frame() const
{
    return static_cast<std::uint32_t>(implementation_->steps_of(1 / scene().time.frame_rate).first);
}
double Simulation::stable_step() const { return implementation_->stable_step; }

std::string Simulation::resolution_warning() const
{
    constexpr double half_ulp = 0x1p-24, noticeable = 1e-3;  // of a rest length
    for (std::size_t c = 0; c < implementation_->places.size(); ++c) {
        const auto& place = implementation_->places[c];
        const ClothModel& model = implementation_->models[place.model];
        const double farthest = double{place.farthest};
        const double shortest = model.springs.shortest;
        if (farthest * half_ulp > noticeable * shortest) {
            char text[256];
            std::snprintf(text, sizeof text,
                          " single precision rounds positions by %.2g m, which is more than a thousandth of "
                          "the shortest spring of %.3g m: ",
                          farthest * half_ulp, shortest);
            char distance[64];
            std::snprintf(distance, sizeof distance, "at %.3g m from ", farthest);
            const std::string& name = scene().cloth(c).name;
            // The origin of a body's coordinates is near its middle.
            if (model.plan.is_body())
                return "body '" + name + "': " + distance + "its middle" + text +
                       "use a mesh without edges as short as that";
            return "cloth '" + name + "': " + distance + "the origin" + text +
                   "move the cloth nearer to the origin, or use fewer nodes";
        }
    }
    return {};
}

std::string Simulation::stability_warning() const
{
    const double step = step_length(), stable = stable_step();
    const bool implicit = uses_solver(scene().method) && scene().solver == Solver::newton_multigrid;
    if (step <= stable || implicit || stepped_method(scene()) == Method::constraint) return {};
    const double frame = 1 / scene().time.frame_rate;
    if (scene().method == Method::acad)
        return "the step of " + text_of_seconds(step) + " exceeds the largest safe one of " +
               text_of_seconds(stable) +
               ": below the threshold, springs are taken softer, as stiff as this step can carry; for their "
               "full "
               "stiffness use at least " +
               std::to_string(static_cast<long long>(std::ceil(frame / stable))) +
               " substeps per frame (time.substeps)";
    return "the step of " + text_of_seconds(step) + " exceeds the largest safe one of " +
           text_of_seconds(stable) + " and the run may diverge: use at least " +
           std::to_string(static_cast<long long>(std::ceil(frame / stable))) +
           " substeps per frame (time.substeps), softer springs or heavier nodes";
}

std::vector<std::string> Simulation::warnings() const
{
    std::vector<std::string> sentences;
    for (std::string& sentence : std::array{stability_warning(), resolution_warning()})
        if (!sentence.empty()) sentences.push_back(std::move(sentence));
    sentences.insert(sentences.end(), implementation_->start_warnings.begin(),
                     implementation_->start_warnings.end());
    return sentences;
}

std::optional<DeviceBuffers> Simulation::device_buffers(std::size_t cloth)
{
    if (!implementation_->device_state) return std::nullopt;
    if (scene().cloth(cloth).is_body()) return std::nullopt;  // its nodes have another order
    const vulkan::Device& device = *implementation_->device_state->device();
    const DeviceClothBuffers buffers = [&] {
        try {
            return implementation_->device_state->drawable(implementation_->places[cloth].model);
        } catch (const std::runtime_error& error) {
            throw Error(ErrorKind::device_failure,
                        "the device " + device_name() + " failed: " + error.what());
        }
    }();
    const auto handle = [](vk::Buffer buffer) {
        return reinterpret_cast<std::uint64_t>(static_cast<VkBuffer>(buffer));
    };
    return DeviceBuffers{static_cast<VkInstance>(*device.instance()),
                         static_cast<VkPhysicalDevice>(*device.physical()),
                         static_cast<VkDevice>(*device.handle()),
                         device.queue_family(),
                         handle(buffers.position),
                         handle(buffers.normal),
                         handle(buffers.strain),
                         buffers.node_count,
                         node_of_vertex(cloth)};
}

std::span<const std::uint32_t> Simulation::node_of_vertex(std::size_t cloth) const
{
    return implementation_->places.at(cloth).node_of_vertex;
}

DeviceState* Simulation::device_state() { return implementation_->device_state; }

}  // namespace pliant

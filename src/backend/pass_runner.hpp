// The interface of all backends: they store the state of cloths, run programs on it, and return it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "body/cloth_model.hpp"
#include "pliant/options.hpp"
#include "solve/pass.hpp"
#include "solve/step_constants.hpp"

namespace pliant {

/// The inputs that change from frame to frame.
struct FrameInput {
    double step_length = 0;  ///< s
    std::uint32_t collider_count = 0;
    std::span<const PlacedCollider> colliders;  ///< collider_count for each step, or once if `colliders_rest`
    bool colliders_rest = true;                 ///< the same at every step
    /// By cloth: positions of its attached nodes, a row per step; empty if the program attaches nothing.
    std::span<const std::vector<Vec3>> attached = {};
    /// By cloth: targets of its bodies at the end of each step, or once if they do not change; see
    /// BodyModel::goal_at. Empty: the targets at the start.
    std::span<const std::vector<VolumeGoal>> goals = {};
    GrabInput grab = {};  ///< the pull of a hand on one of the cloths, if any
    GrabInput grab_of(std::size_t cloth) const { return grab.cloth == cloth ? grab : GrabInput{}; }

    /// Colliders at the end of a step of the frame; calls without colliders may pass any index.
    std::span<const PlacedCollider> colliders_at(std::uint32_t step) const
    {
        const std::size_t first = colliders_rest ? 0 : std::size_t{step} * collider_count;
        return first + collider_count <= colliders.size() ? colliders.subspan(first, collider_count)
                                                          : std::span<const PlacedCollider>{};
    }
};

/// A cloth's measures, merged over its nodes; see laws/measure.law.glsl.
struct MeasureTotals {
    double max_stretch = -1, max_penetration = 0, max_speed2 = 0, stretch_sum = 0;
    double kinetic_energy = 0, elastic_energy = 0, height_moment = 0, non_finite = 0;
};

/// Milliseconds by pass.
class PassClock {
public:
    PassClock();
    void add(Pass pass, double milliseconds, std::uint64_t calls = 1);
    void times(std::vector<PassTime>& into) const;  ///< of the passes that ran, in table order

private:
    std::vector<PassTime> times_;
};

class PassRunner {
public:
    virtual ~PassRunner() = default;

    /// Runs the calls in order. Throws only if a device is lost.
    virtual void run(const Program& program, const FrameInput& input) = 0;

    /// Restores what the last program with this among its `keeps` has saved.
    virtual void put_back(const Kept& kept) = 0;

    /// Copies a resource into floats, as many per entry as Resource documents, in the order of nodes, springs
    /// or levels.
    virtual void read(std::uint32_t cloth, Resource resource, std::uint32_t parity,
                      std::vector<float>& values) = 0;
    /// Replaces the positions (m, in the cloth's coordinates) and velocities (m/s) of all nodes of a cloth.
    virtual void write(std::uint32_t cloth, std::span<const Vec3> positions,
                       std::span<const Vec3> velocities) = 0;
    /// Copies the present mass of a node from the cloth's model.
    virtual void take_mass(std::uint32_t cloth, std::uint32_t node) = 0;
    /// The root of the tree of measures, after a program that computed it.
    virtual MeasureTotals measures(std::uint32_t cloth) = 0;

    /// 6 V in m3 of a body of a cloth, after a program that measured it.
    virtual double volume(std::uint32_t cloth, std::size_t body) = 0;

    /// A scalar of a cloth's constraint solver, by its number in kernels/planes.kernel.glsl.
    virtual double solver_scalar(std::uint32_t cloth, std::size_t number) = 0;
    /// Numbers of the arena of a cloth's constraint solver, see Hierarchy. Reuses the memory of `values`.
    virtual void solver_numbers(std::uint32_t cloth, std::size_t first, std::size_t count,
                                std::vector<float>& values) = 0;
    virtual void write_solver_numbers(std::uint32_t cloth, std::size_t first,
                                      std::span<const float> values) = 0;

    virtual const PassClock& clock() const = 0;
    virtual std::string device_name() const = 0;
    virtual unsigned thread_count() const = 0;
    virtual std::uint64_t validation_messages() const { return 0; }
};

std::unique_ptr<PassRunner> make_reference_runner(std::span<const ClothModel> cloths);
std::unique_ptr<PassRunner> make_cpu_runner(std::span<const ClothModel> cloths,
                                            const SimulationOptions& options);

}  // namespace pliant

// One cloth on the host and every pass over it, one node at a time: PlainCloth<double> is the reference
// backend, PlainCloth<float> the state of the CPU backend, which replaces the hot passes by its SIMD kernels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "backend/host/plain_body.hpp"
#include "backend/host/planes.hpp"
#include "backend/pass_runner.hpp"
#include "body/cloth_model.hpp"
#include "laws/laws.hpp"
#include "solve/pass.hpp"

namespace pliant {

/// A collider in the numbers of a kernel.
template <class T>
typename Laws<T>::Collider make_collider(const PlacedCollider& placed)
{
    const auto number = [](double a) { return static_cast<T>(a); };
    const auto vector = [&](Vec3d a) { return Vector3<T>{number(a.x), number(a.y), number(a.z)}; };
    typename Laws<T>::Collider collider;
    collider.kind = static_cast<int>(placed.kind);
    const bool lets_rise = placed.lets_rise && placed.response == ContactResponse::coulomb;
    collider.response = lets_rise ? 2 : static_cast<int>(placed.response);
    collider.centre = vector(placed.centre);
    collider.axis_x = vector(placed.axes[0]);
    collider.axis_y = vector(placed.axes[1]);
    collider.axis_z = vector(placed.axes[2]);
    collider.half_size = vector(placed.half_size);
    collider.radius = number(placed.radius);
    collider.friction = number(placed.friction);
    collider.velocity = vector(placed.velocity);
    collider.spin = vector(placed.spin);
    return collider;
}

/// Constants of a step in the numbers of a kernel.
template <class T>
struct StepConstants {
    T dt{}, decay{}, thickness{};
    Vector3<T> gravity{}, gravity_direction{}, wind{};
    T air_density{}, drag{}, lift{};
    T stiffness[spring_class_count]{}, damping[spring_class_count]{};
    T rest_lengths[5]{};  ///< of a sheet

    T inverse_dt{};  ///< 1/s
    std::span<const VolumeGoal> goals =
        {};  ///< of a body's parts, a row for each step of the frame or one for all

    std::span<const Vec3> attached = {};  ///< m, places of attached nodes, a row for each step of the frame

    std::uint32_t grabbed_node = 0;  ///< see GrabInput
    Vector3<T> grab_target{};
    T grab_pull{}, grab_hold{};

    StepConstants(const ClothModel& model, double step_length);
    void set(const GrabInput& grab);
};

template <class T>
class PlainCloth {
public:
    using L = Laws<T>;
    using Vector = Vector3<T>;
    using Collider = typename L::Collider;
    using Measure = typename L::Measure;

    explicit PlainCloth(const ClothModel& model);

    /// How many nodes, springs or blocks a call works on.
    std::size_t size_of(const Call& call) const;
    /// Runs the part [begin, end) of a call.
    void run(const Call& call, const StepConstants<T>& constants, std::span<const Collider> colliders,
             std::size_t begin, std::size_t end);
    /// Normals and strains are kept from the first time on that somebody looks at them; not for more than
    /// one thread.
    void make_room_for(Pass pass);
    Vector external_force_at(std::size_t offset) const
    {
        return external_force.x.empty() ? Vector{T(0), T(0), T(0)} : external_force.get(offset);
    }
    void read(Resource resource, std::uint32_t parity, std::vector<float>& values) const;
    /// See PassRunner.
    void write(std::span<const Vec3> positions, std::span<const Vec3> velocities);
    void take_mass(std::size_t node);
    MeasureTotals totals() const;

    const ClothModel& model;
    NodeLayout layout;
    Planes<T> position[2], velocity[2];
    Planes<T> external_force;                          ///< none without any
    VectorArray<T> spring_force;                       ///< per spring
    Planes<T> position_slope, velocity_slope;          ///< of the integrators with stages
    Planes<T> normal;                                  ///< none before make_room_for
    AlignedArray<T> inverse_mass, strain, multiplier;  ///< multiplier: of the constraint methods
    std::vector<Measure> measures;
    MeasureTree tree;
    PlainBody<T> body;  ///< empty but for a soft body

private:
    struct Place {
        std::size_t node, row, column, offset;
    };
    template <class Function>
    void for_each_node(std::size_t begin, std::size_t end, Function&& f) const;
    template <class Function>
    void for_each_sheet_neighbour(const Place& place, std::size_t first, Function&& f) const;
    template <class Function>
    void for_each_sheet_triangle(const Place& place, Function&& f) const;

    void sheet_step(const Call&, const StepConstants<T>&, std::span<const Collider>, std::size_t,
                    std::size_t);
    void attach(const Call&, const StepConstants<T>&, std::size_t, std::size_t);
    void grab(const Call&, const StepConstants<T>&);
    void list_step(const Call&, const StepConstants<T>&, std::span<const Collider>, std::size_t, std::size_t);
    void stage_step(const Call&, const StepConstants<T>&, std::span<const Collider>, std::size_t,
                    std::size_t);
    void spring_forces(const Call&, const StepConstants<T>&, std::size_t, std::size_t);
    void sheet_wind(const Call&, const StepConstants<T>&, std::size_t, std::size_t);
    void mesh_wind(const Call&, const StepConstants<T>&, std::size_t, std::size_t);
    void sheet_normals(const Call&, std::size_t, std::size_t);
    void mesh_normals(const Call&, std::size_t, std::size_t);
    void sheet_strains(const Call&, const StepConstants<T>&, std::size_t, std::size_t);
    void list_strains(const Call&, std::size_t, std::size_t);
    void measure_blocks(const Call&, const StepConstants<T>&, std::span<const Collider>, std::size_t,
                        std::size_t);
    void merge_blocks(const Call&, std::size_t, std::size_t);

    friend class PlainBody<T>;
    Measure measured_springs(const Call&, const StepConstants<T>&, const Place&) const;
    void finish_step(const Call&, const StepConstants<T>&, std::span<const Collider>, const Place&,
                     Vector force);
    static Measure merged(Measure* values);
};

extern template class PlainCloth<double>;
extern template class PlainCloth<float>;
extern template struct StepConstants<double>;
extern template struct StepConstants<float>;

}  // namespace pliant

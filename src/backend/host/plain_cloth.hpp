// One cloth on the host, with a plain loop for every pass. PlainCloth<double> is the reference backend;
// PlainCloth<float> is the state of the CPU backend, which replaces the hot passes by SIMD kernels.
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
#include "solve/step_constants.hpp"

namespace pliant {

template <class T>
class PlainCloth {
public:
    using L = Laws<T>;
    using Vector = Vector3<T>;
    using Collider = typename L::Collider;
    using Measure = typename L::Measure;

    explicit PlainCloth(const ClothModel& model);

    /// The number of nodes, springs or blocks in a call.
    std::size_t size_of(const Call& call) const;
    /// Runs the part [begin, end) of a call.
    void run(const Call& call, const StepConstants<T>& constants, std::span<const Collider> colliders,
             std::size_t begin, std::size_t end);
    /// Allocates normals or strains when a pass first needs them; single-threaded.
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
    Planes<T> external_force;                          ///< empty if there is none
    VectorArray<T> spring_force;                       ///< by spring
    Planes<T> position_slope, velocity_slope;          ///< for integrators with stages
    Planes<T> normal;                                  ///< empty before make_room_for
    AlignedArray<T> inverse_mass, strain, multiplier;  ///< multiplier: for the constraint methods
    std::vector<Measure> measures;
    MeasureTree tree;
    PlainBody<T> body;  ///< empty except for a soft body

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

}  // namespace pliant

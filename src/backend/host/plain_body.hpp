// The passes of soft bodies as plain loops over nodes and fans.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "backend/host/planes.hpp"
#include "body/cloth_model.hpp"
#include "laws/laws.hpp"
#include "solve/pass.hpp"

namespace pliant {

template <class T>
class PlainCloth;
template <class T>
struct StepConstants;

/// Data of a soft body's passes besides the state of its nodes.
template <class T>
class PlainBody {
public:
    using L = Laws<T>;
    using Vector = Vector3<T>;
    using Collider = typename L::Collider;
    using Rate = typename L::VolumeRate;
    using Cubic = typename L::VolumeCubic;

    /// Carried from step to step.
    struct Record {
        Vector centre{T(0), T(0), T(0)};  ///< m
        T volume{};                       ///< 6 V, m3
    };

    PlainBody(const ClothModel& model, const NodeLayout& layout);

    std::size_t size_of(const Call& call) const;
    void run(const Call& call, PlainCloth<T>& cloth, const StepConstants<T>& constants,
             std::span<const Collider> colliders, std::size_t begin, std::size_t end);
    void read(Resource resource, const NodeLayout& layout, std::vector<float>& values) const;

    typename L::Blocked blocked_at(std::size_t offset) const
    {
        return {blocked.get(offset), blocked_count[offset]};
    }
    /// The merged sums of one body.
    Rate rate_of(const BodyPart& part) const;
    Cubic cubic_of(const BodyPart& part) const;
    /// The target of a body at the end of a step.
    VolumeGoal goal_of(const Call& call, const StepConstants<T>& constants, std::size_t part) const;

    /// The mean gradient, and the multiplier of eq. (14) as a change of velocity.
    std::pair<Vector, T> multiplier_of(const BodyPart& part, std::size_t index, const VolumeGoal& goal,
                                       const StepConstants<T>& constants) const;
    /// The length of the exact correction; writes the result into the body's record.
    T correction_of(const BodyPart& part, std::size_t index, const VolumeGoal& goal);
    /// The same without writing the record: for all blocks but the first.
    T correction_of(const BodyPart& part, const VolumeGoal& goal) const;

    const BodyModel* model = nullptr;  ///< null for a cloth
    std::size_t node_count = 0;
    Planes<T> gradient, direction, blocked;
    AlignedArray<T> blocked_count, weight;
    std::vector<Rate> rates;
    std::vector<Cubic> cubics;
    std::vector<Record> records;
    std::vector<T> volumes;  ///< 6 V at the last measurement

    /// Merges the values of a block of 256 in the fixed tree, see plain_body.cpp.
    static Rate merged(Rate* values);
    static Cubic merged(Cubic* values);

private:
    void load_force(const Call&, PlainCloth<T>&, std::size_t begin, std::size_t end) const;
    void ring_step(const Call&, PlainCloth<T>&, const StepConstants<T>&, std::span<const Collider>,
                   std::size_t begin, std::size_t end) const;
    void gather(const Call&, PlainCloth<T>&, const StepConstants<T>&, std::size_t begin, std::size_t end);
    void step(const Call&, PlainCloth<T>&, const StepConstants<T>&, std::span<const Collider>,
              std::size_t begin, std::size_t end);
    void sum_fans(const Call&, const PlainCloth<T>&, std::size_t begin, std::size_t end);
    void correct(const Call&, PlainCloth<T>&, const StepConstants<T>&, std::size_t begin, std::size_t end);
};

extern template class PlainBody<double>;
extern template class PlainBody<float>;

}  // namespace pliant

// The constraint solver's passes on the host: the same text that the shaders compile (src/kernels), once per
// number type. SolverKernels<double> is the reference; SolverKernels<Pack<W>> processes W nodes of a row at a
// time. Uses nothing of the standard library, so that files for single instruction sets can include it.
#pragma once

#include "backend/host/inlining.hpp"
#include "backend/host/lanes.hpp"
#include "backend/host/mesh_lanes.hpp"
#include "backend/host/solver_context.hpp"
#include "body/hierarchy.hpp"
#include "kernels/planes.hpp"
#include "laws/laws.hpp"
#include "solve/pass.hpp"

namespace pliant {

template <class T>
struct SolverKernels {
    using Number = typename Lanes<T>::Number;
    using Context = SolverContext<Number>;
#include "laws/laws_of_type.inl"
    /// Rounded twice: a fused operation would give other bits where a machine lacks it.
    static real multiply_add(real a, real b, real c) { return a * b + c; }

    // --- functions that the kernels' text calls ---

#define KERNEL PLIANT_INLINE
#define UNROLL _Pragma("GCC unroll 9")
#include "kernels/block.kernel.glsl"

    const Context context;  // by value, so that it stays in registers despite writes to memory
    const SolverConstants<Number> constants;
    SolverLevel level, finer;
    T sums[most_sums];

    SolverKernels(const Context& c, const Call& call)
        : context(c),
          constants(*c.constants),
          level(c.levels[call.level]),
          finer(c.levels[call.level > 0 ? call.level - 1 : 0]),
          base_(c.arena + level.base),
          finer_base_(c.arena + finer.base),
          size_(level.size),
          finer_size_(finer.size),
          operator_(operator_of(level)),
          finer_operator_(operator_of(finer)),
          detail_(call.detail),
          level_number_(call.level),
          is_cloth_(call.level == 0),
          finer_is_cloth_(call.level == 1)
    {
    }

    // The operator's planes are stored together in groups of columns, since a pass reads all of them: one
    // stream of memory instead of 36, which would exceed the prefetcher and the TLB.
    static constexpr int group_columns = 16, operator_planes = level_planes - plane_block;
    static constexpr bool is_of_operator(int plane) { return plane >= plane_block && plane < level_planes; }
    static int in_groups(int plane, int o)
    {
        const auto place = static_cast<unsigned>(o);
        return static_cast<int>(place / group_columns * (operator_planes * group_columns) +
                                place % group_columns) +
               (plane - plane_block) * group_columns;
    }
    /// The address of offset 0. On a mesh nothing precedes the offsets of its only row, and its planes begin
    /// there.
    Number* operator_of(const SolverLevel& of) const
    {
        const int first = of.first_of_plane();
        return context.arena + (of.base + plane_block * of.size + first - in_groups(plane_block, first));
    }

    // Planes are addressed by a pointer and their distance, which x86 addressing computes for free.
    using Distance = decltype(static_cast<Number*>(nullptr) - static_cast<Number*>(nullptr));
    Distance apart(int plane) const { return is_of_operator(plane) ? group_columns : size_; }
    Distance finer_apart(int plane) const { return is_of_operator(plane) ? group_columns : finer_size_; }
    Number* at(int plane, int o) const
    {
        return is_of_operator(plane) ? operator_ + in_groups(plane, o) : base_ + (plane * size_ + o);
    }
    const Number* finer_at(int plane, int o) const
    {
        return is_of_operator(plane) ? finer_operator_ + in_groups(plane, o)
                                     : finer_base_ + (plane * finer_size_ + o);
    }
    real load(int plane, int o) const { return Lanes<T>::load(at(plane, o)); }
    void store(int plane, int o, real a) const { Lanes<T>::store(at(plane, o), a); }
    template <auto load_one>
    static vec3 three(const Number* p, Distance size)
    {
        return {load_one(p), load_one(p + size), load_one(p + 2 * size)};
    }
    template <auto load_one>
    static Symmetric six(const Number* p, Distance size)
    {
        const Number* q = p + 3 * size;
        return {load_one(p), load_one(p + size), load_one(p + 2 * size),
                load_one(q), load_one(q + size), load_one(q + 2 * size)};
    }
    vec3 load3(int plane, int o) const { return three<&Lanes<T>::load>(at(plane, o), size_); }
    Symmetric load6(int plane, int o) const { return six<&Lanes<T>::load>(at(plane, o), apart(plane)); }
    /// For offsets where the lanes may reach into the next group.
    Symmetric load6_anywhere(int plane, int o) const
    {
        const int rest = group_columns - static_cast<int>(static_cast<unsigned>(o) % group_columns);
        if (Lanes<T>::count <= rest || !is_of_operator(plane)) return load6(plane, o);
        const Number* p = at(plane, o);
        const Number* next = at(plane, o + rest) - rest;
        const mask here = Lanes<T>::first_lanes(rest);
        const auto either = [&](int k) {
            return choose(here, Lanes<T>::load(p + k * group_columns),
                          Lanes<T>::load(next + k * group_columns));
        };
        return {either(0), either(1), either(2), either(3), either(4), either(5)};
    }
    static void put3(Number* p, Distance size, real x, real y, real z)
    {
        Lanes<T>::store(p, x);
        Lanes<T>::store(p + size, y);
        Lanes<T>::store(p + 2 * size, z);
    }
    void store3(int plane, int o, vec3 a) const { put3(at(plane, o), size_, a.x, a.y, a.z); }
    void store6(int plane, int o, Symmetric a) const
    {
        Number* p = at(plane, o);
        const Distance size = apart(plane);
        put3(p, size, a.xx, a.xy, a.xz);
        put3(p + 3 * size, size, a.yy, a.yz, a.zz);
    }
    /// Every second node of the finer level, one per lane.
    vec3 finer_load3(int plane, int o) const
    {
        return three<&Lanes<T>::load_even>(finer_at(plane, o), finer_size_);
    }
    Symmetric finer_load6(int plane, int o) const
    {
        static_assert(Lanes<T>::count == 1, "packs coarsen by rows");
        return six<&Lanes<T>::load>(finer_at(plane, o), finer_apart(plane));
    }
    /// Adds alternately to the nodes of the finer level at and after o, if they are free.
    void finer_add3(int plane, int o, vec3 even, vec3 odd) const
    {
        const Number *low = finer_at(plane_factor, o), *high = finer_at(plane_factor, o + Lanes<T>::count);
        Number* p = finer_base_ + (plane * finer_size_ + o);
        Lanes<T>::add_by_turns(p, even.x, odd.x, low, high);
        Lanes<T>::add_by_turns(p + finer_size_, even.y, odd.y, low, high);
        Lanes<T>::add_by_turns(p + 2 * finer_size_, even.z, odd.z, low, high);
    }
    int finer_coupling(int k) const
    {
        const bool folded = finer_is_cloth_ && constants.exact_bend && (k == 0 || k == 2);
        return folded ? plane_fold + 3 * k : plane_block + 6 * k;
    }

    static real spread(Number a) { return Lanes<T>::spread(a); }
    static vec3 spread(Vector3<Number> a) { return {spread(a.x), spread(a.y), spread(a.z)}; }
    int source_plane() const { return detail_ % 2 == 0 ? plane_correction : plane_correction_2; }
    int target_plane() const { return detail_ % 2 == 0 ? plane_correction_2 : plane_correction; }
    /// For sheet_prolong, which reads one copy of the correction and adds to the other on the finer level.
    int finer_plane() const { return detail_ / 2 % 2 == 0 ? plane_correction : plane_correction_2; }
    real relaxation() const { return spread(constants.relaxations[detail_ / 2]); }
    real scalar(int k) const { return spread(context.scalars[k]); }
    void set_scalar(int k, real a) const { context.scalars[k] = Lanes<T>::first(a); }
    real total(int slot) const
    {
        const Number* parts = context.parts + slot * context.part_stride;
        const int count = context.part_counts[slot];
        Number lanes[sum_lanes];
        for (int lane = 0; lane < sum_lanes; ++lane) {
            lanes[lane] = Number(0);
            for (int k = lane; k < count; k += sum_lanes) lanes[lane] += parts[k];
        }
        for (int width = sum_lanes / 2; width > 0; width /= 2)
            for (int lane = 0; lane < width; ++lane) lanes[lane] += lanes[lane + width];
        return spread(lanes[0]);
    }

    bool sheet_has(int k) const { return constants.has[sheet_class(k)]; }
    static int sheet_class(int k) { return k >= 4 ? 2 : k % 2; }
    LimitCurve sheet_curve(int k) const { return class_curve(sheet_class(k)); }
    LimitCurve class_curve(int k) const
    {
        const auto& c = constants.curves[k];
        return {c.kind,
                spread(c.below),
                spread(c.limit),
                spread(c.beyond),
                spread(c.compressed),
                spread(c.damping),
                spread(Number(0)),
                spread(c.reach),
                spread(c.kept)};
    }
    real sheet_rest(int k) const
    {
        constexpr int rest[] = {0, 2, 1, 2, 3, 4};
        return spread(constants.rest_lengths[rest[k]]);
    }
    bool has_damping() const { return constants.has_damping; }
    bool is_graded() const { return constants.is_graded; }
    bool has_bend() const { return constants.has[2]; }
    bool exact_bend() const { return is_cloth_ && constants.exact_bend && constants.has[2]; }
    real contact_stiffness() const { return spread(constants.contact_stiffness); }
    bool contact_is_by_mass() const { return constants.contact_is_by_mass; }
    real slip() const { return spread(constants.slip); }
    real thickness() const { return spread(constants.thickness); }
    real decay() const { return spread(constants.decay); }
    real step_length() const { return spread(constants.dt); }
    real inverse_step() const { return spread(constants.inverse_dt); }
    bool is_second_order() const { return constants.history_plane > 0; }
    int history_plane() const { return constants.history_plane; }
    real short_step() const { return spread(constants.short_dt); }
    real inverse_short_step() const { return spread(constants.inverse_short_dt); }
    real third() const { return spread(constants.third); }
    real air() const { return spread(constants.air); }
    vec3 gravity() const { return spread(constants.gravity); }
    bool hand_is_near(int o) const { return constants.held >= o && constants.held < o + Lanes<T>::count; }
    vec3 where_held(int o, vec3 held, vec3 otherwise) const
    {
        const int lane = constants.held - o;
        return choose(Lanes<T>::first_lanes(lane), otherwise,
                      choose(Lanes<T>::first_lanes(lane + 1), held, otherwise));
    }
    vec3 hand_target() const { return spread(constants.hand_target); }
    real hand_pull() const { return spread(constants.hand_pull); }
    real hand_hold() const { return spread(constants.hand_hold); }
    real linear_tolerance() const { return spread(constants.linear_tolerance); }
    real newton_tolerance() const { return spread(constants.newton_tolerance); }
    real enough_iterations() const { return spread(constants.enough_iterations); }
    bool remembers(int k) const { return constants.remembers[k]; }
    bool remembers_any() const { return constants.remembers[0] || constants.remembers[1]; }
    real softest(int k) const { return spread(constants.softest[k]); }
    real softest_limit() const { return spread(constants.softest_limit); }
    /// For a mesh's edges from e on: `held` for edges to a pin, else `other`.
    real where_held_edge(int e, Number held, Number other) const
    {
        return choose(Lanes<T>::first_lanes(level.held - e), spread(other),
                      choose(Lanes<T>::first_lanes(level.loose - e), spread(held), spread(other)));
    }
    real softest_of_edge(int e, int k) const
    {
        return where_held_edge(e, constants.softest_held, constants.softest[k]);
    }
    real bare_softest_of_edge(int e) const
    {
        return where_held_edge(e, constants.softest_held_limit, constants.softest_limit);
    }
    real compliance(int k) const { return spread(constants.compliance[k]); }
    real polish_reach() const { return spread(constants.polish_reach); }
    real stiffest_limit() const { return spread(constants.stiffest_limit); }

    int collider_count() const { return context.collider_count; }
    Collider collider(int k) const { return spread_collider<Collider, T>(context.colliders[k]); }

    template <class P>
    static vec3 load_planes(const P& p, int o)
    {
        return {Lanes<T>::load(p.x + o), Lanes<T>::load(p.y + o), Lanes<T>::load(p.z + o)};
    }
    vec3 node_position(int o) const { return load_planes(context.position, o); }
    vec3 node_velocity(int o) const { return load_planes(context.velocity, o); }
    vec3 node_next_position(int o) const { return load_planes(context.next_position, o); }
    vec3 node_next_velocity(int o) const { return load_planes(context.next_velocity, o); }
    vec3 node_force(int o) const
    {
        const real zero = real(0.0f);
        return context.external_force.x ? load_planes(context.external_force, o) : vec3(zero, zero, zero);
    }
    real node_inverse_mass(int o) const { return Lanes<T>::load(context.inverse_mass + o); }
    real node_mass(int o) const { return Lanes<T>::load(context.mass + o); }
    void node_end(int o, vec3 x, vec3 v) const
    {
        Lanes<T>::store(context.next_position.x + o, x.x);
        Lanes<T>::store(context.next_position.y + o, x.y);
        Lanes<T>::store(context.next_position.z + o, x.z);
        Lanes<T>::store(context.next_velocity.x + o, v.x);
        Lanes<T>::store(context.next_velocity.y + o, v.y);
        Lanes<T>::store(context.next_velocity.z + o, v.z);
    }

    bool is_last_look() const { return static_cast<int>(detail_) == detail_last_look; }
    bool is_polish_look() const { return static_cast<int>(detail_) == detail_polish_look; }
    bool is_cloth() const { return is_cloth_; }
    bool is_acad() const { return constants.is_acad; }
    bool acad_has_memory() const { return constants.acad_has_memory; }
    bool acad_has_compression() const { return constants.acad_below2 > 0; }
    real acad_above2() const { return spread(constants.acad_above2); }
    real acad_below2() const { return spread(constants.acad_below2); }
    real acad_held_above2() const { return spread(constants.acad_held_above2); }
    real acad_held_below2() const { return spread(constants.acad_held_below2); }
    real acad_near_above2() const { return spread(constants.acad_near_above2); }
    real acad_near_below2() const { return spread(constants.acad_near_below2); }
    real acad_reach() const { return spread(constants.acad_reach); }
    void set_multiplier(int o, real a) const { Lanes<T>::store(context.multiplier + o, a); }
    mask inside_level() const { return inside_; }

    int topology(int k) const { return context.topology[k]; }
    /// Data of a mesh's edges: the numbers of an edge are consecutive, with its taut flag next to its force.
    Number* edge_at(int plane, int numbers, int e) const
    {
        Number* first = context.arena + level.edge_base;
        if (plane == edge_force) return first + (edge_force * level.edge_size + 4 * e);
        if (plane == edge_taut) return first + (edge_force * level.edge_size + 4 * e + 3);
        return first + (plane * level.edge_size + numbers * e);
    }
    /// For the edges from e on.
    real edge_load(int plane, int e) const { return Lanes<T>::load(edge_at(plane, 1, e)); }
    void edge_store(int plane, int e, real a) const { *edge_at(plane, 1, e) = Lanes<T>::first(a); }
    vec3 edge_load3(int plane, int e) const
    {
        const Number* p = edge_at(plane, 3, e);
        return {spread(p[0]), spread(p[1]), spread(p[2])};
    }
    void edge_store3(int plane, int e, vec3 a) const
    {
        Number* p = edge_at(plane, 3, e);
        p[0] = Lanes<T>::first(a.x);
        p[1] = Lanes<T>::first(a.y);
        p[2] = Lanes<T>::first(a.z);
    }
    static Symmetric edge_six(const Number* p)
    {
        return {spread(p[0]), spread(p[1]), spread(p[2]), spread(p[3]), spread(p[4]), spread(p[5])};
    }
    Symmetric edge_load6(int plane, int e) const { return edge_six(edge_at(plane, 6, e)); }
    Symmetric finer_edge_load6(int plane, int e) const
    {
        return edge_six(context.arena + (finer.edge_base + plane * finer.edge_size + 6 * e));
    }
    void edge_store6(int plane, int e, Symmetric a) const
    {
        const real numbers[] = {a.xx, a.xy, a.xz, a.yy, a.yz, a.zz};
        Number* p = edge_at(plane, 6, e);
        for (int k = 0; k < 6; ++k) p[k] = Lanes<T>::first(numbers[k]);
    }
    void finer_store3(int plane, int o, vec3 a) const
    {
        put3(finer_base_ + (plane * finer_size_ + o), finer_size_, a.x, a.y, a.z);
    }
    real topology_weight(int k) const
    {
        return spread(static_cast<Number>(__builtin_bit_cast(float, topology(k))));
    }
    real number(int k) const { return spread(context.arena[k]); }
    void set_number(int k, real a) const { context.arena[k] = Lanes<T>::first(a); }
    real part_of_sum(int slot, int k) const { return spread(context.parts[slot * context.part_stride + k]); }
    static int whole(real a) { return static_cast<int>(Lanes<T>::first(a)); }
    int scan_level() const { return static_cast<int>(detail_); }

    int bottom_nodes() const { return level.rows * level.columns; }
    Number* bottom() const { return context.arena + context.bottom_base; }
    real bottom_get(int k) const { return spread(bottom()[k]); }
    void bottom_set(int k, real a) const { bottom()[k] = Lanes<T>::first(a); }
    Number* bottom_number(int plane, int k) const
    {
        const int node = k / 3;
        return at(plane + k % 3, level_offset(node / level.columns, node % level.columns));
    }
    real bottom_vector(int plane, int k) const { return spread(*bottom_number(plane, k)); }
    void bottom_set_vector(int plane, int k, real a) const { *bottom_number(plane, k) = Lanes<T>::first(a); }
    int level_offset(int row, int column) const
    {
        return (row + border_rows) * level.stride + row_pad + column;
    }
    int finer_offset(int row, int column) const
    {
        return (row + border_rows) * finer.stride + row_pad + column;
    }

#include "kernels/acad.kernel.glsl"
#include "kernels/linear.kernel.glsl"
#include "kernels/newton.kernel.glsl"
#include "kernels/sheet.kernel.glsl"
    // For one invocation; T is a plain number:
#include "kernels/bottom.kernel.glsl"
#include "kernels/mesh.kernel.glsl"
#include "kernels/paper.kernel.glsl"
#include "kernels/serial.kernel.glsl"

    // --- running passes ---

    /// Runs the part [begin, end) of a pass over nodes: rows of a sheet, or groups of `sum_columns` nodes of
    /// a mesh. In a solve of ACAD only live ones are numbered (kernels/acad.kernel.glsl).
    void run(Pass pass, int begin, int end)
    {
        if (!is_acad() || !is_live(unit_of(pass))) return run_rows(pass, begin, end);
        const Number* live = context.arena + live_flags(pass, level, finer);
        int first = -1;
        const auto finish = [&](int last) {
            if (first >= 0) run_rows(pass, first, last);
            first = -1;
        };
        int row = 0;
        for (int seen = 0; seen < end; ++row)
            if (!(live[row] > Number(0)))
                finish(row);
            else if (seen++ >= begin && first < 0)
                first = row;
        finish(row);
    }
    /// The same for consecutive rows or groups. Runs the loop that the table of passes names; meshes without
    /// lanes, and the paper's solver, run one unit at a time.
    void run_rows(Pass pass, int begin, int end)
    {
        constexpr bool scalar = Lanes<T>::count == 1;
        using K = SolverKernels;
        switch (pass) {
#define LOOP_each(name, unit) over_##unit<&K::name>(pass, begin, end)
#define LOOP_own_rows(name, unit) name##_rows(pass, begin, end)
#define LOOP_lanes(name, unit) \
    if constexpr (scalar)      \
        LOOP_each(name, unit); \
    else                       \
        LOOP_each(name##_lanes, unit)
#define LOOP_records(name, unit) LOOP_lanes(name, unit)
#define LOOP_groups(name, unit) \
    if constexpr (scalar)       \
        LOOP_each(name, unit);  \
    else                        \
        name##_groups(pass, begin, end)
#define LOOP_record_groups(name, unit) LOOP_groups(name, unit)
#define LOOP_WHERE(condition, name, unit, loop) \
    case Pass::name:                            \
        if constexpr (condition) {              \
            LOOP_##loop(name, unit);            \
        }                                       \
        return;
#define SOLVER_PASS(name, unit, loop, ...) LOOP_WHERE(true, name, unit, loop)
#define SHEET_PASS(name, unit, loop, ...) LOOP_WHERE(true, name, unit, loop)
#define MESH_PASS(name, unit, loop, ...) LOOP_WHERE(scalar || has_lanes(Pass::name), name, unit, loop)
#define PAPER_PASS(name, unit, loop, ...) LOOP_WHERE(scalar, name, unit, loop)
#define PASS(name, ...) /* of one invocation, or none of a solver's */ \
    case Pass::name: {                                                 \
        return;                                                        \
    }
#include "solve/passes.def"
#undef LOOP_each
#undef LOOP_own_rows
#undef LOOP_lanes
#undef LOOP_records
#undef LOOP_groups
#undef LOOP_record_groups
#undef LOOP_WHERE
        }
    }

    /// Runs a pass of one invocation.
    void run_single(Pass pass)
    {
        switch (pass) {
#define SINGLE_PASS(name, ...) \
    case Pass::name: {         \
        name();                \
        return;                \
    }
#define PASS(name, ...) \
    case Pass::name: {  \
        return;         \
    }
#include "solve/passes.def"
        }
    }

#include "backend/host/mesh_rows.inl"

private:
#include "backend/host/solver_parts.inl"

#include "backend/host/sheet_rows.inl"

#include "backend/host/coarse_rows.inl"

    Number *base_, *finer_base_;
    Distance size_, finer_size_;
    Number *operator_, *finer_operator_;
    mask inside_{};
    unsigned detail_, level_number_;
    bool is_cloth_, finer_is_cloth_;
};

#undef KERNEL
#undef UNROLL

}  // namespace pliant

// Passes of meshes in packs: neighbouring nodes or edges side by side, by the tables of MeshLanes. Every node
// sums as in kernels/mesh.kernel.glsl, in the same order. Part of SolverKernels (solver_kernels.hpp).

using Record = Records<T>;

const MeshLanes& lanes_of(unsigned number) const { return context.lanes[number]; }
const MeshLanes& lanes() const { return lanes_of(level_number_); }

/// The entries of lane `first` and the following lanes, row by row.
struct Entries {
    struct Place {
        int entry;
        PLIANT_SMALL int operator*() const { return entry; }
        PLIANT_SMALL void operator++() { entry += LaneTable::lanes; }
        PLIANT_SMALL bool operator!=(Place other) const { return entry != other.entry; }
    };
    int first, last;
    PLIANT_SMALL Place begin() const { return {first}; }
    PLIANT_SMALL Place end() const { return {last}; }
};
KERNEL static Entries entries_of(const LaneTable& table, int first)
{
    constexpr int slice_lanes = LaneTable::lanes, counted = LaneTable::counted;
    int rows = table.rows[first / counted];
    for (int k = 1; k < Lanes<T>::count / counted; ++k)
        rows = table.rows[first / counted + k] > rows ? table.rows[first / counted + k] : rows;
    const int begin = table.start[first / slice_lanes] * slice_lanes + first % slice_lanes;
    return {begin, begin + rows * slice_lanes};
}
/// The number of lanes before `end`.
static int lanes_left(int first, int end)
{
    return end - first < Lanes<T>::count ? end - first : Lanes<T>::count;
}

KERNEL static Symmetric symmetric_of(const SixNumbers<T>& a)
{
    const T* n = a.numbers;
    return {n[0], n[1], n[2], n[3], n[4], n[5]};
}
/// Blocks of a level, by twice their numbers.
KERNEL Symmetric blocks_at(const SolverLevel& of, const std::int32_t* twice) const
{
    return symmetric_of(Record::template sixes<3>(context.arena + of.edge_base, twice));
}
/// Stores consecutive blocks from `first` on.
KERNEL void store_blocks_in_a_row(Symmetric a, int count, int first) const
{
    Record::store_sixes_in_a_row(context.arena + (level.edge_base + 6 * first),
                                 {{a.xx, a.xy, a.xz, a.yy, a.yz, a.zz}}, count);
}
template <class Place>
KERNEL void store_blocks(Symmetric a, int count, const Place& place) const
{
    Record::store_sixes(context.arena + level.edge_base, {{a.xx, a.xy, a.xz, a.yy, a.yz, a.zz}}, count,
                        place);
}
/// Stores the row sums of nodes twice: for coarser levels, and for the product.
KERNEL void store_row_sums(int o, Symmetric a)
{
    const int first = mesh_node(o);
    store_blocks_in_a_row(a, lanes_left(first, level.columns), level.edges + first);
    store6(plane_row_sum, o, a);
}
/// Couplings of nodes with their neighbours, stored row by row for the product to stream.
KERNEL Number* couplings_at(int entry) const
{
    const int lane = entry % LaneTable::lanes;
    return lanes().couplings + (6 * (entry - lane) + lane);
}

// --- records ---------------------------------------------------------------------------------------------

/// Makes the records that a pass reads from neighbours, for groups of nodes of this level or the finer one.
void make_records(Pass pass, int begin, int end)
{
    SolverKernels self = *this;
    if (pass == Pass::mesh_springs || pass == Pass::mesh_multiply) {
        self.for_each_row(begin, end, [&](int, int first, int last) {
            for (int column = first; column < last; column += Lanes<T>::count) {
                const int o = self.level_offset(0, column);
                Number* to = self.lanes().states + MeshLanes::state_size * column;
                Record::template store<MeshLanes::state_size>(to, self.load3(plane_start, o));
                Record::template store<MeshLanes::state_size>(to + MeshLanes::vector_size,
                                                              self.load3(plane_way, o));
            }
        });
        return;
    }
    const bool is_finer = pass == Pass::mesh_restrict;
    const SolverLevel& of = is_finer ? finer : level;
    const int plane = is_finer ? plane_left : pass == Pass::mesh_apply ? plane_direction : source_plane();
    const int first = is_finer ? finer_offset(0, 0) : level_offset(0, 0);
    const Number* from = (is_finer ? finer_base_ : base_) + (plane * of.size + first);
    Number* to = lanes_of(is_finer ? level_number_ - 1 : level_number_).vectors;
    const int last = end * sum_columns < of.columns ? end * sum_columns : of.columns;
    for (int column = begin * sum_columns; column < last; column += Lanes<T>::count)
        Record::template store<MeshLanes::vector_size>(to + MeshLanes::vector_size * column,
                                                       three<&Lanes<T>::load>(from + column, of.size));
}

// --- springs ---------------------------------------------------------------------------------------------

/// A group of springs before their forces: x_j - x_i at the start of the step and now, and lengths. Computed
/// in sweeps of short chains, which a core overlaps.
struct SpringGroup {
    Number start[3 * sum_columns], d[3 * sum_columns], length2[sum_columns], inverse_length[sum_columns];
};
KERNEL void find_lengths(SpringGroup& group, int first, int last) const
{
    const Number* states = lanes().states;
    for (int k = 0; first + k < last; k += Lanes<T>::count) {
        const std::int32_t *i = lanes().first_end + first + k, *j = lanes().second_end + first + k;
        const auto [start, moved] = Record::differences(states, i, j);
        const vec3 d = start + moved;
        put3(group.start + k, sum_columns, start.x, start.y, start.z);
        put3(group.d + k, sum_columns, d.x, d.y, d.z);
        Lanes<T>::store(group.length2 + k, dot3(d, d));
    }
    for (int k = 0; first + k < last; k += Lanes<T>::count)
        Lanes<T>::store(group.inverse_length + k, inverse_sqrt(Lanes<T>::load(group.length2 + k)));
}

/// damped_between and damper_between for the nodes of each spring. Computed lane by lane, since few cloths
/// need it.
KERNEL void damp_lanes(int e, vec3 start, LimitCurve& curve, vec3& damper) const
{
    Number ahead[3 * Lanes<T>::count], known[Lanes<T>::count];
    for (int lane = 0; lane < Lanes<T>::count; ++lane) {
        const int i = level_offset(0, lanes().first_end[e + lane] / MeshLanes::state_size),
                  j = level_offset(0, lanes().second_end[e + lane] / MeshLanes::state_size);
        for (int k = 0; k < 3; ++k)
            ahead[k * Lanes<T>::count + lane] = *at(plane_aim + k, j) - *at(plane_aim + k, i);
        known[lane] = Number(knows_step(i) && knows_step(j) ? 1 : 0);
    }
    damper = start + three<&Lanes<T>::load>(ahead, Lanes<T>::count);
    curve.damping =
        choose(Lanes<T>::load(known) > 0.0f, curve.damping, curve.damping - curve.damping * third());
}
/// knows_before, for one node.
bool knows_step(int o) const
{
    const Number h = constants.dt, off = *at(history_plane() + history_step, o) - h;
    return h * Number(1e-3f) > (off < Number(0) ? -off : off);
}

/// If a group has several classes, computes the state of each class for all lanes and selects.
KERNEL SpringShare spring_of_lanes(const SpringGroup& group, int first, int e)
{
    const int k = e - first;
    const vec3 start = three<&Lanes<T>::load>(group.start + k, sum_columns);
    const vec3 d = three<&Lanes<T>::load>(group.d + k, sum_columns);
    const real length2 = Lanes<T>::load(group.length2 + k),
               inverse_length = Lanes<T>::load(group.inverse_length + k);
    const real rest = edge_load(edge_rest, e), spring_class = Lanes<T>::load(lanes().spring_class + e);
    const int only = lanes().class_of_group[e / sum_columns];
    LimitCurve curve = mesh_limit(e, only < 0 ? lanes().classes[0] : only);
    SpringState state = spring_state(curve, length2, inverse_length, rest);
    for (int c = 1; only < 0 && c < lanes().class_count; ++c) {
        const LimitCurve next = mesh_limit(e, lanes().classes[c]);
        const mask is_next = spring_class > real(float(lanes().classes[c]) - 0.5f);
        state = chosen(is_next, spring_state(next, length2, inverse_length, rest), state);
        curve.damping = choose(is_next, next.damping, curve.damping);
    }
    vec3 damper = start;
    if (is_second_order() && has_damping()) damp_lanes(e, start, curve, damper);
    const SpringShare spring =
        share_of(state, curve.damping, start, d, damper, inverse_length, mesh_scale(e));
    return with_bending(e, spring, d);
}
KERNEL void leave_spring(int e, const SpringShare& spring, Symmetric block)
{
    const int count = lanes_left(e, level.edges);
    Record::store_fours(edge_at(edge_force, 4, e),
                        {spring.force.x, spring.force.y, spring.force.z, mesh_taut(spring)}, count);
    store_blocks_in_a_row(block, count, e);
    sums[0] = sums[0] + choose(Lanes<T>::first_lanes(count), spring.energy, real(0.0f));
}
KERNEL void springs_lanes(const SpringGroup& group, int first, int e)
{
    const SpringShare spring = spring_of_lanes(group, first, e);
    leave_spring(e, spring, spring.block);
}
KERNEL static SpringState chosen(mask m, SpringState a, SpringState b)
{
    return {choose(m, a.force, b.force), choose(m, a.along, b.along), choose(m, a.across, b.across),
            choose(m, a.energy, b.energy), choose(m, a.multiplier, b.multiplier)};
}
/// If loose springs are folded, the springs before them are computed in mesh_fold, which then has their
/// blocks in registers. Groups with both kinds are computed in mesh_springs, and all groups if nothing is
/// folded.
int folding_groups() const { return level.folds() ? level.loose / sum_columns : 0; }
/// Groups [first, end) for the part [begin, finish) of a pass.
template <class Function>
void for_part(int first, int end, int begin, int finish, const Function& function) const
{
    const std::int64_t all = sum_groups(level.edges), count = end - first;
    if (all == 0) return;
    function(first + static_cast<int>(count * begin / all), first + static_cast<int>(count * finish / all));
}
template <auto kernel>
void springs_of_groups(int begin, int end)
{
    const SumSlots slots = sum_slots_of(Pass::mesh_springs);
    SolverKernels self = *this;
    SpringGroup springs;
    for (int group = begin; group < end; ++group) {
        const int first = group * sum_columns;
        const int last = first + sum_columns < level.edges ? first + sum_columns : level.edges;
        self.find_lengths(springs, first, last);
        self.summed(slots, group, first, last, [&](int e) { (self.*kernel)(springs, first, e); });
    }
}
void mesh_springs_groups(Pass, int begin, int end)
{
    for_part(folding_groups(), sum_groups(level.edges), begin, end,
             [&](int from, int to) { springs_of_groups<&SolverKernels::springs_lanes>(from, to); });
}
void mesh_fold_groups(Pass, int begin, int end)
{
    const int folding = folding_groups();
    for_part(0, folding + 1, begin, end, [&](int from, int to) {
        const int last = to < folding ? to : folding;
        springs_of_groups<&SolverKernels::folded_springs_lanes>(from, last);
        if (from <= folding && folding < to)
            for (int e = folding * sum_columns; e < level.loose; e += Lanes<T>::count) fold_lanes(e);
    });
}

/// A spring's block plus those folded onto it.
KERNEL Symmetric with_folds(Symmetric own, int e)
{
    const Symmetric first = plus_scaled(symmetric_diagonal(real(0.0f)), own, real(1.0f));
    return plus_blocks(first, level, lanes().folds, e);
}
KERNEL void folded_springs_lanes(const SpringGroup& group, int first, int e)
{
    const SpringShare spring = spring_of_lanes(group, first, e);
    leave_spring(e, spring, with_folds(spring.block, e));
}
/// For a group whose springs mesh_springs has computed.
KERNEL void fold_lanes(int e)
{
    std::int32_t own[Lanes<T>::count];
    for (int lane = 0; lane < Lanes<T>::count; ++lane)
        own[lane] = 2 * (e + lane < level.loose ? e + lane : e);
    store_blocks_in_a_row(with_folds(blocks_at(level, own), e), lanes_left(e, level.loose), e);
}

/// The forces of springs, by twice their numbers, and whether they are taut.
KERNEL FourNumbers<T> force_at(const std::int32_t* twice) const
{
    return Record::template fours<2>(edge_at(edge_force, 4, 0), twice);
}
KERNEL void mesh_gather_lanes(int o)
{
    const int first = mesh_node(o);
    MeshNode node = mesh_node_alone(o);
    const LaneTable &held = lanes().held, &neighbours = lanes().neighbours;
    for (const int entry : entries_of(held, first)) {
        const FourNumbers<T> force = force_at(held.place + entry);
        node = with_spring(node, {force.x, force.y, force.z}, blocks_at(level, held.place + entry),
                           Lanes<T>::load(held.weight + entry));
        node.taut = node.taut + force.w;
    }
    const bool is_multiplied = !is_polish_look();
    if (is_multiplied) store_row_sums(o, where_else_zero(node.mass > 0.0f, node.row_sum));
    const LaneTable& loose = lanes().loose;
    for (const int entry : entries_of(loose, first)) {
        const FourNumbers<T> force = force_at(loose.place + entry);
        node = with_force(node, {force.x, force.y, force.z}, Lanes<T>::load(loose.weight + entry));
    }
    for (const int entry : entries_of(neighbours, first)) {
        const std::int32_t* place = lanes().neighbour_edges + entry;
        const FourNumbers<T> force = force_at(place);
        const Symmetric block = blocks_at(level, place);
        const real side = Lanes<T>::load(neighbours.weight + entry);
        node = with_spring(node, {force.x, force.y, force.z}, block, side);
        node.taut = node.taut + choose(side > 0.0f, force.w, real(0.0f));
        if (is_multiplied) store_coupling(entry, block);
    }
    leave_mesh_node(o, node);
}
KERNEL void store_coupling(int entry, Symmetric a) const
{
    Number* p = couplings_at(entry);
    put3(p, LaneTable::lanes, a.xx, a.xy, a.xz);
    put3(p + 3 * LaneTable::lanes, LaneTable::lanes, a.yy, a.yz, a.zz);
}

KERNEL void mesh_multiply_lanes(int e)
{
    const std::int32_t *i = lanes().first_end + e, *j = lanes().second_end + e;
    const Number* states = lanes().states;
    const auto [start, moved] = Record::differences(states, i, j);
    const vec3 d = start + moved;
    const real spring_class = Lanes<T>::load(lanes().spring_class + e);
    const mask is_there = Lanes<T>::first_lanes(level.edges - e);
    const int only = lanes().class_of_group[e / sum_columns];
    for (int k = 0; k < lanes().class_count; ++k) {
        const int renewed_class = lanes().classes[k];
        if (!remembers(renewed_class) || (only >= 0 && only != renewed_class)) continue;
        const RenewedLimit limit = mesh_renewed(e, renewed_class, d);
        const mask renews = both(is_there, is_number(spring_class, renewed_class));
        Number *slip = edge_at(edge_slip, 1, e), *stiff = edge_at(edge_stiff, 1, e);
        Lanes<T>::store(slip, choose(renews, limit.memory.slip, Lanes<T>::load(slip)));
        Lanes<T>::store(stiff, choose(renews, limit.memory.stiffness, Lanes<T>::load(stiff)));
        sums[0] = sums[0] + choose(renews, limit.energy * mesh_scale(e), real(0.0f));
    }
}

// --- products --------------------------------------------------------------------------------------------

/// mesh_row_product; x is also in records.
KERNEL vec3 lanes_product(int x, int o)
{
    const vec3 own = load3(x, o);
    vec3 y = product(load6(plane_row_sum, o), own);
    const LaneTable& neighbours = lanes().neighbours;
    for (const int entry : entries_of(neighbours, mesh_node(o))) {
        const vec3 other = Record::template vectors<1>(lanes().vectors, neighbours.place + entry);
        y = y + product(six<&Lanes<T>::load>(couplings_at(entry), LaneTable::lanes), own - other);
    }
    return y;
}
KERNEL void mesh_apply_lanes(int o) { leave_applied(o, lanes_product(plane_direction, o)); }
KERNEL void mesh_smooth_lanes(int o) { leave_smoothed(o, lanes_product(source_plane(), o)); }
KERNEL void mesh_residual_lanes(int o) { leave_residual(o, lanes_product(source_plane(), o)); }

// --- between levels --------------------------------------------------------------------------------------

KERNEL Symmetric sum_of_blocks(const SolverLevel& of, const LaneTable& table, int first)
{
    return plus_blocks(symmetric_diagonal(real(0.0f)), of, table, first);
}
KERNEL Symmetric plus_blocks(Symmetric a, const SolverLevel& of, const LaneTable& table, int first)
{
    for (const int entry : entries_of(table, first)) {
        a = plus_scaled(a, blocks_at(of, table.place + entry), Lanes<T>::load(table.weight + entry));
    }
    return a;
}
KERNEL void mesh_coarsen_couplings_lanes(int first)
{
    const std::int32_t* edge = lanes().source_edges + first;
    store_blocks(sum_of_blocks(finer, lanes().sources, first), lanes_left(first, level.edges),
                 [&](int lane) { return edge[lane]; });
}
KERNEL void mesh_coarsen_nodes_lanes(int o)
{
    const int first = mesh_node(o);
    const LaneTable &children = lanes().children, &neighbours = lanes().neighbours;
    const Number* row_sums = context.arena + (finer.edge_base + 6 * finer.edges);
    Symmetric row_sum = symmetric_diagonal(real(0.0f));
    for (const int entry : entries_of(children, first)) {
        row_sum =
            plus_scaled(row_sum, symmetric_of(Record::template sixes<6>(row_sums, children.place + entry)),
                        Lanes<T>::load(children.weight + entry));
    }
    store_row_sums(o, row_sum);
    Symmetric diagonal = row_sum;
    for (const int entry : entries_of(neighbours, first)) {
        const Symmetric block = blocks_at(level, lanes().neighbour_edges + entry);
        store_coupling(entry, block);
        diagonal = plus(diagonal, block);
    }
    store6(plane_factor, o, factored(diagonal, real(0.0f)));
}

KERNEL void mesh_restrict_lanes(int o)
{
    const LaneTable& children = lanes().children;
    const Number* vectors = lanes_of(level_number_ - 1).vectors;
    vec3 r = vec3(real(0.0f), real(0.0f), real(0.0f));
    for (const int entry : entries_of(children, mesh_node(o))) {
        r = plus_scaled(r, Record::template vectors<MeshLanes::vector_size>(vectors, children.place + entry),
                        Lanes<T>::load(children.weight + entry));
    }
    leave_restricted(o, r);
}
KERNEL void mesh_prolong_lanes(int f)
{
    const LaneTable& parents = lanes().parents;
    Number* p = finer_base_ + (finer_plane() * finer_size_ + f);
    vec3 z = three<&Lanes<T>::load>(p, finer_size_);
    for (const int entry : entries_of(parents, f - finer_offset(0, 0))) {
        z = plus_scaled(z, Record::template vectors<1>(lanes().vectors, parents.place + entry),
                        Lanes<T>::load(parents.weight + entry));
    }
    put3(p, finer_size_, z.x, z.y, z.z);
}

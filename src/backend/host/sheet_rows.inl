// Passes over a sheet row by row. Each coupling or spring is computed once; the row at its other end reads it
// from a buffer. Part of SolverKernels (solver_kernels.hpp), for packs. The bits equal those of the kernels'
// text, which computes it at both ends.

/// A batch of columns, so that the buffers of a few rows stay in cache.
struct RowSpan {
    static constexpr int most = 256, pad = 16, pitch = most + 2 * pad;
    int first, columns;
    int left, right;  ///< columns to compute, including those for neighbours

    RowSpan(int begin, int level_columns) : first(begin)
    {
        const int rest = level_columns - first;
        columns = rest < most ? rest : most;
        left = first > 0 ? -Lanes<T>::count : 0;
        right = columns < rest ? columns + Lanes<T>::count : columns;
    }
};

/// A pass that begins with a product with the operator. The force of each coupling is computed once: the row
/// at its other end reads it from the buffer of the row before, with the opposite sign, see sum_of_forces.
template <auto kernel, auto leave>
void products(Pass pass, int x, int begin, int end)
{
    if (Lanes<T>::count == 1 || exact_bend()) return nodes<kernel>(pass, begin, end);
    constexpr int pitch = RowSpan::pitch, kinds = 12;  // four couplings of three coordinates
    Number forces[2 * kinds * pitch];
    const auto row_of = [&](int row) { return forces + (row & 1) * kinds * pitch + RowSpan::pad; };
    SolverKernels self = *this;
    const auto make_forces = [&](int row, const RowSpan& span) {
        Number* to = row_of(row);
        for (int column = span.left, o = level_offset(row, span.first + column); column < span.right;
             column += Lanes<T>::count, o += Lanes<T>::count)
            UNROLL for (int k = 0; k < 4; ++k)
            {
                const vec3 f = self.coupling_force(plane_block + 6 * k, k, x, o);
                put3(to + 3 * k * pitch + column, pitch, f.x, f.y, f.z);
            }
    };
    const SumSlots slots = is_cloth_ ? sum_slots_of(pass) : SumSlots{};
    for (int first_column = 0; first_column < level.columns; first_column += RowSpan::most) {
        const RowSpan span(first_column, level.columns);
        for (int kind = 0; kind < 2 * kinds; ++kind)  // zero beyond the border
            for (int k = 0; k < RowSpan::pad; ++k)
                forces[kind * pitch + k] = forces[kind * pitch + RowSpan::pad + span.columns + k] = Number(0);
        make_forces(begin - 1, span);
        for (int row = begin; row < end; ++row) {
            make_forces(row, span);
            const Number *now = row_of(row), *before = row_of(row - 1);
            const int first = level_offset(row, span.first);
            const auto at_node = [&, now, before, first](int column) {
                constexpr int shifts[] = {-1, 1, 0, -1};
                vec3 ahead[4], behind[4];
                UNROLL for (int k = 0; k < 4; ++k)
                {
                    const Number* from = k == 0 ? now : before;
                    ahead[k] = three<&Lanes<T>::load>(now + 3 * k * pitch + column, pitch);
                    behind[k] = three<&Lanes<T>::load>(from + 3 * k * pitch + column + shifts[k], pitch);
                }
                (self.*leave)(first + column, self.sum_of_forces(x, first + column, ahead, behind));
            };
            for (int group = 0; group < span.columns; group += sum_columns) {
                const int last = group + sum_columns < span.columns ? group + sum_columns : span.columns;
                if (slots.count > 0)
                    self.summed(slots, part_of(row, span.first + group), group, last, at_node);
                else
                    for (int column = group; column < last; column += Lanes<T>::count) at_node(column);
            }
        }
    }
}

void linear_apply_rows(Pass pass, int begin, int end)
{
    products<&SolverKernels::linear_apply, &SolverKernels::leave_applied>(pass, plane_direction, begin, end);
}
void level_smooth_rows(Pass pass, int begin, int end)
{
    products<&SolverKernels::level_smooth, &SolverKernels::leave_smoothed>(pass, source_plane(), begin, end);
}
void level_residual_rows(Pass pass, int begin, int end)
{
    products<&SolverKernels::level_residual, &SolverKernels::leave_residual>(pass, source_plane(), begin,
                                                                             end);
}

/// The springs of a row, as in sheet_forces: force, block, and the quantities counted at their first node.
struct SpringRows {
    static constexpr int pitch = RowSpan::pitch, numbers = 9, kinds = 6, rows = 3;
    Number shares[rows * kinds * numbers * pitch];
    Number energy[pitch], taut[pitch];

    Number* at(int row, int k, int column)
    {
        return shares + (((row + rows) % rows * kinds + k) * numbers * pitch + RowSpan::pad + column);
    }
};

template <int k>
KERNEL void make_springs(SpringRows& to, int row, const RowSpan& span)
{
    if (!sheet_has(k)) return;
    for (int column = span.left; column < span.right; column += Lanes<T>::count) {
        const int o = level_offset(row, span.first + column);
        const SpringShare share = sheet_spring(k, o, o + forward_offset(k), spring_scale(k, o), o);
        Number* p = to.at(row, k, column);
        constexpr Distance pitch = SpringRows::pitch;
        put3(p, pitch, share.force.x, share.force.y, share.force.z);
        put3(p + 3 * pitch, pitch, share.block.xx, share.block.xy, share.block.xz);
        put3(p + 6 * pitch, pitch, share.block.yy, share.block.yz, share.block.zz);
        Number *energy = to.energy + RowSpan::pad + column, *taut = to.taut + RowSpan::pad + column;
        Lanes<T>::store(energy, Lanes<T>::load(energy) + share.energy);
        Lanes<T>::store(taut, Lanes<T>::load(taut) + counted_taut(share));
    }
}
/// Counts in the order of sheet_forces.
KERNEL void make_springs(SpringRows& to, int row, const RowSpan& span)
{
    for (int k = 0; k < SpringRows::pitch; ++k) to.energy[k] = to.taut[k] = Number(0);
    make_springs<0>(to, row, span);
    make_springs<4>(to, row, span);
    make_springs<1>(to, row, span);
    make_springs<2>(to, row, span);
    make_springs<5>(to, row, span);
    make_springs<3>(to, row, span);
}

/// sheet_gather, with each spring computed once.
void sheet_gather_rows(Pass pass, int begin, int end)
{
    if (is_last_look()) return nodes<&SolverKernels::sheet_energy>(pass, begin, end);
    if (Lanes<T>::count == 1) return nodes<&SolverKernels::sheet_forces>(pass, begin, end);
    SolverKernels self = *this;
    const SumSlots slots = sum_slots_of(pass);
    SpringRows springs;
    for (int first = 0; first < level.columns; first += RowSpan::most) {
        const RowSpan span(first, level.columns);
        for (Number& number : springs.shares) number = Number(0);  // the border has no springs
        for (int row = begin > 2 ? begin - 2 : 0; row < begin; ++row) self.make_springs(springs, row, span);
        for (int row = begin; row < end; ++row) {
            self.make_springs(springs, row, span);
            self.gather_row(springs, slots, row, span);
        }
    }
}
KERNEL void gather_row(SpringRows& springs, SumSlots slots, int row, const RowSpan& span)
{
    const auto share = [&](int k, int rows_back, int column) {
        const Number* p = springs.at(row - rows_back, k, column);
        SpringShare read = no_spring();
        read.force = three<&Lanes<T>::load>(p, SpringRows::pitch);
        read.block = six<&Lanes<T>::load>(p + 3 * SpringRows::pitch, SpringRows::pitch);
        return read;
    };
    const auto turned = [](SpringShare a) {
        a.force = {-a.force.x, -a.force.y, -a.force.z};
        return a;
    };
    const auto at_node = [&](int column) {
        const int o = level_offset(row, span.first + column);
        constexpr int rows_back[] = {0, 1, 1, 1}, columns_back[] = {1, -1, 0, 1};
        SheetNode node = sheet_node(o);
        UNROLL for (int k = 0; k < 4; ++k)
        {
            SpringShare far_onward = no_spring(), far_back = far_onward;
            Symmetric across = far_onward.block;
            if (is_bent(k)) {
                const int bend = bend_along(k), down = rows_back[k], right = columns_back[k];
                far_onward = share(bend, 0, column);
                far_back = turned(share(bend, 2 * down, column - 2 * right));
                across = share(bend, down, column - right).block;
            }
            node = with_springs(node, k, o, share(k, 0, column),
                                turned(share(k, rows_back[k], column - columns_back[k])), far_onward,
                                far_back, across);
        }
        leave_gathered(o, node, Lanes<T>::load(springs.energy + RowSpan::pad + column),
                       Lanes<T>::load(springs.taut + RowSpan::pad + column));
    };
    for (int group = 0; group < span.columns; group += sum_columns)
        summed(slots, part_of(row, span.first + group), group,
               group + sum_columns < span.columns ? group + sum_columns : span.columns, at_node);
}

/// sheet_limits without memory and compression, as in nearly every step of ACAD: a group of columns in which
/// no spring exceeds the threshold writes empty sums and ends early.
void sheet_limits_rows(Pass pass, int begin, int end)
{
    const bool plain = sheet_has(0) && sheet_has(1) && !acad_has_memory() && !acad_has_compression();
    if (Lanes<T>::count == 1 || !plain) return nodes<&SolverKernels::sheet_limits>(pass, begin, end);
    const SumSlots slots = sum_slots_of(pass);
    SolverKernels self = *this;
    for_each_group(begin, end, [&](int row, int first, int last) {
        if (self.is_within_limits(row, first, last))
            for (unsigned slot = slots.first; slot < slots.first + slots.count; ++slot)
                context.parts[int(slot) * context.part_stride + part_of(row, first)] = Number(0);
        else
            self.template nodes_of_group<&SolverKernels::sheet_limits>(slots, row, first, last);
    });
}
KERNEL bool is_within_limits(int row, int begin, int end)
{
    const auto limit_of = [&](int k) { return acad_above2() * (sheet_rest(k) * sheet_rest(k)); };
    const real along_row = limit_of(0), along_column = limit_of(2), across = limit_of(1);
    const auto excess_at = [&](int o, int k, vec3 x, real limit, auto is_inside) {
        const vec3 d = node_next_position(o + forward_offset(k)) - x;
        const real over = dot3(d, d) - limit;
        if constexpr (is_inside)
            return over;
        else
            return choose(load(plane_scale + k, o) > 0.0f, over, real(-1.0f));
    };
    const auto most_at = [&](int column, auto is_inside) {
        const int o = level_offset(row, column);
        const vec3 x = node_next_position(o);
        return largest(
            largest(excess_at(o, 0, x, along_row, is_inside), excess_at(o, 2, x, along_column, is_inside)),
            largest(excess_at(o, 1, x, across, is_inside), excess_at(o, 3, x, across, is_inside)));
    };
    const std::bool_constant<true> inside;
    const std::bool_constant<false> at_border;
    real most = real(-1.0f);
    int column = begin;
    if (row + 1 < level.rows) {
        if (column == 0) most = most_at(column, at_border), column += Lanes<T>::count;
        for (; column < end && column + Lanes<T>::count < level.columns; column += Lanes<T>::count)
            most = largest(most, most_at(column, inside));
    }
    for (; column < end; column += Lanes<T>::count) most = largest(most, most_at(column, at_border));
    return !any_lane(most > 0.0f);
}

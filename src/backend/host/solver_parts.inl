// Runs a part of a pass: over rows, nodes or edges, in groups that each write one part of a sum. Part of
// SolverKernels (solver_kernels.hpp).

// Runs a kernel over each unit of a pass (PassUnit).
template <auto kernel>
void over_level_node(Pass pass, int begin, int end)
{
    nodes<kernel>(pass, begin, end);
}
template <auto kernel>
void over_live_node(Pass pass, int begin, int end)
{
    nodes<kernel>(pass, begin, end);
}
template <auto kernel>
void over_numbered_node(Pass, int begin, int end)
{
    for_each_row(begin, end, [&](int row, int first, int last) {
        for (int column = first; column < last; ++column)
            (this->*kernel)(level_offset(row, column), row * level.columns + column);
    });
}
template <auto kernel>
void over_edge(Pass pass, int begin, int end)
{
    rows<kernel>(pass, begin, end, level.edges);
}
template <auto kernel>
void over_live_edge(Pass pass, int begin, int end)
{
    rows<kernel>(pass, begin, end, level.edges);
}
template <auto kernel>
void over_live_cell(Pass, int begin, int end)
{
    cells<kernel>(begin, end, level.rows, level.columns);
}
template <auto kernel>
void over_live_finer_cell(Pass, int begin, int end)
{
    cells<kernel>(begin, end, (finer.rows + 1) / 2, (finer.columns + 1) / 2);
}
template <auto kernel>
void over_live_finer_node(Pass, int begin, int end)
{
    SolverKernels self = *this;
    const int last = end * sum_columns < finer.columns ? end * sum_columns : finer.columns;
    for (int column = begin * sum_columns; column < last; column += Lanes<T>::count)
        (self.*kernel)(finer_offset(0, column));
}
template <auto kernel>
void over_flag(Pass, int begin, int end)
{
    for (int k = begin; k < end; ++k) (this->*kernel)(k);
}
template <auto kernel>
void over_row_block(Pass, int begin, int end)
{
    for (int k = begin; k < end; ++k) (this->*kernel)(k);
}
template <auto kernel>
void over_spring_row(Pass pass, int begin, int end)
{
    rows<kernel>(pass, begin, end, topology(rows_springs));
}
template <auto kernel>
void over_constraint_row(Pass pass, int begin, int end)
{
    rows<kernel>(pass, begin, end, topology(rows_constraints));
}
template <auto kernel>
void over_active_row(Pass pass, int begin, int end)
{
    rows<kernel>(pass, begin, end, whole(scalar(scalar_rows)));
}

/// Rows in groups of `sum_columns`; rows from the `count`-th on have empty sums.
template <auto kernel>
void rows(Pass pass, int begin, int end, int count)
{
    const SumSlots slots = sum_slots_of(pass);
    SolverKernels self = *this;
    for (int group = begin; group < end; ++group) {
        const int first = group * sum_columns, last = first + sum_columns;
        self.summed(slots, group, first, last < count ? last : count, [&](int k) { (self.*kernel)(k); });
    }
}
/// Calls function(row, first, last) for the columns of each row, or for each group of a single row.
template <class Function>
KERNEL void for_each_row(int begin, int end, const Function& function) const
{
    if (level.rows > 1)
        for (int row = begin; row < end; ++row) function(row, 0, level.columns);
    else if (begin < end)
        function(0, begin * sum_columns,
                 end * sum_columns < level.columns ? end * sum_columns : level.columns);
}
/// Calls function(row, first, last) for each group of columns that forms one part of a sum.
template <class Function>
KERNEL void for_each_group(int begin, int end, const Function& function) const
{
    for_each_row(begin, end, [&](int row, int first, int last) {
        for (int group = first; group < last; group += sum_columns)
            function(row, group, group + sum_columns < last ? group + sum_columns : last);
    });
}
template <auto kernel>
void nodes(Pass pass, int begin, int end)
{
    SolverKernels self = *this;  // a local copy, so that the compiler knows of no aliases
    const SumSlots slots = sum_slots_of(pass);
    if (slots.count > 0 && is_cloth_)  // sums over coarser levels are not used
        return for_each_group(begin, end, [&](int row, int first, int last) {
            self.template nodes_of_group<kernel>(slots, row, first, last);
        });
    for_each_row(begin, end, [&](int row, int first, int last) {
        const int offset = level_offset(row, 0);
        for (int column = first; column < last; column += Lanes<T>::count) (self.*kernel)(offset + column);
    });
}
template <auto kernel>
KERNEL void nodes_of_group(SumSlots slots, int row, int begin, int end)
{
    const int offset = level_offset(row, 0);
    summed(slots, part_of(row, begin), begin, end, [&](int column) { (this->*kernel)(offset + column); });
}
void sheet_clear_rows(Pass pass, int begin, int end)
{
    clear_parts(begin, end);
    nodes<&SolverKernels::sheet_clear>(pass, begin, end);
}
void mesh_clear_rows(Pass pass, int begin, int end)
{
    clear_parts(begin, end);
    nodes<&SolverKernels::mesh_clear>(pass, begin, end);
}
/// Clears the parts of sums in a solve of ACAD: rows that are not live do not write theirs.
void clear_parts(int begin, int end) const
{
    if (!is_cloth_) return;
    for_each_group(begin, end, [&](int row, int first, int) {
        const int part = part_of(row, first);
        for (int slot = 0; slot < sum_active; ++slot)
            if (part < context.part_counts[slot])
                context.parts[slot * context.part_stride + part] = Number(0);
    });
}
int part_of(int row, int column) const { return row * sum_groups(level.columns) + column / sum_columns; }
/// A group of up to sum_columns units, and the part of the sums that it forms.
template <class Function>
KERNEL void summed(SumSlots slots, int part, int first, int last, const Function& kernel)
{
    constexpr int packs = sum_columns / Lanes<T>::count;
    T left[most_sums][packs];
    for (int k = 0; k < packs; ++k) {
        for (T& sum : sums) sum = spread(Number(0));
        const int column = first + k * Lanes<T>::count;
        if (column < last) kernel(column);
        for (int slot = 0; slot < most_sums; ++slot) left[slot][k] = sums[slot];
    }
    for (unsigned slot = 0; slot < slots.count; ++slot) {
        T* values = left[slot];
        for (int width = packs / 2; width > 0; width /= 2)
            for (int k = 0; k < width; ++k) values[k] = values[k] + values[k + width];
        if (part < context.part_counts[slots.first + slot])
            context.parts[int(slots.first + slot) * context.part_stride + part] = Lanes<T>::sum(values[0]);
    }
}

template <auto kernel>
void cells(int begin, int end, int rows, int columns)
{
    SolverKernels self = *this;
    for (int row = begin; row < end && row < rows; ++row)
        for (int column = 0; column < columns; column += Lanes<T>::count) {
            self.inside_ = Lanes<T>::first_lanes(level.columns - column);
            (self.*kernel)(level_offset(row, column), finer_offset(2 * row, 2 * column));
        }
}

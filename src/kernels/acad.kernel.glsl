// ACAD with the solver newton_multigrid: section 3.3 of the cloth paper, unilateral. Each step is first made with springs
// alone. If a spring is then longer than the threshold, the springs near the threshold become limits, and the step is
// corrected. The correction minimises the same energy as for constraints, starting from the result of the springs:
//   E(t) = 1/2 |t - y|^2_{M / dt^2} + sum over the marked springs of their limits' energies,   y = x_springs - q
// Without such a spring only the test runs.

// Whether a spring of this squared length becomes a constraint. `held`: it was one in the previous step.
KERNEL mask is_overstretched(real length2, real rest, mask held)
{
    real rest2 = rest * rest;
    real above = choose(held, acad_held_above2(), acad_above2()), below = choose(held, acad_held_below2(), acad_below2());
    return length2 > choose(length2 < below * rest2, real(-1.0f), above * rest2);
}

// Close enough to the threshold to reach it within this step.
KERNEL mask is_near_threshold(real length2, real rest, mask held)
{
    real rest2 = rest * rest, reach = scalar(scalar_reach);
    real above = acad_near_above2() * rest2, below = acad_near_below2() * rest2;
    real above_by_reach = acad_above2() * rest2 - reach, below_by_reach = acad_below2() * rest2 + reach;
    above = choose(held, acad_held_above2() * rest2, choose(above > above_by_reach, above_by_reach, above));
    if (acad_has_compression()) below = choose(held, acad_held_below2() * rest2, largest(below, below_by_reach));
    return length2 > choose(length2 < below, real(-1.0f), above);
}

// Excess of the squared length over the threshold, m2.
KERNEL real excess(real length2, real rest2)
{
    real over = length2 - acad_above2() * rest2;
    return acad_has_compression() ? largest(over, acad_below2() * rest2 - length2) : over;
}

// 1 if the spring exists and is longer than the threshold.
KERNEL real counted_over(int k, int o, real length2)
{
    mask over = acad_has_memory() ? is_overstretched(length2, sheet_rest(k), load(plane_mark + k, o) > 0.0f)
                                  : excess(length2, sheet_rest(k) * sheet_rest(k)) > 0.0f;
    return choose(over, load(plane_scale + k, o), real(0.0f));
}
KERNEL real squared_excess(real length2, real rest)
{
    real over = largest(excess(length2, rest * rest), real(0.0f));
    return over * over;
}

// Whether the springs k are tested. A bend spring of a sheet is at most as long as the two structural springs on its line,
// so it exceeds the threshold only if one of them does.
KERNEL bool is_tested(int k)
{
    return sheet_has(k) && (k < 4 || !sheet_has(0) || acad_has_compression() || acad_has_memory());
}

// The sum tells whether the step has anything to solve; sheet_marks counts the springs.
KERNEL void sheet_limits(int o)
{
    vec3 x = node_next_position(o);
    for (int k = 0; k < 6; ++k) {
        if (!is_tested(k)) continue;
        vec3 d = node_next_position(o + forward_offset(k)) - x;
        sums[0] = sums[0] + counted_over(k, o, dot3(d, d));
        sums[1] = sums[1] + load(plane_scale + k, o) * squared_excess(dot3(d, d), sheet_rest(k));
    }
}

KERNEL void sheet_marks(int o)
{
    vec3 x = node_next_position(o);
    for (int k = 0; k < 6; ++k) {
        vec3 d = node_next_position(o + forward_offset(k)) - x;
        sums[0] = sums[0] + counted_over(k, o, dot3(d, d));
        mask held = load(plane_mark + k, o) > real(acad_has_memory() ? 0.0f : 2.0f);
        mask near = both(load(plane_scale + k, o) > 0.0f, is_near_threshold(dot3(d, d), sheet_rest(k), held));
        real mark = choose(near, real(1.0f), real(0.0f));
        store(plane_mark + k, o, mark);
        sums[1] = sums[1] + mark;
    }
}

// --- Active rows ----------------------------------------------------------------------------------------------------
// Where no marked spring acts, the operator is inertia alone and the right-hand side is zero, so a solve does not move those
// nodes. The passes of a solve therefore run only over live rows: rows of a level that a marked spring reaches, and rows of
// coarser levels that interpolate to them. On a mesh they are groups of nodes and edges. All numbers of the other rows are
// zero, as for pins: rows that were live in the previous solve are cleared before the next. A solve costs in proportion to
// the cloth around its constraints.

KERNEL void clear_node(int o)
{
    int count = is_cloth() ? node_planes : level_planes;
    for (int plane = 0; plane < count; ++plane) store(plane, o, real(0.0f));
}
KERNEL void sheet_clear(int o)
{
    clear_node(o);
    if (!exact_bend()) return;
    for (int plane = plane_bend; plane < bent_sheet_planes; ++plane) store(plane, o, real(0.0f));
}

// A spring begins at most two rows before the other rows that it reaches; interpolation reads at most one row away.
KERNEL void sheet_live(int row)
{
    real found = real(0.0f);
    int parts_of_row = (level.columns + sum_columns - 1) / sum_columns;
    if (is_cloth())
        for (int k = parts_of_row * (row > 2 ? row - 2 : 0); k < parts_of_row * (row + 1); ++k)
            found = found + part_of_sum(sum_marked, k);
    else
        for (int r = 2 * row - 1; r <= 2 * row + 1; ++r)
            if (r >= 0 && r < finer.rows) found = found + number(finer.live + r);
    set_number(level.live + row, choose(found > 0.0f, real(1.0f), real(0.0f)));
}

// The result of the springs is both the start and the target of the minimisation. Friction has already acted there.
KERNEL void acad_begin(int o)
{
    vec3 q = node_position(o), ahead = node_next_position(o) - q;
    real mass = choose(node_inverse_mass(o) > 0.0f, node_mass(o) * inverse_step() * inverse_step(), real(0.0f));
    store3(plane_start, o, q);
    store3(plane_way, o, ahead);
    store3(plane_aim, o, ahead);
    store(plane_mass, o, mass);
    store(plane_grip, o, real(0.0f));
    vec3 change = ahead - node_velocity(o) * step_length();
    sums[0] = sums[0] + mass * dot3(change, change);
}

// v' = v_springs + (t - y) / dt
KERNEL void acad_end(int o)
{
    vec3 t = load3(plane_way, o);
    vec3 v = node_next_velocity(o) + (t - load3(plane_aim, o)) * inverse_step();
    v = choose(node_inverse_mass(o) > 0.0f, settled_velocity(v), node_next_velocity(o));
    node_end(o, load3(plane_start, o) + t, v);
}

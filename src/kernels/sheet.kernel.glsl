// The solver on sheets: geometric multigrid. A level is a sheet of half as many rows and columns; interpolation is
// bilinear, and a coarse operator is what it makes of the fine one (Galerkin). Operators are kept by their couplings B,
// and applied to differences:  (A x)_i = s_i x_i + sum_j B_ij (x_i - x_j),  so that what moves as a whole feels only s,
// however stiff B is. Couplings of a sheet's level reach its eight neighbours; those of bend springs are folded onto
// them, k (a - c)^2 as 2 k ((a - b)^2 + (b - c)^2), which is the same for smooth shapes and never softer.
// Source: Trottenberg, Oosterlee, Schueller, "Multigrid", 2001.

// Places of a sheet: the four forward neighbours by structural and shear springs, and the two by bend springs.
KERNEL int forward_offset(int k)
{
    return k == 0 ? 1 : k == 1 ? level.stride - 1 : k == 2 ? level.stride : k == 3 ? level.stride + 1 : k == 4 ? 2 : 2 * level.stride;
}

// 1 where the sheet has such a spring, and ACAD has marked it.
KERNEL real spring_scale(int k, int o)
{
    return load((is_acad() ? plane_mark : plane_scale) + k, o);
}

// A spring as the node at i has it, which it draws towards the one at j; nothing where `scale` is 0.
KERNEL SpringShare sheet_spring(int k, int i, int j, real scale)
{
    return spring_share(sheet_curve(k), load3(plane_q, j) - load3(plane_q, i), load3(plane_t, j) - load3(plane_t, i),
                        sheet_rest(k), scale);
}
KERNEL real counted_taut(SpringShare spring)
{
    return choose(magnitude(spring.multiplier) > 0.0f, real(1.0f), real(0.0f));
}

// The largest force of a constraint at a node, N.
KERNEL void sheet_multipliers(int o)
{
    vec3 x = load3(plane_q, o) + load3(plane_t, o);
    real most = real(0.0f);
    for (int side = 0; side < 2; ++side)
        for (int k = 0; k < 6; ++k) {
            if (!sheet_has(k)) continue;
            int j = side == 0 ? o + forward_offset(k) : o - forward_offset(k), first = side == 0 ? o : j;
            vec3 d = load3(plane_q, j) + load3(plane_t, j) - x;
            real length2 = dot3(d, d);
            SpringState state = spring_state(sheet_curve(k), length2, inverse_sqrt(length2), sheet_rest(k));
            real scale = spring_scale(k, first);
            most = largest(magnitude(state.multiplier * scale), most);
        }
    set_multiplier(o, choose(scalar(scalar_idle) > 0.0f, real(0.0f), most));
}

// A node while its springs are added: the force on it, and the rows of the operator.
struct SheetNode
{
    vec3 r;
    Symmetric diagonal, row_sum;
};

KERNEL SpringShare no_spring()
{
    SpringShare share;
    share.force = vec3(real(0.0f), real(0.0f), real(0.0f));
    share.block = symmetric_diagonal(real(0.0f));
    share.energy = real(0.0f);
    share.multiplier = real(0.0f);
    return share;
}

// Whether the couplings to the neighbour k and to the one behind it have a bend spring folded in, and which.
KERNEL bool is_bent(int k)
{
    return has_bend() && (k == 0 || k == 2);
}
KERNEL int bend_along(int k)
{
    return k == 0 ? 4 : 5;
}

// Forces and the operator of a node, springs apart: inertia and contact. They go by sums[1] and [2].
KERNEL SheetNode sheet_node(int o)
{
    vec3 t = load3(plane_t, o);
    real mass = load(plane_mass, o);
    vec3 ahead = t - load3(plane_y, o);
    Contact contact = contact_at(o, load3(plane_q, o), t);
    SheetNode node;
    node.r = contact.force - ahead * mass;
    node.row_sum = plus(symmetric_diagonal(mass), contact.stiffness);
    node.diagonal = node.row_sum;
    sums[1] = sums[1] + 0.5f * mass * dot3(ahead, ahead);
    sums[2] = sums[2] + choose(mass > 0.0f, contact.energy, real(0.0f));
    return node;
}

// With the springs to the neighbour k and to the one opposite it; those of the bend springs on the same line; and the
// block of the one that leads across the node.
KERNEL SheetNode with_springs(SheetNode node, int k, int o, SpringShare onward, SpringShare back, SpringShare far_onward,
                              SpringShare far_back, Symmetric across)
{
    int j = o + forward_offset(k), i = o - forward_offset(k);
    node.r = node.r + onward.force + back.force;
    Symmetric to_j = onward.block, to_i = back.block;
    mask coupled = both(load(plane_mass, o) > 0.0f, load(plane_mass, j) > 0.0f);
    if (is_bent(k)) {
        node.r = node.r + far_onward.force + far_back.force;
        Symmetric folded_j = plus_scaled(to_j, plus(far_onward.block, across), real(2.0f));
        if (exact_bend()) {
            store6(plane_bend + 3 * k, o, far_onward.block);
            store6(plane_fold + 3 * k, o, where_else_zero(coupled, folded_j));
            node.diagonal = plus(plus(node.diagonal, far_onward.block), far_back.block);
        } else {
            to_j = folded_j;
            to_i = plus_scaled(to_i, plus(far_back.block, across), real(2.0f));
        }
    }
    node.diagonal = plus(plus(node.diagonal, to_j), to_i);
    // A coupling to a pinned node is a support of this one.
    real held_j = choose(load(plane_mass, j) > 0.0f, real(0.0f), real(1.0f));
    real held_i = choose(load(plane_mass, i) > 0.0f, real(0.0f), real(1.0f));
    if (any_lane(held_j + held_i > 0.0f))
        node.row_sum = plus_scaled(plus_scaled(node.row_sum, to_j, held_j), to_i, held_i);
    store6(plane_block + 6 * k, o, where_else_zero(coupled, to_j));
    return node;
}

KERNEL void leave_gathered(int o, SheetNode node, real energy, real taut)
{
    real mass = load(plane_mass, o);
    mask is_free = mass > 0.0f;
    store(plane_active, o, taut);
    store6(plane_row_sum, o, where_else_zero(is_free, node.row_sum));
    store6(plane_factor, o, where_else_zero(is_free, factored(node.diagonal, mass)));
    store3(plane_r, o, choose(is_free, node.r, vec3(real(0.0f), real(0.0f), real(0.0f))));
    sums[0] = sums[0] + energy;
}

// A spring is counted where it begins, and a force is the exact opposite at its other end: whether it is computed once
// (SolverKernels::gathers) or at both ends, as here, makes no difference.
KERNEL void sheet_gather(int o)
{
    SheetNode node = sheet_node(o);
    real energy = real(0.0f), taut = real(0.0f);
    UNROLL for (int k = 0; k < 4; ++k) {
        int step = forward_offset(k), j = o + step, i = o - step;
        SpringShare onward = no_spring(), back = onward, far_onward = onward, far_back = onward;
        Symmetric across = onward.block;
        if (sheet_has(k)) {
            onward = sheet_spring(k, o, j, spring_scale(k, o));
            back = sheet_spring(k, o, i, spring_scale(k, i));
            energy = energy + onward.energy;
            taut = taut + counted_taut(onward);
        }
        if (is_bent(k)) {
            int bend = bend_along(k);
            far_onward = sheet_spring(bend, o, j + step, spring_scale(bend, o));
            far_back = sheet_spring(bend, o, i - step, spring_scale(bend, i - step));
            across = sheet_spring(bend, i, j, spring_scale(bend, i)).block;
            energy = energy + far_onward.energy;
            taut = taut + counted_taut(far_onward);
        }
        node = with_springs(node, k, o, onward, back, far_onward, far_back, across);
    }
    leave_gathered(o, node, energy, taut);
}

// The last look of a step, which no linear system follows: energies alone.
KERNEL void sheet_energy(int o)
{
    real energy = real(0.0f), taut = real(0.0f);
    UNROLL for (int k = 0; k < 4; ++k) {
        int step = forward_offset(k);
        if (sheet_has(k)) {
            SpringShare onward = sheet_spring(k, o, o + step, spring_scale(k, o));
            energy = energy + onward.energy;
            taut = taut + counted_taut(onward);
        }
        if (is_bent(k)) {
            int bend = bend_along(k);
            SpringShare onward = sheet_spring(bend, o, o + 2 * step, spring_scale(bend, o));
            energy = energy + onward.energy;
            taut = taut + counted_taut(onward);
        }
    }
    sheet_node(o);
    store(plane_active, o, taut);
    sums[0] = sums[0] + energy;
}

// B (x_i - x_j) of the coupling from a node to its forward neighbour k; j is left with the negative of it.
KERNEL vec3 coupling_force(int blocks, int k, int x, int o)
{
    return product(load6(blocks, o), load3(x, o) - load3(x, o + forward_offset(k)));
}

// (A x) of a node, from the forces of the couplings that lead ahead from it, and of those that come from behind.
KERNEL vec3 sum_of_forces(int x, int o, vec3 ahead[4], vec3 behind[4])
{
    vec3 y = product(load6(plane_row_sum, o), load3(x, o));
    UNROLL for (int k = 0; k < 4; ++k) y = y + ahead[k] - behind[k];
    return y;
}

// (A x) of a node; vectors are 0 at pinned nodes and beyond the border.
KERNEL vec3 row_product(int x, int o)
{
    vec3 ahead[4], behind[4];
    UNROLL for (int k = 0; k < 4; ++k) {
        ahead[k] = coupling_force(plane_block + 6 * k, k, x, o);
        behind[k] = coupling_force(plane_block + 6 * k, k, x, o - forward_offset(k));
    }
    vec3 y = sum_of_forces(x, o, ahead, behind);
    if (exact_bend()) {
        vec3 bend = vec3(real(0.0f), real(0.0f), real(0.0f));
        UNROLL for (int k = 4; k < 6; ++k)
            bend = bend + coupling_force(plane_bend + 6 * (k - 4), k, x, o) -
                   coupling_force(plane_bend + 6 * (k - 4), k, x, o - forward_offset(k));
        y = y + bend * choose(load(plane_mass, o) > 0.0f, real(1.0f), real(0.0f));
    }
    return y;
}

// Bilinear interpolation: how much of a coarse node is in a fine one that lies (rows, columns) from it.
KERNEL float interpolation(int rows, int columns)
{
    int a = rows < 0 ? -rows : rows, b = columns < 0 ? -columns : columns;
    if (a > 1 || b > 1) return 0.0f;
    return (a == 1 ? 0.5f : 1.0f) * (b == 1 ? 0.5f : 1.0f);
}

// The operator of this level from that of the finer one, whose node over this one is at f:
//   A(I, J) = sum over fine couplings of (w_iI - w_jI) (w_iJ - w_jJ) B_ij + sum over fine nodes of w_iI w_iJ s_i
KERNEL void sheet_coarsen(int o, int f)
{
    Symmetric zero = symmetric_diagonal(real(0.0f));
    Symmetric diagonal = zero, row_sum = zero, block_0 = zero, block_1 = zero, block_2 = zero, block_3 = zero;
    UNROLL for (int row = -2; row <= 1; ++row)
        UNROLL for (int column = -2; column <= 2; ++column) {
            int i = f + row * finer.stride + column;
            float here = interpolation(row, column);
            float here_0 = interpolation(row, column - 2), here_1 = interpolation(row - 2, column + 2);
            float here_2 = interpolation(row - 2, column), here_3 = interpolation(row - 2, column - 2);
            if (here > 0.0f) {
                Symmetric s = finer_load6(plane_row_sum, i);
                row_sum = plus_scaled(row_sum, s, real(here));
                diagonal = plus_scaled(diagonal, s, real(here * here));
                if (here_0 > 0.0f) block_0 = plus_scaled(block_0, s, real(-here * here_0));
                if (here_1 > 0.0f) block_1 = plus_scaled(block_1, s, real(-here * here_1));
                if (here_2 > 0.0f) block_2 = plus_scaled(block_2, s, real(-here * here_2));
                if (here_3 > 0.0f) block_3 = plus_scaled(block_3, s, real(-here * here_3));
            }
            UNROLL for (int k = 0; k < 4; ++k) {
                int down = k == 0 ? 0 : 1, right = k == 1 ? -1 : k == 2 ? 0 : 1;
                float change = here - interpolation(row + down, column + right);
                if (change == 0.0f) continue;
                Symmetric b = finer_load6(finer_coupling(k), i);
                diagonal = plus_scaled(diagonal, b, real(change * change));
                float change_0 = here_0 - interpolation(row + down, column + right - 2);
                float change_1 = here_1 - interpolation(row + down - 2, column + right + 2);
                float change_2 = here_2 - interpolation(row + down - 2, column + right);
                float change_3 = here_3 - interpolation(row + down - 2, column + right - 2);
                if (change_0 != 0.0f) block_0 = plus_scaled(block_0, b, real(-change * change_0));
                if (change_1 != 0.0f) block_1 = plus_scaled(block_1, b, real(-change * change_1));
                if (change_2 != 0.0f) block_2 = plus_scaled(block_2, b, real(-change * change_2));
                if (change_3 != 0.0f) block_3 = plus_scaled(block_3, b, real(-change * change_3));
            }
        }
    mask inside = inside_level();  // what lies beyond a row's end is padding, and stays empty
    store6(plane_row_sum, o, where_else_zero(inside, row_sum));
    store6(plane_block, o, where_else_zero(inside, block_0));
    store6(plane_block + 6, o, where_else_zero(inside, block_1));
    store6(plane_block + 12, o, where_else_zero(inside, block_2));
    store6(plane_block + 18, o, where_else_zero(inside, block_3));
    store6(plane_factor, o, where_else_zero(inside, factored(diagonal, real(0.0f))));
}

// The residual of the finer level, gathered, and the first correction of this one.
KERNEL void sheet_restrict(int o, int f)
{
    vec3 r = vec3(real(0.0f), real(0.0f), real(0.0f));
    UNROLL for (int row = -1; row <= 1; ++row)
        UNROLL for (int column = -1; column <= 1; ++column)
            r = plus_scaled(r, finer_load3(plane_s, f + row * finer.stride + column), real(interpolation(row, column)));
    Symmetric factor = load6(plane_factor, o);
    r = choose(factor.xx > 0.0f, r, vec3(real(0.0f), real(0.0f), real(0.0f)));
    store3(plane_r, o, r);
    store3(plane_z, o, solved(factor, r) * relaxation());
}

// The correction of this level, added to the four nodes of the finer one at and after f.
KERNEL void sheet_prolong(int o, int f)
{
    vec3 here = load3(source_plane(), o), right = load3(source_plane(), o + 1);
    vec3 below = load3(source_plane(), o + level.stride), diagonal = load3(source_plane(), o + level.stride + 1);
    finer_add3(finer_plane(), f, here, (here + right) * real(0.5f));
    finer_add3(finer_plane(), f + finer.stride, (here + below) * real(0.5f),
               (here + right + below + diagonal) * real(0.25f));
}

// The operator of the last level, dense.
KERNEL void bottom_assemble()
{
    for (int row = 0; row < level.rows; ++row)
        for (int column = 0; column < level.columns; ++column) {
            int o = level_offset(row, column), i = row * level.columns + column;
            bottom_add(i, i, load6(plane_row_sum, o), real(1.0f));
            for (int k = 0; k < 4; ++k) {
                int down = k == 0 ? 0 : 1, right = k == 1 ? -1 : k == 2 ? 0 : 1;
                if (row + down >= level.rows || column + right < 0 || column + right >= level.columns) continue;
                int j = i + down * level.columns + right;
                Symmetric b = load6(plane_block + 6 * k, o);
                bottom_add(i, i, b, real(1.0f));
                bottom_add(j, j, b, real(1.0f));
                bottom_add(j, i, b, real(-1.0f));  // the lower triangle
            }
        }
}

// The solver on sheets: geometric multigrid. Each level is a sheet of half as many rows and columns; interpolation is
// bilinear, and coarse operators are Galerkin's. Operators are stored by their couplings B and applied to differences: (A
// x)_i = s_i x_i + sum_j B_ij (x_i - x_j). A rigid displacement thus feels only s, however stiff B is. Couplings reach the
// eight neighbours. Couplings of bend springs are folded onto them: k (a - c)^2 becomes 2 k ((a - b)^2 + (b - c)^2), which
// is equal for smooth shapes and never softer.
// Source: Trottenberg, Oosterlee, Schueller, "Multigrid", 2001.

// Offsets of the six springs that begin at a node, by their numbers in sheet_neighbours.glsl: four structural and shear
// springs, then two bend springs.
KERNEL int forward_offset(int k)
{
    return k == 0 ? 1 : k == 1 ? level.stride - 1 : k == 2 ? level.stride : k == 3 ? level.stride + 1 : k == 4 ? 2 : 2 * level.stride;
}

// 1 if the sheet has such a spring and ACAD has marked it.
KERNEL real spring_scale(int k, int o)
{
    return load((is_acad() ? plane_mark : plane_scale) + k, o);
}

// The limit of spring k that begins at a node.
KERNEL LimitCurve sheet_limit(int k, int first)
{
    LimitCurve curve = sheet_curve(k);
    if (k >= 4 || !remembers(sheet_class(k))) return curve;
    return remembered(curve, load(plane_slip + k, first), load(plane_stiff + k, first), softest(sheet_class(k)));
}

// The spring that pulls node i towards node j; zero if `scale` is 0. It begins at node `first`.
KERNEL SpringShare sheet_spring(int k, int i, int j, real scale, int first)
{
    vec3 start = load3(plane_start, j) - load3(plane_start, i), moved = load3(plane_way, j) - load3(plane_way, i);
    return spring_share(damped_between(sheet_limit(k, first), i, j), start, moved, damper_between(start, i, j), sheet_rest(k),
                        scale);
}
KERNEL real counted_taut(SpringShare spring)
{
    return choose(magnitude(spring.multiplier) > 0.0f, real(1.0f), real(0.0f));
}

// The largest force of a constraint at a node, N.
KERNEL void sheet_multipliers(int o)
{
    vec3 x = load3(plane_start, o) + load3(plane_way, o);
    real most = real(0.0f);
    for (int side = 0; side < 2; ++side)
        for (int k = 0; k < 6; ++k) {
            if (!sheet_has(k)) continue;
            int j = side == 0 ? o + forward_offset(k) : o - forward_offset(k), first = side == 0 ? o : j;
            vec3 d = load3(plane_start, j) + load3(plane_way, j) - x;
            real length2 = dot3(d, d);
            SpringState state = spring_state(sheet_limit(k, first), length2, inverse_sqrt(length2), sheet_rest(k));
            real scale = spring_scale(k, first);
            most = largest(magnitude(state.multiplier * scale), most);
        }
    set_multiplier(o, choose(scalar(scalar_idle) > 0.0f, real(0.0f), most));
}

// The memory of the limits of a node's forward springs after a step. The sum is the change of their energy.
KERNEL void sheet_multiply(int o)
{
    vec3 x = load3(plane_start, o) + load3(plane_way, o);
    UNROLL for (int k = 0; k < 4; ++k) {
        if (!sheet_has(k) || !remembers(sheet_class(k))) continue;
        int j = o + forward_offset(k);
        vec3 d = load3(plane_start, j) + load3(plane_way, j) - x;
        real scale = spring_scale(k, o);
        RenewedLimit limit = renewed(sheet_limit(k, o), dot3(d, d), sheet_rest(k), sheet_class(k), softest_limit());
        store(plane_slip + k, o, limit.memory.slip * scale);
        store(plane_stiff + k, o, limit.memory.stiffness);
        sums[0] = sums[0] + limit.energy * scale;
    }
}

// Accumulator of a node's springs: the force on it, and its rows of the operator.
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

// Whether a bend spring is folded into the couplings to neighbour k and to the one opposite it, and which.
KERNEL bool is_bent(int k)
{
    return has_bend() && (k == 0 || k == 2);
}
KERNEL int bend_along(int k)
{
    return k == 0 ? 4 : 5;
}

// Force on a node and its rows of the operator without springs: inertia and contact. Their energies go to sums[1] and [2].
KERNEL SheetNode sheet_node(int o)
{
    vec3 t = load3(plane_way, o);
    real mass = load(plane_mass, o);
    vec3 ahead = t - load3(plane_aim, o);
    Contact contact = contact_at(o, load3(plane_start, o), t);
    SheetNode node;
    node.r = contact.force - ahead * mass;
    node.row_sum = plus(symmetric_diagonal(mass), contact.stiffness);
    node.diagonal = node.row_sum;
    sums[1] = sums[1] + 0.5f * mass * dot3(ahead, ahead);
    sums[2] = sums[2] + choose(mass > 0.0f, contact.energy, real(0.0f));
    return node;
}

// Adds the springs to neighbour k and to the one opposite it, the bend springs on the same line, and the block of the bend
// spring across the node.
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
    // A coupling to a pinned node adds to this node's row sum.
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
    store3(plane_residual, o, choose(is_free, node.r, vec3(real(0.0f), real(0.0f), real(0.0f))));
    sums[0] = sums[0] + energy;
}

// A spring is counted at its first node, and its forces at both ends are exact opposites. Computing it once
// (SolverKernels::sheet_gather_rows) or at both ends, as here, gives the same bits.
KERNEL void sheet_forces(int o)
{
    SheetNode node = sheet_node(o);
    real energy = real(0.0f), taut = real(0.0f);
    UNROLL for (int k = 0; k < 4; ++k) {
        int step = forward_offset(k), j = o + step, i = o - step;
        SpringShare onward = no_spring(), back = onward, far_onward = onward, far_back = onward;
        Symmetric across = onward.block;
        if (sheet_has(k)) {
            onward = sheet_spring(k, o, j, spring_scale(k, o), o);
            back = sheet_spring(k, o, i, spring_scale(k, i), i);
            energy = energy + onward.energy;
            taut = taut + counted_taut(onward);
        }
        if (is_bent(k)) {
            int bend = bend_along(k);
            far_onward = sheet_spring(bend, o, j + step, spring_scale(bend, o), o);
            far_back = sheet_spring(bend, o, i - step, spring_scale(bend, i - step), i - step);
            across = sheet_spring(bend, i, j, spring_scale(bend, i), i).block;
            energy = energy + far_onward.energy;
            taut = taut + counted_taut(far_onward);
        }
        node = with_springs(node, k, o, onward, back, far_onward, far_back, across);
    }
    leave_gathered(o, node, energy, taut);
}

// The last evaluation of a step: energies alone, since no linear system follows.
KERNEL void sheet_energy(int o)
{
    real energy = real(0.0f), taut = real(0.0f);
    UNROLL for (int k = 0; k < 4; ++k) {
        int step = forward_offset(k);
        if (sheet_has(k)) {
            SpringShare onward = sheet_spring(k, o, o + step, spring_scale(k, o), o);
            energy = energy + onward.energy;
            taut = taut + counted_taut(onward);
        }
        if (is_bent(k)) {
            int bend = bend_along(k);
            SpringShare onward = sheet_spring(bend, o, o + 2 * step, spring_scale(bend, o), o);
            energy = energy + onward.energy;
            taut = taut + counted_taut(onward);
        }
    }
    sheet_node(o);
    store(plane_active, o, taut);
    sums[0] = sums[0] + energy;
}

KERNEL void sheet_gather(int o)
{
    if (is_last_look())
        sheet_energy(o);
    else
        sheet_forces(o);
}

// B (x_i - x_j) of the coupling from a node to its forward neighbour k; node j gets the negative.
KERNEL vec3 coupling_force(int blocks, int k, int x, int o)
{
    return product(load6(blocks, o), load3(x, o) - load3(x, o + forward_offset(k)));
}
// The same for the coupling from node i to this one.
KERNEL vec3 coupling_force_behind(int blocks, int k, int x, int i)
{
    return product(load6_anywhere(blocks, i), load3(x, i) - load3(x, i + forward_offset(k)));
}

// (A x) of a node, from the forces of its forward couplings and of those from behind.
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
        behind[k] = coupling_force_behind(plane_block + 6 * k, k, x, o - forward_offset(k));
    }
    vec3 y = sum_of_forces(x, o, ahead, behind);
    if (exact_bend()) {
        vec3 bend = vec3(real(0.0f), real(0.0f), real(0.0f));
        UNROLL for (int k = 4; k < 6; ++k)
            bend = bend + coupling_force(plane_bend + 6 * (k - 4), k, x, o) -
                   coupling_force_behind(plane_bend + 6 * (k - 4), k, x, o - forward_offset(k));
        y = y + bend * choose(load(plane_mass, o) > 0.0f, real(1.0f), real(0.0f));
    }
    return y;
}

// The operator of this level from the finer one, by bilinear interpolation P: P^T A P, first columns, then rows. The
// intermediate operator has the rows of the finer level and the columns of this one.
struct HalfCoarse
{
    Symmetric row_sum, diagonal, block_0, block_1, block_2, block_3;
};

// The part of a fine node that does not couple along its row: its row sum, and the couplings to the rows below and above.
KERNEL Symmetric held_across(Symmetric row_sum, Symmetric below_1, Symmetric below_2, Symmetric below_3, Symmetric above_1,
                             Symmetric above_2, Symmetric above_3)
{
    return plus(plus(plus(row_sum, below_1), plus(below_2, below_3)), plus(plus(above_1, above_2), above_3));
}

// A coarse node at the fine node `here`, between the fine nodes `left` and `right`. With the weights 1/2, 1, 1/2 the
// coupling along the row is (b + b' - h) / 4, where h is that part of the fine node between the two coarse ones.
KERNEL Symmetric half_along(Symmetric along_here, Symmetric along_right, Symmetric held_right)
{
    return scaled(minus(plus(along_here, along_right), held_right), real(0.25f));
}
KERNEL Symmetric half_back(Symmetric here_1, Symmetric left_1, Symmetric left_2)
{
    return plus_scaled(scaled(plus(here_1, left_1), real(0.5f)), left_2, real(0.25f));
}
KERNEL Symmetric half_down(Symmetric here_1, Symmetric here_2, Symmetric here_3, Symmetric right_1, Symmetric right_2,
                           Symmetric left_2, Symmetric left_3)
{
    Symmetric slanted = plus(plus(here_1, here_3), plus(right_1, left_3));
    return plus_scaled(plus_scaled(here_2, slanted, real(0.5f)), plus(right_2, left_2), real(0.25f));
}
KERNEL Symmetric half_ahead(Symmetric here_3, Symmetric right_3, Symmetric right_2)
{
    return plus_scaled(scaled(plus(here_3, right_3), real(0.5f)), right_2, real(0.25f));
}
KERNEL Symmetric half_diagonal(Symmetric held_here, Symmetric held_left, Symmetric held_right, Symmetric along_before,
                               Symmetric along_left, Symmetric along_here, Symmetric along_right)
{
    Symmetric along = plus(plus(along_before, along_left), plus(along_here, along_right));
    return plus_scaled(held_here, plus(plus(held_left, held_right), along), real(0.25f));
}
KERNEL Symmetric half_sum(Symmetric here, Symmetric left, Symmetric right)
{
    return plus_scaled(here, plus(right, left), real(0.5f));
}

KERNEL Symmetric held_at(int i)
{
    int above = i - finer.stride;
    return held_across(finer_load6(plane_row_sum, i), finer_load6(plane_block + 6, i),
                       finer_load6(finer_coupling(2), i), finer_load6(plane_block + 18, i),
                       finer_load6(plane_block + 6, above + 1), finer_load6(finer_coupling(2), above),
                       finer_load6(plane_block + 18, above - 1));
}
KERNEL Symmetric half_along_at(int i)
{
    return half_along(finer_load6(finer_coupling(0), i), finer_load6(finer_coupling(0), i + 1), held_at(i + 1));
}
KERNEL Symmetric half_back_at(int i)
{
    return half_back(finer_load6(plane_block + 6, i), finer_load6(plane_block + 6, i - 1), finer_load6(finer_coupling(2), i - 1));
}
KERNEL HalfCoarse half_coarse_at(int i)
{
    HalfCoarse between;
    int along = finer_coupling(0), down = finer_coupling(2);
    Symmetric held_right = held_at(i + 1);
    between.row_sum =
        half_sum(finer_load6(plane_row_sum, i), finer_load6(plane_row_sum, i - 1), finer_load6(plane_row_sum, i + 1));
    between.diagonal = half_diagonal(held_at(i), held_at(i - 1), held_right, finer_load6(along, i - 2),
                                  finer_load6(along, i - 1), finer_load6(along, i), finer_load6(along, i + 1));
    between.block_0 = half_along(finer_load6(along, i), finer_load6(along, i + 1), held_right);
    between.block_1 = half_back_at(i);
    between.block_2 = half_down(finer_load6(plane_block + 6, i), finer_load6(down, i), finer_load6(plane_block + 18, i),
                             finer_load6(plane_block + 6, i + 1), finer_load6(down, i + 1), finer_load6(down, i - 1),
                             finer_load6(plane_block + 18, i - 1));
    between.block_3 =
        half_ahead(finer_load6(plane_block + 18, i), finer_load6(plane_block + 18, i + 1), finer_load6(down, i + 1));
    return between;
}

// Combines rows: the fine row over this one, those above and below it, and couplings from the neighbouring columns.
KERNEL void leave_coarsened(int o, HalfCoarse above, HalfCoarse here, HalfCoarse below, Symmetric above_right_1,
                            Symmetric here_right_1, Symmetric below_left_0)
{
    Symmetric diagonal = minus(plus_scaled(here.diagonal, plus(above.diagonal, below.diagonal), real(0.25f)),
                               plus(above.block_2, here.block_2));
    Symmetric slanted = plus(plus(above_right_1, here.block_3), plus(here_right_1, above.block_3));
    mask inside = inside_level();  // padding beyond the end of a row stays zero
    store6(plane_row_sum, o, where_else_zero(inside, half_sum(here.row_sum, above.row_sum, below.row_sum)));
    store6(plane_block, o,
           where_else_zero(inside, plus_scaled(plus_scaled(here.block_0, slanted, real(0.5f)),
                                               plus(below.block_0, above.block_0), real(0.25f))));
    store6(plane_block + 6, o,
           where_else_zero(inside, plus_scaled(scaled(plus(here.block_1, below.block_1), real(0.5f)), below_left_0,
                                               real(0.25f))));
    store6(plane_block + 12, o,
           where_else_zero(inside, plus_scaled(scaled(plus(here.block_2, below.block_2), real(0.5f)), below.diagonal,
                                               real(-0.25f))));
    store6(plane_block + 18, o,
           where_else_zero(inside, plus_scaled(scaled(plus(here.block_3, below.block_3), real(0.5f)), below.block_0,
                                               real(0.25f))));
    store6(plane_factor, o, where_else_zero(inside, factored(diagonal, real(0.0f))));
}

// f: the node of the finer level at the place of this one.
KERNEL void sheet_coarsen(int o, int f)
{
    int above = f - finer.stride, below = f + finer.stride;
    leave_coarsened(o, half_coarse_at(above), half_coarse_at(f), half_coarse_at(below), half_back_at(above + 2),
                    half_back_at(f + 2), half_along_at(below - 2));
}

// The residual of the finer level, restricted, and the first correction of this level.
KERNEL void sheet_restrict(int o, int f)
{
    vec3 r = vec3(real(0.0f), real(0.0f), real(0.0f));
    UNROLL for (int row = -1; row <= 1; ++row)
        UNROLL for (int column = -1; column <= 1; ++column)
            r = plus_scaled(r, finer_load3(plane_left, f + row * finer.stride + column), real((row == 0 ? 1.0f : 0.5f) * (column == 0 ? 1.0f : 0.5f)));
    Symmetric factor = load6(plane_factor, o);
    r = choose(factor.xx > 0.0f, r, vec3(real(0.0f), real(0.0f), real(0.0f)));
    store3(plane_residual, o, r);
    store3(plane_correction, o, solved(factor, r) * relaxation());
}

// Adds the correction of this level to the four nodes of the finer one at and after f.
KERNEL void sheet_prolong(int o, int f)
{
    vec3 here = load3(source_plane(), o), right = load3(source_plane(), o + 1);
    vec3 below = load3(source_plane(), o + level.stride), diagonal = load3(source_plane(), o + level.stride + 1);
    finer_add3(finer_plane(), f, here, (here + right) * real(0.5f));
    finer_add3(finer_plane(), f + finer.stride, (here + below) * real(0.5f),
               (here + right + below + diagonal) * real(0.25f));
}

// The operator of the coarsest level, dense.
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

// The solver of the cloth paper: Va, Choi, Hong, "Real-Time Cloth Simulation Using Compute Shader in Unity3D for AR/VR
// Contents", 2021, sections 2.2 and 3.2, and 3.3 for ACAD. With C_s = |x_i - x_j|^2 - L^2 of a spring s and J its
// derivative, a row of 2 (x_i - x_j) at i and -2 (x_i - x_j) at j, one linear system gives the multipliers of a step:
//
//   (J M^-1 J^T + S) lambda = C / dt^2 + J u / dt,    v' = u - dt M^-1 J^T lambda,    x' = x + dt v'     (eq. 7 to 11)
//
// u is the velocity without constraints; for a pin it is the pin's own velocity: the paper's Phi_t. S is the compliance,
// which the paper does not have (docs/physics.md, "The paper's solver"). One invocation handles a node, a spring or an
// active constraint; nodes gather from springs, so no atomics are needed.

KERNEL real row_get(int plane, int s) { return number(topology(rows_base) + plane * topology(rows_size) + s); }
KERNEL void row_set(int plane, int s, real a) { set_number(topology(rows_base) + plane * topology(rows_size) + s, a); }
KERNEL vec3 row_get3(int plane, int s) { return vec3(row_get(plane, s), row_get(plane + 1, s), row_get(plane + 2, s)); }
KERNEL void row_set3(int plane, int s, vec3 a)
{
    row_set(plane, s, a.x);
    row_set(plane + 1, s, a.y);
    row_set(plane + 2, s, a.z);
}
KERNEL real paper_value(int k) { return number(topology(rows_values) + k); }
KERNEL int spring_end(int s, int side) { return topology(topology(rows_ends) + 2 * s + side); }

// The spring of the k-th active constraint.
KERNEL int active_row(int k) { return topology(rows_adaptive) != 0 ? whole(row_get(row_list, k)) : k; }

KERNEL void paper_begin(int o)
{
    vec3 q = node_position(o);
    real w = node_inverse_mass(o);
    vec3 carried = (node_next_position(o) - q) * inverse_step();
    store3(paper_start_position, o, q);
    store3(paper_velocity, o, choose(w > 0.0f, node_velocity(o), carried));
    store(paper_inverse_mass, o, w);
}

// Section 3.3: whether a spring is a constraint in this step. A constraint stays one until its strain is below the second
// threshold. A unilateral one also stays while it bears a load; otherwise rounding would switch it on and off at the
// threshold.
KERNEL real next_mark(int s, real stretch)
{
    real last = row_get(row_mark, s), on = paper_value(paper_activate), off = paper_value(paper_deactivate);
    bool bears = topology(rows_unilateral) != 0 && row_get(row_lambda, s) * last > 0.0f;
    if (stretch > (last > 0.0f ? off : on) || (bears && last > 0.0f)) return real(1.0f);
    if (topology(rows_compression) == 0) return real(0.0f);
    if (-stretch > (last < 0.0f ? off : on) || (bears && last < 0.0f)) return real(-1.0f);
    return real(0.0f);
}

// A spring is either a constraint, with a row of J, or it exerts a force: eq. (1) or eq. (5).
KERNEL void paper_springs(int s)
{
    int i = spring_end(s, 0), j = spring_end(s, 1), k = topology(topology(rows_classes) + s);
    vec3 xi = load3(paper_start_position, i), xj = load3(paper_start_position, j);
    real rest = row_get(row_rest, s), mark = real(0.0f);
    if (s < topology(rows_constraints)) {
        mark = topology(rows_adaptive) != 0 ? next_mark(s, spring_stretch(xi, xj, rest)) : real(1.0f);
        row_set(row_mark, s, mark);
        row_set3(row_jacobian, s, xi - xj);
        row_set(row_direction, s, real(0.0f));  // so that this column of the matrix adds nothing
    }
    bool is_constraint = magnitude(mark) > 0.0f;
    vec3 force = vec3(real(0.0f), real(0.0f), real(0.0f));
    if (!is_constraint)
        force = spring_force(xi, xj, load3(paper_velocity, i), load3(paper_velocity, j), rest, paper_value(paper_stiffness + k),
                             paper_value(paper_damping + k));
    row_set3(row_force, s, force);
    sums[0] = sums[0] + (is_constraint ? real(1.0f) : real(0.0f));
}

// F^A, and from it u; the sum has the order of list_step.
KERNEL void paper_gather(int o, int node)
{
    vec3 force = vec3(real(0.0f), real(0.0f), real(0.0f));
    int first = topology(topology(rows_node_start) + node), end = topology(topology(rows_node_start) + node + 1);
    for (int e = first; e < end; ++e) {
        int entry = topology(topology(rows_node_entries) + e);
        vec3 f = row_get3(row_force, entry / 2);
        force = entry % 2 == 0 ? force + f : force - f;
    }
    force = force + node_force(o);
    real w = load(paper_inverse_mass, o);
    vec3 v = load3(paper_velocity, o);
    vec3 u = velocity_step(v, force, w, gravity(), decay(), step_length());
    store3(paper_force, o, force);
    store3(paper_free_velocity, o, choose(w > 0.0f, u, v));
}

// The number of constraints. If it is 0, the solve is skipped.
KERNEL void paper_count()
{
    real count = total(sum_active);
    bool idle = !(count > 0.0f);
    set_scalar(scalar_rows, count);
    set_scalar(scalar_rows_left, count);
    set_scalar(scalar_idle, real(idle ? 1.0f : 0.0f));
    set_scalar(scalar_linear_done, real(1.0f));
    set_scalar(scalar_iterations, real(0.0f));
    set_scalar(scalar_residual_last, real(0.0f));
}

// The list of active constraints, by an exclusive prefix sum over their marks: first within blocks of 256, then over the
// blocks' totals, level by level until one block is left. The numbers are whole, so the order of addition does not matter.
// Source: Blelloch, "Prefix sums and their applications", 1990.
KERNEL void paper_scan(int block)
{
    int at = rows_scan + 2 * scan_level(), base = topology(at);
    int first = scan_block * block, end = first + scan_block;
    if (end > topology(at + 1)) end = topology(at + 1);
    real sum = real(0.0f);
    for (int k = first; k < end; ++k) {
        real a = scan_level() > 0 ? number(base + k) : magnitude(row_get(row_mark, k));
        set_number(base + k, sum);
        sum = sum + a;
    }
    if (scan_level() + 1 < topology(rows_scan_levels)) set_number(topology(at + 2) + block, sum);
}

KERNEL void paper_list(int s)
{
    if (!(magnitude(row_get(row_mark, s)) > 0.0f)) return;
    real place = real(0.0f);
    int block = s;
    for (int k = 0; k < topology(rows_scan_levels); ++k) {
        place = place + number(topology(rows_scan + 2 * k) + block);
        block = block / scan_block;
    }
    row_set(row_list, whole(place), real(s));
}

// The length that a constraint enforces.
KERNEL real target_length(int s)
{
    real rest = row_get(row_rest, s);
    if (topology(rows_unilateral) == 0) return rest;
    return rest * (1.0f + paper_value(paper_activate) * row_get(row_mark, s));
}

// The inverse mass that two springs share, with the sign of their product in J M^-1 J^T.
KERNEL real shared_inverse_mass(int s, int t)
{
    int si = spring_end(s, 0), sj = spring_end(s, 1), ti = spring_end(t, 0), tj = spring_end(t, 1);
    real c = real(0.0f);
    if (si == ti) c = c + load(paper_inverse_mass, si);
    if (sj == tj) c = c + load(paper_inverse_mass, sj);
    if (si == tj) c = c - load(paper_inverse_mass, si);
    if (sj == ti) c = c - load(paper_inverse_mass, sj);
    return c;
}

// A row of J M^-1 J^T (the paper's SpMM, over the possible couplings), the right-hand side of eq. (11), and the start of
// conjugate gradients at lambda = 0 (eq. 12). A compliance a of the length, l' - L = a T with the tension T = 2 l lambda, is
// a compliance (2 l)^2 a of C, as C' = 2 l (l' - L) to first order.
KERNEL void paper_system(int k)
{
    int s = active_row(k);
    vec3 d = row_get3(row_jacobian, s);
    real length2 = dot3(d, d), target = target_length(s);
    real compliance = paper_value(paper_compliance) * inverse_step() * inverse_step();
    int first = topology(topology(rows_matrix_start) + s), end = topology(topology(rows_matrix_start) + s + 1);
    for (int e = first; e < end; ++e) {
        int t = topology(topology(rows_columns) + e);
        real c = shared_inverse_mass(s, t);
        if (t == s) c = c + compliance;
        set_number(topology(rows_matrix) + e, 4.0f * c * dot3(d, row_get3(row_jacobian, t)));
    }
    vec3 approach = load3(paper_free_velocity, spring_end(s, 0)) - load3(paper_free_velocity, spring_end(s, 1));
    real b = ((length2 - target * target) * inverse_step() + 2.0f * dot3(d, approach)) * inverse_step();
    row_set(row_residual, s, b);
    row_set(row_direction, s, b);
    row_set(row_lambda, s, real(0.0f));
    row_set(row_best, s, real(0.0f));
    sums[0] = sums[0] + b * b;
}

// lambda = 0, with the residual b, is the first candidate for the best multipliers.
//
// A unilateral constraint must not push. Removing those that push from the final solution would leave the forces that other
// constraints exert against them, which are unbounded where the matrix is nearly singular. So they are dropped during the
// iteration, and conjugate gradients continue with the others. The step that drops them has the direction p = -lambda at
// their rows, and length 1.
KERNEL void paper_start()
{
    real b2 = total(sum_linear_residual2), tolerance = paper_value(paper_tolerance);
    bool fine = b2 > 0.0f && is_finite(b2);
    set_scalar(scalar_right_side, b2);
    set_scalar(scalar_rho, b2);
    set_scalar(scalar_best, b2);
    set_scalar(scalar_better, real(1.0f));
    set_scalar(scalar_goal, b2 * tolerance * tolerance);
    set_scalar(scalar_dropping, real(0.0f));
    set_scalar(scalar_linear_done, real(fine ? 0.0f : 1.0f));
}

// A p (the paper's SpMV, by rows) and p . A p
KERNEL void paper_apply(int k)
{
    int s = active_row(k);
    int first = topology(topology(rows_matrix_start) + s), end = topology(topology(rows_matrix_start) + s + 1);
    real ap = real(0.0f);
    for (int e = first; e < end; ++e)
        ap = ap + number(topology(rows_matrix) + e) * row_get(row_direction, topology(topology(rows_columns) + e));
    row_set(row_applied, s, ap);
    sums[0] = sums[0] + row_get(row_direction, s) * ap;
}

// Eq. (13). J M^-1 J^T is singular if constraints depend on each other; a direction without curvature ends the iteration.
KERNEL void paper_alpha()
{
    real curvature = total(sum_curvature);
    real alpha = scalar(scalar_rho) * reciprocal(curvature);
    bool fine = curvature > 0.0f && is_finite(curvature) && is_finite(alpha);
    if (scalar(scalar_dropping) > 0.0f) {
        fine = true;
        alpha = real(1.0f);
    }
    set_scalar(scalar_alpha, fine ? alpha : real(0.0f));
    if (!fine) set_scalar(scalar_linear_done, real(1.0f));
    set_scalar(scalar_iterations, scalar(scalar_iterations) + real(1.0f));
}

// Eq. (14) and (15). The error of a dropped constraint is not part of the residual.
KERNEL void paper_update(int k)
{
    int s = active_row(k);
    real alpha = scalar(scalar_alpha);
    real mark = row_get(row_mark, s), lambda = row_get(row_lambda, s) + alpha * row_get(row_direction, s);
    bool dropped = !(magnitude(mark) > 0.0f);
    real r = dropped ? real(0.0f) : row_get(row_residual, s) - alpha * row_get(row_applied, s);
    row_set(row_lambda, s, lambda);
    row_set(row_residual, s, r);
    sums[0] = sums[0] + r * r;
    sums[1] = sums[1] + (lambda * mark < 0.0f ? real(1.0f) : real(0.0f));
}

// Eq. (16). On a singular system the residual stops falling and may grow: the best multipliers are kept.
KERNEL void paper_check()
{
    real r2 = total(sum_linear_residual2), before = scalar(scalar_rho), best = scalar(scalar_best);
    bool dropping = scalar(scalar_dropping) > 0.0f;  // after dropping, conjugate gradients start again
    bool fine = is_finite(r2), better = fine && (r2 < best || dropping);
    set_scalar(scalar_rho, r2);
    set_scalar(scalar_beta, fine && !dropping ? r2 * reciprocal(before) : real(0.0f));
    set_scalar(scalar_better, real(better ? 1.0f : 0.0f));
    if (better) set_scalar(scalar_best, r2);
    bool solved_here = !(r2 > scalar(scalar_goal)), drop = solved_here && total(sum_pushing) > 0.0f;
    drop = drop && topology(rows_unilateral) != 0;
    if (drop) set_scalar(scalar_rows_left, scalar(scalar_rows_left) - total(sum_pushing));
    set_scalar(scalar_dropping, real(drop ? 1.0f : 0.0f));
    if (!fine || (solved_here && !drop)) set_scalar(scalar_linear_done, real(1.0f));
}

// Eq. (17), or the step that drops constraints which push.
KERNEL void paper_direction(int k)
{
    int s = active_row(k);
    if (scalar(scalar_better) > 0.0f) row_set(row_best, s, row_get(row_lambda, s));
    real p = row_get(row_residual, s) + scalar(scalar_beta) * row_get(row_direction, s);
    if (scalar(scalar_dropping) > 0.0f) {
        real lambda = row_get(row_lambda, s);
        bool pushes = lambda * row_get(row_mark, s) < 0.0f;
        if (pushes) row_set(row_mark, s, real(0.0f));
        p = pushes ? real(0.0f) - lambda : real(0.0f);
    }
    row_set(row_direction, s, p);
}

// The final multipliers. If the iterations did not suffice, a unilateral constraint may push in this step.
KERNEL void paper_multipliers(int k)
{
    int s = active_row(k);
    if (!(scalar(scalar_better) > 0.0f)) row_set(row_lambda, s, row_get(row_best, s));
}

// Eq. (6) to (8): the constraints' forces J^T lambda (the paper's SpMVT, by columns), and the step. Contact follows
// separately, as in the other explicit methods.
KERNEL void paper_step(int o, int node)
{
    vec3 force = load3(paper_force, o), v = load3(paper_velocity, o);
    real w = load(paper_inverse_mass, o), largest_force = real(0.0f);
    if (!(scalar(scalar_idle) > 0.0f)) {
        int first = topology(topology(rows_node_start) + node), end = topology(topology(rows_node_start) + node + 1);
        for (int e = first; e < end; ++e) {
            int entry = topology(topology(rows_node_entries) + e), s = entry / 2;
            if (s >= topology(rows_constraints) || !(magnitude(row_get(row_mark, s)) > 0.0f)) continue;
            vec3 tension = row_get3(row_jacobian, s) * (2.0f * row_get(row_lambda, s));
            force = entry % 2 == 0 ? force - tension : force + tension;
            real length2 = dot3(tension, tension);
            largest_force = largest(length2 * inverse_sqrt(length2), largest_force);
        }
    }
    store(paper_multiplier, o, largest_force);
    Motion now, next;
    now.position = load3(paper_start_position, o);
    now.velocity = v;
    next.velocity = choose(w > 0.0f, velocity_step(v, force, w, gravity(), decay(), step_length()), v);
    next.position = choose(w > 0.0f, position_step(now.position, next.velocity, step_length()), node_next_position(o));
    for (int k = 0; k < collider_count(); ++k)
        next = contact_step(now, next, collider(k), thickness(), w, step_length());
    node_end(o, next.position, next.velocity);
}

KERNEL void paper_end()
{
    real iterations = scalar(scalar_iterations), count = scalar(scalar_rows_left), residual = real(0.0f);
    if (scalar(scalar_rows) > 0.0f) {
        real load = scalar(scalar_right_side), left = load > 0.0f ? scalar(scalar_best) * reciprocal(load) : real(0.0f);
        residual = left <= 0.0f ? real(0.0f) : left * inverse_sqrt(left);
    }
    set_scalar(scalar_solves, scalar(scalar_solves) + real(1.0f));
    set_scalar(scalar_iterations_sum, scalar(scalar_iterations_sum) + iterations);
    set_scalar(scalar_iterations_max, largest(scalar(scalar_iterations_max), iterations));
    set_scalar(scalar_iterations_last, iterations);
    set_scalar(scalar_residual_last, residual);
    set_scalar(scalar_residual_max, larger(scalar(scalar_residual_max), residual));
    set_scalar(scalar_active_sum, scalar(scalar_active_sum) + count);
    set_scalar(scalar_active_max, largest(scalar(scalar_active_max), count));
    set_scalar(scalar_active_last, count);
}

// The largest force of a constraint at a node, N, for reports.
KERNEL void paper_export(int o)
{
    set_multiplier(o, load(paper_multiplier, o));
}

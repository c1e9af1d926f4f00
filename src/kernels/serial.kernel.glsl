// Passes of one invocation between the passes over nodes. They turn sums into the scalars of Newton's method, the line
// search and conjugate gradients, and count. The loops of solve/newton_multigrid.cpp are unrolled to their maximum length.
// These passes set a flag when a loop ends, and the rest of its passes do nothing. Nothing returns to the host.

KERNEL void solve_reset()
{
    for (int k = scalar_solves; k < scalar_count; ++k) set_scalar(k, real(0.0f));
}

// ACAD: a step without springs beyond the threshold has nothing to solve. Otherwise the correction moves nodes by about as
// much as springs are too long, and may take other springs beyond the threshold. Springs within that reach are marked, too.
KERNEL void acad_check()
{
    set_scalar(scalar_idle, real(total(sum_active) > 0.0f ? 0.0f : 1.0f));
    real excess2 = total(sum_excess);
    set_scalar(scalar_reach, acad_reach() * (excess2 * inverse_sqrt(excess2)));
}

// The energies of this evaluation are the reference of the line search.
KERNEL void accept_energies()
{
    set_scalar(scalar_energy, total(sum_spring_energy) + total(sum_node_energy));
    set_scalar(scalar_contact_energy, total(sum_contact_energy));
}

KERNEL void solve_begin()
{
    bool idle = scalar(scalar_idle) > 0.0f;
    set_scalar(scalar_newton_done, real(idle ? 1.0f : 0.0f));
    set_scalar(scalar_linear_done, real(1.0f));
    set_scalar(scalar_search_done, real(1.0f));
    set_scalar(scalar_newton, real(0.0f));
    set_scalar(scalar_iterations, real(0.0f));
    set_scalar(scalar_residual_last, real(0.0f));
    if (idle) return;
    // In free flight the load is 0, and no residual could be small relative to that: the load is at least a thousandth of
    // the displacement.
    real least = is_acad() ? real(0.0f) : total(sum_least_load);
    set_scalar(scalar_load, largest(total(sum_load), least));
    accept_energies();
}

KERNEL void linear_start()
{
    real r2 = total(sum_linear_residual2);
    set_scalar(scalar_linear_done, real(r2 > 0.0f ? 0.0f : 1.0f));
    set_scalar(scalar_first_residual2, r2);
    set_scalar(scalar_residual2, r2);
    set_scalar(scalar_rho, real(0.0f));
    set_scalar(scalar_slope, real(0.0f));
}

// beta = (r . z) / (r . z)_before.  r . z is the squared residual in the norm of the energy, J. The iteration ends when it
// is a fraction of the load of the step, so every linear system of a step is solved equally well. (Relative to its own first
// residual, the first systems of a step, dominated by overstretched springs, would be solved too roughly. The norm |r| is
// dominated by stiff springs.)
KERNEL void linear_beta()
{
    real rho = total(sum_rho), before = scalar(scalar_rho);
    set_scalar(scalar_beta, before > 0.0f ? rho * reciprocal(before) : real(0.0f));
    set_scalar(scalar_rho, rho);
    if (!(before > 0.0f)) {
        real load = scalar(scalar_load);
        real scale = load > 0.0f && load < rho ? load : rho;
        set_scalar(scalar_goal, scale * linear_tolerance() * linear_tolerance());
    }
    if (!(rho > 0.0f) || (before > 0.0f && rho <= scalar(scalar_goal))) set_scalar(scalar_linear_done, real(1.0f));
}

// alpha = (r . z) / (p . A p). Rounding may make A indefinite; then the iteration ends with the present solution.
KERNEL void linear_alpha()
{
    real curvature = total(sum_curvature), rho = scalar(scalar_rho);
    bool fine = curvature > 0.0f && is_finite(curvature);
    real alpha = fine ? rho * reciprocal(curvature) : real(0.0f);
    set_scalar(scalar_alpha, alpha);
    set_scalar(scalar_slope, scalar(scalar_slope) + alpha * rho);
    if (!fine) set_scalar(scalar_linear_done, real(1.0f));
    set_scalar(scalar_iterations, scalar(scalar_iterations) + real(1.0f));
}

// alpha (r . z) is the decrease of the squared error. When it is at most the goal, the iteration ends; testing r . z itself
// would cost one more V-cycle.
KERNEL void linear_check()
{
    real r2 = total(sum_linear_residual2);
    set_scalar(scalar_residual2, r2);
    bool small = scalar(scalar_alpha) * scalar(scalar_rho) <= scalar(scalar_goal);
    if (small || !(r2 > 0.0f)) set_scalar(scalar_linear_done, real(1.0f));
}

KERNEL void search_begin()
{
    set_scalar(scalar_linear_done, real(1.0f));
    set_scalar(scalar_search_done, real(0.0f));
    set_scalar(scalar_step, real(1.0f));
}

// Armijo's rule, with a tolerance for rounding of the sums. A refused step is shortened to 1/4, and the factor is then
// squared at each try: the Newton step does not include limits ahead, and a spring about to reach its limit may allow only a
// thousandth of it. The last try is the step zero, and is accepted. Either the total energy or that without contact must
// fall: a node that meets a collider within an iteration does not stop the cloth, since the next iteration corrects it.
KERNEL void search_check()
{
    real energy = total(sum_spring_energy) + total(sum_node_energy);
    real step = scalar(scalar_step), before = scalar(scalar_energy), slope = scalar(scalar_slope);
    real room = real(1e-4f) * (largest(magnitude(before), scalar(scalar_load)));
    real contact = total(sum_contact_energy), least = room - real(1e-4f) * step * slope;
    bool falls = energy <= before + least || energy + contact <= before + scalar(scalar_contact_energy) + least;
    if (falls || step == 0.0f) {
        set_scalar(scalar_search_done, real(1.0f));
        set_scalar(scalar_energy, energy);
        set_scalar(scalar_contact_energy, contact);
    } else {
        real shorter = step < 1.0f ? step * step : real(0.25f);
        set_scalar(scalar_step, step > 1e-3f ? shorter : real(0.0f));
    }
}

// The gain r . A^-1 r of the last Newton step, relative to the load of the step: the squared residual in the norm of the
// energy.
KERNEL void newton_check()
{
    real newton = scalar(scalar_newton) + real(1.0f);
    real load = scalar(scalar_load);
    real left = load > 0.0f ? scalar(scalar_slope) * reciprocal(load) : real(0.0f);
    set_scalar(scalar_newton, newton);
    set_scalar(scalar_residual_last, left <= 0.0f ? real(0.0f) : left * inverse_sqrt(left));
    // after the iterations that usually suffice, only an unsolved step goes on
    real tolerance = newton + 0.5f > enough_iterations() ? real(solved_residual) : newton_tolerance();
    bool solved = scalar(scalar_slope) <= tolerance * tolerance * load;
    bool refused = !(scalar(scalar_step) > 0.0f), done = solved || refused;
    if (refused) set_scalar(scalar_refused, scalar(scalar_refused) + real(1.0f));
    if (done) set_scalar(scalar_newton_done, real(1.0f));
}

// Between the halves of a step's iterations: the normal forces have changed, so the iteration goes on.
KERNEL void contact_check()
{
    if (total(sum_contact_change) > newton_tolerance() * newton_tolerance() * scalar(scalar_load))
        set_scalar(scalar_newton_done, real(0.0f));
}
KERNEL void contact_resume()
{
    accept_energies();
}

KERNEL void solve_end()
{
    if (scalar(scalar_idle) > 0.0f) {
        set_scalar(scalar_solves, scalar(scalar_solves) + real(1.0f));
        set_scalar(scalar_active_last, real(0.0f));
        set_scalar(scalar_newton_last, real(0.0f));
        set_scalar(scalar_iterations_last, real(0.0f));
        return;
    }
    real newton = scalar(scalar_newton), iterations = scalar(scalar_iterations);
    real constraints = total(sum_active), residual = scalar(scalar_residual_last);
    set_scalar(scalar_solves, scalar(scalar_solves) + real(1.0f));
    set_scalar(scalar_newton_sum, scalar(scalar_newton_sum) + newton);
    set_scalar(scalar_newton_max, largest(scalar(scalar_newton_max), newton));
    set_scalar(scalar_iterations_sum, scalar(scalar_iterations_sum) + iterations);
    set_scalar(scalar_iterations_max, largest(scalar(scalar_iterations_max), iterations));
    set_scalar(scalar_residual_max, larger(scalar(scalar_residual_max), residual));
    // Energy balance of the implicit step: springs release S - S', and contact and inertia take the work f . t. A converged
    // step loses only what its length costs. The rest was lost or gained for lack of convergence.
    real springs = total(sum_spring_energy), work = total(sum_lost);
    bool counts = scalar(scalar_started) > 0.0f && !is_acad();
    real lost = counts ? scalar(scalar_spring_energy) - springs + work : real(0.0f);
    set_scalar(scalar_energy_lost, scalar(scalar_energy_lost) + lost);
    set_scalar(scalar_spring_energy, springs + (remembers_any() ? total(sum_renewed) : real(0.0f)));
    set_scalar(scalar_started, real(1.0f));
    set_scalar(scalar_active_sum, scalar(scalar_active_sum) + constraints);
    set_scalar(scalar_active_max, largest(scalar(scalar_active_max), constraints));
    set_scalar(scalar_active_last, constraints);
    set_scalar(scalar_newton_last, newton);
    set_scalar(scalar_iterations_last, iterations);
}

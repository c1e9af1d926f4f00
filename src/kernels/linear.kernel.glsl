// Conjugate gradients on A x = r, and the smoother of its preconditioner: Chebyshev's iteration on D^-1 A as steps
// of damped block Jacobi. Source: Saad, "Iterative Methods for Sparse Linear Systems", 2003, algorithms 9.1 and 12.1.

KERNEL void linear_begin(int o)
{
    vec3 zero = vec3(real(0.0f), real(0.0f), real(0.0f));
    vec3 r = load3(plane_residual, o);
    store3(plane_step, o, zero);
    store3(plane_correction, o, solved(load6(plane_factor, o), r) * relaxation());
    sums[0] = sums[0] + dot3(r, r);
}

KERNEL void linear_direction(int o)
{
    real beta = scalar(scalar_beta);
    vec3 w = load3(plane_correction_2, o);
    store3(plane_direction, o, choose(beta > 0.0f, plus_scaled(w, load3(plane_direction, o), beta), w));
}

KERNEL void linear_update(int o)
{
    real alpha = scalar(scalar_alpha);
    store3(plane_step, o, plus_scaled(load3(plane_step, o), load3(plane_direction, o), alpha));
    vec3 r = plus_scaled(load3(plane_residual, o), load3(plane_applied, o), real(0.0f) - alpha);
    store3(plane_residual, o, r);
    store3(plane_correction, o, solved(load6(plane_factor, o), r) * relaxation());
    sums[0] = sums[0] + dot3(r, r);
}

// Preconditioners for comparison: the diagonal blocks alone, and none.
KERNEL void linear_jacobi(int o)
{
    vec3 r = load3(plane_residual, o);
    vec3 w = solved(load6(plane_factor, o), r);
    store3(plane_correction_2, o, w);
    sums[0] = sums[0] + dot3(r, w);
}
KERNEL void linear_plain(int o)
{
    vec3 r = load3(plane_residual, o);
    store3(plane_correction_2, o, r);
    sums[0] = sums[0] + dot3(r, r);
}

// Stores a product with the operator and its sums; for sheets and meshes.
KERNEL void leave_applied(int o, vec3 ap)
{
    store3(plane_applied, o, ap);
    sums[0] = sums[0] + dot3(load3(plane_direction, o), ap);
}
// source and target: plane_correction or plane_correction_2
KERNEL void leave_smoothed(int o, vec3 product)
{
    vec3 r = load3(plane_residual, o);
    vec3 z = plus_scaled(load3(source_plane(), o), solved(load6(plane_factor, o), r - product), relaxation());
    store3(target_plane(), o, z);
    sums[0] = sums[0] + dot3(r, z);
}
KERNEL void leave_residual(int o, vec3 product)
{
    store3(plane_left, o, load3(plane_residual, o) - product);
}

KERNEL void linear_apply(int o)
{
    leave_applied(o, row_product(plane_direction, o));
}
KERNEL void level_smooth(int o)
{
    leave_smoothed(o, row_product(source_plane(), o));
}
KERNEL void level_residual(int o)
{
    leave_residual(o, row_product(source_plane(), o));
}

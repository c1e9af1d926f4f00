// Springs: eq. (1)-(2) of the cloth paper.

// The force of a spring from the differences of its ends: d = x_j - x_i, v_j - v_i, d . d and 1 / |d|.
LAW vec3 spring_pull(vec3 d, vec3 relative_velocity, real length2, real inverse_length, real rest_length, real stiffness,
                     real damping)
{
    vec3 n = d * inverse_length;
    return n * (stiffness * (length2 * inverse_length - rest_length) + damping * dot3(relative_velocity, n));
}

// Force on node i of the spring to node j, N:
//   f_i = (k (l - l0) + c (v_j - v_i) . n) n,   n = (x_j - x_i) / l,   f_j = -f_i bit for bit.
// Coincident nodes have no direction, so their spring exerts no force.
LAW vec3 spring_force(vec3 xi, vec3 xj, vec3 vi, vec3 vj, real rest_length, real stiffness, real damping)
{
    vec3 d = xj - xi;
    real length2 = dot3(d, d);
    return spring_pull(d, vj - vi, length2, inverse_sqrt(length2), rest_length, stiffness, damping);
}

// The quadratic bending energy as springs of rest length zero (body/bending.hpp), N:  f_i = w (x_j - x_i)
LAW vec3 bending_force(vec3 xi, vec3 xj, real weight)
{
    return (xj - xi) * weight;
}

// w (x_j - x_i)^2 / 2, J. The part of one pair may be negative; their sum is not.
LAW real bending_energy(vec3 xi, vec3 xj, real weight)
{
    vec3 d = xj - xi;
    return 0.5f * weight * dot3(d, d);
}

// (l - l0) / l0
LAW real spring_stretch(vec3 xi, vec3 xj, real rest_length)
{
    vec3 d = xj - xi;
    real length2 = dot3(d, d);
    return length2 * inverse_sqrt(length2) * inverse_sqrt(rest_length * rest_length) - 1.0f;
}

// k (l - l0)^2 / 2, J
LAW real spring_energy(vec3 xi, vec3 xj, real rest_length, real stiffness)
{
    vec3 d = xj - xi;
    real length2 = dot3(d, d);
    real extension = length2 * inverse_sqrt(length2) - rest_length;
    return 0.5f * stiffness * extension * extension;
}

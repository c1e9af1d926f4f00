// One implicit step of a cloth as a minimisation, node by node: what the springs' own kernels (sheet.kernel.glsl,
// mesh.kernel.glsl) leave over.
//
//   E(t) = 1/2 |t - y|^2_{M / dt^2} + sum of the springs' energies + contact + friction
//
// over the displacement t of the step. The unknown is the displacement and not the position, because float then
// resolves it to a part of itself and not of the distance to the origin. Newton's method starts at the displacement
// dt v, not at 0 and not at y: from there slack springs are found slack (docs/physics.md, "Constraints").

// A spring between two nodes in a step: the force on the first, N, and what the operator and the energy take from it.
struct SpringShare
{
    vec3 force;
    Symmetric block;
    real energy, multiplier;
};

// start: x_j - x_i when the step began; moved: t_j - t_i; scale: 1, or 0 where there is no such spring
KERNEL SpringShare spring_share(LimitCurve curve, vec3 start, vec3 moved, real rest_length, real scale)
{
    vec3 d = start + moved;
    real length2 = dot3(d, d);
    real inverse_length = inverse_sqrt(length2);
    vec3 n = d * inverse_length;
    SpringState state = spring_state(curve, length2, inverse_length, rest_length);
    SpringShare share;
    share.force = n * (state.force * scale);
    share.block = symmetric_about(n, state.along * scale, state.across * scale);
    share.energy = state.energy * scale;
    share.multiplier = state.multiplier * scale;
    if (has_damping()) {
        vec3 n0 = start * inverse_sqrt(dot3(start, start));
        real along = dot3(d - start, n0), damping = curve.damping * scale;
        share.force = share.force + n0 * (damping * along);
        share.block = plus(share.block, symmetric_about(n0, damping, real(0.0f)));
        share.energy = share.energy + 0.5f * damping * along * along;
    }
    return share;
}

// Contact of a node with the solid parts of the scene. The energy 1/2 k d^2 of the depth d, and friction as in
// Li et al., "Incremental Potential Contact", 2020: the normal force of the last step times the coefficient, growing
// linearly with the tangential displacement up to `slip`, constant beyond.
struct Contact
{
    vec3 force;         // N
    Symmetric stiffness;  // N/m
    real energy;        // J
};

// The first look of a step, at the displacement dt v, takes a node that inertia would carry into a collider for touching
// it already: as stiff as contact, and drawn to the surface. Newton's first step then ends on the surface, and not as deep
// inside as nothing but inertia would go.
KERNEL Contact contact_at(int o, vec3 q, vec3 t)
{
    Contact c;
    c.force = vec3(real(0.0f), real(0.0f), real(0.0f));
    c.stiffness = symmetric_diagonal(real(0.0f));
    c.energy = real(0.0f);
    if (collider_count() == 0) return c;
    for (int k = 0; k < collider_count(); ++k) {
        vec4 contact = collider_gap(collider(k), q + t);
        vec3 n = xyz(contact);
        real depth = largest(thickness() - contact.w, real(0.0f));
        real stiffness = choose(depth > 0.0f, contact_stiffness(), real(0.0f));
        c.force = c.force + n * (stiffness * depth);
        if (is_first_look()) {
            vec4 aimed = collider_gap(collider(k), q + load3(plane_y, o));
            mask meets = both(thickness() > aimed.w, contact.w > thickness());
            stiffness = choose(meets, contact_stiffness(), stiffness);
            c.force = c.force + n * choose(meets, contact_stiffness() * (thickness() - contact.w), real(0.0f));
        }
        c.stiffness = plus(c.stiffness, symmetric_about(n, stiffness, real(0.0f)));
        c.energy = c.energy + 0.5f * contact_stiffness() * depth * depth;
    }
    vec3 n = load3(plane_slide, o);
    real grip = load(plane_grip, o);
    vec3 moved = t - load3(plane_drag, o);
    vec3 sliding = moved - n * dot3(moved, n);
    real length2 = dot3(sliding, sliding);
    real length = length2 * inverse_sqrt(length2);
    real sticking = reciprocal(slip());
    real per_length = choose(length > slip(), reciprocal(largest(length, slip())), sticking);
    c.force = c.force - sliding * (grip * per_length);
    c.stiffness = plus(c.stiffness, symmetric_about(n, real(0.0f), grip * per_length));
    c.energy = c.energy + grip * choose(length > slip(), length - 0.5f * slip(), 0.5f * length2 * sticking);
    return c;
}

// The start of a step. Friction knows the normal force that the last step ended with: where the node was, carried on
// with the surface.
KERNEL void step_begin(int o)
{
    vec3 zero = vec3(real(0.0f), real(0.0f), real(0.0f));
    vec3 q = node_position(o), v = node_velocity(o);
    real w = node_inverse_mass(o);
    mask is_free = w > 0.0f;
    real mass = choose(is_free, node_mass(o) * inverse_step() * inverse_step(), real(0.0f));
    vec3 start = choose(is_free, v * step_length(), node_next_position(o) - q);
    // A hand aims, too, but does not move the start: that its node is ahead of what it hangs on is for Newton's method
    // to find, and not a stretched spring to begin with.
    vec3 pulled = v;
    if (hand_is_near(o))
        pulled = where_held(o, grabbed_velocity(q, v, hand_target(), gravity(), hand_pull(), hand_hold(), step_length()), v);
    vec3 aim = (pulled * decay() + (gravity() + node_force(o) * w) * step_length()) * step_length();
    aim = choose(is_free, aim, start);
    store3(plane_q, o, q);
    store3(plane_t, o, start);
    store3(plane_y, o, aim);
    store(plane_mass, o, mass);
    vec3 ahead = aim - start;
    sums[0] = sums[0] + mass * dot3(ahead, ahead);

    if (collider_count() == 0) return;  // nobody asks for friction
    vec3 normal = zero, drag = zero;
    real deepest = real(0.0f), grip = real(0.0f);
    for (int k = 0; k < collider_count(); ++k) {
        vec3 carried = collider_surface_velocity(collider(k), q) * step_length();
        vec4 contact = collider_gap(collider(k), q + carried);
        real depth = thickness() - contact.w;
        mask deeper = both(depth > deepest, is_free);
        deepest = choose(deeper, depth, deepest);
        normal = choose(deeper, xyz(contact), normal);
        drag = choose(deeper, carried, drag);
        grip = choose(deeper, collider(k).friction * contact_stiffness() * depth, grip);
    }
    store3(plane_slide, o, normal);
    store3(plane_drag, o, drag);
    store(plane_grip, o, grip);
}

// Newton's step, whole, and part of it again when the line search refuses it.
KERNEL void newton_move(int o)
{
    vec3 t = load3(plane_t, o);
    store3(plane_u, o, t);
    store3(plane_t, o, t + load3(plane_x, o));
}
KERNEL void search_move(int o)
{
    store3(plane_t, o, load3(plane_u, o) + load3(plane_x, o) * scalar(scalar_step));
}

// v' = t / dt, x' = q + t. The sum is the work of everything but springs and gravity's share of inertia, for the balance
// of energy in solve_end.
KERNEL void step_end(int o)
{
    vec3 t = load3(plane_t, o);
    node_end(o, load3(plane_q, o) + t, settled_velocity(t * inverse_step()));
    vec3 inertia = (t - load3(plane_y, o)) * load(plane_mass, o);
    sums[0] = sums[0] + dot3(contact_at(o, load3(plane_q, o), t).force - inertia, t);
    sums[1] = sums[1] + load(plane_active, o);
}

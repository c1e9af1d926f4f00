// One implicit step of a cloth as a minimisation: the parts that work on single nodes. Springs are in sheet.kernel.glsl and
// mesh.kernel.glsl.
//
//   E(t) = 1/2 |t - y|^2_{M / dt^2} + sum of the springs' energies + contact + friction
//
// The unknown t is the displacement of the step. Float resolves it relative to its own size; a position would be resolved
// relative to its distance from the origin. Newton's method starts at the displacement dt v, not at 0 or y: from there it
// finds slack springs slack (docs/physics.md, "Constraints").

// A limit with memory, in this step (laws/limit.law.glsl). `stiffness` is 0 if it is new.
KERNEL LimitCurve remembered(LimitCurve curve, real slip, real stiffness, real softest_of_class)
{
    curve.slip = slip;
    curve.beyond = largest(stiffness, softest_of_class);
    curve.compressed = choose(curve.compressed > 0.0f, curve.beyond, real(0.0f));
    return curve;
}

// The memory of such a limit after a step, and the resulting change of its energy, J. softest_bare: N/m, without compliance
struct RenewedLimit
{
    LimitMemory memory;
    real energy;
};
KERNEL RenewedLimit renewed(LimitCurve curve, real length2, real rest_length, int spring_class, real softest_bare)
{
    real inverse_length = inverse_sqrt(length2), extension = length2 * inverse_length - rest_length;
    real slack = curve.limit * rest_length, over = extension - slack, under = real(0.0f) - extension - slack;
    real violation = choose(curve.compressed > 0.0f, largest(over, under), over);
    SpringState state = spring_state(curve, length2, inverse_length, rest_length);
    RenewedLimit limit;
    limit.memory = renewed_limit(state.multiplier, violation * reciprocal(rest_length), curve.beyond, compliance(spring_class),
                                 softest_bare, stiffest_limit());
    curve = remembered(curve, limit.memory.slip, limit.memory.stiffness, limit.memory.stiffness);
    limit.energy = spring_state(curve, length2, inverse_length, rest_length).energy - state.energy;
    return limit;
}

// A second-order step, BDF2. With the previous step, from x_before and v_before to x and v, and s = 2/3 h,
//   x' = q + t,  q = x + (x - x_before) / 3,   M (v' - mean) / s = F,  mean = v + (v - v_before) / 3,   v' = t / s
// is an implicit Euler step of length s from (q, mean), so the rest of the solver is unchanged. A node has no history if the
// previous step had another length, or if the node touched a collider in it. It then makes an Euler step: q = x, mean = v, s
// = h.
// Source: Hairer, Wanner, "Solving Ordinary Differential Equations II", 1996, section V.1.
KERNEL mask knows_before(int o)
{
    real h = step_length();
    return h * 1e-3f > magnitude(load(history_plane() + history_step, o) - h);
}
KERNEL real step_of(int o)
{
    if (!is_second_order()) return step_length();
    return choose(knows_before(o), short_step(), step_length());
}
KERNEL real inverse_step_of(int o)
{
    if (!is_second_order()) return inverse_step();
    return choose(knows_before(o), inverse_short_step(), inverse_step());
}
// Damping of a spring. Its second-order coefficient needs the history of both nodes.
KERNEL LimitCurve damped_between(LimitCurve curve, int i, int j)
{
    if (!is_second_order() || !has_damping()) return curve;
    real first_order = curve.damping - curve.damping * third();
    curve.damping = choose(both(knows_before(i), knows_before(j)), curve.damping, first_order);
    return curve;
}

// A spring between two nodes in a step: the force on the first node, N, and its parts of the operator and the energy.
struct SpringShare
{
    vec3 force;
    Symmetric block;
    real energy, multiplier;
};

// The direction in which a damper acts: that of the spring at the start of the step; at second order, at the inertial
// target.
KERNEL vec3 damper_between(vec3 start, int i, int j)
{
    if (!is_second_order() || !has_damping()) return start;
    return start + (load3(plane_aim, j) - load3(plane_aim, i));
}

// state: of the spring now; start: x_j - x_i at the start of the step; d: x_j - x_i now; damper: see above; scale: 1, or 0
// if the spring does not exist
KERNEL SpringShare share_of(SpringState state, real damping_of_class, vec3 start, vec3 d, vec3 damper, real inverse_length,
                            real scale)
{
    vec3 n = d * inverse_length;
    SpringShare share;
    share.force = n * (state.force * scale);
    share.block = symmetric_about(n, state.along * scale, state.across * scale);
    share.energy = state.energy * scale;
    share.multiplier = state.multiplier * scale;
    if (has_damping()) {
        vec3 n0 = damper * inverse_sqrt(dot3(damper, damper));
        real along = dot3(d - start, n0), damping = damping_of_class * scale;
        share.force = share.force + n0 * (damping * along);
        share.block = plus(share.block, symmetric_about(n0, damping, real(0.0f)));
        share.energy = share.energy + 0.5f * damping * along * along;
    }
    return share;
}

// moved: t_j - t_i
KERNEL SpringShare spring_share(LimitCurve curve, vec3 start, vec3 moved, vec3 damper, real rest_length, real scale)
{
    vec3 d = start + moved;
    real length2 = dot3(d, d);
    real inverse_length = inverse_sqrt(length2);
    return share_of(spring_state(curve, length2, inverse_length, rest_length), curve.damping, start, d, damper, inverse_length,
                    scale);
}

// Contact of a node with colliders, by an augmented Lagrangian like the limits. A node in contact keeps its normal force p
// from step to step; a soft stiffness k corrects it:
//   E = 1/2 k max(0, p / k + depth)^2,   p' = k max(0, p / k + depth)
// A node at rest therefore lies on the surface for any k, and k can be so small that nodes which gain or lose contact do not
// slow Newton's method down. If a node is still too deep, for example under the weight of a whole cloth, k grows.
// Source: Hestenes, "Multiplier and gradient methods", 1969.
// Friction follows Li et al., "Incremental Potential Contact", 2020: the coefficient times a lagged normal force, that of
// the previous step, and from the middle of this step's iterations on that of this step. It grows linearly with the
// tangential displacement up to `slip`, and is constant beyond.
struct Contact
{
    vec3 force;         // N
    Symmetric stiffness;  // N/m
    real energy;        // J
    real press, touched;  // N, of the collider with the largest normal force; its number, from 1 on
    real depth;         // m, in that collider
};

KERNEL real contact_stiffness_of(int o)
{
    if (!contact_is_by_mass()) return contact_stiffness();
    return contact_stiffness() * load(plane_mass, o) * (load(plane_firm, o) + 1.0f);
}

KERNEL mask is_number(real a, int k)
{
    return both(a > real(float(k)) - 0.5f, real(float(k)) + 0.5f > a);
}

// Penetration of a node at the start of a step, beyond the depth that contact leaves, m. Such a node is not put on the
// surface at once: for this step the surface is moved to the node's depth, and step_begin lets the node rise.
KERNEL real sunk_in(int k, int o, vec3 q)
{
    if (collider(k).response != 2) return real(0.0f);
    vec3 carried = collider_surface_velocity(collider(k), q) * step_of(o);
    return sunk_depth(thickness() - collider_gap(collider(k), q + carried).w);
}
KERNEL vec4 gap_in_step(int k, int o, vec3 q, vec3 t)
{
    vec4 contact = collider_gap(collider(k), q + t);
    contact.w = contact.w + sunk_in(k, o, q);
    return contact;
}

KERNEL Contact contact_at(int o, vec3 q, vec3 t)
{
    Contact c;
    c.force = vec3(real(0.0f), real(0.0f), real(0.0f));
    c.stiffness = symmetric_diagonal(real(0.0f));
    c.energy = c.press = c.touched = c.depth = real(0.0f);
    if (collider_count() == 0) return c;
    real k_node = contact_stiffness_of(o), touched = load(plane_touched, o);
    real before = load(plane_press, o) * reciprocal(choose(k_node > 0.0f, k_node, real(1.0f)));
    for (int k = 0; k < collider_count(); ++k) {
        vec4 contact = collider_gap(collider(k), q + t);
        real sunk = sunk_in(k, o, q);
        vec3 n = xyz(contact);
        real inside = thickness() - (contact.w + sunk);
        real depth = largest(inside + choose(is_number(touched, k + 1), before, real(0.0f)), real(0.0f));
        real stiffness = choose(depth > 0.0f, k_node, real(0.0f));
        real press = stiffness * depth;
        mask most = choose(sunk > 0.0f, real(0.0f), press) > c.press;
        c.press = choose(most, press, c.press);
        c.touched = choose(most, real(float(k + 1)), c.touched);
        c.depth = choose(most, inside, c.depth);
        c.force = c.force + n * press;
        c.stiffness = plus(c.stiffness, symmetric_about(n, stiffness, real(0.0f)));
        c.energy = c.energy + 0.5f * press * depth;
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
    // Where inertia drives a node against friction, the tangent has no stiffness along the direction of sliding. Where
    // friction will stop the node, the secant slows it down without overshoot.
    vec3 ahead = load3(plane_aim, o) - load3(plane_drag, o);
    ahead = ahead - n * dot3(ahead, n);
    real inertia = load(plane_mass, o);
    mask slides = both(length > slip(), inertia * inertia * dot3(ahead, ahead) > grip * grip);
    c.stiffness = plus(c.stiffness, symmetric_about(sliding * per_length, choose(slides, real(0.0f) - grip * per_length, real(0.0f)), real(0.0f)));
    c.energy = c.energy + grip * choose(length > slip(), length - 0.5f * slip(), 0.5f * length2 * sticking);
    return c;
}

// The data of friction: the collider with the largest normal force, and that force.
struct Grip
{
    vec3 normal, drag;  // m: displacement of the surface in this step
    real press, grip;   // N
};

KERNEL Grip no_grip()
{
    Grip g;
    g.normal = g.drag = vec3(real(0.0f), real(0.0f), real(0.0f));
    g.press = g.grip = real(0.0f);
    return g;
}
KERNEL Grip with_collider(Grip g, Collider by, vec3 normal, vec3 carried, real press)
{
    mask more = press > g.press;
    g.press = choose(more, press, g.press);
    g.normal = choose(more, normal, g.normal);
    g.drag = choose(more, carried, g.drag);
    g.grip = choose(more, by.friction * press, g.grip);
    return g;
}
KERNEL void leave_grip(int o, Grip g)
{
    mask is_free = load(plane_mass, o) > 0.0f;
    store3(plane_slide, o, g.normal);
    store3(plane_drag, o, g.drag);
    store(plane_grip, o, choose(is_free, g.grip, real(0.0f)));
}

// A node that may touch a collider in this step or the next makes first-order steps: BDF2 would throw a stopped node back at
// half its speed of impact, with the cloth around it.
KERNEL void forget_near_colliders(int o, vec3 x, vec3 v)
{
    int before = history_plane() + history_step;
    real kept = load(before, o);
    for (int k = 0; k < collider_count(); ++k) {
        vec3 way = (v - collider_surface_velocity(collider(k), x)) * step_length();
        real length2 = dot3(way, way), reach = thickness() + 2.0f * (length2 * inverse_sqrt(length2));
        kept = choose(reach > collider_gap(collider(k), x).w, real(0.0f), kept);
    }
    store(before, o, kept);
}

// Wind force of a step, N. First order: its value at the start. Second order: extrapolated to the end from the starts of
// this and the previous step, unless it changes by more than half of itself; then extrapolation would be unstable.
// Source: Ascher, Ruuth, Wetton, "Implicit-explicit methods for time-dependent partial differential equations", 1995.
KERNEL vec3 wind_in_step(int o)
{
    vec3 force = node_force(o);
    if (!is_second_order()) return force;
    vec3 change = force - load3(history_plane() + history_force, o);
    store3(history_plane() + history_force, o, force);
    mask is_smooth = both(knows_before(o), dot3(force, force) > 4.0f * dot3(change, change));
    return force + change * choose(is_smooth, real(1.0f), real(0.0f));
}

// The target of a node inside colliders while it rises (`rising_speed` of laws/contact.law.glsl).
KERNEL vec3 risen(int o, vec3 q, vec3 aim, real step, real inverse_step)
{
    for (int k = 0; k < collider_count(); ++k) {
        vec3 carried = collider_surface_velocity(collider(k), q) * step;
        vec4 contact = collider_gap(collider(k), q + carried);
        real depth = thickness() - contact.w;
        real sunk = sunk_in(k, o, q), speed = dot3(aim - carried, xyz(contact)) * inverse_step;
        real gained = choose(sunk > 0.0f, rising_speed(speed, depth, step) - speed, real(0.0f));
        aim = aim + xyz(contact) * (gained * step);
    }
    return aim;
}

// A lower bound of a node's part of the load, J. Without forces there is no load, and no step can be solved to a fraction of
// nothing. The bound is that of a thousandth of the node's displacement, and of the rounding of its position to 2^-24, which
// six springs resist.
KERNEL real least_load(real mass, vec3 q, vec3 way)
{
    const float thousandth2 = 1e-6f, rounding2 = 3.5527136788005009e-15f;  // the second: 2^-48
    return mass * dot3(way, way) * thousandth2 + dot3(q, q) * (softest_limit() * (6.0f * rounding2));
}

// The start of a step. Friction knows the normal force that the last step ended with; of a node that touches a collider
// without having been found there by a step, what its depth makes of it.
KERNEL void step_begin(int o)
{
    vec3 q = node_position(o), v = node_velocity(o), mean = v;
    if (is_second_order()) {
        forget_near_colliders(o, q, v);
        real part = choose(knows_before(o), third(), real(0.0f));
        q = q + load3(history_plane() + history_way, o) * part;
        mean = v + (v - load3(history_plane() + history_velocity, o)) * part;
    }
    real w = node_inverse_mass(o), step = step_of(o), inverse_step = inverse_step_of(o);
    mask is_free = w > 0.0f;
    real mass = choose(is_free, node_mass(o) * inverse_step * inverse_step, real(0.0f));
    vec3 start = choose(is_free, v * step, node_next_position(o) - q);
    // A hand changes the target but not the start: otherwise the node's springs would be stretched before Newton's method
    // begins.
    vec3 pulled = mean;
    if (hand_is_near(o))
        pulled = where_held(o, grabbed_velocity(q, mean, hand_target(), gravity(), hand_pull(), hand_hold(), step), mean);
    vec3 push = (gravity() + wind_in_step(o) * w) * step, aim = (pulled * decay() + push) * step;
    if (is_second_order()) {  // drag acts on the velocity at the end, so it adds to inertia
        real weight = air() * step + 1.0f;
        aim = (pulled + push) * (step * reciprocal(weight));
        mass = mass * weight;
    }
    if (collider_count() > 0) aim = risen(o, q, aim, step, inverse_step);
    aim = choose(is_free, aim, start);
    store3(plane_start, o, q);
    store3(plane_way, o, start);
    store3(plane_aim, o, aim);
    store(plane_mass, o, mass);
    vec3 ahead = aim - start;
    sums[0] = sums[0] + mass * dot3(ahead, ahead);
    sums[1] = sums[1] + least_load(mass, q, start);

    if (collider_count() == 0) return;  // without colliders friction is not read
    Grip g = no_grip();
    real touched = load(plane_touched, o), press = load(plane_press, o), k_node = contact_stiffness_of(o);
    for (int k = 0; k < collider_count(); ++k) {
        vec3 carried = collider_surface_velocity(collider(k), q) * step;
        vec4 contact = collider_gap(collider(k), q + carried);
        real found = k_node * largest(thickness() - contact.w, real(0.0f));
        found = choose(touched > 0.0f, choose(is_number(touched, k + 1), press, real(0.0f)), found);
        found = choose(sunk_in(k, o, q) > 0.0f, real(0.0f), found);
        g = with_collider(g, collider(k), xyz(contact), carried, found);
    }
    leave_grip(o, g);
}

// The second half of a step's iterations uses the normal forces that the first half found. The node then lies on the
// surface, not a hundredth of its displacement below it, and friction is that of this step. The sum, J, measures the change
// of normal forces by the displacement that it would give the nodes' masses.
KERNEL void contact_change(int o)
{
    Contact contact = contact_at(o, load3(plane_start, o), load3(plane_way, o));
    real mass = load(plane_mass, o), change = contact.press - load(plane_press, o);
    real moved = change * reciprocal(choose(mass > 0.0f, mass, real(1.0f)));
    sums[0] = sums[0] + mass * moved * moved;
}

// How much stiffer the contact of a node becomes: more at a depth above 0.1 mm, gradually less below it.
KERNEL real firm_for(real firm, real depth)
{
    real target = real(1e-4f), most = real(100.0f);
    real grown = (firm + 1.0f) * largest(depth * real(1e4f), real(1.0f));
    return choose(depth > target, choose(grown > most, most, grown) - 1.0f, firm);
}
KERNEL void contact_keep(int o)
{
    vec3 q = load3(plane_start, o), t = load3(plane_way, o);
    Contact contact = contact_at(o, q, t);
    Grip g = no_grip();
    for (int k = 0; k < collider_count(); ++k)
        g = with_collider(g, collider(k), xyz(collider_gap(collider(k), q + t)),
                          collider_surface_velocity(collider(k), q) * step_of(o),
                          choose(is_number(contact.touched, k + 1), contact.press, real(0.0f)));
    store(plane_press, o, contact.press);
    store(plane_touched, o, contact.touched);
    store(plane_firm, o, firm_for(load(plane_firm, o), contact.depth));
    leave_grip(o, g);
}

// A Newton step x of a node without contact does not include colliders ahead, so the next iteration would push the node out
// again; on a table hundreds of nodes would alternate without end. The step therefore ends where the collider carries the
// node: at the depth whose force equals that of the previous step, or the node's own inertia and weight.
// Source: projected Newton methods; Bertsekas, 1982.
KERNEL vec3 stopped_by_colliders(int o, vec3 t, vec3 x)
{
    vec3 q = load3(plane_start, o), ahead = load3(plane_aim, o) - t;
    real mass = load(plane_mass, o), touched = load(plane_touched, o), k_node = contact_stiffness_of(o);
    real give = reciprocal(choose(k_node > 0.0f, k_node, real(1.0f)));
    for (int k = 0; k < collider_count(); ++k) {
        real slip = choose(is_number(touched, k + 1), load(plane_press, o) * give, real(0.0f));
        vec4 before = gap_in_step(k, o, q, t), after = gap_in_step(k, o, q, t + x);
        mask touches = thickness() - before.w + slip > 0.0f;
        real carried = largest(largest(slip, dot3(xyz(after), ahead) * (real(0.0f) - mass * give)), real(0.0f));
        real excess = largest(thickness() - after.w + slip - carried, real(0.0f));
        x = x + xyz(after) * choose(touches, real(0.0f), excess);
    }
    return x;
}

// The full Newton step, and a shorter one each time the line search refuses it.
KERNEL void newton_move(int o)
{
    vec3 t = load3(plane_way, o), x = load3(plane_step, o);
    if (collider_count() > 0) {
        x = choose(load(plane_mass, o) > 0.0f, stopped_by_colliders(o, t, x), x);
        store3(plane_step, o, x);
    }
    store3(plane_accepted, o, t);
    store3(plane_way, o, t + x);
}
// Reduces local errors at the end of a step: one damped step of block Jacobi, from the residual of the last evaluation. It
// removes peaks of strain at single springs. If all springs of a node lie in one plane, as at the border of a mesh, only the
// node's inertia resists a step across that plane until the springs are stretched by some per cent. The step is therefore
// limited to polish_reach() in the softest direction, which a second D^-1 finds.
KERNEL void newton_polish(int o)
{
    Symmetric factor = load6(plane_factor, o);
    vec3 x = solved(factor, load3(plane_residual, o)) * real(0.7f);
    vec3 softest = solved(factor, x);
    softest = softest * inverse_sqrt(dot3(softest, softest));
    real way = dot3(softest, x), reach = polish_reach();
    real kept = choose(way > reach, reach, largest(way, real(0.0f) - reach));
    store3(plane_way, o, load3(plane_way, o) + (x + softest * (kept - way)));
}
KERNEL void search_move(int o)
{
    store3(plane_way, o, load3(plane_accepted, o) + load3(plane_step, o) * scalar(scalar_step));
}

// v' = t / dt, x' = q + t. A node in contact gets the velocity of its displacement in this step: by BDF2 a stopped node
// would be thrown back at half its speed of impact. The sum is the work of everything but springs and gravity's part of
// inertia, for the energy balance in solve_end.
KERNEL void step_end(int o)
{
    vec3 t = load3(plane_way, o);
    vec3 v = t * inverse_step_of(o), way = t;
    vec3 inertia = (t - load3(plane_aim, o)) * load(plane_mass, o);
    Contact contact = contact_at(o, load3(plane_start, o), t);
    store(plane_press, o, contact.press);
    store(plane_touched, o, contact.touched);
    store(plane_firm, o, firm_for(load(plane_firm, o) * 0.5f, contact.depth));
    if (is_second_order()) {
        way = t + (load3(plane_start, o) - node_position(o));
        mask touches = contact.press > 0.0f;
        v = choose(touches, way * inverse_step(), v);
        store3(history_plane() + history_way, o, way);
        store3(history_plane() + history_velocity, o, node_velocity(o));
        store(history_plane() + history_step, o, choose(touches, real(0.0f), step_length()));
    }
    node_end(o, load3(plane_start, o) + t, settled_velocity(v));
    sums[0] = sums[0] + dot3(contact.force - inertia, way);
    sums[1] = sums[1] + load(plane_active, o);
}

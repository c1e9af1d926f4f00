// Contact with solid shapes. A gap is the signed distance to the surface in m, negative inside; laws that return
// vec4 return (unit normal outwards, gap).

// A collider at one time. `kind` and `response` are the same for all nodes.
struct Collider
{
    int kind;           // 0 sphere, 1 plane, 2 box, 3 capsule, 4 tapered capsule: the order of the variant Collider (scene.hpp)
    int response;       // 0 Coulomb, 1 as the paper prints it, 2 Coulomb, and nodes inside it rise
    vec3 centre;        // m; a point of a plane
    vec3 axis_x;        // unit vectors of a box; axis_y is a plane's normal and a capsule's direction
    vec3 axis_y;
    vec3 axis_z;
    vec3 half_size;     // m; of a capsule, y is half the distance between its ends; x, z: see gap_tapered_capsule
    real radius;        // m; of a tapered capsule, in the middle
    real friction;      // Coulomb's mu
    vec3 velocity;      // m/s
    vec3 spin;          // rad/s
};

// gap = |p - c| - r
LAW vec4 gap_sphere(vec3 p, vec3 centre, real radius)
{
    vec3 d = p - centre;
    real length2 = dot3(d, d);
    real inverse_length = inverse_sqrt(length2);
    vec3 n = choose(length2 > 0.0f, d * inverse_length, vec3(0.0f, 1.0f, 0.0f));  // at the centre any direction is valid
    return vec4(n, length2 * inverse_length - radius);
}

// gap = (p - q) . n
LAW vec4 gap_plane(vec3 p, vec3 point, vec3 normal)
{
    return vec4(normal, dot3(p - point, normal));
}

// A sphere around the nearest point of the segment centre +- half_length direction.
LAW vec4 gap_capsule(vec3 p, vec3 centre, vec3 axis_direction, real half_length, real radius)
{
    real along = dot3(p - centre, axis_direction);
    along = choose(along > half_length, half_length, choose(along < -half_length, -half_length, along));
    return gap_sphere(p, centre + axis_direction * along, radius);
}

// The hull of two spheres is the union of spheres along the segment: centre c + t a, radius r + s t. The gap to it,
//   f(t) = sqrt((t - u)^2 + w^2) - r - s t,    u = (p - c) . a,  w = |p - c - u a|,
// is convex, with its minimum at t = u + s w / sqrt(1 - s^2), or at the nearest end. `growth` is s, `lean` is s / sqrt(1 - s^2).
LAW vec4 gap_tapered_capsule(vec3 p, vec3 centre, vec3 axis_direction, real half_length, real radius, real growth, real lean)
{
    vec3 d = p - centre;
    real along = dot3(d, axis_direction);
    vec3 across = d - axis_direction * along;
    real across2 = dot3(across, across);
    real t = along + lean * (across2 * inverse_sqrt(across2));
    t = choose(t > half_length, half_length, choose(t < -half_length, -half_length, t));
    vec3 nearest = centre + axis_direction * t;
    real radius_there = radius + growth * t;
    return gap_sphere(p, nearest, radius_there);
}

// Outside: the distance to the nearest point of the box. Inside: the way out through the nearest face.
LAW vec4 gap_box(vec3 p, vec3 centre, vec3 axis_x, vec3 axis_y, vec3 axis_z, vec3 half_size)
{
    vec3 d = p - centre;
    vec3 q = vec3(dot3(d, axis_x), dot3(d, axis_y), dot3(d, axis_z));
    vec3 side = vec3(choose(q.x < 0.0f, real(-1.0f), real(1.0f)), choose(q.y < 0.0f, real(-1.0f), real(1.0f)),
                     choose(q.z < 0.0f, real(-1.0f), real(1.0f)));
    vec3 beyond = vec3(magnitude(q.x), magnitude(q.y), magnitude(q.z)) - half_size;  // by axis; negative inside

    vec3 out_of = vec3(largest(beyond.x, real(0.0f)), largest(beyond.y, real(0.0f)), largest(beyond.z, real(0.0f)));
    real length2 = dot3(out_of, out_of);
    real inverse_length = inverse_sqrt(length2);
    vec3 n_out = out_of * inverse_length;

    mask x_nearest = both(beyond.x >= beyond.y, beyond.x >= beyond.z);
    mask y_nearest = beyond.y >= beyond.z;
    vec3 n_in = choose(x_nearest, vec3(1.0f, 0.0f, 0.0f),
                       choose(y_nearest, vec3(0.0f, 1.0f, 0.0f), vec3(0.0f, 0.0f, 1.0f)));
    real gap_in = largest(beyond.x, largest(beyond.y, beyond.z));

    mask outside = length2 > 0.0f;
    vec3 n = choose(outside, n_out, n_in);
    vec3 normal = axis_x * (n.x * side.x) + axis_y * (n.y * side.y) + axis_z * (n.z * side.z);
    return vec4(normal, choose(outside, length2 * inverse_length, gap_in));
}

LAW vec4 collider_gap(Collider collider, vec3 p)
{
    if (collider.kind == 0) return gap_sphere(p, collider.centre, collider.radius);
    if (collider.kind == 1) return gap_plane(p, collider.centre, collider.axis_y);
    if (collider.kind == 2)
        return gap_box(p, collider.centre, collider.axis_x, collider.axis_y, collider.axis_z, collider.half_size);
    if (collider.kind == 3) return gap_capsule(p, collider.centre, collider.axis_y, collider.half_size.y, collider.radius);
    return gap_tapered_capsule(p, collider.centre, collider.axis_y, collider.half_size.y, collider.radius,
                               collider.half_size.z, collider.half_size.x);
}

// v_s = v_c + w x (p - c)
LAW vec3 collider_surface_velocity(Collider collider, vec3 p)
{
    return collider.velocity + cross3(collider.spin, p - collider.centre);
}

// Coulomb friction. Relative to the surface: removes the approaching normal velocity, reduces the tangential one by at most
// mu times as much, keeps the rest:
//   r = v - v_s,  r_n = r . n,  r_t = r - r_n n,  v' = v_s + max(r_n, 0) n + max(1 - mu max(-r_n, 0) / |r_t|, 0) r_t
LAW vec3 contact_velocity(vec3 velocity, vec3 surface_velocity, vec3 n, real friction)
{
    vec3 r = velocity - surface_velocity;
    real normal_part = dot3(r, n);
    vec3 tangential = r - n * normal_part;
    real approach = largest(-normal_part, real(0.0f));
    real kept = largest(1.0f - friction * approach * inverse_sqrt(dot3(tangential, tangential)), real(0.0f));
    return surface_velocity + tangential * kept + n * largest(normal_part, real(0.0f));
}

// The predicted position p' = x + dt v, projected onto the surface. Along the surface it moves with the new velocity, so
// that a sticking node does not creep:  p = p' - gap n + dt (I - n n^T) (v' - v)
LAW vec3 contact_position(vec3 predicted, vec3 n, real gap, vec3 velocity, vec3 next_velocity, real dt)
{
    vec3 change = next_velocity - velocity;
    vec3 tangential = change - n * dot3(change, n);
    return predicted - n * gap + tangential * dt;
}

// Algorithm 4 of the cloth paper as printed:  v' = d / |d| + v / |v|,  with d = p_0 - O outwards. It does not have the unit
// of a velocity. v = 0, which divides by zero as printed, adds nothing here.
LAW vec3 contact_velocity_paper(vec3 velocity, vec3 n)
{
    return n + direction(velocity);
}

// p_1 = O + d / |d| (r + offset), for any shape: moved out along the normal at the position before the step.
LAW vec3 contact_position_paper(vec3 before, vec3 n_before, real gap_before)
{
    return before - n_before * gap_before;
}

// Excess of a depth, m, over the depth that contact leaves. A collider whose nodes are deeper, from the start or after a
// jump, has the response 2 until they are out.
LAW real sunk_depth(real depth)
{
    return largest(depth - 0.0009765625f, real(0.0f));
}

// The outward speed, m/s, of such a node after a step of dt, from its speed without contact. Its acceleration is at most
// 1000 m/s2, and its speed at most 8/s of its depth and 1 m/s, so that it reaches the surface without speed; stronger
// springs keep it inside:
//   r' = max(r, min(r + 1000 dt, 8 depth, 1))
// A projection onto the surface in one step would stretch the springs around the node many times over, and throw the cloth
// away.
LAW real rising_speed(real speed, real depth, real dt)
{
    real wanted = 8.0f * depth, faster = speed + 1000.0f * dt;
    wanted = choose(wanted > 1.0f, real(1.0f), wanted);
    return largest(speed, choose(faster > wanted, wanted, faster));
}

struct Motion
{
    vec3 position;  // m
    vec3 velocity;  // m/s
};

// Contact with one collider in a step: `now` is the node before the step, `next` the integrator's result. The node keeps the
// distance `thickness` from the surface; a pin (inverse mass 0) is not moved.
LAW Motion contact_step(Motion now, Motion next, Collider collider, real thickness, real inverse_mass, real dt)
{
    vec4 contact = collider_gap(collider, next.position);
    vec3 n = xyz(contact);
    real gap = contact.w - thickness;
    mask touching = both(gap < 0.0f, inverse_mass > 0.0f);
    if (!any_lane(touching)) return next;

    Motion after;
    if (collider.response == 1) {
        vec4 before = collider_gap(collider, now.position);
        after.position = contact_position_paper(now.position, xyz(before), before.w - thickness);
        after.velocity = contact_velocity_paper(next.velocity, xyz(before));
    } else {
        vec3 surface_velocity = collider_surface_velocity(collider, next.position);
        after.velocity = contact_velocity(next.velocity, surface_velocity, n, collider.friction);
        after.position = contact_position(next.position, n, gap, next.velocity, after.velocity, dt);
        if (collider.response == 2) {
            vec3 carried = now.position + surface_velocity * dt;
            real before = thickness - collider_gap(collider, carried).w;
            mask sunk = sunk_depth(before) > 0.0f;
            real speed = dot3(next.velocity - surface_velocity, n), risen = rising_speed(speed, real(0.0f) - gap, dt);
            vec3 rising = after.velocity + n * (largest(risen, real(0.0f)) - largest(speed, real(0.0f)));
            vec3 let_out = next.position + (rising - next.velocity) * dt;
            after.velocity = choose(sunk, rising, after.velocity);
            after.position = choose(sunk, let_out, after.position);
        }
    }
    next.position = choose(touching, after.position, next.position);
    next.velocity = choose(touching, settled_velocity(after.velocity), next.velocity);
    return next;
}

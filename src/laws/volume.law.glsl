// The volume of a closed triangle mesh, its gradient, and the multiplier of the volume constraint: eq. (7)-(15) of the
// volume paper, with the gradient corrected (docs/physics.md, "Volume").
//
// Laws use six times the volume, 6 V = sum a . (b x c) over the triangles, so that no factor is rounded.

// --- The gradient, gathered around a node -----------------------------------------------------------------------------
//
// 6 dV/dx = sum over the ring of (b - x) x (c - x). For a closed ring that equals the sum of b x c about any point. About
// the node itself nothing cancels, however far the body is from the origin.
LAW vec3 ring_add(vec3 gradient, vec3 to_neighbour, vec3 to_next)
{
    return gradient + cross3(to_neighbour, to_next);
}

// A force plus one that turns about an axis: f = F + tau x p
LAW vec3 region_force(vec3 force, vec3 torque, vec3 position)
{
    return force + cross3(torque, position);
}

// --- Blocked directions ------------------------------------------------------------------------------------------------

// The obstacles of a node in a step: none (`count` 0), one collider (1, and its normal), or several (2): then the node
// counts as blocked in all directions.
struct Blocked
{
    vec3 normal;
    real count;
};

LAW Blocked blocked_by_nothing()
{
    Blocked blocked;
    blocked.normal = vec3(real(0.0f), real(0.0f), real(0.0f));
    blocked.count = real(0.0f);
    return blocked;
}

// Adds one more collider. `position` is the predicted one, as in `contact_step`. A node that rises out of a collider is not
// blocked: its speed along the normal changes the volume.
LAW Blocked blocked_with(Blocked blocked, Collider collider, vec3 position, real thickness, real inverse_mass)
{
    vec4 contact = collider_gap(collider, position);
    mask touching = both(contact.w - thickness < 0.0f, inverse_mass > 0.0f);
    if (collider.response == 2) touching = both(touching, real(0.0f) >= sunk_depth(thickness - contact.w));
    blocked.normal = choose(touching, xyz(contact), blocked.normal);
    blocked.count = blocked.count + choose(touching, real(1.0f), real(0.0f));
    return blocked;
}

// The part of a across the normal: (I - n n^T) a
LAW vec3 free_part(vec3 a, Blocked blocked)
{
    vec3 along_surface = a - blocked.normal * dot3(a, blocked.normal);
    return choose(blocked.count > 1.5f, vec3(real(0.0f), real(0.0f), real(0.0f)), along_surface);
}

// --- Both sides of eq. (14) -------------------------------------------------------------------------------------------

// With G = 6 dV/dx, w the inverse mass, omega the weight of a node and P its free directions:
struct VolumeRate
{
    real rate;      // sum G . P v, where v follows from forces alone, m3/s
    real mobility;  // sum G . P omega w G
    vec3 pushed;    // sum P omega w G
    vec3 thrust;    // sum omega G
};

LAW VolumeRate volume_rate_of_nothing()
{
    VolumeRate a;
    a.rate = real(0.0f);
    a.mobility = real(0.0f);
    a.pushed = vec3(real(0.0f), real(0.0f), real(0.0f));
    a.thrust = vec3(real(0.0f), real(0.0f), real(0.0f));
    return a;
}

LAW VolumeRate volume_rate_merge(VolumeRate a, VolumeRate b)
{
    VolumeRate m;
    m.rate = a.rate + b.rate;
    m.mobility = a.mobility + b.mobility;
    m.pushed = a.pushed + b.pushed;
    m.thrust = a.thrust + b.thrust;
    return m;
}

LAW VolumeRate volume_rate_of(vec3 gradient, vec3 velocity, real inverse_mass, real weight, Blocked blocked)
{
    vec3 free_gradient = free_part(gradient, blocked);
    VolumeRate a;
    a.rate = dot3(free_gradient, velocity);
    a.pushed = free_gradient * (weight * inverse_mass);
    a.mobility = dot3(gradient, a.pushed);
    a.thrust = gradient * choose(inverse_mass > 0.0f, weight, real(0.0f));
    return a;
}

// 1 / a, for a > 0
LAW real inverse_of(real a)
{
    real r = inverse_sqrt(a);
    return r * r;
}

// The weighted mean of the gradient. Subtracting it leaves weighted forces without net thrust: sum omega (G - mean) = 0.
// `inverse_weight` is 1 / sum omega over free nodes; 0 if all weights are 1, since then sum G = 0.
LAW vec3 volume_mean(VolumeRate sums, real inverse_weight)
{
    return sums.thrust * inverse_weight;
}

// Eq. (14) with Phi_t = 0, as a change of velocity: v' = v - q omega w (G - mean) makes 6 V' = 6 V + dt sum G . P v' the
// target value. `excess` is 6 (V - V_wanted) before the step; the multiplier itself is 6 q / dt.
LAW real volume_multiplier(VolumeRate sums, vec3 mean, real excess, real inverse_dt)
{
    real mobility = sums.mobility - dot3(mean, sums.pushed);
    real q = (excess * inverse_dt + sums.rate) * inverse_of(mobility);
    return choose(mobility > 0.0f, q, real(0.0f));
}

// Applies the multiplier's force to a node, blocked or not: a node on a plate is pressed against it.
LAW vec3 volume_velocity(vec3 velocity, vec3 gradient, vec3 mean, real inverse_mass, real weight, real q)
{
    return settled_velocity(velocity - (gradient - mean) * (weight * inverse_mass) * q);
}

// Displacement of a node per unit of q: omega w P (G - mean)
LAW vec3 volume_direction(vec3 gradient, vec3 mean, real inverse_mass, real weight, Blocked blocked)
{
    return free_part((gradient - mean) * (weight * inverse_mass), blocked);
}

// --- The exact correction ---------------------------------------------------------------------------------------------

// 6 V(x - s d) - 6 V_wanted = (volume + low - wanted) - first s + second s^2 - third s^3
struct VolumeCubic
{
    real volume;  // 6 V(x), m3; `low` is the rounding error of its sum
    real low;
    real first, second, third;
    vec3 arm;     // sum of the apexes about the centre, m: the displacement of the centre
};

LAW VolumeCubic volume_cubic_of_nothing()
{
    VolumeCubic a;
    a.volume = real(0.0f);
    a.low = real(0.0f);
    a.first = real(0.0f);
    a.second = real(0.0f);
    a.third = real(0.0f);
    a.arm = vec3(real(0.0f), real(0.0f), real(0.0f));
    return a;
}

// Volumes are added with their rounding errors (two-sum: Knuth, "The art of computer programming", volume 2, 4.2.2), so that
// V - V_wanted is as exact as the volumes of the triangles.
LAW VolumeCubic volume_cubic_merge(VolumeCubic a, VolumeCubic b)
{
    VolumeCubic m;
    m.volume = a.volume + b.volume;
    real of_b = m.volume - a.volume;
    real lost = (a.volume - (m.volume - of_b)) + (b.volume - of_b);
    m.low = (a.low + b.low) + lost;
    m.first = a.first + b.first;
    m.second = a.second + b.second;
    m.third = a.third + b.third;
    m.arm = a.arm + b.arm;
    return m;
}

// A fan of triangles (a, b_k, b_k+1): sums of the cross products of their sides, and of their changes along d.
struct FanSums
{
    vec3 area;    // sum e_k x e_k+1,  e = b - a
    vec3 linear;  // sum e_k x u_k+1 + u_k x e_k+1,  u = d_b - d_a
    vec3 square;  // sum u_k x u_k+1
};

LAW FanSums fan_of_nothing()
{
    FanSums fan;
    fan.area = vec3(real(0.0f), real(0.0f), real(0.0f));
    fan.linear = vec3(real(0.0f), real(0.0f), real(0.0f));
    fan.square = vec3(real(0.0f), real(0.0f), real(0.0f));
    return fan;
}

LAW FanSums fan_add(FanSums fan, vec3 side, vec3 next_side, vec3 change, vec3 next_change)
{
    fan.area = fan.area + cross3(side, next_side);
    fan.linear = fan.linear + (cross3(side, next_change) + cross3(change, next_side));
    fan.square = fan.square + cross3(change, next_change);
    return fan;
}

// a . (b x c) = a . ((b - a) x (c - a)): the triangles' volumes with the centre of the body, and their derivatives.
LAW VolumeCubic fan_cubic(FanSums fan, vec3 arm, vec3 change)
{
    VolumeCubic a;
    a.volume = dot3(arm, fan.area);
    a.low = real(0.0f);
    a.first = dot3(arm, fan.linear) + dot3(change, fan.area);
    a.second = dot3(arm, fan.square) + dot3(change, fan.linear);
    a.third = dot3(change, fan.square);
    a.arm = arm;
    return a;
}

// 6 (V(x - s d) - V_wanted)
LAW real volume_excess(VolumeCubic a, real wanted, real s)
{
    return ((a.volume - wanted) + a.low) - s * (a.first - s * (a.second - s * a.third));
}

// The root nearest to 0, by six Newton steps. Each doubles the number of digits; the first equals eq. (14). If the volume
// does not fall along d (all nodes blocked, or a body turned inside out), nothing moves.
LAW real volume_root(VolumeCubic a, real wanted)
{
    real s = 0.0f;
    for (int step = 0; step < 6; ++step) {
        real slope = a.first - s * (2.0f * a.second - 3.0f * (s * a.third));
        real next = s + volume_excess(a, wanted, s) * inverse_of(slope);
        s = choose(slope > 0.0f, next, s);
    }
    return s;
}

// Moves a node by -s d at the end of a step and corrects its velocity: momentum is as if the multiplier had been exact at
// once.
LAW Motion volume_corrected(Motion end, vec3 d, real s, real inverse_dt)
{
    end.position = end.position - d * s;
    end.velocity = settled_velocity(end.velocity - d * (s * inverse_dt));
    return end;
}

// Symplectic Euler, velocity first: eq. (7)-(8) of the cloth paper without its constraint term.

// A velocity component under 2^-64 m/s counts as rest. That is two millimetres in a billion years, and
// it keeps the state out of the denormal numbers, which some devices flush to zero and others do not.
LAW real settled(real a)
{
    return choose(magnitude(a) < 5.421011e-20f, real(0.0f), a);
}
LAW vec3 settled_velocity(vec3 v)
{
    return vec3(settled(v.x), settled(v.y), settled(v.z));
}

// v' = (1 - d dt) v + dt (f / m + g),  with decay = 1 - d dt of the global damping d (1/s); a pinned node
// (inverse mass 0) stays where it is.
LAW vec3 velocity_step(vec3 velocity, vec3 force, real inverse_mass, vec3 gravity, real decay, real dt)
{
    vec3 next = velocity * decay + (force * inverse_mass + gravity) * dt;
    return choose(inverse_mass > 0.0f, settled_velocity(next), vec3(0.0f, 0.0f, 0.0f));
}

// dt (f / m + g - d v), what velocity_step adds, for schemes of several stages:  1 - decay = d dt
LAW vec3 velocity_change(vec3 velocity, vec3 force, real inverse_mass, vec3 gravity, real decay, real dt)
{
    vec3 change = (force * inverse_mass + gravity) * dt - velocity * (1.0f - decay);
    return choose(inverse_mass > 0.0f, change, vec3(0.0f, 0.0f, 0.0f));
}

// A stage of a scheme that looks at the state more than once in a step: for one quantity y, from its value at the start of
// the step and its change dt f(state of this stage), the state that the next stage, or step, begins with.
//   0: explicit Euler, which has one.   1 to 4: Runge and Kutta's classical scheme,
//   k1 at y, k2 at y + k1/2, k3 at y + k2/2, k4 at y + k3,   y' = y + (k1 + 2 k2 + 2 k3 + k4) / 6
// stage_sum: the changes so far, weighted; stage_next is given it with this stage's.
LAW vec3 stage_sum(int stage, vec3 sum, vec3 change)
{
    if (stage == 2 || stage == 3) return sum + change * 2.0f;
    if (stage == 4) return sum + change;
    return change;
}
LAW vec3 stage_next(int stage, vec3 start, vec3 sum, vec3 change)
{
    if (stage == 1 || stage == 2) return start + change * 0.5f;
    if (stage == 4) return start + sum * 0.16666667f;
    return start + change;
}

// x' = x + dt v'
LAW vec3 position_step(vec3 position, vec3 next_velocity, real dt)
{
    return position + next_velocity * dt;
}

// The velocity with which a node begins a step while a hand pulls at it by a spring (stiffness k, damping c) to `target`:
//   v' = v + pull (target - x) - hold (v + dt g),   pull = k dt / m',  hold = (c dt + k dt^2) / m',  m' = m + c dt + k dt^2
// With m' as the node's mass in that step the result is that of the spring taken implicitly (to first order, as by
// Baraff and Witkin 1998, Large Steps in Cloth Simulation, eq. (6)), by whatever method the step is made: no stiffness
// of the hand is too large.
LAW vec3 grabbed_velocity(vec3 position, vec3 velocity, vec3 target, vec3 gravity, real pull, real hold, real dt)
{
    return velocity + (target - position) * pull - (velocity + gravity * dt) * hold;
}

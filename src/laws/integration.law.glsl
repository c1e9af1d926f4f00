// Symplectic Euler, velocity first: eq. (7)-(8) of the cloth paper without its constraint term.

// A velocity component below 2^-64 m/s is set to 0. That is two millimetres in a billion years. It keeps denormal numbers,
// which only some devices flush to zero, out of the state.
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

// dt (f / m + g - d v), the change that velocity_step adds, for multi-stage schemes:  1 - decay = d dt
LAW vec3 velocity_change(vec3 velocity, vec3 force, real inverse_mass, vec3 gravity, real decay, real dt)
{
    vec3 change = (force * inverse_mass + gravity) * dt - velocity * (1.0f - decay);
    return choose(inverse_mass > 0.0f, change, vec3(0.0f, 0.0f, 0.0f));
}

// A stage of a multi-stage scheme. For one quantity y, from its value at the start of the step and its change dt f(state of
// this stage), it gives the state in which the next stage, or step, begins.
//   0: explicit Euler, which has one stage.   1 to 4: the classical Runge-Kutta scheme,
//   k1 at y, k2 at y + k1/2, k3 at y + k2/2, k4 at y + k3,   y' = y + (k1 + 2 k2 + 2 k3 + k4) / 6
// stage_sum: the weighted sum of the changes so far; stage_next gets it with this stage's change included.
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

// The velocity of a node at the start of a step while a hand pulls it by a spring (stiffness k, damping c) to `target`:
//   v' = v + pull (target - x) - hold (v + dt g),   pull = k dt / m',  hold = (c dt + k dt^2) / m',  m' = m + c dt + k dt^2
// If the node has the mass m' in that step, the result is that of the spring taken implicitly (to first order, as by Baraff
// and Witkin 1998, Large Steps in Cloth Simulation, eq. (6)), whatever method makes the step. Any stiffness of the hand is
// stable.
LAW vec3 grabbed_velocity(vec3 position, vec3 velocity, vec3 target, vec3 gravity, real pull, real hold, real dt)
{
    return velocity + (target - position) * pull - (velocity + gravity * dt) * hold;
}

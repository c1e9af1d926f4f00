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

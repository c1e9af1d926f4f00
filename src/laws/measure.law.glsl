// Measures of a state, gathered by node and merged in one fixed tree on every backend.

struct Measure
{
    real max_stretch;      // (l - l0) / l0
    real max_penetration;  // m
    real max_speed2;       // m2/s2
    real stretch_sum;      // over structural and shear springs
    real kinetic_energy;   // J
    real elastic_energy;   // J
    real height_moment;    // kg m: mass times height along gravity
    real non_finite;       // nodes
};

LAW Measure measure_of_nothing()
{
    Measure m;
    m.max_stretch = real(-1.0f);
    m.max_penetration = real(0.0f);
    m.max_speed2 = real(0.0f);
    m.stretch_sum = real(0.0f);
    m.kinetic_energy = real(0.0f);
    m.elastic_energy = real(0.0f);
    m.height_moment = real(0.0f);
    m.non_finite = real(0.0f);
    return m;
}

LAW Measure measure_merge(Measure a, Measure b)
{
    Measure m;
    m.max_stretch = largest(a.max_stretch, b.max_stretch);
    m.max_penetration = largest(a.max_penetration, b.max_penetration);
    m.max_speed2 = largest(a.max_speed2, b.max_speed2);
    m.stretch_sum = a.stretch_sum + b.stretch_sum;
    m.kinetic_energy = a.kinetic_energy + b.kinetic_energy;
    m.elastic_energy = a.elastic_energy + b.elastic_energy;
    m.height_moment = a.height_moment + b.height_moment;
    m.non_finite = a.non_finite + b.non_finite;
    return m;
}

// Adds one spring, counted at its node of lower index. `counts`: structural and shear springs.
LAW Measure measure_spring(Measure m, vec3 xi, vec3 xj, real rest_length, real stiffness, mask counts)
{
    real stretch = spring_stretch(xi, xj, rest_length);
    m.max_stretch = choose(counts, largest(stretch, m.max_stretch), m.max_stretch);
    m.stretch_sum = m.stretch_sum + choose(counts, stretch, real(0.0f));
    m.elastic_energy = m.elastic_energy + spring_energy(xi, xj, rest_length, stiffness);
    return m;
}

// Adds one node, with its mass in kg (a pin has one too).
LAW Measure measure_node(Measure m, vec3 position, vec3 velocity, real mass, vec3 gravity_direction)
{
    real speed2 = dot3(velocity, velocity);
    mask finite = both(is_finite(dot3(position, position)), is_finite(speed2));
    m.max_speed2 = largest(speed2, m.max_speed2);
    m.kinetic_energy = m.kinetic_energy + 0.5f * mass * speed2;
    m.height_moment = m.height_moment - mass * dot3(position, gravity_direction);
    m.non_finite = m.non_finite + choose(finite, real(0.0f), real(1.0f));
    return m;
}

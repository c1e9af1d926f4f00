// Wind: drag and lift of a triangle in moving air.

// Force on each of the three corners, N. u is the wind relative to the triangle, A n its area vector; both sides are alike:
//   drag = 1/2 rho C_d A |u . n| u                       along u
//   lift = 1/2 rho C_l A |u . n| (|u| n' - (u . n') u / |u|)   across u, n' being n turned towards u
// Source: flat-plate model, as in Wilson and Ling, "Practical wind for cloth"; each corner gets a third.
LAW vec3 wind_force(vec3 x0, vec3 x1, vec3 x2, vec3 v0, vec3 v1, vec3 v2, vec3 wind, real density, real drag, real lift)
{
    real third = 0.33333334f;
    vec3 u = wind - (v0 + v1 + v2) * third;
    vec3 twice_area = cross3(x1 - x0, x2 - x0);
    vec3 n = direction(twice_area);
    real area = 0.5f * dot3(twice_area, n);
    real facing = dot3(u, n);
    vec3 n_towards = choose(facing < 0.0f, n * real(-1.0f), n);
    real incident = magnitude(facing);
    real speed2 = dot3(u, u);
    real inverse_speed = inverse_sqrt(speed2);
    vec3 across = n_towards * (speed2 * inverse_speed) - u * (incident * inverse_speed);
    real pressure = 0.5f * density * area * incident * third;
    return (u * drag + across * lift) * pressure;
}

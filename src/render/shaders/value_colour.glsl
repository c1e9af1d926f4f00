// Viridis, a perceptually uniform map (S. van der Walt and N. Smith, CC0), as a polynomial of degree 6 fitted by M. Zucker
// (CC0). Its values are sRGB; the power 2.2 converts them to linear.
vec3 viridis(float t)
{
    t = clamp(t, 0.0, 1.0);
    const vec3 c0 = vec3(0.2777273272, 0.0054073445, 0.3340998053);
    const vec3 c1 = vec3(0.1050930431, 1.4046135299, 1.3845901626);
    const vec3 c2 = vec3(-0.3308618287, 0.2148475595, 0.0950951630);
    const vec3 c3 = vec3(-4.6342304990, -5.7991009734, -19.3324409563);
    const vec3 c4 = vec3(6.2282699363, 14.1799333668, 56.6905526007);
    const vec3 c5 = vec3(4.7763849977, -13.7451453777, -65.3530326334);
    const vec3 c6 = vec3(-5.4354558559, 4.6458526122, 26.3124352496);
    vec3 srgb = c0 + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * (c5 + t * c6)))));
    return pow(clamp(srgb, 0.0, 1.0), vec3(2.2));
}

// From blue over white to red, for values around a middle at t = 0.5.
vec3 diverging(float t)
{
    t = clamp(t, 0.0, 1.0) * 2.0 - 1.0;
    vec3 end = t < 0.0 ? vec3(0.03, 0.10, 0.48) : vec3(0.50, 0.02, 0.03);
    return mix(vec3(0.86), end, sqrt(abs(t)));
}

vec3 value_colour(float t) { return frame.colours == 2u ? diverging(t) : viridis(t); }

// Portable arithmetic, of which the other laws consist: only +, -, *, comparison and choice. A law then gives the same bits
// wherever these are correctly rounded: on every CPU, and on every GPU that conforms to Vulkan.

// a . b, summed from left to right
LAW real dot3(vec3 a, vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// a x b
LAW vec3 cross3(vec3 a, vec3 b)
{
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

// The larger of two; b if either is NaN.
LAW real largest(real a, real b)
{
    return choose(a > b, a, b);
}

// |a|
LAW real magnitude(real a)
{
    return choose(a > -a, a, -a);
}

// 1 / sqrt(a):  r <- r (3/2 - (a/2 r) r), from a seed that halves the exponent.
// Each step squares the relative error (times 3/2): 3.4e-2, 1.8e-3, 4.7e-6, 3.3e-11. In float three steps reach rounding
// (largest relative error 1.8e-7 over all normal floats); double takes four.
// At a = 0 the result is large but finite, so that 0 * inverse_sqrt(0) = 0: a zero vector has no direction.
// Source: the seed is that of Lomont, "Fast inverse square root", 2003; the iteration is Newton's.
LAW real inverse_sqrt(real a)
{
    real half_a = 0.5f * a;
    real r = inverse_sqrt_seed(a);
    for (int step = 0; step < inverse_sqrt_steps; ++step)
        r = r * (1.5f - (half_a * r) * r);
    return r;
}

// a / |a|; 0 for the zero vector
LAW vec3 direction(vec3 a)
{
    return a * inverse_sqrt(dot3(a, a));
}

// Symmetric 3 x 3 blocks, of which the solver's operators consist.

struct Symmetric
{
    real xx, xy, xz, yy, yz, zz;
};

KERNEL Symmetric symmetric(real xx, real xy, real xz, real yy, real yz, real zz)
{
    Symmetric a;
    a.xx = xx;
    a.xy = xy;
    a.xz = xz;
    a.yy = yy;
    a.yz = yz;
    a.zz = zz;
    return a;
}

// d I
KERNEL Symmetric symmetric_diagonal(real d)
{
    real zero = real(0.0f);
    return symmetric(d, zero, zero, d, zero, d);
}

// a + s b
KERNEL Symmetric plus_scaled(Symmetric a, Symmetric b, real s)
{
    return symmetric(multiply_add(b.xx, s, a.xx), multiply_add(b.xy, s, a.xy), multiply_add(b.xz, s, a.xz),
                     multiply_add(b.yy, s, a.yy), multiply_add(b.yz, s, a.yz), multiply_add(b.zz, s, a.zz));
}

KERNEL Symmetric plus(Symmetric a, Symmetric b)
{
    return symmetric(a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz);
}

KERNEL Symmetric minus(Symmetric a, Symmetric b)
{
    return symmetric(a.xx - b.xx, a.xy - b.xy, a.xz - b.xz, a.yy - b.yy, a.yz - b.yz, a.zz - b.zz);
}
KERNEL Symmetric scaled(Symmetric a, real s)
{
    return symmetric(a.xx * s, a.xy * s, a.xz * s, a.yy * s, a.yz * s, a.zz * s);
}

KERNEL Symmetric where_else_zero(mask m, Symmetric a)
{
    real zero = real(0.0f);
    return symmetric(choose(m, a.xx, zero), choose(m, a.xy, zero), choose(m, a.xz, zero), choose(m, a.yy, zero),
                     choose(m, a.yz, zero), choose(m, a.zz, zero));
}

// along n n^T + across (I - n n^T)
KERNEL Symmetric symmetric_about(vec3 n, real along, real across)
{
    real d = along - across;
    vec3 m = n * d;
    return symmetric(multiply_add(m.x, n.x, across), m.x * n.y, m.x * n.z, multiply_add(m.y, n.y, across), m.y * n.z,
                     multiply_add(m.z, n.z, across));
}

// A x
KERNEL vec3 product(Symmetric a, vec3 x)
{
    return vec3((a.xx * x.x + a.xy * x.y) + a.xz * x.z, (a.xy * x.x + a.yy * x.y) + a.yz * x.z,
                (a.xz * x.x + a.yz * x.y) + a.zz * x.z);
}

// y + s x
KERNEL vec3 plus_scaled(vec3 y, vec3 x, real s)
{
    return vec3(multiply_add(x.x, s, y.x), multiply_add(x.y, s, y.y), multiply_add(x.z, s, y.z));
}

KERNEL real reciprocal(real a)
{
    real r = inverse_sqrt(a);
    return r * r;
}

// The larger of two; NaN if either is NaN (`largest` drops it). For reported values.
KERNEL real larger(real a, real b)
{
    return choose(a >= b, a, choose(b >= a, b, a + b));
}

// A = L D L^T, stored as the inverse pivots (xx, yy, zz) and the entries of L below them. A stiff sheet is stiff in its
// plane and nearly free across it, so cancellation can ruin the last pivot. No pivot is taken smaller than `least` (the
// node's inertia, a lower bound in theory) or than the rounding error. The inverse of an empty block is zero.
KERNEL Symmetric factored(Symmetric a, real least)
{
    real rounding = 2.3841858e-7f;
    mask filled = a.xx > 0.0f;
    real d1 = largest(a.xx, least);
    real i1 = choose(filled, reciprocal(d1), real(0.0f));
    real l21 = a.xy * i1, l31 = a.xz * i1;
    real d2 = largest(a.yy - l21 * a.xy, largest(least, a.yy * rounding));
    real i2 = choose(filled, reciprocal(d2), real(0.0f));
    real t = a.yz - l31 * a.xy;
    real l32 = t * i2;
    real d3 = largest(a.zz - l31 * a.xz - l32 * t, largest(least, a.zz * rounding));
    real i3 = choose(filled, reciprocal(d3), real(0.0f));
    return symmetric(i1, l21, l31, i2, l32, i3);
}

// A^-1 b from `factored`
KERNEL vec3 solved(Symmetric f, vec3 b)
{
    real y2 = b.y - f.xy * b.x;
    real y3 = b.z - f.xz * b.x - f.yz * y2;
    real z3 = y3 * f.zz;
    real z2 = y2 * f.yy - f.yz * z3;
    return vec3(b.x * f.xx - f.xy * z2 - f.xz * z3, z2, z3);
}

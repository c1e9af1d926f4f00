// The coarsest level: a dense L D L^T factorisation of its few nodes, by one invocation.

KERNEL void bottom_add(int i, int j, Symmetric a, real sign)
{
    int n = 3 * bottom_nodes(), first = 3 * i * n + 3 * j;
    bottom_set(first, bottom_get(first) + sign * a.xx);
    bottom_set(first + 1, bottom_get(first + 1) + sign * a.xy);
    bottom_set(first + 2, bottom_get(first + 2) + sign * a.xz);
    bottom_set(first + n, bottom_get(first + n) + sign * a.xy);
    bottom_set(first + n + 1, bottom_get(first + n + 1) + sign * a.yy);
    bottom_set(first + n + 2, bottom_get(first + n + 2) + sign * a.yz);
    bottom_set(first + 2 * n, bottom_get(first + 2 * n) + sign * a.xz);
    bottom_set(first + 2 * n + 1, bottom_get(first + 2 * n + 1) + sign * a.yz);
    bottom_set(first + 2 * n + 2, bottom_get(first + 2 * n + 2) + sign * a.zz);
}

KERNEL void bottom_clear()
{
    int n = 3 * bottom_nodes();
    for (int i = 0; i < n * n; ++i) bottom_set(i, real(0.0f));
}

KERNEL void bottom_eliminate()
{
    int n = 3 * bottom_nodes();
    for (int j = 0; j < n; ++j) {
        real least = bottom_get(j * n + j) * real(2.3841858e-7f);
        for (int k = 0; k < j; ++k) {
            real l = bottom_get(j * n + k);
            bottom_set(j * n + j, bottom_get(j * n + j) - l * l * bottom_get(k * n + k));
        }
        real pivot = largest(bottom_get(j * n + j), largest(least, real(1e-30f)));
        bottom_set(j * n + j, pivot);
        real inverse = reciprocal(pivot);
        for (int i = j + 1; i < n; ++i) {
            real a = bottom_get(i * n + j);
            for (int k = 0; k < j; ++k)
                a = a - bottom_get(i * n + k) * bottom_get(j * n + k) * bottom_get(k * n + k);
            bottom_set(i * n + j, a * inverse);
        }
    }
}

// The operator of the coarsest level as dense rows, factored.
KERNEL void bottom_factor()
{
    bottom_clear();
    bottom_assemble();
    bottom_eliminate();
}

KERNEL void bottom_solve()
{
    int n = 3 * bottom_nodes();
    for (int i = 0; i < n; ++i) {
        real a = bottom_vector(plane_residual, i);
        for (int k = 0; k < i; ++k) a = a - bottom_get(i * n + k) * bottom_vector(plane_correction, k);
        bottom_set_vector(plane_correction, i, a);
    }
    for (int i = 0; i < n; ++i)
        bottom_set_vector(plane_correction, i, bottom_vector(plane_correction, i) * reciprocal(bottom_get(i * n + i)));
    for (int i = n - 1; i >= 0; --i) {
        real a = bottom_vector(plane_correction, i);
        for (int k = i + 1; k < n; ++k) a = a - bottom_get(k * n + i) * bottom_vector(plane_correction, k);
        bottom_set_vector(plane_correction, i, a);
    }
}

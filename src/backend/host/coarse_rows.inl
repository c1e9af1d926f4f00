// sheet_coarsen row by row. The intermediate operator (rows of the finer level, columns of this one) is
// computed once for the three rows of this level that use it. Part of SolverKernels (solver_kernels.hpp), for
// packs.

/// Columns of this level per batch, and more than a pack on both sides.
struct CoarseSpan {
    // The pitch is an odd number of cache lines, so that rows begin in different sets of a cache.
    static constexpr int most = 128, pad = 32, pitch = most + 2 * pad + 16;
    int first, columns;
    int left, right;  ///< columns of the intermediate operator to compute
};

/// A row of the finer level, with even and odd columns separate.
struct SplitRow {
    static constexpr int kinds = 5;  ///< row sums, and couplings to the four forward neighbours
    Number numbers[2 * kinds * 6 * CoarseSpan::pitch];

    Number* at(int odd, int kind, int column)
    {
        return numbers + ((odd * kinds + kind) * 6 * CoarseSpan::pitch + CoarseSpan::pad + column);
    }
};
/// A row of the intermediate operator.
struct HalfRow {
    static constexpr int kinds = 6;  ///< row sums, diagonals, couplings
    Number numbers[kinds * 6 * CoarseSpan::pitch];

    Number* at(int kind, int column)
    {
        return numbers + (kind * 6 * CoarseSpan::pitch + CoarseSpan::pad + column);
    }
};
static Symmetric buffered6(const Number* p) { return six<&Lanes<T>::load>(p, CoarseSpan::pitch); }
static void buffer6(Number* p, Symmetric a)
{
    put3(p, CoarseSpan::pitch, a.xx, a.xy, a.xz);
    put3(p + 3 * CoarseSpan::pitch, CoarseSpan::pitch, a.yy, a.yz, a.zz);
}

/// Columns beyond the border are zero.
KERNEL void split_row(SplitRow& to, int row, const CoarseSpan& span)
{
    constexpr int lanes = Lanes<T>::count;
    for (int column = span.left - lanes; column < span.right + lanes; column += lanes) {
        const bool is_there = span.first + column >= 0 && span.first + column < level.columns;
        const int f = finer_offset(row, 2 * (span.first + column));
        for (int kind = 0; kind < SplitRow::kinds; ++kind) {
            const int plane = kind == 0                ? plane_row_sum
                              : kind == 1 || kind == 3 ? finer_coupling(kind - 1)
                                                       : plane_block + 6 * (kind - 1);
            Number *even = to.at(0, kind, column), *odd = to.at(1, kind, column);
            const Number *low = finer_at(plane, f), *high = finer_at(plane, f + lanes);
            const Distance size = finer_apart(plane);
            for (int k = 0; k < 6; ++k) {
                const T zero = spread(Number(0));
                const T a = is_there ? Lanes<T>::load(low + k * size) : zero;
                const T b = is_there ? Lanes<T>::load(high + k * size) : zero;
                Lanes<T>::store(even + k * CoarseSpan::pitch, Lanes<T>::even_of(a, b));
                Lanes<T>::store(odd + k * CoarseSpan::pitch, Lanes<T>::odd_of(a, b));
            }
        }
    }
}

/// As half_coarse_at, for a whole row; `above` is the row of the finer level before it.
KERNEL void make_half_row(HalfRow& to, SplitRow& above, SplitRow& row, const CoarseSpan& span)
{
    const auto even = [&](int kind, int column) { return buffered6(row.at(0, kind, column)); };
    const auto odd = [&](int kind, int column) { return buffered6(row.at(1, kind, column)); };
    const auto even_above = [&](int kind, int column) { return buffered6(above.at(0, kind, column)); };
    const auto odd_above = [&](int kind, int column) { return buffered6(above.at(1, kind, column)); };
    const auto held_odd = [&](int c) {
        return held_across(odd(0, c), odd(2, c), odd(3, c), odd(4, c), even_above(2, c + 1), odd_above(3, c),
                           even_above(4, c));
    };
    for (int c = span.left; c < span.right; c += Lanes<T>::count) {
        const Symmetric held_here = held_across(even(0, c), even(2, c), even(3, c), even(4, c),
                                                odd_above(2, c), even_above(3, c), odd_above(4, c - 1));
        const Symmetric held_right = held_odd(c);
        buffer6(to.at(0, c), half_sum(even(0, c), odd(0, c - 1), odd(0, c)));
        buffer6(to.at(1, c), half_diagonal(held_here, held_odd(c - 1), held_right, even(1, c - 1),
                                           odd(1, c - 1), even(1, c), odd(1, c)));
        buffer6(to.at(2, c), half_along(even(1, c), odd(1, c), held_right));
        buffer6(to.at(3, c), half_back(even(2, c), odd(2, c - 1), odd(3, c - 1)));
        buffer6(to.at(4, c), half_down(even(2, c), even(3, c), even(4, c), odd(2, c), odd(3, c),
                                       odd(3, c - 1), odd(4, c - 1)));
        buffer6(to.at(5, c), half_ahead(even(4, c), odd(4, c), odd(3, c)));
    }
}

void sheet_coarsen_rows(Pass, int begin, int end)
{
    if constexpr (Lanes<T>::count == 1)
        cells<&SolverKernels::sheet_coarsen>(begin, end, level.rows, level.columns);
    else
        coarsen_rows(begin, end);
}
void coarsen_rows(int begin, int end)
{
    SolverKernels self = *this;
    SplitRow split[2];
    HalfRow half[3];
    const auto half_row = [&](int row) -> HalfRow& { return half[(row + 3) % 3]; };
    for (int first = 0; first < level.columns; first += CoarseSpan::most) {
        const int rest = level.columns - first;
        CoarseSpan span{};
        span.first = first;
        span.columns = rest < CoarseSpan::most ? rest : CoarseSpan::most;
        span.left = -Lanes<T>::count;
        span.right = span.columns + Lanes<T>::count;
        const auto make = [&](int row) {
            self.split_row(split[(row + 2) % 2], row, span);
            self.make_half_row(half_row(row), split[(row + 1) % 2], split[(row + 2) % 2], span);
        };
        self.split_row(split[0], 2 * begin - 2, span);  // an even row, as `make` requires
        make(2 * begin - 1);
        for (int row = begin; row < end; ++row) {
            make(2 * row);
            make(2 * row + 1);
            HalfRow &above = half_row(2 * row - 1), &here = half_row(2 * row), &below = half_row(2 * row + 1);
            const auto whole_half = [](HalfRow& from, int c) {
                return HalfCoarse{buffered6(from.at(0, c)), buffered6(from.at(1, c)),
                                  buffered6(from.at(2, c)), buffered6(from.at(3, c)),
                                  buffered6(from.at(4, c)), buffered6(from.at(5, c))};
            };
            for (int c = 0; c < span.columns; c += Lanes<T>::count) {
                self.inside_ = Lanes<T>::first_lanes(level.columns - first - c);
                self.leave_coarsened(level_offset(row, first + c), whole_half(above, c), whole_half(here, c),
                                     whole_half(below, c), buffered6(above.at(3, c + 1)),
                                     buffered6(here.at(3, c + 1)), buffered6(below.at(2, c - 1)));
            }
        }
    }
}

// The kernels. Included by one file per instruction set, which defines PLIANT_LANES and PLIANT_KERNELS.
// Everything is in an unnamed namespace and uses nothing of the standard library: code compiled here with
// wide instructions must not be shared with files that run before the instruction set is chosen.
#include "backend/cpu/kernels.hpp"
#include "backend/cpu/pack.hpp"
#include "backend/cpu/records.hpp"
#if !PLIANT_FAST_MATH
#include "backend/host/solver_kernels.hpp"
#endif

namespace pliant::cpu {
namespace {

constexpr int width = PLIANT_LANES;
using Number = Pack<width>;
using L = Laws<Number>;
using Vector = Vector3<Number>;

template <class Pointers>
inline Vector load(const Pointers& from, std::ptrdiff_t offset)
{
    return {Number::load(from.x + offset), Number::load(from.y + offset), Number::load(from.z + offset)};
}
inline void store(const Vectors& to, std::ptrdiff_t offset, const Vector& a)
{
    a.x.store(to.x + offset);
    a.y.store(to.y + offset);
    a.z.store(to.z + offset);
}
/// Lanes whose column, shifted, is on the sheet.
inline L::mask lanes_on_sheet(std::ptrdiff_t column, std::ptrdiff_t columns)
{
    LaneTypes<width>::Integers lane;
    for (int k = 0; k < width; ++k) lane[k] = k;
    const auto first = static_cast<std::int32_t>(column), end = static_cast<std::int32_t>(columns);
    return {(lane + first >= 0) & (lane + first < end)};
}

struct Block {
    std::ptrdiff_t row, column, offset;
    bool interior;  ///< the neighbours of all lanes are on the sheet
};

// As NodeLayout::offset, which must not be compiled in this file.
inline std::ptrdiff_t offset_of(const NodeLayout& layout, std::ptrdiff_t row, std::ptrdiff_t column)
{
    const auto border = static_cast<std::ptrdiff_t>(NodeLayout::border_rows);
    return (row + border) * static_cast<std::ptrdiff_t>(layout.stride) +
           static_cast<std::ptrdiff_t>(NodeLayout::pad) + column;
}

/// Visits a sheet's rows in packs: f(block).
template <class Function>
inline void for_each_block(const SheetArguments& a, std::size_t first_row, std::size_t end_row, Function&& f)
{
    const auto columns = static_cast<std::ptrdiff_t>(a.layout->columns);
    for (std::size_t row = first_row; row < end_row; ++row)
        for (std::ptrdiff_t column = 0; column < columns; column += width)
            f(Block{static_cast<std::ptrdiff_t>(row), column,
                    offset_of(*a.layout, static_cast<std::ptrdiff_t>(row), column),
                    column >= 2 && column + width + 2 <= columns});
}

/// Triangles around a node of a sheet in the order of ClothModel::triangles, by offsets of (row, column).
struct SheetTriangle {
    int quad_row, quad_column;  ///< of the quad's first corner, relative to the node
    bool lower;                 ///< (b, c, d) of the quad, else (a, c, b)
};
constexpr SheetTriangle sheet_triangles[6] = {{-1, -1, true}, {-1, 0, false}, {-1, 0, true},
                                              {0, -1, false}, {0, -1, true},  {0, 0, false}};

void sheet_wind(const SheetArguments& a, std::size_t first_row, std::size_t end_row)
{
    const StepConstants<float>& c = *a.constants;
    const Vector wind = spread_vector<Number>(c.wind);
    const Number density(c.air_density), drag(c.drag), lift(c.lift);
    const auto rows = static_cast<std::ptrdiff_t>(a.layout->rows),
               columns = static_cast<std::ptrdiff_t>(a.layout->columns);
    const auto stride = static_cast<std::ptrdiff_t>(a.layout->stride);
    const Vector zero{Number(0.0f), Number(0.0f), Number(0.0f)};
    for_each_block(a, first_row, end_row, [&](const Block& block) {
        Vector force = zero;
        for (const SheetTriangle& t : sheet_triangles) {
            const std::ptrdiff_t quad_row = block.row + t.quad_row;
            if (quad_row < 0 || quad_row + 1 >= rows) continue;
            const std::ptrdiff_t quad = block.offset + t.quad_row * stride + t.quad_column;
            const std::ptrdiff_t i = t.lower ? quad + 1 : quad, j = quad + stride,
                                 k = t.lower ? j + 1 : quad + 1;
            Vector f = L::wind_force(load(a.position, i), load(a.position, j), load(a.position, k),
                                     load(a.velocity, i), load(a.velocity, j), load(a.velocity, k), wind,
                                     density, drag, lift);
            if (!block.interior)
                f = L::choose(lanes_on_sheet(block.column + t.quad_column, columns - 1), f, zero);
            force = force + f;
        }
        // Padding must stay zero: the last pack of a row reaches beyond the sheet.
        if (!block.interior) force = L::choose(lanes_on_sheet(block.column, columns), force, zero);
        store(a.wind_force, block.offset, force);
    });
}

/// Ends the step of a pack of nodes: forces, integration, contact.
template <class Arguments>
PLIANT_INLINE L::Motion stepped(const Arguments& a, const L::Motion& now, const Vector& force,
                                const Number& inverse_mass)
{
    const StepConstants<float>& c = *a.constants;
    const Number dt(c.dt);
    L::Motion next;
    next.velocity = L::velocity_step(now.velocity, force, inverse_mass, spread_vector<Number>(c.gravity),
                                     Number(c.decay), dt);
    next.position = L::position_step(now.position, next.velocity, dt);
    for (std::size_t k = 0; k < a.collider_count; ++k)
        next = L::contact_step(now, next, spread_collider<L::Collider, Number>(a.colliders[k]),
                               Number(c.thickness), inverse_mass, dt);
    return next;
}

#include "backend/cpu/sheet_kernels.inl"

#include "backend/cpu/drawing_kernels.inl"

#include "backend/cpu/list_kernels.inl"

#include "backend/cpu/measure_kernels.inl"

#include "backend/cpu/body_kernels.inl"

#if PLIANT_FAST_MATH
constexpr auto solve = nullptr, solver_records = nullptr;  // the solver has exact arithmetic only
#else
void solve(const SolverContext<float>& context, const Call& call, int first, int end)
{
    SolverKernels<Number>(context, call).run(call.pass, first, end);
}
void solver_records(const SolverContext<float>& context, const Call& call, int first, int end)
{
    SolverKernels<Number>(context, call).make_records(call.pass, first, end);
}
#endif

}  // namespace

extern const Kernels PLIANT_KERNELS;
const Kernels PLIANT_KERNELS = {
    PLIANT_KERNELS_NAME, sheet_steps,   sheet_wind,     sheet_normal, sheet_strain,  sheet_measure,
    mesh_measure,        record_states, spring_forces,  list_step,    ring_step,     volume_gather,
    volume_step,         volume_cubic,  volume_correct, solve,        solver_records};

}  // namespace pliant::cpu

#include "backend/host/plain_cloth.hpp"

#include <algorithm>
#include <iterator>

namespace pliant {

template <class T>
PlainCloth<T>::PlainCloth(const ClothModel& cloth)
    : model(cloth),
      layout(cloth.shape.sheet ? cloth.shape.sheet->rows : 1,
             cloth.shape.sheet ? cloth.shape.sheet->columns : cloth.node_count()),
      spring_force(cloth.springs.list.size()),
      inverse_mass(layout.size),
      multiplier(cloth.hierarchy.empty() ? 0 : layout.size),
      tree(cloth.node_count()),
      body(cloth, layout)
{
    for (auto* planes : {&position[0], &position[1], &velocity[0], &velocity[1]})
        *planes = Planes<T>(layout.size);
    if (model.has_external_force()) external_force = Planes<T>(layout.size);
    if (model.plan.integrator == Integrator::runge_kutta_4)
        position_slope = velocity_slope = Planes<T>(layout.size);
    measures.assign(tree.value_count, L::measure_of_nothing());
    write(model.shape.positions, model.shape.velocities);
    for (std::size_t i = 0; i < model.node_count(); ++i) take_mass(i);
}

template <class T>
void PlainCloth<T>::write(std::span<const Vec3> positions, std::span<const Vec3> velocities)
{
    const auto vector = [](Vec3 a) {
        return Vector{static_cast<T>(a.x), static_cast<T>(a.y), static_cast<T>(a.z)};
    };
    for (std::size_t i = 0; i < model.node_count(); ++i) {
        const std::size_t offset = layout.offset(i);
        for (auto& planes : position) planes.set(offset, vector(positions[i]));
        for (auto& planes : velocity) planes.set(offset, vector(velocities[i]));
    }
}

template <class T>
void PlainCloth<T>::make_room_for(Pass pass)
{
    if ((pass == Pass::sheet_normal || pass == Pass::mesh_normal) && normal.x.empty())
        normal = Planes<T>(layout.size);
    if ((pass == Pass::sheet_strain || pass == Pass::list_strain) && strain.empty())
        strain = AlignedArray<T>(layout.size);
}

template <class T>
void PlainCloth<T>::take_mass(std::size_t node)
{
    inverse_mass[layout.offset(node)] = static_cast<T>(model.masses.inverse(node));
}

template <class T>
std::size_t PlainCloth<T>::size_of(const Call& call) const
{
    if (is_body_pass(call.pass)) return body.size_of(call);
    switch (unit_of(call.pass)) {
        case PassUnit::single: return 1;
        case PassUnit::attached_node: return model.attachments.nodes.size();
        case PassUnit::spring: return model.springs.list.size();
        case PassUnit::block: return tree.levels.front().count;
        case PassUnit::merged_block: return tree.levels[call.index].count;
        default: return model.node_count();
    }
}

template <class T>
void PlainCloth<T>::run(const Call& call, const StepConstants<T>& constants,
                        std::span<const Collider> colliders, std::size_t begin, std::size_t end)
{
    if (is_body_pass(call.pass)) return body.run(call, *this, constants, colliders, begin, end);
    switch (call.pass) {
        case Pass::sheet_wind: return sheet_wind(call, constants, begin, end);
        case Pass::mesh_wind: return mesh_wind(call, constants, begin, end);
        case Pass::sheet_step: return sheet_step(call, constants, colliders, begin, end);
        case Pass::attach: return attach(call, constants, begin, end);
        case Pass::grab: return grab(call, constants);
        case Pass::spring_force: return spring_forces(call, constants, begin, end);
        case Pass::list_step: return list_step(call, constants, colliders, begin, end);
        case Pass::stage_step: return stage_step(call, constants, colliders, begin, end);
        case Pass::sheet_measure:
        case Pass::list_measure: return measure_blocks(call, constants, colliders, begin, end);
        case Pass::measure_merge: return merge_blocks(call, begin, end);
        case Pass::sheet_normal: return sheet_normals(call, begin, end);
        case Pass::mesh_normal: return mesh_normals(call, begin, end);
        case Pass::sheet_strain: return sheet_strains(call, constants, begin, end);
        case Pass::list_strain:
            return list_strains(call, begin, end);
            // PlainBody runs the passes of bodies, SolverState those of solvers. A pass of cloths without a
            // case here is an error of the build.
#define CLOTH_PASS(name, ...)
#define PASS(name, ...) \
    case Pass::name: {  \
        return;         \
    }
#include "solve/passes.def"
    }
}

template <class T>
template <class Function>
void PlainCloth<T>::for_each_node(std::size_t begin, std::size_t end, Function&& f) const
{
    if (begin >= end) return;
    std::size_t row = begin / layout.columns, column = begin % layout.columns;
    for (std::size_t node = begin; node < end; ++node) {
        f(Place{node, row, column, layout.offset(row, column)});
        if (++column == layout.columns) ++row, column = 0;
    }
}

/// Visits the springs of a sheet's node from the first-th on, in canonical order: f(neighbour, offset of the
/// other node).
template <class T>
template <class Function>
void PlainCloth<T>::for_each_sheet_neighbour(const Place& place, std::size_t first, Function&& f) const
{
    for (std::size_t n = first; n < std::size(sheet_neighbours); ++n) {
        const SheetNeighbour& neighbour = sheet_neighbours[n];
        const auto row = static_cast<std::ptrdiff_t>(place.row) + neighbour.row_offset;
        const auto column = static_cast<std::ptrdiff_t>(place.column) + neighbour.column_offset;
        if (row < 0 || column < 0 || row >= static_cast<std::ptrdiff_t>(layout.rows) ||
            column >= static_cast<std::ptrdiff_t>(layout.columns))
            continue;
        f(neighbour, layout.offset(static_cast<std::size_t>(row), static_cast<std::size_t>(column)));
    }
}

/// Visits the up to six triangles around a sheet's node, in the order of ClothModel::triangles: f(offsets of
/// the corners).
template <class T>
template <class Function>
void PlainCloth<T>::for_each_sheet_triangle(const Place& place, Function&& f) const
{
    const std::size_t stride = layout.stride, x = place.offset;
    const bool above = place.row > 0, below = place.row + 1 < layout.rows;
    const bool left = place.column > 0, right = place.column + 1 < layout.columns;
    const auto upper = [&](std::size_t a) { f(a, a + stride, a + 1); };  // (a, c, b) of the quad at a
    const auto lower = [&](std::size_t a) { f(a + 1, a + stride, a + stride + 1); };  // (b, c, d)
    if (above && left) lower(x - stride - 1);
    if (above && right) upper(x - stride), lower(x - stride);
    if (below && left) upper(x - 1), lower(x - 1);
    if (below && right) upper(x);
}

template <class T>
void PlainCloth<T>::finish_step(const Call& call, const StepConstants<T>& c,
                                std::span<const Collider> colliders, const Place& place, Vector force)
{
    using Motion = typename L::Motion;
    const T w = inverse_mass[place.offset];
    const Motion now = {position[call.parity].get(place.offset), velocity[call.parity].get(place.offset)};
    Motion next;
    next.velocity = L::velocity_step(now.velocity, force, w, c.gravity, c.decay, c.dt);
    next.position = L::position_step(now.position, next.velocity, c.dt);
    for (const Collider& collider : colliders)
        next = L::contact_step(now, next, collider, c.thickness, w, c.dt);
    position[1 - call.parity].set(place.offset, next.position);
    velocity[1 - call.parity].set(place.offset, next.velocity);
}

template <class T>
void PlainCloth<T>::sheet_step(const Call& call, const StepConstants<T>& c,
                               std::span<const Collider> colliders, std::size_t begin, std::size_t end)
{
    const Planes<T>& x = position[call.parity];
    const Planes<T>& v = velocity[call.parity];
    for_each_node(begin, end, [&](const Place& place) {
        Vector force{T(0), T(0), T(0)};
        for_each_sheet_neighbour(place, 0, [&](const SheetNeighbour& neighbour, std::size_t other) {
            const auto k = static_cast<std::size_t>(neighbour.spring_class);
            force =
                force + L::spring_force(x.get(place.offset), x.get(other), v.get(place.offset), v.get(other),
                                        c.rest_lengths[neighbour.rest], c.stiffness[k], c.damping[k]);
        });
        finish_step(call, c, colliders, place, force + external_force_at(place.offset));
    });
}

/// Moves attached nodes to where they are at the end of the step.
template <class T>
void PlainCloth<T>::attach(const Call& call, const StepConstants<T>& c, std::size_t begin, std::size_t end)
{
    if (c.attached.size() < (call.index + 1) * model.attachments.nodes.size()) return;
    for (std::size_t k = begin; k < end; ++k) {
        const std::size_t offset = layout.offset(model.attachments.nodes[k].node);
        const Vec3 place = c.attached[call.index * model.attachments.nodes.size() + k];
        const Vector next{static_cast<T>(place.x), static_cast<T>(place.y), static_cast<T>(place.z)};
        velocity[1 - call.parity].set(offset, (next - position[call.parity].get(offset)) * (T(1) / c.dt));
        position[1 - call.parity].set(offset, next);
    }
}

/// The velocity of the hand's node before the step.
template <class T>
void PlainCloth<T>::grab(const Call& call, const StepConstants<T>& c)
{
    const std::size_t offset = layout.offset(c.grabbed_node);
    Planes<T>& v = velocity[call.parity];
    v.set(offset, L::grabbed_velocity(position[call.parity].get(offset), v.get(offset), c.grab_target,
                                      c.gravity, c.grab_pull, c.grab_hold, c.dt));
}

template <class T>
void PlainCloth<T>::spring_forces(const Call& call, const StepConstants<T>& c, std::size_t begin,
                                  std::size_t end)
{
    const Planes<T>& x = position[call.parity];
    const Planes<T>& v = velocity[call.parity];
    for (std::size_t s = begin; s < end; ++s) {
        const Spring& spring = model.springs.list[s];
        const std::size_t i = layout.offset(spring.i), j = layout.offset(spring.j);
        const auto k = static_cast<std::size_t>(spring.spring_class);
        const T scale = static_cast<T>(spring.scale);
        const Vector force =
            L::spring_force(x.get(i), x.get(j), v.get(i), v.get(j), static_cast<T>(spring.rest_length),
                            c.stiffness[k] * scale, c.damping[k] * scale);
        spring_force.set(s, force + L::bending_force(x.get(i), x.get(j), static_cast<T>(spring.bending)));
    }
}

template <class T>
void PlainCloth<T>::list_step(const Call& call, const StepConstants<T>& c,
                              std::span<const Collider> colliders, std::size_t begin, std::size_t end)
{
    for_each_node(begin, end, [&](const Place& place) {
        Vector force{T(0), T(0), T(0)};
        for (const Neighbour& neighbour : model.springs.neighbours.row(place.node)) {
            const Vector f = spring_force.get(neighbour.spring);
            force = place.node < neighbour.node ? force + f : force - f;
        }
        finish_step(call, c, colliders, place, force + external_force_at(place.offset));
    });
}

template <class T>
void PlainCloth<T>::stage_step(const Call& call, const StepConstants<T>& c,
                               std::span<const Collider> colliders, std::size_t begin, std::size_t end)
{
    using Motion = typename L::Motion;
    const auto stage = static_cast<int>(call.detail);
    const std::uint32_t next = 1 - call.parity, state = stage <= 1 ? call.parity : next;
    const bool is_last = stage == 0 || stage == 4;
    const Vector zero{T(0), T(0), T(0)};
    for_each_node(begin, end, [&](const Place& place) {
        Vector force = zero;
        for (const Neighbour& neighbour : model.springs.neighbours.row(place.node)) {
            const Vector f = spring_force.get(neighbour.spring);
            force = place.node < neighbour.node ? force + f : force - f;
        }
        force = force + external_force_at(place.offset);
        const std::size_t o = place.offset;
        const T w = inverse_mass[o];
        const Vector v = velocity[state].get(o);
        const Motion start = {position[call.parity].get(o), velocity[call.parity].get(o)};
        const Vector moved = w > T(0) ? v * c.dt : zero;
        const Vector change = L::velocity_change(v, force, w, c.gravity, c.decay, c.dt);
        const bool sums = stage > 1;
        const Vector x_sum = L::stage_sum(stage, sums ? position_slope.get(o) : zero, moved);
        const Vector v_sum = L::stage_sum(stage, sums ? velocity_slope.get(o) : zero, change);
        if (!is_last) {
            position_slope.set(o, x_sum);
            velocity_slope.set(o, v_sum);
        }
        Motion after = {L::stage_next(stage, start.position, x_sum, moved),
                        L::settled_velocity(L::stage_next(stage, start.velocity, v_sum, change))};
        if (is_last && !(w > T(0))) after.velocity = zero;
        if (is_last)
            for (const Collider& collider : colliders)
                after = L::contact_step(start, after, collider, c.thickness, w, c.dt);
        position[next].set(o, after.position);
        velocity[next].set(o, after.velocity);
    });
}

template <class T>
void PlainCloth<T>::sheet_wind(const Call& call, const StepConstants<T>& c, std::size_t begin,
                               std::size_t end)
{
    const Planes<T>& x = position[call.parity];
    const Planes<T>& v = velocity[call.parity];
    for_each_node(begin, end, [&](const Place& place) {
        Vector force{T(0), T(0), T(0)};
        for_each_sheet_triangle(place, [&](std::size_t i, std::size_t j, std::size_t k) {
            force = force + L::wind_force(x.get(i), x.get(j), x.get(k), v.get(i), v.get(j), v.get(k), c.wind,
                                          c.air_density, c.drag, c.lift);
        });
        external_force.set(place.offset, force);
    });
}

template <class T>
void PlainCloth<T>::mesh_wind(const Call& call, const StepConstants<T>& c, std::size_t begin, std::size_t end)
{
    const Planes<T>& x = position[call.parity];
    const Planes<T>& v = velocity[call.parity];
    const auto triangles = model.shape.triangles();
    for_each_node(begin, end, [&](const Place& place) {
        Vector force{T(0), T(0), T(0)};
        for (const std::uint32_t t : model.shape.node_triangles.row(place.node)) {
            const std::size_t i = layout.offset(triangles[t][0]), j = layout.offset(triangles[t][1]),
                              k = layout.offset(triangles[t][2]);
            force = force + L::wind_force(x.get(i), x.get(j), x.get(k), v.get(i), v.get(j), v.get(k), c.wind,
                                          c.air_density, c.drag, c.lift);
        }
        external_force.set(place.offset, force);
    });
}

template <class T>
void PlainCloth<T>::sheet_normals(const Call& call, std::size_t begin, std::size_t end)
{
    const Planes<T>& x = position[call.parity];
    const auto stride = static_cast<std::ptrdiff_t>(layout.stride);
    for_each_node(begin, end, [&](const Place& place) {
        const bool above = place.row > 0, below = place.row + 1 < layout.rows;
        const bool left = place.column > 0, right = place.column + 1 < layout.columns;
        Vector sum{T(0), T(0), T(0)};
        const auto add = [&](bool exists, std::ptrdiff_t first, std::ptrdiff_t second) {
            if (!exists) return;
            const auto at = [&](std::ptrdiff_t d) {
                return x.get(static_cast<std::size_t>(static_cast<std::ptrdiff_t>(place.offset) + d));
            };
            sum = sum + L::quadrant_normal(at(0), at(first), at(first + second), at(second));
        };
        add(below && right, stride, 1);
        add(above && right, 1, -stride);
        add(above && left, -stride, -1);
        add(below && left, -1, stride);
        normal.set(place.offset, L::direction(sum));
    });
}

template <class T>
void PlainCloth<T>::mesh_normals(const Call& call, std::size_t begin, std::size_t end)
{
    const Planes<T>& x = position[call.parity];
    const auto triangles = model.shape.triangles();
    for_each_node(begin, end, [&](const Place& place) {
        Vector sum{T(0), T(0), T(0)};
        for (const std::uint32_t t : model.shape.node_triangles.row(place.node))
            sum = sum + L::triangle_normal(x.get(layout.offset(triangles[t][0])),
                                           x.get(layout.offset(triangles[t][1])),
                                           x.get(layout.offset(triangles[t][2])));
        normal.set(place.offset, L::direction(sum));
    });
}

template <class T>
void PlainCloth<T>::sheet_strains(const Call& call, const StepConstants<T>& c, std::size_t begin,
                                  std::size_t end)
{
    const Planes<T>& x = position[call.parity];
    for_each_node(begin, end, [&](const Place& place) {
        T most = T(-1);
        for_each_sheet_neighbour(place, 0, [&](const SheetNeighbour& neighbour, std::size_t other) {
            if (neighbour.spring_class == SpringClass::bend) return;
            most = L::largest(
                L::spring_stretch(x.get(place.offset), x.get(other), c.rest_lengths[neighbour.rest]), most);
        });
        strain[place.offset] = most;
    });
}

template <class T>
void PlainCloth<T>::list_strains(const Call& call, std::size_t begin, std::size_t end)
{
    const Planes<T>& x = position[call.parity];
    for_each_node(begin, end, [&](const Place& place) {
        T most = T(-1);
        for (const Neighbour& neighbour : model.springs.neighbours.row(place.node)) {
            const Spring& spring = model.springs.list[neighbour.spring];
            if (spring.spring_class == SpringClass::bend) continue;
            most = L::largest(L::spring_stretch(x.get(place.offset), x.get(layout.offset(neighbour.node)),
                                                static_cast<T>(spring.rest_length)),
                              most);
        }
        strain[place.offset] = most;
    });
}

/// A node's springs to nodes of higher index: each spring is counted once.
template <class T>
typename PlainCloth<T>::Measure PlainCloth<T>::measured_springs(const Call& call, const StepConstants<T>& c,
                                                                const Place& place) const
{
    const Planes<T>& x = position[call.parity];
    Measure m = L::measure_of_nothing();
    const auto add = [&](std::size_t other, T rest_length, SpringClass spring_class, T scale) {
        m = L::measure_spring(m, x.get(place.offset), x.get(other), rest_length,
                              c.stiffness[static_cast<std::size_t>(spring_class)] * scale,
                              spring_class != SpringClass::bend);
    };
    if (model.plan.node_centric) {
        for_each_sheet_neighbour(place, std::size(sheet_neighbours) / 2,
                                 [&](const SheetNeighbour& neighbour, std::size_t other) {
                                     add(other, c.rest_lengths[neighbour.rest], neighbour.spring_class, T(1));
                                 });
    } else {
        for (const Neighbour& neighbour : model.springs.neighbours.row(place.node)) {
            if (neighbour.node < place.node) continue;
            const Spring& spring = model.springs.list[neighbour.spring];
            const std::size_t other = layout.offset(neighbour.node);
            add(other, static_cast<T>(spring.rest_length), spring.spring_class, static_cast<T>(spring.scale));
            m.elastic_energy = m.elastic_energy + L::bending_energy(x.get(place.offset), x.get(other),
                                                                    static_cast<T>(spring.bending));
        }
    }
    return m;
}

template <class T>
void PlainCloth<T>::measure_blocks(const Call& call, const StepConstants<T>& c,
                                   std::span<const Collider> colliders, std::size_t begin, std::size_t end)
{
    for (std::size_t block = begin; block < end; ++block) {
        Measure values[block_size];
        const std::size_t first = block * block_size;
        const std::size_t count = std::min<std::size_t>(block_size, model.node_count() - first);
        for_each_node(first, first + count, [&](const Place& place) {
            const Vector x = position[call.parity].get(place.offset);
            Measure m = measured_springs(call, c, place);
            m = L::measure_node(m, x, velocity[call.parity].get(place.offset),
                                static_cast<T>(model.masses.kg[place.node]), c.gravity_direction);
            if (inverse_mass[place.offset] > T(0))
                for (const Collider& collider : colliders)
                    m.max_penetration =
                        L::largest(c.thickness - L::collider_gap(collider, x).w, m.max_penetration);
            values[place.node - first] = m;
        });
        std::fill(values + count, values + block_size, L::measure_of_nothing());
        measures[block] = merged(values);
    }
}

template <class T>
void PlainCloth<T>::merge_blocks(const Call& call, std::size_t begin, std::size_t end)
{
    const MeasureTree::Level from = tree.levels[call.index - 1], to = tree.levels[call.index];
    for (std::size_t block = begin; block < end; ++block) {
        Measure values[block_size];
        for (std::size_t k = 0; k < block_size; ++k) {
            const std::size_t source = block * block_size + k;
            values[k] = source < from.count ? measures[from.first + source] : L::measure_of_nothing();
        }
        measures[to.first + block] = merged(values);
    }
}

/// The fixed tree: adds halves until one value is left.
template <class T>
typename PlainCloth<T>::Measure PlainCloth<T>::merged(Measure* values)
{
    for (std::size_t half = block_size / 2; half > 0; half /= 2)
        for (std::size_t k = 0; k < half; ++k) values[k] = L::measure_merge(values[k], values[k + half]);
    return values[0];
}

template <class T>
void PlainCloth<T>::read(Resource resource, std::uint32_t parity, std::vector<float>& values) const
{
    values.clear();
    const auto push = [&](auto... numbers) { (values.push_back(static_cast<float>(numbers)), ...); };
    const std::size_t nodes = model.node_count();
    const auto push_planes = [&](const Planes<T>& planes) {
        values.assign(3 * nodes, 0.0f);
        if (planes.x.empty()) return;
        for_each_node(0, nodes, [&](const Place& place) {
            const Vector a = planes.get(place.offset);
            float* const to = &values[3 * place.node];
            to[0] = static_cast<float>(a.x);
            to[1] = static_cast<float>(a.y);
            to[2] = static_cast<float>(a.z);
        });
    };
    const auto push_numbers = [&](const AlignedArray<T>& numbers) {
        values.assign(nodes, 0.0f);
        if (numbers.empty()) return;
        for_each_node(0, nodes, [&](const Place& place) {
            values[place.node] = static_cast<float>(numbers[place.offset]);
        });
    };
    switch (resource) {
        case Resource::position: return push_planes(position[parity]);
        case Resource::next_position: return push_planes(position[1 - parity]);
        case Resource::velocity: return push_planes(velocity[parity]);
        case Resource::next_velocity: return push_planes(velocity[1 - parity]);
        case Resource::external_force: return push_planes(external_force);
        case Resource::spring_force:
            for (std::size_t s = 0; s < model.springs.list.size(); ++s) {
                const Vector a = spring_force.get(s);
                push(a.x, a.y, a.z);
            }
            return;
        case Resource::normal: return push_planes(normal);
        case Resource::strain: return push_numbers(strain);
        case Resource::measures:
            for (const Measure& m : measures)
                push(m.max_stretch, m.max_penetration, m.max_speed2, m.stretch_sum, m.kinetic_energy,
                     m.elastic_energy, m.height_moment, m.non_finite);
            return;
        case Resource::multiplier:
            if (!multiplier.empty()) push_numbers(multiplier);
            return;
        case Resource::colliders:
        case Resource::slopes:
        case Resource::motion:
        case Resource::vectors:
        case Resource::blocks:
        case Resource::flags:
        case Resource::scalars:
        case Resource::sums: return;  // see SolverState
        default: return body.read(resource, layout, values);
    }
}

template <class T>
MeasureTotals PlainCloth<T>::totals() const
{
    const Measure& m = measures[tree.levels.back().first];
    return {m.max_stretch,    m.max_penetration, m.max_speed2,    m.stretch_sum,
            m.kinetic_energy, m.elastic_energy,  m.height_moment, m.non_finite};
}

template class PlainCloth<double>;
template class PlainCloth<float>;

}  // namespace pliant

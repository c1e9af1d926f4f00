#include "backend/host/solver_state.hpp"

#include <algorithm>

#include "backend/host/solver_kernels.hpp"

namespace pliant {

template <class T>
SolverState<T>::SolverState(const ClothModel& model, const Hierarchy& hierarchy)
    : hierarchy_(&hierarchy),
      corrects_steps_(model.plan.corrects_steps()),
      arena_(hierarchy.number_count),
      scalars_(solver_scalar_count)
{
    if (hierarchy.empty()) return;
    set_first_numbers(model, hierarchy, arena_.data());
    const SolverLevel& cloth = hierarchy.levels.front();
    const SumParts sum_parts(model, hierarchy);
    part_stride_ = sum_parts.stride;
    parts_.assign(static_cast<std::size_t>(sum_parts.stride) * sum_slot_count, T(0));
    part_counts_.assign(sum_parts.counts.begin(), sum_parts.counts.end());
    mass_ = AlignedArray<T>(
        NodeLayout(static_cast<std::size_t>(cloth.rows), static_cast<std::size_t>(cloth.columns)).size);
    for (std::size_t i = 0; i < model.node_count(); ++i) take_mass(model, i);
}

template <class T>
void SolverState<T>::take_mass(const ClothModel& model, std::size_t node)
{
    if (hierarchy_->empty()) return;
    const SolverLevel& cloth = hierarchy_->levels.front();
    const NodeLayout layout(static_cast<std::size_t>(cloth.rows), static_cast<std::size_t>(cloth.columns));
    mass_[layout.offset(node)] = static_cast<T>(model.masses.kg[node]);
}

template <class T>
std::size_t SolverState<T>::size_of(const Call& call) const
{
    const std::size_t all = whole_size_of(call);
    if (!corrects_steps_ || !is_live(unit_of(call.pass))) return all;
    const SolverLevel* levels = hierarchy_->levels.data();
    const T* live = arena_.data() +
                    live_flags(call.pass, levels[call.level], levels[call.level > 0 ? call.level - 1 : 0]);
    return static_cast<std::size_t>(std::count_if(live, live + all, [](T flag) { return flag > T(0); }));
}

template <class T>
std::size_t SolverState<T>::whole_size_of(const Call& call) const
{
    const SolverLevel& level = hierarchy_->levels[call.level];
    const auto groups = [](auto count) {
        return static_cast<std::size_t>(sum_groups(static_cast<int>(count)));
    };
    switch (unit_of(call.pass)) {
        case PassUnit::single:
        case PassUnit::bottom: return 1;
        case PassUnit::spring_row: return groups(hierarchy_->constraints.springs);
        case PassUnit::constraint_row:
        case PassUnit::active_row: return groups(hierarchy_->constraints.constraints);
        case PassUnit::row_block: return hierarchy_->constraints.scan_blocks(call.detail);
        case PassUnit::edge:
        case PassUnit::live_edge: return groups(level.edges);
        case PassUnit::flag:
            return std::max(static_cast<std::size_t>(level.node_units()), groups(level.edges));
        case PassUnit::live_finer_node: return groups(hierarchy_->levels[call.level - 1].columns);
        default: return static_cast<std::size_t>(level.node_units());
    }
}

template <class T>
std::size_t SolverState<T>::weight_of(const Call& call) const
{
    const PassUnit unit = unit_of(call.pass);
    const SolverLevel& level = hierarchy_->levels[call.level];
    if (unit == PassUnit::row_block) return block_size;
    const bool over_rows = unit == PassUnit::level_node || unit == PassUnit::live_node ||
                           unit == PassUnit::numbered_node || unit == PassUnit::live_cell ||
                           unit == PassUnit::live_finer_cell;
    return level.rows > 1 && over_rows ? static_cast<std::size_t>(level.columns) : sum_columns;
}

template <class T>
const SolverContext<T>& SolverState<T>::context(const Call& call, PlainCloth<T>& cloth,
                                                const SolverConstants<T>& constants,
                                                std::span<const typename Laws<T>::Collider> colliders)
{
    const auto pointers = [](Planes<T>& a) { return NumberPlanes<T>{a.x.data(), a.y.data(), a.z.data()}; };
    SolverContext<T>& c = context_;
    c.arena = arena_.data();
    c.levels = hierarchy_->levels.data();
    c.topology = hierarchy_->topology.data();
    c.scalars = scalars_.data();
    c.parts = parts_.data();
    c.part_stride = part_stride_;
    c.part_counts = part_counts_.data();
    c.bottom_base = hierarchy_->bottom_base;
    c.position = pointers(cloth.position[call.parity]);
    c.velocity = pointers(cloth.velocity[call.parity]);
    c.next_position = pointers(cloth.position[1 - call.parity]);
    c.next_velocity = pointers(cloth.velocity[1 - call.parity]);
    c.external_force = pointers(cloth.external_force);
    c.multiplier = cloth.multiplier.data();
    c.inverse_mass = cloth.inverse_mass.data();
    c.mass = mass_.data();
    c.constants = &constants;
    c.colliders = colliders.data();
    c.collider_count = static_cast<int>(colliders.size());
    return c;
}

template <class T>
void SolverState<T>::run(const Call& call, const SolverContext<T>& context, std::size_t begin,
                         std::size_t end) const
{
    SolverKernels<T> kernels(context, call);
    if (is_single_pass(call.pass))
        kernels.run_single(call.pass);
    else
        kernels.run(call.pass, static_cast<int>(begin), static_cast<int>(end));
}

template class SolverState<double>;
template class SolverState<float>;

}  // namespace pliant

// Copies of a cloth's numbers that host backends save before a program, see Kept.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "backend/host/plain_cloth.hpp"
#include "backend/host/solver_state.hpp"

namespace pliant {

template <class T>
class KeptState {
public:
    void keep(const Kept& kept, PlainCloth<T>& cloth, const SolverState<T>& solver)
    {
        numbers_.clear();
        if (kept.state)
            for (const T* plane : planes(kept, cloth))
                numbers_.insert(numbers_.end(), plane, plane + cloth.layout.size);
        for (const ArenaRange& range : kept.numbers) {
            const auto part = solver.arena().subspan(range.first, range.count);
            numbers_.insert(numbers_.end(), part.begin(), part.end());
        }
        scalars_.assign(solver.scalars().begin(), solver.scalars().end());
    }
    void put_back(const Kept& kept, PlainCloth<T>& cloth, SolverState<T>& solver) const
    {
        std::span<const T> left = numbers_;
        const auto take = [&](std::size_t count) {
            const std::span<const T> part = left.first(count);
            left = left.subspan(count);
            return part;
        };
        if (kept.state)
            for (T* plane : planes(kept, cloth)) std::ranges::copy(take(cloth.layout.size), plane);
        for (const ArenaRange& range : kept.numbers) solver.put(range.first, take(range.count));
        solver.put_scalars(scalars_);
    }

private:
    static std::array<T*, 6> planes(const Kept& kept, PlainCloth<T>& cloth)
    {
        Planes<T>&x = cloth.position[kept.parity], &v = cloth.velocity[kept.parity];
        return {x.x.data(), x.y.data(), x.z.data(), v.x.data(), v.y.data(), v.z.data()};
    }

    std::vector<T> numbers_, scalars_;
};

}  // namespace pliant

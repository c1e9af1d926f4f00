#include "solve/newton_multigrid.hpp"

#include "solve/chosen_passes.hpp"
#include "solve/mass_spring.hpp"

namespace pliant {
namespace {

/// The tries of a line search: the whole Newton step, 1/4, 1/16, 1/256, 1/65536 of it, none.
constexpr std::uint32_t search_tries = 6;
/// If the residual is above 1 after the usual iterations, for example at an impact, a step gets this many
/// times as many.
constexpr std::uint32_t while_unsolved = 3;
constexpr int polishes_of_mesh = 3;

class StepWriter {
public:
    StepWriter(const ClothModel& cloth, std::uint32_t index, std::uint32_t step, std::uint32_t parity,
               std::vector<Call>& calls)
        : cloth_(cloth),
          index_(index),
          step_(step),
          parity_(parity),
          calls_(calls),
          level_count_(static_cast<std::uint32_t>(cloth.hierarchy.level_count())),
          on_mesh_(!cloth.plan.on_grid)
    {
    }

    void step()
    {
        add(Pass::step_begin);
        evaluate(Guard::none);
        add(Pass::solve_begin);
        const std::uint32_t enough = enough_iterations(cloth_), most = while_unsolved * enough;
        for (std::uint32_t k = 1; k <= most; ++k) {
            newton_iteration(k == most);
            if (cloth_.plan.meets_colliders && k == (enough + 1) / 2) renew_contact();
        }
        if (cloth_.limits.remembers_any()) {
            polish();
            add(on_mesh_ ? Pass::mesh_multiply : Pass::sheet_multiply);
        }
        add(Pass::step_end);
        add(Pass::solve_end);
    }

    /// A step of ACAD: springs alone, then a correction with limits for the springs that are too long.
    void acad_step()
    {
        add(on_mesh_ ? Pass::mesh_limits : Pass::sheet_limits);
        add(Pass::acad_check);
        for (std::uint32_t level = 0; level < level_count_; ++level) clear(level);
        add(on_mesh_ ? Pass::mesh_marks : Pass::sheet_marks, Guard::idle);
        for (std::uint32_t level = 0; level < level_count_; ++level)
            add(on_mesh_ ? Pass::mesh_live : Pass::sheet_live, Guard::idle, level);
        add(Pass::acad_begin, Guard::idle);
        evaluate(Guard::idle);
        add(Pass::solve_begin);
        const std::uint32_t most = enough_iterations(cloth_);
        for (std::uint32_t k = 1; k <= most; ++k) newton_iteration(k == most);
        add(Pass::acad_end, Guard::idle);
        add(Pass::solve_end);
    }

    /// The first linear system of a step, not solved.
    void linear_system()
    {
        add(Pass::step_begin);
        evaluate(Guard::none);
        add(Pass::solve_begin);
    }

    void prepare_linear_solve()
    {
        if (cloth_.plan.newton.preconditioner == Preconditioner::multigrid) coarsen();
        add(Pass::linear_begin, Guard::newton);
        add(Pass::linear_start, Guard::newton);
    }

    void linear_iteration()
    {
        precondition();
        add(Pass::linear_beta, Guard::linear);
        add(Pass::linear_direction, Guard::linear);
        add(on_mesh_ ? Pass::mesh_apply : Pass::linear_apply, Guard::linear);
        add(Pass::linear_alpha, Guard::linear);
        add(Pass::linear_update, Guard::linear);
        add(Pass::linear_check, Guard::linear);
    }

private:
    void add(Pass pass, Guard guard = Guard::none, std::uint32_t level = 0, std::uint32_t detail = 0)
    {
        calls_.push_back({pass, index_, parity_, step_, level, detail, guard});
    }

    /// Clears rows that were live in the last solve.
    void clear(std::uint32_t level)
    {
        add(on_mesh_ ? Pass::mesh_clear : Pass::sheet_clear, Guard::idle, level);
        if (on_mesh_) add(Pass::mesh_clear_edges, Guard::idle, level);
    }

    /// Energy, forces and operator at the displacement t.
    void evaluate(Guard guard, std::uint32_t look = 0)
    {
        if (on_mesh_) add(Pass::mesh_springs, guard);
        if (on_mesh_ && cloth_.hierarchy.levels.front().folds()) add(Pass::mesh_fold, guard);
        add(on_mesh_ ? Pass::mesh_gather : Pass::sheet_gather, guard, 0, look);
    }

    /// Reduces local errors. On a mesh one polish is not enough: a node at the border has three or four
    /// springs, all in one plane, and little resists motion across it. One polish moves the node out of that
    /// plane, which stretches its springs by some per cent; the next one brings it back.
    void polish()
    {
        const int times = on_mesh_ ? polishes_of_mesh : 1;
        for (int k = 0; k < times; ++k) {
            if (k > 0) evaluate(Guard::none, detail_polish_look);
            add(Pass::newton_polish);
        }
    }

    /// Updates the normal forces for the rest of the step.
    void renew_contact()
    {
        add(Pass::contact_change);
        add(Pass::contact_check);
        add(Pass::contact_keep, Guard::newton);
        evaluate(Guard::newton);
        add(Pass::contact_resume, Guard::newton);
    }

    void coarsen()
    {
        for (std::uint32_t level = 1; level < level_count_; ++level) {
            if (on_mesh_) add(Pass::mesh_coarsen_couplings, Guard::newton, level);
            add(on_mesh_ ? Pass::mesh_coarsen_nodes : Pass::sheet_coarsen, Guard::newton, level);
        }
        add(on_mesh_ ? Pass::mesh_bottom_factor : Pass::bottom_factor, Guard::newton, level_count_ - 1);
    }

    void newton_iteration(bool is_last)
    {
        prepare_linear_solve();
        for (std::uint32_t k = 0; k < cloth_.plan.newton.linear_iterations; ++k) linear_iteration();
        add(Pass::search_begin, Guard::newton);
        add(Pass::newton_move, Guard::newton);
        for (std::uint32_t k = 0; k < search_tries; ++k) {
            if (k > 0) add(Pass::search_move, Guard::search);
            evaluate(Guard::search, is_last && !cloth_.limits.remembers_any() ? detail_last_look : 0);
            add(Pass::search_check, Guard::search);
        }
        add(Pass::newton_check, Guard::newton);
    }

    void precondition()
    {
        switch (cloth_.plan.newton.preconditioner) {
            case Preconditioner::multigrid: return cycle(0);
            case Preconditioner::jacobi: return add(Pass::linear_jacobi, Guard::linear);
            case Preconditioner::none: return add(Pass::linear_plain, Guard::linear);
        }
    }

    /// A V-cycle from a level down. The pass that writes the level's residual also makes the first smoothing
    /// step, from zero, so the first correction exists already. The result is in the second copy.
    void cycle(std::uint32_t level)
    {
        if (level + 1 == level_count_) {
            add(Pass::bottom_solve, Guard::linear, level);
            return;
        }
        const std::uint32_t sweeps = cloth_.plan.newton.smoothing;
        const Pass smooth = on_mesh_ ? Pass::mesh_smooth : Pass::level_smooth;
        std::uint32_t copy = 0;
        for (std::uint32_t k = 1; k < sweeps; ++k, copy ^= 1)
            add(smooth, Guard::linear, level, detail_of(copy, k));
        add(on_mesh_ ? Pass::mesh_residual : Pass::level_residual, Guard::linear, level, detail_of(copy, 0));
        add(on_mesh_ ? Pass::mesh_restrict : Pass::sheet_restrict, Guard::linear, level + 1);
        cycle(level + 1);
        const std::uint32_t child = level + 2 == level_count_ ? 0 : 1;
        add(on_mesh_ ? Pass::mesh_prolong : Pass::sheet_prolong, Guard::linear, level + 1,
            detail_of(child, copy));
        for (std::uint32_t k = sweeps; k-- > 0; copy ^= 1)  // in reverse order, so that the cycle is
                                                            // symmetric
            add(smooth, Guard::linear, level, detail_of(copy, k));
    }

    const ClothModel& cloth_;
    std::uint32_t index_, step_, parity_;
    std::vector<Call>& calls_;
    std::uint32_t level_count_;
    bool on_mesh_;
};

}  // namespace

std::uint32_t enough_iterations(const ClothModel& cloth)
{
    // ACAD bounds strain by stiff limits that come and go; a step of it that is only half solved gains
    // energy.
    constexpr std::uint32_t of_acad = 4;
    return cloth.plan.newton.newton_iterations * (cloth.plan.method == Method::acad ? of_acad : 1);
}

void append_acad_step(const ClothModel& cloth, std::uint32_t index, std::uint32_t step, std::uint32_t parity,
                      std::vector<Call>& calls)
{
    append_mass_spring_step(cloth, index, step, parity, calls);
    StepWriter(cloth, index, step, parity, calls).acad_step();
}

void append_linear_system(const ClothModel& cloth, std::uint32_t index, std::uint32_t parity,
                          std::vector<Call>& calls)
{
    calls.push_back({Pass::solve_reset, index, parity, 0});
    StepWriter(cloth, index, 0, parity, calls).linear_system();
}

void append_linear_start(const ClothModel& cloth, std::uint32_t index, std::uint32_t parity,
                         std::vector<Call>& calls)
{
    StepWriter(cloth, index, 0, parity, calls).prepare_linear_solve();
}

void append_linear_iterations(const ClothModel& cloth, std::uint32_t index, std::uint32_t parity,
                              std::uint32_t count, std::vector<Call>& calls)
{
    StepWriter writer(cloth, index, 0, parity, calls);
    for (std::uint32_t k = 0; k < count; ++k) writer.linear_iteration();
}

void append_multipliers(const ClothModel& cloth, std::uint32_t index, std::uint32_t parity,
                        std::vector<Call>& calls)
{
    calls.push_back({passes_of(cloth.plan).multipliers, index, parity, 0});
}

void append_constraint_step(const ClothModel& cloth, std::uint32_t index, std::uint32_t step,
                            std::uint32_t parity, std::vector<Call>& calls)
{
    append_external_forces(cloth, index, step, parity, calls);
    append_attachments(cloth, index, step, parity, calls);
    StepWriter(cloth, index, step, parity, calls).step();
}

}  // namespace pliant

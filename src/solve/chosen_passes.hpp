// Which of the passes that do the same a cloth takes: those that go along a sheet's grid, or those that go by
// lists.
#pragma once

#include "body/stepping_plan.hpp"
#include "solve/pass.hpp"

namespace pliant {

struct ChosenPasses {
    Pass wind, normal;           ///< over triangles
    Pass step, measure, strain;  ///< over springs
    Pass multipliers;            ///< of the methods that have a solver
};

inline ChosenPasses passes_of(const SteppingPlan& plan)
{
    const bool grid = plan.on_grid, gathers = plan.node_centric;
    return {.wind = grid ? Pass::sheet_wind : Pass::mesh_wind,
            .normal = grid ? Pass::sheet_normal : Pass::mesh_normal,
            .step = gathers                ? Pass::sheet_step
                    : plan.gathers_rings() ? Pass::ring_step
                                           : Pass::list_step,
            .measure = gathers ? Pass::sheet_measure : Pass::list_measure,
            .strain = gathers ? Pass::sheet_strain : Pass::list_strain,
            .multipliers = plan.step == SteppingPlan::Step::paper ? Pass::paper_export
                           : grid                                 ? Pass::sheet_multipliers
                                                                  : Pass::mesh_multipliers};
}

}  // namespace pliant

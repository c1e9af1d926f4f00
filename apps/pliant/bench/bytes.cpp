#include "bench/bytes.hpp"

namespace pliant::tool {
namespace {

/// Sizes in a backend's layout, bytes.
struct Layout {
    double vector;        ///< of a node
    double spring_force;  ///< a vector of a spring
    double inverse_mass;  ///< 0 if it is stored in a vector's fourth number
    double number;        ///< a rest length, a stiffness
    double spring;        ///< a spring's parameters, without its ends
    double entry;         ///< of a node's list of spring forces
    double record;        ///< two vectors side by side, for gathers; 0 if vectors are gathered from planes
};
constexpr double index = 4;

Layout layout_of(Backend backend)
{
    switch (backend) {
        case Backend::vulkan: return {16, 16, 0, 4, 16, 8, 0};
        case Backend::reference: return {24, 32, 8, 8, 32, 8, 0};
        default: return {12, 16, 4, 4, 16, 4, 32};
    }
}

}  // namespace

double bytes_per_node_and_step(const ClothModel& model, Backend backend)
{
    const Layout layout = layout_of(backend);
    const double v = layout.vector, state = 2 * v, record = layout.record;  // position and velocity
    const double node = state + layout.inverse_mass;
    const double gathered = record > 0 ? record : state;
    const auto nodes = static_cast<double>(model.node_count());
    const double springs = static_cast<double>(model.springs.count) / nodes;
    if (model.plan.node_centric) return node + state;
    if (!model.plan.gathers_rings())
        return gathered + springs * (2 * index + layout.spring + layout.spring_force)         // spring_force
               + springs * (2 * layout.entry + layout.spring_force) + node + state + record;  // list_step

    const double own = record > 0 ? node : layout.inverse_mass;  // own data that is not gathered
    const double ring = 2 * springs * (index + layout.number);   // each spring from both its ends
    if (!model.plan.keeps_volume()) return own + gathered + ring + state + record;  // ring_step
    const double fans = static_cast<double>(model.body->fans.entries.size()) / nodes * index;
    const double gather = own + gathered + ring + 2 * v;               // predicted velocity and gradient
    const double step = 3 * v + layout.inverse_mass + 3 * v + record;  // and the direction
    const double cubic = fans + gathered;
    const double correct = 3 * v + state + record;
    return gather + step + cubic + correct;
}

}  // namespace pliant::tool

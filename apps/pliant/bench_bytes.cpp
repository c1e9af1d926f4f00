#include "bench_bytes.hpp"

namespace pliant::tool {
namespace {

/// Sizes in a backend's layout, bytes.
struct Layout {
    double vector;        ///< of a node or a spring
    double inverse_mass;  ///< 0 where it travels in a vector
    double number;        ///< a rest length, a stiffness
    double spring;        ///< what a spring is, without its ends
    double list_load;     ///< the external force that list_step always reads
};
constexpr double index = 4;

Layout layout_of(Backend backend)
{
    switch (backend) {
        case Backend::vulkan: return {16, 0, 4, 8, 0};
        case Backend::reference: return {24, 8, 8, 24, 24};
        default: return {12, 4, 4, 12, 12};
    }
}

}  // namespace

double bytes_per_node_and_step(const ClothModel& model, Backend backend)
{
    const Layout layout = layout_of(backend);
    const double v = layout.vector, state = 2 * v;  // position and velocity
    const double node = state + layout.inverse_mass;
    const auto nodes = static_cast<double>(model.node_count());
    const double springs = static_cast<double>(model.spring_count()) / nodes;
    if (model.node_centric()) return node + state + (backend == Backend::reference ? v : 0);
    if (!model.gathers_rings())
        return state + springs * (2 * index + layout.spring + v)                           // spring_force
               + index + springs * (2 * 2 * index + v) + node + layout.list_load + state;  // list_step

    const double ring = 2 * springs * (index + layout.number);  // each spring from both its ends
    if (!model.body->constrained) return node + ring + state;   // ring_step
    const double fans = static_cast<double>(model.body->fans.entries.size()) / nodes * index;
    const double gather = node + ring + 2 * v;                // predicted velocity and gradient
    const double step = 3 * v + layout.inverse_mass + 3 * v;  // and the direction
    const double cubic = fans + 2 * v;
    const double correct = 3 * v + state;
    return gather + step + cubic + correct;
}

}  // namespace pliant::tool

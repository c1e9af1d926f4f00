#include "solve/step_constants.hpp"

#include <algorithm>
#include <cmath>

namespace pliant {

template <class T>
StepConstants<T>::StepConstants(const ClothModel& model, double step_length)
{
    const auto number = [](double a) { return static_cast<T>(a); };
    const auto vector = [&](Vec3d a) { return Vector3<T>{number(a.x), number(a.y), number(a.z)}; };
    const ClothParameters& p = model.parameters;
    dt = number(step_length);
    inverse_dt = step_length > 0 ? T(1) / dt : T(0);
    decay = number(std::max(0.0, 1 - p.damping * step_length));
    thickness = number(p.thickness);
    gravity = vector(p.gravity);
    const double g = std::sqrt(dot(p.gravity, p.gravity));
    gravity_direction = vector(g > 0 ? p.gravity * (1 / g) : Vec3d{});
    wind = vector(p.wind);
    air_density = number(p.air_density);
    drag = number(p.drag);
    lift = number(p.lift);
    for (std::size_t k = 0; k < spring_class_count; ++k) {
        stiffness[k] = number(p.stiffness[k]);
        damping[k] = number(p.spring_damping[k]);
    }
    if (model.shape.sheet)
        for (std::size_t k = 0; k < 5; ++k) rest_lengths[k] = number(model.shape.sheet->rest_lengths[k]);
}

template <class T>
void StepConstants<T>::set(const GrabInput& grab)
{
    grabbed_node = grab.node;
    grab_target = {static_cast<T>(grab.target.x), static_cast<T>(grab.target.y),
                   static_cast<T>(grab.target.z)};
    grab_pull = static_cast<T>(grab.pull);
    grab_hold = static_cast<T>(grab.hold);
}

template struct StepConstants<double>;
template struct StepConstants<float>;

}  // namespace pliant

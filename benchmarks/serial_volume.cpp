#include "serial_volume.hpp"

namespace pliant::serial {
namespace {

constexpr float sixth = 1.0f / 6.0f;

/// dV/dx of all nodes, and V: the first loop of algorithm 2.
double add_up_jacobian(Body& body)
{
    body.jacobian.assign(body.skin.nodes.size(), {});
    double sixfold = 0;
    for (const auto& triangle : body.triangles) {
        const Vector a = body.skin.nodes[triangle[0]].position;
        const Vector b = body.skin.nodes[triangle[1]].position;
        const Vector c = body.skin.nodes[triangle[2]].position;
        const Vector of_a = cross(b, c);
        sixfold += double{dot(a, of_a)};
        body.jacobian[triangle[0]] += of_a * sixth;
        body.jacobian[triangle[1]] += cross(c, a) * sixth;
        body.jacobian[triangle[2]] += cross(a, b) * sixth;
    }
    return sixfold / 6;
}

}  // namespace

double volume_of(const Body& body)
{
    double sixfold = 0;
    for (const auto& triangle : body.triangles)
        sixfold +=
            double{dot(body.skin.nodes[triangle[0]].position,
                       cross(body.skin.nodes[triangle[1]].position, body.skin.nodes[triangle[2]].position))};
    return sixfold / 6;
}

void step(Body& body, float dt)
{
    Cloth& skin = body.skin;
    add_up_spring_forces(skin);
    const double volume = add_up_jacobian(body);

    // J M^-1 J^T lambda = Phi / dt^2 + J (v / dt + M^-1 f)
    const float decay = 1.0f - skin.damping * dt, inverse_dt = 1.0f / dt;
    double left = 0, right = (volume - body.wanted_volume) * double{inverse_dt} * double{inverse_dt};
    for (std::size_t i = 0; i < skin.nodes.size(); ++i) {
        const Node& node = skin.nodes[i];
        if (node.inverse_mass == 0.0f) continue;
        const Vector& j = body.jacobian[i];
        left += double{dot(j, j) * node.inverse_mass};
        right += double{
            dot(j, node.velocity * (decay * inverse_dt) + node.force * node.inverse_mass + skin.gravity)};
    }
    const float multiplier = left > 0 ? static_cast<float>(right / left) : 0.0f;
    for (std::size_t i = 0; i < skin.nodes.size(); ++i) skin.nodes[i].force -= body.jacobian[i] * multiplier;

    integrate(skin, dt);
}

}  // namespace pliant::serial

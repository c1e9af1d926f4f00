#include "serial_cloth.hpp"

#include <algorithm>
#include <cmath>

namespace pliant::serial {
namespace {

/// Takes a node that is `gap` < 0 deep out along `normal`; removes the approaching velocity, and of the
/// tangential one what friction can.
void leave(Node& node, Vector normal, float gap, float friction, float dt)
{
    const float approach = dot(node.velocity, normal);
    const Vector tangential = node.velocity - normal * approach;
    const float speed = std::sqrt(dot(tangential, tangential));
    const float lost = friction * std::max(-approach, 0.0f);
    const float kept = speed > lost ? 1.0f - lost / speed : 0.0f;
    const Vector next = tangential * kept + normal * std::max(approach, 0.0f);
    node.position += (tangential * kept - tangential) * dt - normal * gap;
    node.velocity = next;
}

void collide(Node& node, const Cloth& cloth, float dt)
{
    for (const Sphere& sphere : cloth.spheres) {
        const Vector away = node.position - sphere.centre;
        const float square = dot(away, away);
        if (square >= sphere.radius * sphere.radius || square == 0.0f) continue;
        const float distance = std::sqrt(square);
        leave(node, away * (1.0f / distance), distance - sphere.radius, sphere.friction, dt);
    }
    for (const Plane& plane : cloth.planes) {
        const float gap = dot(node.position - plane.point, plane.normal) - plane.thickness;
        if (gap < 0.0f) leave(node, plane.normal, gap, plane.friction, dt);
    }
}

}  // namespace

void add_up_spring_forces(Cloth& cloth)
{
    for (Node& node : cloth.nodes) node.force = {};
    for (const Spring& spring : cloth.springs) {
        Node& a = cloth.nodes[spring.i];
        Node& b = cloth.nodes[spring.j];
        const Vector d = b.position - a.position;
        const float length = std::sqrt(dot(d, d));
        if (length == 0.0f) continue;
        const Vector n = d * (1.0f / length);
        const float size = spring.stiffness * (length - spring.rest_length) +
                           spring.damping * dot(b.velocity - a.velocity, n);
        const Vector force = n * size;
        a.force += force;
        b.force -= force;
    }
}

void integrate(Cloth& cloth, float dt)
{
    const float decay = 1.0f - cloth.damping * dt;
    const bool collides = !cloth.spheres.empty() || !cloth.planes.empty();
    for (Node& node : cloth.nodes) {
        if (node.inverse_mass == 0.0f) continue;
        node.velocity = node.velocity * decay + (node.force * node.inverse_mass + cloth.gravity) * dt;
        node.position += node.velocity * dt;
        if (collides) collide(node, cloth, dt);
    }
}

void step(Cloth& cloth, float dt)
{
    add_up_spring_forces(cloth);
    integrate(cloth, dt);
}

}  // namespace pliant::serial

// The baseline of `pliant bench`: cloth as the paper's CPU implementation steps it (Va, Choi, Hong 2021,
// section 3 and figure 7). An array of structures, a list of springs whose forces are added at both ends, one
// thread, plain floats and the compiler's square root. Nothing of Pliant's laws or kernels is in it, and the
// library never uses it.
#pragma once

#include <cstdint>
#include <vector>

namespace pliant::serial {

struct Vector {
    float x = 0, y = 0, z = 0;
};
constexpr Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vector operator*(Vector a, float s) { return {a.x * s, a.y * s, a.z * s}; }
constexpr Vector& operator+=(Vector& a, Vector b) { return a = a + b; }
constexpr Vector& operator-=(Vector& a, Vector b) { return a = a - b; }
constexpr float dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vector cross(Vector a, Vector b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

struct Node {
    Vector position;         ///< m
    Vector velocity;         ///< m/s
    Vector force;            ///< N
    float inverse_mass = 0;  ///< 1/kg; 0: pinned
};
struct Spring {
    std::uint32_t i = 0, j = 0;
    float rest_length = 0;  ///< m
    float stiffness = 0;    ///< N/m
    float damping = 0;      ///< N s/m
};
/// At rest, with Coulomb friction.
struct Sphere {
    Vector centre;     ///< m
    float radius = 0;  ///< m, with the thickness of the cloth
    float friction = 0;
};
struct Plane {
    Vector point, normal;  ///< m; of length 1
    float thickness = 0;   ///< m
    float friction = 0;
};

struct Cloth {
    std::vector<Node> nodes;
    std::vector<Spring> springs;
    std::vector<Sphere> spheres;
    std::vector<Plane> planes;
    Vector gravity;     ///< m/s2
    float damping = 0;  ///< 1/s
};

/// Sets the force of every node to the sum of its springs': eq. (1)-(2).
void add_up_spring_forces(Cloth& cloth);
/// Velocities and positions from forces, symplectic Euler (eq. 7-8), then colliders.
void integrate(Cloth& cloth, float dt);
/// Both: one step of `dt` s.
void step(Cloth& cloth, float dt);

}  // namespace pliant::serial

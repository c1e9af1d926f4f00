// The bindings of a cloth's buffers, for shaders and for C++ (bindings.hpp), which define UNIFORM_BLOCK and STORAGE.
UNIFORM_BLOCK(parameters, 0)  // Parameters
STORAGE(position_in, 1)  // 3 floats, m; w: inverse mass, 1/kg
STORAGE(velocity_in, 2)  // 3 floats, m/s; w: mass, kg
STORAGE(position_out, 3)  // as position_in
STORAGE(velocity_out, 4)  // as velocity_in
STORAGE(external_force, 5)  // 3 floats, N
STORAGE(colliders, 6)  // rows of 4 floats: colliders (ColliderRow), positions of attached nodes, targets of bodies
STORAGE(springs, 7)  // nodes i < j
STORAGE(spring_rest_class, 8)  // m, class, scale, bending in N/m
STORAGE(neighbour_start, 9)  // CSR by node
STORAGE(neighbours, 10)  // node, spring
STORAGE(triangles, 11)  // three nodes each
STORAGE(triangle_start, 12)  // CSR by node
STORAGE(node_triangles, 13)  // triangle
STORAGE(spring_force, 14)  // 3 floats, N, on node i
STORAGE(normal, 15)  // 3 floats
STORAGE(strain, 16)  // 1 float
STORAGE(measures, 17)  // 8 floats per value
UNIFORM_BLOCK(solver, 18)  // SolverBlock
STORAGE(solver_arena, 19)  // floats: kernels/planes.kernel.glsl
STORAGE(solver_scalars, 20)  // floats: the same
STORAGE(solver_parts, 21)  // floats: a row for each sum
STORAGE(solver_topology, 22)  // integers
STORAGE(multiplier, 23)  // 1 float, N
STORAGE(body_topology, 24)  // integers
STORAGE(gradient, 25)  // 3 floats, m2
STORAGE(direction, 26)  // 3 floats
STORAGE(blocked, 27)  // 4 floats
STORAGE(body_sums, 28)  // 4 floats
STORAGE(slopes, 29)  // position and velocity, alternating

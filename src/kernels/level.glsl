// One level of the hierarchy of a cloth's solver, for shaders and for C++ (SolverLevel of body/hierarchy.hpp): offsets into
// the arena and into `topology`.
struct LevelNumbers
{
    int rows, columns;
    int stride;  // numbers from a row to the next
    int base;    // of plane 0
    int size;    // numbers of a plane
    // Meshes only. Edges couple nodes; on the finest level they are the springs. Edges between free nodes come first, then
    // those to a pinned node, then loose ones: folded bend springs.
    int edges;
    int edge_base;  // of plane 0 of the edges; k numbers of edge e from plane p on are at
    int edge_size;  // edge_base + p edge_size + k e
    // Offsets into `topology`. A "start" table has the first entry of each node's or edge's row, and the end of the last
    // row.
    int edge_ends;   // offset, offset and spring class of each edge
    int row_start;   // by node: pairs (offset of the neighbour, edge)
    int held_start;  // by node of the cloth: the same for pinned neighbours
    // Interpolation between this level and the finer one: pairs (source, weight); a weight is stored as the bits of a float.
    int parents_start;   // by node of the finer level; sources are offsets on this level
    int children_start;  // by node; sources are offsets on the finer level
    int loose_start;     // by node of the cloth: as row_start, for loose springs
    int coupling_start;  // by edge; sources are blocks of the finer level, see mesh.kernel.glsl
    // ACAD: where in the arena the flags of live rows begin (acad.kernel.glsl); on a mesh, of groups of nodes and of edges.
    int live, live_edges;
    // The cloth's level: the first edge to a pinned node, and the first loose edge. `fold_start`: for each edge before them,
    // the weighted sum of blocks that makes its block.
    int held, loose, fold_start;
    int reserved_0, reserved_1, reserved_2, reserved_3;  // pads to a multiple of 16 bytes for std140
};

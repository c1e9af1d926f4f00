// A level of the hierarchy of a cloth's solver, for shaders and for C++ (SolverLevel of body/hierarchy.hpp): where its numbers
// lie in the arena, and places in `topology`.
struct LevelNumbers
{
    int rows, columns;
    int stride;  // numbers from a row to the next
    int base;    // of plane 0
    int size;    // numbers of a plane
    // Of a mesh's level only. Edges are what couples nodes: on the cloth its springs. Those between free nodes come first,
    // then those that hold one to a pinned node, then loose ones: bend springs that are folded.
    int edges;
    int edge_base;  // of plane 0 of the edges; k numbers of edge e from plane p on are at
    int edge_size;  // edge_base + p edge_size + k e
    // Places in `topology`; "start" is where a row begins for each node or edge, and one more.
    int edge_ends;   // offset, offset, class of springs for each edge
    int row_start;   // of nodes: pairs (offset of the neighbour, edge)
    int held_start;  // of the cloth's nodes: the same for pinned neighbours
    // How this level comes from the finer one: pairs (source, weight), the weight being the bits of a float.
    int parents_start;   // of the finer level's nodes; sources are offsets on this one
    int children_start;  // of nodes; sources are offsets on the finer one
    int loose_start;     // of the cloth's nodes: as row_start, of loose springs
    int coupling_start;  // of edges; sources are blocks of the finer one, see mesh.kernel.glsl
    // Of ACAD: where in the arena the flags of rows begin that take part in a solve (acad.kernel.glsl); on a mesh, of groups
    // of nodes and of edges.
    int live, live_edges;
    // Of the cloth: the first edge that holds a node, and the first that is loose. Those before have a row each of blocks
    // that make theirs, by weights.
    int held, loose, fold_start;
    int reserved_0, reserved_1, reserved_2, reserved_3;  // a multiple of 16 bytes, as std140 asks
};

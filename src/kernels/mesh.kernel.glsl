// The solver on meshes: smoothed aggregation. Data of springs, and of couplings on coarser levels, is stored by edge.
// `topology` has the connectivity as integers: tables of starts, and rows of pairs. Weights in it are the bits of a float.
// Operators have the same form as on sheets,
//   (A x)_i = s_i x_i + sum_e B_e (x_i - x_j),
// and the blocks of a level are numbered: first its couplings B, then its row sums s.
// Sources: body/mesh_hierarchy.hpp; kernels/sheet.kernel.glsl.

KERNEL int mesh_node(int o)
{
    return o - level_offset(0, 0);
}

// The factor on a spring's stiffness: its own grade, times 0 where ACAD has not marked it.
KERNEL real mesh_scale(int e)
{
    real scale = is_graded() ? edge_load(edge_scale, e) : real(1.0f);
    return is_acad() ? scale * edge_load(edge_mark, e) : scale;
}

// Adds a spring's part of the quadratic bending energy (body/bending.hpp): a spring of rest length zero.
KERNEL SpringShare bent(SpringShare spring, vec3 d, real weight)
{
    spring.force = spring.force + d * weight;
    spring.block = plus(spring.block, symmetric_diagonal(weight));
    spring.energy = spring.energy + 0.5f * weight * dot3(d, d);
    return spring;
}

KERNEL int mesh_class(int e)
{
    return topology(level.edge_ends + 3 * e + 2);
}
KERNEL LimitCurve mesh_limit(int e, int spring_class)
{
    LimitCurve curve = class_curve(spring_class);
    if (!remembers(spring_class)) return curve;
    return remembered(curve, edge_load(edge_slip, e), edge_load(edge_stiff, e), softest_of_edge(e, spring_class));
}

// ACAD handles bending in its explicit step; its solve has limits only.
KERNEL SpringShare with_bending(int e, SpringShare spring, vec3 d)
{
    if (is_graded() && !is_acad()) spring = bent(spring, d, edge_load(edge_bending, e));
    return spring;
}
KERNEL real mesh_taut(SpringShare spring)
{
    return choose(magnitude(spring.multiplier) > 0.0f, real(1.0f), real(0.0f));
}

// A sum of blocks of this level or of the finer one, over the row of pairs at `start`.
KERNEL Symmetric mesh_sum_of_blocks(bool of_finer, int start)
{
    Symmetric a = symmetric_diagonal(real(0.0f));
    for (int k = topology(start), end = topology(start + 1); k < end; k += 2) {
        int e = topology(k);
        a = plus_scaled(a, of_finer ? finer_edge_load6(edge_block, e) : edge_load6(edge_block, e), topology_weight(k + 1));
    }
    return a;
}

KERNEL void mesh_springs(int e)
{
    int ends = level.edge_ends + 3 * e;
    int i = topology(ends), j = topology(ends + 1);
    vec3 start = load3(plane_start, j) - load3(plane_start, i), moved = load3(plane_way, j) - load3(plane_way, i);
    SpringShare spring =
        spring_share(damped_between(mesh_limit(e, mesh_class(e)), i, j), start, moved, damper_between(start, i, j),
                     edge_load(edge_rest, e), mesh_scale(e));
    spring = with_bending(e, spring, start + moved);
    edge_store3(edge_force, e, spring.force);
    edge_store6(edge_block, e, spring.block);
    edge_store(edge_taut, e, mesh_taut(spring));
    sums[0] = sums[0] + spring.energy;
}

// As sheet_multiply. d: x_j - x_i
KERNEL RenewedLimit mesh_renewed(int e, int spring_class, vec3 d)
{
    return renewed(mesh_limit(e, spring_class), dot3(d, d), edge_load(edge_rest, e), spring_class, bare_softest_of_edge(e));
}
KERNEL void mesh_multiply(int e)
{
    int ends = level.edge_ends + 3 * e, spring_class = mesh_class(e);
    if (!remembers(spring_class)) return;
    int i = topology(ends), j = topology(ends + 1);
    vec3 d = load3(plane_start, j) - load3(plane_start, i) + (load3(plane_way, j) - load3(plane_way, i));
    RenewedLimit limit = mesh_renewed(e, spring_class, d);
    edge_store(edge_slip, e, limit.memory.slip);
    edge_store(edge_stiff, e, limit.memory.stiffness);
    sums[0] = sums[0] + limit.energy * mesh_scale(e);
}

// Loose bend springs couple no nodes: their blocks are added to those of the sides of their triangles (folds_of in
// body/mesh_hierarchy.cpp). A row lists the side's own block first.
KERNEL void mesh_fold(int e)
{
    if (e >= level.loose) return;
    edge_store6(edge_block, e, mesh_sum_of_blocks(false, level.fold_start + e));
}

// Force on a node and its row of the operator, from the node itself and its springs.
struct MeshNode
{
    vec3 r;
    Symmetric row_sum;   // later the diagonal
    real taut;
    real mass, energy, contact_energy;
};
KERNEL MeshNode mesh_node_alone(int o)
{
    vec3 q = load3(plane_start, o), t = load3(plane_way, o);
    MeshNode node;
    node.mass = load(plane_mass, o);
    vec3 ahead = t - load3(plane_aim, o);
    Contact contact = contact_at(o, q, t);
    node.r = ahead * (real(0.0f) - node.mass) + contact.force;
    node.row_sum = plus(symmetric_diagonal(node.mass), contact.stiffness);
    node.taut = real(0.0f);
    node.energy = 0.5f * node.mass * dot3(ahead, ahead);
    node.contact_energy = choose(node.mass > 0.0f, contact.energy, real(0.0f));
    return node;
}
// side: 1 at the spring's first node, -1 at its second
KERNEL MeshNode with_spring(MeshNode node, vec3 force, Symmetric block, real side)
{
    node.r = plus_scaled(node.r, force, side);
    node.row_sum = plus(node.row_sum, block);
    return node;
}
KERNEL void leave_mesh_node(int o, MeshNode node)
{
    mask is_free = node.mass > 0.0f;
    store(plane_active, o, node.taut);
    store6(plane_factor, o, where_else_zero(is_free, factored(node.row_sum, node.mass)));
    store3(plane_residual, o, choose(is_free, node.r, vec3(real(0.0f), real(0.0f), real(0.0f))));
    sums[0] = sums[0] + node.energy;
    sums[1] = sums[1] + node.contact_energy;
}

// The force of a loose spring. Its block is added to other edges.
KERNEL MeshNode with_force(MeshNode node, vec3 force, real side)
{
    node.r = plus_scaled(node.r, force, side);
    return node;
}

// A spring to a pinned node adds to this node's row sum. A taut spring is counted at its free node of lower index.
KERNEL void mesh_gather(int o)
{
    int index = mesh_node(o);
    MeshNode node = mesh_node_alone(o);
    for (int k = topology(level.held_start + index); k < topology(level.held_start + index + 1); k += 2) {
        int e = topology(k + 1);
        real side = real(topology(k) > o ? 1.0f : -1.0f);
        node = with_spring(node, edge_load3(edge_force, e), edge_load6(edge_block, e), side);
        node.taut = node.taut + edge_load(edge_taut, e);
    }
    edge_store6(edge_block, level.edges + index, where_else_zero(node.mass > 0.0f, node.row_sum));
    for (int k = topology(level.loose_start + index); k < topology(level.loose_start + index + 1); k += 2)
        node = with_force(node, edge_load3(edge_force, topology(k + 1)), real(topology(k) > o ? 1.0f : -1.0f));
    for (int k = topology(level.row_start + index); k < topology(level.row_start + index + 1); k += 2) {
        int e = topology(k + 1);
        bool ahead_of = topology(k) > o;
        node = with_spring(node, edge_load3(edge_force, e), edge_load6(edge_block, e), real(ahead_of ? 1.0f : -1.0f));
        if (ahead_of) node.taut = node.taut + edge_load(edge_taut, e);
    }
    leave_mesh_node(o, node);
}

// (A x) of a node. Vectors are 0 at pinned nodes, which have no couplings.
KERNEL vec3 mesh_row_product(int x, int o)
{
    int node = mesh_node(o);
    vec3 own = load3(x, o);
    vec3 y = product(edge_load6(edge_block, level.edges + node), own);
    int end = topology(level.row_start + node + 1);
    for (int k = topology(level.row_start + node); k < end; k += 2)
        y = y + product(edge_load6(edge_block, topology(k + 1)), own - load3(x, topology(k)));
    return y;
}

// As linear_apply, level_smooth and level_residual do for sheets.
KERNEL void mesh_apply(int o)
{
    leave_applied(o, mesh_row_product(plane_direction, o));
}
KERNEL void mesh_smooth(int o)
{
    leave_smoothed(o, mesh_row_product(source_plane(), o));
}
KERNEL void mesh_residual(int o)
{
    leave_residual(o, mesh_row_product(source_plane(), o));
}

KERNEL void mesh_coarsen_couplings(int e)
{
    edge_store6(edge_block, e, mesh_sum_of_blocks(true, level.coupling_start + e));
}

KERNEL void mesh_coarsen_nodes(int o)
{
    int node = mesh_node(o), finer_first = finer_offset(0, 0);
    Symmetric row_sum = symmetric_diagonal(real(0.0f));
    int end = topology(level.children_start + node + 1);
    for (int k = topology(level.children_start + node); k < end; k += 2) {
        int f = finer.edges + topology(k) - finer_first;
        row_sum = plus_scaled(row_sum, finer_edge_load6(edge_block, f), topology_weight(k + 1));
    }
    edge_store6(edge_block, level.edges + node, row_sum);
    Symmetric diagonal = row_sum;
    for (int k = topology(level.row_start + node); k < topology(level.row_start + node + 1); k += 2)
        diagonal = plus(diagonal, edge_load6(edge_block, topology(k + 1)));
    store6(plane_factor, o, factored(diagonal, real(0.0f)));
}

// The residual of the finer level, restricted, and the first correction of this level.
KERNEL void leave_restricted(int o, vec3 r)
{
    store3(plane_residual, o, r);
    store3(plane_correction, o, solved(load6(plane_factor, o), r) * relaxation());
}
KERNEL void mesh_restrict(int o)
{
    int node = mesh_node(o);
    vec3 r = vec3(real(0.0f), real(0.0f), real(0.0f));
    int end = topology(level.children_start + node + 1);
    for (int k = topology(level.children_start + node); k < end; k += 2)
        r = plus_scaled(r, finer_load3(plane_left, topology(k)), topology_weight(k + 1));
    leave_restricted(o, r);
}

// Adds the correction of this level to node f of the finer one.
KERNEL void mesh_prolong(int f)
{
    int node = f - finer_offset(0, 0);
    vec3 z = finer_load3(finer_plane(), f);
    int end = topology(level.parents_start + node + 1);
    for (int k = topology(level.parents_start + node); k < end; k += 2)
        z = plus_scaled(z, load3(source_plane(), topology(k)), topology_weight(k + 1));
    finer_store3(finer_plane(), f, z);
}

// The operator of the coarsest level, dense and factored.
KERNEL void mesh_bottom_factor()
{
    bottom_clear();
    for (int i = 0; i < level.columns; ++i)
        bottom_add(i, i, edge_load6(edge_block, level.edges + i), real(1.0f));
    for (int e = 0; e < level.edges; ++e) {
        int i = mesh_node(topology(level.edge_ends + 3 * e)), j = mesh_node(topology(level.edge_ends + 3 * e + 1));
        Symmetric b = edge_load6(edge_block, e);
        bottom_add(i, i, b, real(1.0f));
        bottom_add(j, j, b, real(1.0f));
        bottom_add(j, i, b, real(-1.0f));  // the lower triangle
    }
    bottom_eliminate();
}

// --- ACAD, as in acad.kernel.glsl for sheets ---------------------------------------------------------------------------

KERNEL void mesh_limits(int o)
{
    int node = mesh_node(o);
    vec3 x = node_next_position(o);
    for (int list = 0; list < 2; ++list) {
        int start = (list == 0 ? level.row_start : level.held_start) + node;
        for (int k = topology(start); k < topology(start + 1); k += 2) {
            if (list == 0 && topology(k) < o) continue;
            int e = topology(k + 1);
            vec3 d = node_next_position(topology(k)) - x;
            mask held = edge_load(edge_mark, e) > real(acad_has_memory() ? 0.0f : 2.0f);
            mask over = is_overstretched(dot3(d, d), edge_load(edge_rest, e), held);
            sums[0] = sums[0] + choose(over, real(1.0f), real(0.0f));
            sums[1] = sums[1] + squared_excess(dot3(d, d), edge_load(edge_rest, e));
        }
    }
}

KERNEL void mesh_marks(int e)
{
    int ends = level.edge_ends + 3 * e;
    vec3 d = node_next_position(topology(ends + 1)) - node_next_position(topology(ends));
    mask held = edge_load(edge_mark, e) > real(acad_has_memory() ? 0.0f : 2.0f);
    mask near = is_near_threshold(dot3(d, d), edge_load(edge_rest, e), held);
    edge_store(edge_mark, e, choose(near, real(1.0f), real(0.0f)));
}

// The live groups of nodes and of edges, as the live rows of sheets in acad.kernel.glsl.
KERNEL void mesh_clear(int o)
{
    clear_node(o);
    edge_store6(edge_block, level.edges + mesh_node(o), symmetric_diagonal(real(0.0f)));
}
KERNEL void mesh_clear_edges(int e)
{
    edge_store6(edge_block, e, symmetric_diagonal(real(0.0f)));
    if (!is_cloth()) return;
    edge_store3(edge_force, e, vec3(real(0.0f), real(0.0f), real(0.0f)));
    edge_store(edge_taut, e, real(0.0f));
}

// Whether a marked spring ends at this node.
KERNEL bool is_at_marked(int node)
{
    for (int list = 0; list < 2; ++list) {
        int start = (list == 0 ? level.row_start : level.held_start) + node;
        for (int k = topology(start); k < topology(start + 1); k += 2)
            if (whole(edge_load(edge_mark, topology(k + 1))) > 0) return true;
    }
    return false;
}
// Whether this node of a coarser level interpolates to a live node.
KERNEL bool has_live_child(int node)
{
    for (int k = topology(level.children_start + node); k < topology(level.children_start + node + 1); k += 2)
        if (whole(number(finer.live + (topology(k) - finer_offset(0, 0)) / sum_columns)) > 0) return true;
    return false;
}
// Whether this coupling of a coarser level is made from a live block.
KERNEL bool has_live_source(int e)
{
    for (int k = topology(level.coupling_start + e); k < topology(level.coupling_start + e + 1); k += 2) {
        int block = topology(k), node = block - finer.edges;
        int flag = node < 0 ? finer.live_edges + block / sum_columns : finer.live + node / sum_columns;
        if (whole(number(flag)) > 0) return true;
    }
    return false;
}
KERNEL void mesh_live(int group)
{
    int first = group * sum_columns, end = first + sum_columns;
    int last_node = end < level.columns ? end : level.columns, last_edge = end < level.edges ? end : level.edges;
    bool live = false;
    for (int node = first; node < last_node && !live; ++node)
        live = is_cloth() ? is_at_marked(node) : has_live_child(node);
    if (first < level.columns) set_number(level.live + group, real(live ? 1.0f : 0.0f));
    live = false;
    for (int e = first; e < last_edge && !live; ++e)
        live = is_cloth() ? whole(edge_load(edge_mark, e)) > 0 : has_live_source(e);
    if (first < level.edges) set_number(level.live_edges + group, real(live ? 1.0f : 0.0f));
}

// The largest force of a constraint at a node, N.
KERNEL void mesh_multipliers(int o)
{
    int node = mesh_node(o);
    vec3 x = load3(plane_start, o) + load3(plane_way, o);
    real most = real(0.0f);
    for (int list = 0; list < 2; ++list) {
        int start = (list == 0 ? level.row_start : level.held_start) + node;
        for (int k = topology(start); k < topology(start + 1); k += 2) {
            int e = topology(k + 1), j = topology(k);
            vec3 d = load3(plane_start, j) + load3(plane_way, j) - x;
            real length2 = dot3(d, d), rest = edge_load(edge_rest, e);
            SpringState state = spring_state(mesh_limit(e, mesh_class(e)), length2, inverse_sqrt(length2), rest);
            most = largest(magnitude(state.multiplier * mesh_scale(e)), most);
        }
    }
    set_multiplier(o, choose(scalar(scalar_idle) > 0.0f, real(0.0f), most));
}

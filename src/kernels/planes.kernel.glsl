// Padding: a plane begins with border_rows rows, and each row with row_pad columns, that hold no node.
const int border_rows = 2, row_pad = 16;

// The solver's planes, by number. Each level of the hierarchy has planes of its own size and layout; level 0, the cloth
// itself, has some more. Vectors take three planes, blocks six.

const int plane_residual = 0;        // right-hand side, then residual of the linear system, N
const int plane_correction = 3;      // correction, and its second copy, m
const int plane_correction_2 = 6;
const int plane_left = 9;            // residual of the correction, N
const int plane_mass = 12;           // m / dt^2, N/m; 0 for a pin. This and the next two planes exist on the cloth's level
                                     // only
const int plane_grip = 13;           // friction: its largest force, N
const int plane_active = 14;         // number of active constraints at a node
// The operator; the CPU stores it node by node (SolverKernels::at):
const int plane_block = 15;          // couplings to the four forward neighbours of a sheet: B of -B at (i, j), N/m
const int plane_row_sum = 39;        // row sum of the operator: inertia, pins, contact, N/m
const int plane_factor = 45;         // the diagonal block, factored
const int level_planes = 51;

const int plane_start = 51;          // m, position at the start of the step
const int plane_accepted = 54;       // m, displacement at the end of the last Newton iteration
const int plane_aim = 57;            // m, displacement by inertia, gravity and wind alone
const int plane_way = 60;            // m, displacement that is evaluated
const int plane_step = 63;           // m, the Newton step
const int plane_direction = 66;      // direction of conjugate gradients, and its product with the operator
const int plane_applied = 69;
const int plane_slide = 72;          // friction: normal, displacement of the surface (m)
const int plane_drag = 75;
// Kept from step to step: the number, from 1 on, of the collider that a node touches; the normal force, N; and how much
// stiffer than the basic stiffness the node's contact is: the factor less 1.
const int plane_touched = 78;
const int plane_press = 79;
const int plane_firm = 80;
const int node_planes = 81;

// One for each of the six forward springs of a sheet's node; on a mesh they are stored by spring.
const int plane_scale = 81;          // factor on the stiffness; 0 if the sheet has no such spring
const int plane_mark = 87;           // ACAD: 1 if the spring is a limit in this step
// Limits with memory, one for each of the first four springs: LimitMemory, kept from step to step; 0 if new.
const int plane_slip = 93;           // m
const int plane_stiff = 97;          // N/m
const int sheet_planes = 101;
// Where bend springs are constraints: their blocks, and the couplings along rows and columns after folding.
const int plane_bend = 101;
const int plane_fold = 113;
const int bent_sheet_planes = 125;

// The previous step, for second-order steps: the planes from history_plane() on, after all others of a node, kept from step
// to step.
const int history_way = 0;           // m, its displacement
const int history_velocity = 3;      // m/s, its velocity at the start
const int history_step = 6;          // s, its length; 0 if the next step is first order
const int history_force = 7;         // N, wind force at its start
const int history_planes = 10;

// By spring of a mesh; a coupling of a coarser level has the block alone. Row sums of nodes follow the blocks.
const int edge_block = 0;            // N/m
const int edge_force = 6;            // N, on the first node
const int edge_taut = 9;             // 1 for an active constraint
const int edge_rest = 10;            // m
const int edge_mark = 11;            // ACAD: 1 if the spring is a limit in this step
const int edge_scale = 12;           // graded springs: factor on the stiffness, and weight of bending, N/m
const int edge_bending = 13;
const int edge_slip = 14;            // limits with memory: LimitMemory
const int edge_stiff = 15;
const int edge_planes = 16;

// A step is solved if its residual is at most this, relative to its load.
const float solved_residual = 1.0f;

// Scalars of a cloth's solve: the control of the iterations, and their counters.
const int scalar_newton_done = 0;    // 1 when this step's Newton iteration has ended
const int scalar_linear_done = 1;    // the same for conjugate gradients
const int scalar_search_done = 2;    // and for the line search
const int scalar_alpha = 3;
const int scalar_beta = 4;
const int scalar_rho = 5;            // r . z
const int scalar_goal = 6;           // value of r . r at which to stop
const int scalar_slope = 7;          // r . x, twice the energy that the Newton step should gain, J
const int scalar_energy = 8;         // J, accepted
const int scalar_step = 9;           // fraction of the Newton step that is tried
const int scalar_load = 10;          // J: squared (M / dt^2)-norm of what inertia and gravity ask beyond the start
const int scalar_newton = 11;        // iterations of this step
const int scalar_iterations = 12;
const int scalar_idle = 13;          // 1 if this step has nothing to solve
const int scalar_spring_energy = 14; // J, at the end of the last step
const int scalar_started = 15;       // 1 after the first step
const int scalar_solves = 16;        // counters of the frame
const int scalar_newton_sum = 17;
const int scalar_newton_max = 18;
const int scalar_iterations_sum = 19;
const int scalar_iterations_max = 20;
const int scalar_residual_max = 21;
const int scalar_energy_lost = 22;
const int scalar_active_sum = 23;
const int scalar_active_max = 24;
const int scalar_active_last = 25;
const int scalar_newton_last = 26;
const int scalar_iterations_last = 27;
const int scalar_residual_last = 28;
const int scalar_first_residual2 = 29; // N2: r . r of the last linear system, at its start and now
const int scalar_residual2 = 30;
const int scalar_contact_energy = 31; // J, accepted
const int scalar_refused = 32;       // line searches that found no acceptable step
const int scalar_reach = 33;         // m2: how far an ACAD correction may move a spring in this step, by length squared
const int scalar_count = 34;

// Sums over nodes or springs, which passes store in parts.
const int sum_spring_energy = 0;     // J, of springs
const int sum_node_energy = 1;       // J, of inertia
const int sum_contact_energy = 2;    // J, of contact and friction
const int sum_curvature = 3;         // p . A p
const int sum_linear_residual2 = 4;  // r . r
const int sum_rho = 5;               // r . z
const int sum_load = 6;              // J
const int sum_lost = 7;              // J
const int sum_contact_change = 7;    // J, before sum_lost
const int sum_least_load = 7;               // J, of the start of a step, before that
const int sum_active = 8;            // constraints
const int sum_marked = 9;            // springs marked by ACAD
const int sum_renewed = 9;           // J: change of the energy of limits with memory
const int sum_excess = 9;            // m4, before marks: of springs beyond ACAD's threshold
const int sum_slots = 10;
const int sum_columns = 64;          // columns in one part of a sum
const int sum_lanes = 256;           // lanes in which the parts are added

// The paper's solver (paper.kernel.glsl) has only level 0, with these planes.
const int paper_start_position = 0;  // m, position at the start of the step
const int paper_velocity = 3;        // m/s, velocity; of a pin, its prescribed one in this step
const int paper_force = 6;           // N, of springs that are no constraints, and of wind
const int paper_free_velocity = 9;   // m/s, velocity at the end of the step without constraints
const int paper_inverse_mass = 12;   // 1/kg
const int paper_multiplier = 13;     // N, the largest force of a constraint at the node
const int paper_planes = 14;

// Data by spring: plane p of spring s. The springs that may be constraints come first.
const int row_rest = 0;              // m
const int row_force = 1;             // N, on the first node, where the spring is no constraint
const int row_jacobian = 4;          // m, x_i - x_j: half the entries of J at the first node
const int row_mark = 7;              // constraint: 1 if too long, -1 if too short; 0: a spring
const int row_lambda = 8;            // N/m, the multiplier, and the best so far
const int row_best = 9;
const int row_residual = 10;         // m2/s2: conjugate gradients
const int row_direction = 11;
const int row_applied = 12;
const int row_place = 13;            // number of active constraints before it in its block
const int row_list = 14;             // the active constraints
const int row_planes = 15;

// Header: the first entries of `topology`. ConstraintRows (body/constraint_rows.hpp) writes them.
const int rows_springs = 0;          // number of springs, and of those that may be constraints
const int rows_constraints = 1;
const int rows_ends = 2;             // where the pairs of nodes begin
const int rows_classes = 3;
const int rows_node_start = 4;       // J transposed, by node: offsets into the next table
const int rows_node_entries = 5;     // 2 s at the first node of spring s, 2 s + 1 at its second
const int rows_matrix_start = 6;     // J M^-1 J^T, by row: offsets into the next table
const int rows_columns = 7;
const int rows_values = 8;           // where the constants begin, among the numbers
const int rows_base = 9;             // plane 0 of the springs' data, and the size of a plane
const int rows_size = 10;
const int rows_matrix = 11;          // entries of J M^-1 J^T, in the order of the columns
const int rows_adaptive = 12;        // 1: springs become constraints beyond a strain (the method acad)
const int rows_compression = 13;     // 1: also under compression
const int rows_unilateral = 14;      // 1: a constraint only resists change away from rest, at the length where it became one
const int rows_scan_levels = 15;
const int rows_scan = 16;            // for each level of the prefix sum: where its numbers are, and how many
const int scan_block = 256;          // size of a block of the prefix sum
const int rows_header = 24;

const int paper_stiffness = 0;       // N/m, by class
const int paper_damping = 3;         // N s/m
const int paper_tolerance = 6;
const int paper_compliance = 7;      // m/N
const int paper_activate = 8;        // strain
const int paper_deactivate = 9;
const int paper_values = 10;

// Scalars in slots that only Newton's method needs.
const int scalar_better = 2;         // 1: the current multipliers are the best so far
const int scalar_rows = 7;           // constraints of this step
const int scalar_best = 8;           // r . r of the best multipliers so far
const int scalar_dropping = 9;       // 1: the next step of conjugate gradients drops constraints that push
const int scalar_rows_left = 10;     // constraints without dropped ones
const int scalar_right_side = 11;    // b . b
const int sum_pushing = 5;           // unilateral constraints that push

// A detail of sheet_gather: the last evaluation of a step, which needs the energy only.
const int detail_last_look = 1;
// A detail of mesh_gather before a polish, which needs forces and diagonals but no couplings.
const int detail_polish_look = 2;

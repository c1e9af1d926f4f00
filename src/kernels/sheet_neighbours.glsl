// The springs of a sheet's node, for shaders and C++ (body/sheet_shape.hpp). Every backend adds a node's springs in this
// order, by the neighbour's index: the six backward neighbours in row order, then the six forward ones.
// SHEET_NEIGHBOUR(rows, columns, class, rest, number): the offset of the neighbour; the spring's class; the index of its
// rest length, SheetShape::rest_lengths; and its number among the six springs that begin at a node, by which the solver's
// planes have it (forward_offset in sheet.kernel.glsl): structural and shear springs first.
SHEET_NEIGHBOUR(-2, 0, bend, 4, 5),
SHEET_NEIGHBOUR(-1, -1, shear, 2, 3),
SHEET_NEIGHBOUR(-1, 0, structural, 1, 2),
SHEET_NEIGHBOUR(-1, 1, shear, 2, 1),
SHEET_NEIGHBOUR(0, -2, bend, 3, 4),
SHEET_NEIGHBOUR(0, -1, structural, 0, 0),
SHEET_NEIGHBOUR(0, 1, structural, 0, 0),
SHEET_NEIGHBOUR(0, 2, bend, 3, 4),
SHEET_NEIGHBOUR(1, -1, shear, 2, 1),
SHEET_NEIGHBOUR(1, 0, structural, 1, 2),
SHEET_NEIGHBOUR(1, 1, shear, 2, 3),
SHEET_NEIGHBOUR(2, 0, bend, 4, 5)

#ifndef SHEET_GLSL
#define SHEET_GLSL
// A sheet's nodes and neighbours.
#include "cloth.glsl"

struct SheetNeighbour
{
    int row_offset, column_offset;
    uint spring_class, rest;
};

#define SHEET_NEIGHBOUR(rows, columns, spring, rest, number) SheetNeighbour(rows, columns, spring, rest)
const SheetNeighbour sheet_neighbours[12] = SheetNeighbour[12](
#include "kernels/sheet_neighbours.glsl"
);
#undef SHEET_NEIGHBOUR

bool on_sheet(ivec2 place)
{
    return place.x >= 0 && place.y >= 0 && place.x < int(parameters.rows) && place.y < int(parameters.columns);
}
// place: (row, column)
uint node_at(ivec2 place) { return uint(place.x) * parameters.columns + uint(place.y); }
ivec2 neighbour_place(ivec2 place, uint n)
{
    return place + ivec2(sheet_neighbours[n].row_offset, sheet_neighbours[n].column_offset);
}
#endif

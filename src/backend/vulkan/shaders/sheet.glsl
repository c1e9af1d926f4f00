#ifndef SHEET_GLSL
#define SHEET_GLSL
// A sheet's nodes and neighbours.
#include "cloth.glsl"

struct SheetNeighbour
{
    int row_offset, column_offset;
    uint spring_class, rest;
};

// As in body/cloth_model.hpp, in canonical order: the six backward neighbours before the forward ones.
const SheetNeighbour sheet_neighbours[12] = SheetNeighbour[12](
    SheetNeighbour(-2, 0, bend, 4u), SheetNeighbour(-1, -1, shear, 2u), SheetNeighbour(-1, 0, structural, 1u),
    SheetNeighbour(-1, 1, shear, 2u), SheetNeighbour(0, -2, bend, 3u), SheetNeighbour(0, -1, structural, 0u),
    SheetNeighbour(0, 1, structural, 0u), SheetNeighbour(0, 2, bend, 3u), SheetNeighbour(1, -1, shear, 2u),
    SheetNeighbour(1, 0, structural, 1u), SheetNeighbour(1, 1, shear, 2u), SheetNeighbour(2, 0, bend, 4u));

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

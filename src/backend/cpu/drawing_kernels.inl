// Drawing data of a sheet: included by kernels.inl, inside its unnamed namespace.

/// As PlainCloth::sheet_normals: the quads around a node, each given by its corners.
PLIANT_IN_ONE_PIECE void sheet_normal(const SheetArguments& a, std::size_t first_row, std::size_t end_row)
{
    const auto rows = static_cast<std::ptrdiff_t>(a.layout->rows),
               columns = static_cast<std::ptrdiff_t>(a.layout->columns);
    const auto stride = static_cast<std::ptrdiff_t>(a.layout->stride);
    const Vector zero{Number(0.0f), Number(0.0f), Number(0.0f)};
    for_each_block(a, first_row, end_row, [&](const Block& block) {
        const bool above = block.row > 0, below = block.row + 1 < rows;
        const Vector x = load(a.position, block.offset);
        const L::mask left = lanes_on_sheet(block.column - 1, columns),
                      right = lanes_on_sheet(block.column + 1, columns);
        Vector sum = zero;
        const auto add = [&](bool row_exists, const L::mask& column_exists, std::ptrdiff_t first,
                             std::ptrdiff_t second) {
            if (!row_exists) return;
            const auto at = [&](std::ptrdiff_t shift) { return load(a.position, block.offset + shift); };
            const Vector with = sum + L::quadrant_normal(x, at(first), at(first + second), at(second));
            sum = L::choose(column_exists, with, sum);
        };
        add(below, right, stride, 1);
        add(above, right, 1, -stride);
        add(above, left, -stride, -1);
        add(below, left, -1, stride);
        // Padding stays zero: the last pack of a row reaches beyond the sheet.
        store(a.normal, block.offset,
              L::choose(lanes_on_sheet(block.column, columns), L::direction(sum), zero));
    });
}

/// As PlainCloth::sheet_strains: the largest strain of a node's structural and shear springs.
PLIANT_IN_ONE_PIECE void sheet_strain(const SheetArguments& a, std::size_t first_row, std::size_t end_row)
{
    const auto rows = static_cast<std::ptrdiff_t>(a.layout->rows),
               columns = static_cast<std::ptrdiff_t>(a.layout->columns);
    const auto stride = static_cast<std::ptrdiff_t>(a.layout->stride);
    for_each_block(a, first_row, end_row, [&](const Block& block) {
        const Vector x = load(a.position, block.offset);
        Number most(-1.0f);
        for (const SheetNeighbour& neighbour : sheet_neighbours) {
            const std::ptrdiff_t row = block.row + neighbour.row_offset;
            if (neighbour.spring_class == SpringClass::bend || row < 0 || row >= rows) continue;
            const Vector other =
                load(a.position, block.offset + neighbour.row_offset * stride + neighbour.column_offset);
            const Number rest(a.constants->rest_lengths[neighbour.rest]);
            const Number with = L::largest(L::spring_stretch(x, other, rest), most);
            most = L::choose(lanes_on_sheet(block.column + neighbour.column_offset, columns), with, most);
        }
        L::choose(lanes_on_sheet(block.column, columns), most, Number(0.0f)).store(a.strain + block.offset);
    });
}

// The header of a PLY file: its elements, and how their rows are stored.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesh_file/mesh_formats.hpp"

namespace pliant {

enum class PlyEncoding { ascii, little_endian, big_endian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Calls `visit` with a zero of the C++ type.
template <class Visit>
auto with_type(PlyType type, Visit visit)
{
    switch (type) {
        case PlyType::int8: return visit(std::int8_t{});
        case PlyType::uint8: return visit(std::uint8_t{});
        case PlyType::int16: return visit(std::int16_t{});
        case PlyType::uint16: return visit(std::uint16_t{});
        case PlyType::int32: return visit(std::int32_t{});
        case PlyType::uint32: return visit(std::uint32_t{});
        case PlyType::float32: return visit(float{});
        case PlyType::float64: break;
    }
    return visit(double{});
}

inline std::size_t byte_count(PlyType type)
{
    return with_type(type, [](auto zero) { return sizeof(zero); });
}

inline bool is_integer(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;     ///< of the value, or of each item of a list
    std::optional<PlyType> length_type;  ///< set for a list; always an integer type
    std::size_t line = 0;
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;  ///< as claimed: compare it with the size of the file before use
    std::vector<PlyProperty> properties;
    std::size_t line = 0;
};

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::ascii;
    std::vector<PlyElement> elements;
    std::size_t byte_count = 0, line_count = 0;  ///< of the header; the body follows
};

PlyHeader read_ply_header(const MeshSource& source);

}  // namespace pliant

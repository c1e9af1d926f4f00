// How the backends on the host keep nodes in memory: one plane of numbers per coordinate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "laws/laws.hpp"

namespace pliant {

/// Nodes in rows, each row padded, with a border of padding all around: a kernel may read two nodes beyond
/// any side, and write a whole SIMD pack at a row's end, without leaving the plane. A mesh is one row.
/// Padding holds zeros and has inverse mass 0, so that whatever is computed there stays 0.
struct NodeLayout {
    static constexpr std::size_t pad = 16;  // floats; the widest pack, and a cache line
    static constexpr std::size_t border_rows = 2;

    NodeLayout(std::size_t row_count, std::size_t column_count)
        : rows(row_count),
          columns(column_count),
          stride((column_count + pad - 1) / pad * pad + pad),
          size((row_count + 2 * border_rows) * stride + 2 * pad)
    {
    }
    std::size_t offset(std::size_t row, std::size_t column) const
    {
        return (row + border_rows) * stride + pad + column;
    }
    std::size_t offset(std::size_t node) const { return offset(node / columns, node % columns); }

    std::size_t rows, columns, stride, size;
};

/// An array aligned to cache lines.
template <class T>
class AlignedArray {
public:
    AlignedArray() = default;
    explicit AlignedArray(std::size_t size) : storage_(size + line / sizeof(T))
    {
        const auto address = reinterpret_cast<std::uintptr_t>(storage_.data());
        shift_ = (line - address % line) % line / sizeof(T);
    }
    T* data() { return storage_.data() + shift_; }
    const T* data() const { return storage_.data() + shift_; }
    T& operator[](std::size_t i) { return data()[i]; }
    const T& operator[](std::size_t i) const { return data()[i]; }
    bool empty() const { return storage_.empty(); }

private:
    static constexpr std::size_t line = 64;
    std::vector<T> storage_;
    std::size_t shift_ = 0;
};

/// Three planes: vectors by coordinate.
template <class T>
struct Planes {
    Planes() = default;
    explicit Planes(std::size_t size) : x(size), y(size), z(size) {}
    Vector3<T> get(std::size_t offset) const { return {x[offset], y[offset], z[offset]}; }
    void set(std::size_t offset, Vector3<T> value)
    {
        x[offset] = value.x;
        y[offset] = value.y;
        z[offset] = value.z;
    }
    AlignedArray<T> x, y, z;
};

}  // namespace pliant

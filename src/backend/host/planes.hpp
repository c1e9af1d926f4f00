// The memory layout of nodes in host backends: one plane per coordinate.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "body/node_layout.hpp"
#include "laws/laws.hpp"

namespace pliant {

/// An array aligned to cache lines. Each array begins some lines further into a page than the one before:
/// otherwise planes that are read together would collide in a few sets of the cache, which slowed a step of a
/// large sheet by a fifth.
template <class T>
class AlignedArray {
public:
    AlignedArray() = default;
    explicit AlignedArray(std::size_t size)
    {
        const std::size_t skew = next_skew();
        storage_.resize(size + (skew + line) / sizeof(T));
        const auto address = reinterpret_cast<std::uintptr_t>(storage_.data());
        shift_ = ((line - address % line) % line + skew) / sizeof(T);
    }
    T* data() { return storage_.data() + shift_; }
    const T* data() const { return storage_.data() + shift_; }
    T& operator[](std::size_t i) { return data()[i]; }
    const T& operator[](std::size_t i) const { return data()[i]; }
    bool empty() const { return storage_.empty(); }

private:
    static constexpr std::size_t line = 64, page = 4096;
    static std::size_t next_skew()
    {
        static std::atomic<std::size_t> arrays{0};
        return arrays++ * 5 * line % page;
    }
    std::vector<T> storage_;
    std::size_t shift_ = 0;
};

/// Three planes: one per coordinate.
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

/// Consecutive vectors with a fourth number as padding, so that a gathered vector is in one cache line.
template <class T>
class VectorArray {
public:
    VectorArray() = default;
    explicit VectorArray(std::size_t size) : numbers_(4 * size) {}
    Vector3<T> get(std::size_t i) const
    {
        return {numbers_[4 * i], numbers_[4 * i + 1], numbers_[4 * i + 2]};
    }
    void set(std::size_t i, Vector3<T> value)
    {
        numbers_[4 * i] = value.x;
        numbers_[4 * i + 1] = value.y;
        numbers_[4 * i + 2] = value.z;
    }
    T* data() { return numbers_.data(); }
    const T* data() const { return numbers_.data(); }

private:
    AlignedArray<T> numbers_;
};

}  // namespace pliant

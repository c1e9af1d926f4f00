// Numbers of neighbouring nodes that a kernel works on at once: one of them here, W in backend/cpu/pack.hpp.
#pragma once

namespace pliant {

template <class T>
struct Lanes {
    using Number = T;
    static constexpr int count = 1;
    static T load(const T* p) { return *p; }
    static T load_even(const T* p) { return *p; }
    static void store(T* p, T a) { *p = a; }
    static void add_by_turns(T* p, T even, T odd, const T* where)
    {
        if (where[0] > 0) p[0] += even;
        if (where[1] > 0) p[1] += odd;
    }
    static T spread(T a) { return a; }
    static T first(T a) { return a; }
    static bool first_lanes(int number) { return number > 0; }
    static T sum(T a) { return a; }
    static T multiply_add(T a, T b, T c) { return a * b + c; }
};

}  // namespace pliant

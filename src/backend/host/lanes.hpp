// Numbers of neighbouring nodes that a kernel processes at once: one here, W in backend/cpu/pack.hpp.
#pragma once

#include "laws/laws.hpp"

namespace pliant {

template <class T>
struct Lanes {
    using Number = T;
    static constexpr int count = 1;
    static T load(const T* p) { return *p; }
    static T load_even(const T* p) { return *p; }
    static void store(T* p, T a) { *p = a; }
    static void add_by_turns(T* p, T even, T odd, const T* where_low, const T* where_high)
    {
        if (*where_low > 0) p[0] += even;
        if (*where_high > 0) p[1] += odd;
    }
    static T spread(T a) { return a; }
    static T first(T a) { return a; }
    static bool first_lanes(int number) { return number > 0; }
    static T sum(T a) { return a; }
};

/// Access to records. For packs it is in backend/cpu/records.hpp; single numbers do not use it.
template <class T>
struct Records;
template <class T>
struct FourNumbers {
    T x, y, z, w;
};
template <class T>
struct SixNumbers {
    T numbers[6];
};

/// Broadcasts one vector, and one collider, to all lanes of T.
template <class T, class Vector>
auto spread_vector(const Vector& a)
{
    return Vector3<T>{Lanes<T>::spread(a.x), Lanes<T>::spread(a.y), Lanes<T>::spread(a.z)};
}
template <class Target, class T, class Source>
Target spread_collider(const Source& a)
{
    Target c;
    c.kind = a.kind;
    c.response = a.response;
    c.centre = spread_vector<T>(a.centre);
    c.axis_x = spread_vector<T>(a.axis_x);
    c.axis_y = spread_vector<T>(a.axis_y);
    c.axis_z = spread_vector<T>(a.axis_z);
    c.half_size = spread_vector<T>(a.half_size);
    c.radius = Lanes<T>::spread(a.radius);
    c.friction = Lanes<T>::spread(a.friction);
    c.velocity = spread_vector<T>(a.velocity);
    c.spin = spread_vector<T>(a.spin);
    return c;
}

}  // namespace pliant

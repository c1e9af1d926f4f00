// The definitions that a class template over a number type T needs around the laws. Included inside the
// class, by Laws and by classes that add to the laws (backend/host/solver_kernels.hpp).
using real = T;
using vec3 = Vector3<T>;
using vec4 = Vector4<T>;
using mask = decltype(T{} > T{});
static constexpr int inverse_sqrt_steps = NumberTraits<T>::inverse_sqrt_steps;

static real inverse_sqrt_seed(real a) { return NumberTraits<T>::inverse_sqrt_seed(a); }
static mask is_finite(real a) { return NumberTraits<T>::is_finite(a); }
static mask both(mask a, mask b) { return NumberTraits<T>::both(a, b); }
static bool any_lane(mask a) { return NumberTraits<T>::any_lane(a); }
static real choose(mask m, real a, real b) { return NumberTraits<T>::choose(m, a, b); }
static vec3 choose(mask m, vec3 a, vec3 b)
{
    return {choose(m, a.x, b.x), choose(m, a.y, b.y), choose(m, a.z, b.z)};
}
static vec3 xyz(vec4 a) { return {a.x, a.y, a.z}; }

#define LAW static inline
#include "laws/all.law.glsl"
#undef LAW

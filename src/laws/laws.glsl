// The laws as GLSL, from the same text that laws.hpp compiles as C++. `precise` forbids contraction, so that the bits equal
// those of the CPU; a test checks every floating-point instruction of every compute shader for it.
#ifdef FAST_MATH
#define precise  // may be contracted, see SimulationOptions::fast_math
#endif
#define LAW precise
#define mask bool
#ifdef REAL64
#define real double
#define vec3 dvec3
#define vec4 dvec4
const int inverse_sqrt_steps = 4;
precise double inverse_sqrt_seed(double a)
{
    uvec2 bits = unpackDouble2x32(a);  // (low word, high word)
    uint high = bits.y >> 1;
    uint low = (bits.x >> 1) | (bits.y << 31);
    uint borrow = 0xc7b537a9u < low ? 1u : 0u;
    return packDouble2x32(uvec2(0xc7b537a9u - low, 0x5fe6eb50u - high - borrow));
}
bool is_finite(double a) { return (unpackDouble2x32(a).y & 0x7ff00000u) != 0x7ff00000u; }
#else
#define real float
#ifdef FAST_MATH
const int inverse_sqrt_steps = 0;
float inverse_sqrt_seed(float a) { return inversesqrt(max(a, 1.17549435e-38f)); }  // finite at 0, too
#else
const int inverse_sqrt_steps = 3;
precise float inverse_sqrt_seed(float a) { return uintBitsToFloat(0x5f375a86u - (floatBitsToUint(a) >> 1)); }
#endif
bool is_finite(float a) { return (floatBitsToUint(a) & 0x7f800000u) != 0x7f800000u; }
#endif
bool both(bool a, bool b) { return a && b; }
bool any_lane(bool a) { return a; }
precise real choose(bool m, real a, real b) { return m ? a : b; }
precise vec3 choose(bool m, vec3 a, vec3 b) { return m ? a : b; }
vec3 xyz(vec4 a) { return a.xyz; }

#include "all.law.glsl"

// Every law, in the order in which they use each other.
#include "arithmetic.law.glsl"
#include "spring.law.glsl"
#include "integration.law.glsl"
#include "contact.law.glsl"
#include "air.law.glsl"
#include "limit.law.glsl"
#include "normal.law.glsl"
#include "measure.law.glsl"

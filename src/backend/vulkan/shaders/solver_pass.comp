#version 460
// Any pass of a solver. The build compiles this file once per solver row of solve/passes.def (cmake/PliantShaders.cmake),
// with the row's columns as macros: PASS, the name; OVER, OVER_ and the unit; UNIT_ and the unit; TEXT_ and the text.
#extension GL_GOOGLE_include_directive : require
#if defined(UNIT_single)
#include "solver_single.glsl"
#elif defined(UNIT_bottom)
#include "solver_bottom.glsl"
#else
#include "solver_nodes.glsl"
#endif
#if defined(TEXT_mesh)
#include "kernels/mesh.kernel.glsl"
#elif defined(TEXT_paper)
#include "kernels/paper.kernel.glsl"
#endif
OVER(PASS)

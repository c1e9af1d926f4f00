#version 460
// Forces and the operator of a sheet's nodes.
#extension GL_GOOGLE_include_directive : require
#include "solver_nodes.glsl"
void gather(int o)
{
    if (is_last_look())
        sheet_energy(o);
    else
        sheet_gather(o);
}
LIVE_NODE_PASS(gather)

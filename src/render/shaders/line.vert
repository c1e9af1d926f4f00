#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "cloth_nodes.glsl"

// `LineStyle` in render/scene_drawing.cpp.
layout(push_constant) uniform Style {
    uint kind;     // 0: springs by class, 1: springs that a constraint holds, 2: normals
    float reach;   // m, of a normal
} style;

layout(location = 0) out vec3 hue;

const vec3 class_hues[4] = vec3[](vec3(0.85, 0.83, 0.75), vec3(0.10, 0.55, 0.75), vec3(0.90, 0.45, 0.05),
                                  vec3(0.65, 0.15, 0.60));

void main()
{
    uint line = gl_VertexIndex >> 1, end = gl_VertexIndex & 1;
    vec3 at;
    bool visible = true;
    if (style.kind == 2u) {
        at = positions[line].xyz + normals[line].xyz * (float(end) * style.reach);
        hue = mix(vec3(0.9, 0.85, 0.2), vec3(0.9, 0.3, 0.05), float(end));
    } else {
        uvec2 spring = lines[line];  // the nodes, with the class in the uppermost bits of the second
        uint i = spring.x, j = spring.y & 0x3fffffffu;
        at = positions[end == 0u ? i : j].xyz;
        hue = class_hues[spring.y >> 30];
        if (style.kind == 1u) {
            visible = held[line] != 0u;
            hue = vec3(0.95, 0.03, 0.10);
        }
    }
    gl_Position = frame.clip_from_world * vec4(at, 1.0);
    gl_Position.z -= 1e-4 * gl_Position.w;  // in front of the cloth that it lies on, by a hundredth of its distance
    if (!visible) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}

#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "cloth_nodes.glsl"

// `LineStyle` in render/scene_recording.cpp.
layout(push_constant) uniform Style {
    uint kind;     // 0: springs by class, 1: springs held by a constraint, 2: normals, 3: edges of triangles
    float reach;   // m, of a normal
    uint count;    // number of lines; the first is drawn last, on top of the others
} style;

layout(location = 0) out vec3 hue;
layout(location = 1) noperspective out float beside;  // pixels from the middle of the line

const vec3 class_hues[4] = vec3[](vec3(0.85, 0.83, 0.75), vec3(0.10, 0.55, 0.75), vec3(0.90, 0.45, 0.05),
                                  vec3(0.65, 0.15, 0.60));

vec4 seen_at(vec3 place)
{
    vec4 at = frame.clip_from_world * vec4(place, 1.0);
    at.z -= 1e-4 * at.w;  // a little nearer, so that the cloth does not hide it
    return at;
}

void main()
{
    // Two triangles per line, since lines drawn by drivers have no smooth sides.
    uint line = style.count - 1u - uint(gl_VertexIndex / 6);
    int corner = gl_VertexIndex % 6;
    bool at_last = corner == 1 || corner == 2 || corner == 4;
    beside = corner == 2 || corner >= 4 ? 1.0 : -1.0;
    vec3 first, last;
    bool visible = true;
    if (style.kind == 2u) {
        first = positions[line].xyz;
        last = first + normals[line].xyz * style.reach;
        hue = at_last ? vec3(0.9, 0.3, 0.05) : vec3(0.9, 0.85, 0.2);
    } else if (style.kind == 3u) {
        first = positions[edges[line].x].xyz;
        last = positions[edges[line].y].xyz;
        hue = vec3(0.01, 0.012, 0.02);
    } else {
        uvec2 spring = lines[line];  // the nodes, with the class in the uppermost bits of the second
        first = positions[spring.x].xyz;
        last = positions[spring.y & 0x3fffffffu].xyz;
        hue = class_hues[spring.y >> 30];
        if (style.kind == 1u) {
            visible = held[line] != 0u;
            hue = vec3(0.95, 0.03, 0.10);
        }
    }
    vec4 from = seen_at(first), to = seen_at(last);
    vec2 along = (to.xy / to.w - from.xy / from.w) * frame.picture.xy;
    if (!visible || !(min(from.w, to.w) > 0.0) || !(dot(along, along) > 0.0)) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
        return;
    }
    gl_Position = at_last ? to : from;
    gl_Position.xy += normalize(vec2(-along.y, along.x)) * beside * 2.0 * frame.picture.zw * gl_Position.w;
}

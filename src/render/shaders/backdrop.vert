#version 450

void main()
{
    // One triangle over the whole picture, at the far plane.
    gl_Position = vec4((gl_VertexIndex & 1) * 4.0 - 1.0, (gl_VertexIndex & 2) * 2.0 - 1.0, 1.0, 1.0);
}

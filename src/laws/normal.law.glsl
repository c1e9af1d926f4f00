// Vertex normals: Algorithm 5 of the cloth paper.

// Twice the area vector of a triangle: (b - a) x (c - a)
LAW vec3 triangle_normal(vec3 a, vec3 b, vec3 c)
{
    return cross3(b - a, c - a);
}

// The two triangles of one quadrant around a sheet's node: (x, first, corner) and (x, corner, second).
LAW vec3 quadrant_normal(vec3 x, vec3 first, vec3 corner, vec3 second)
{
    return triangle_normal(x, first, corner) + triangle_normal(x, corner, second);
}

"""Shapes, files and measures of meshes for tests, on Python's own library alone.

It shares nothing with the program under test: another formula for every number, and another writer for every file.
A mesh is a list of vertices (x, y, z in m) and a list of faces (indices, counter-clockwise from outside).
"""

import math
import struct
from random import Random

TETRAHEDRON = ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])
CUBE = ([(x, y, z) for z in (-.5, .5) for y in (-.5, .5) for x in (-.5, .5)],
        [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)])


# ---- shapes

def minus(a, b):
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def unit(a):
    length = math.hypot(*a)
    return a[0] / length, a[1] / length, a[2] / length


def sphere(divisions):
    """An icosahedron whose triangles are divided into four again and again, on the unit sphere."""
    g = (1 + 5**.5) / 2
    vertices = [unit(v) for v in ((-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g),
                                  (0, -1, -g), (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1))]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2),
             (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11),
             (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    for _ in range(divisions):
        middles, divided = {}, []
        for a, b, c in faces:
            corners = []
            for pair in ((a, b), (b, c), (c, a)):
                key = min(pair), max(pair)
                if key not in middles:
                    middles[key] = len(vertices)
                    vertices.append(unit([p + q for p, q in zip(vertices[pair[0]], vertices[pair[1]])]))
                corners.append(middles[key])
            ab, bc, ca = corners
            divided += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = divided
    return vertices, faces


def knobbly_torus(around=40, across=20):
    vertices, faces = [], []
    for i in range(around):
        for j in range(across):
            a, b = 2 * math.pi * i / around, 2 * math.pi * j / across
            radius = .35 + .05 * math.cos(5 * a + 3 * b)
            distance = 1 + radius * math.cos(b)
            vertices.append((distance * math.cos(a), distance * math.sin(a), radius * math.sin(b)))
            next_i, next_j = (i + 1) % around, (j + 1) % across
            corners = [i * across + j, next_i * across + j, next_i * across + next_j, i * across + next_j]
            faces += [(corners[0], corners[1], corners[2]), (corners[0], corners[2], corners[3])]
    return vertices, faces


def moebius_strip(segments=24):
    vertices, faces = [], []
    for i in range(segments):
        turn = 2 * math.pi * i / segments
        for side in (-.3, .3):
            distance = 1 + side * math.cos(turn / 2)
            vertices.append((distance * math.cos(turn), distance * math.sin(turn), side * math.sin(turn / 2)))
        a, b = 2 * i, 2 * i + 1
        c, d = (2 * i + 2, 2 * i + 3) if i < segments - 1 else (1, 0)
        faces += [(a, c, b), (b, c, d)]
    return vertices, faces


def scan(divisions, random):
    """As a scanner leaves a figure 0.25 m across: bumps, folds, noise, and triangles of uneven size and shape."""
    vertices, faces = sphere(divisions)
    edge = 1.1 / 2**divisions  # a typical one
    placed = []
    for v in vertices:
        v = unit([c + random.uniform(-.25, .25) * edge for c in v])
        x, y, z = v
        radius = 1 + .25 * math.sin(3 * x + 1) * math.cos(4 * y) + .1 * math.sin(9 * z + 5 * x) + \
            .5 * math.exp(-12 * ((x - .3)**2 + (y - .9)**2 + z**2)) + random.uniform(-.05, .05) * edge
        placed.append((.08 * x * radius, .1 * y * radius + .11, .06 * z * radius * (1 + .5 * x)))
    return placed, faces


def edges_of(face):
    return [(face[k], face[(k + 1) % len(face)]) for k in range(len(face))]


def cut_holes(faces, holes, random):
    """The faces without a patch for each (face to begin at, edges around the hole), grown at random.

    A face joins by one edge where its third corner is not in the patch yet, or by two or three: so a patch stays a
    disc, and its rim passes every vertex once. Patches are to begin far from each other.
    """
    owner = {edge: f for f, face in enumerate(faces) for edge in edges_of(face)}

    def neighbours(f):
        return [owner[b, a] for a, b in edges_of(faces[f])]

    cut = set()
    for start, rim in holes:
        patch, corners, around, front = {start}, set(faces[start]), 3, neighbours(start)
        while around != rim:
            f = front.pop(random.randrange(len(front)))
            if f in patch:
                continue
            shared = sum(other in patch for other in neighbours(f))
            if shared == 1 and all(corner in corners for corner in faces[f]):
                continue
            patch.add(f)
            corners.update(faces[f])
            around += 3 - 2 * shared
            front += neighbours(f)
        cut |= patch
    return [face for f, face in enumerate(faces) if f not in cut]


def shuffled(vertices, faces, random):
    """The vertices in another order."""
    order = list(range(len(vertices)))
    random.shuffle(order)
    place = {old: new for new, old in enumerate(order)}
    return [vertices[old] for old in order], [tuple(place[i] for i in face) for face in faces]


def turned(faces):
    return [tuple(reversed(face)) for face in faces]


def triangles_of(faces):
    return [(f[0], f[k], f[k + 1]) for f in faces for k in range(1, len(f) - 1)]


def joined(*meshes):
    vertices, faces = [], []
    for more, theirs in meshes:
        faces += [tuple(i + len(vertices) for i in face) for face in theirs]
        vertices = vertices + list(more)
    return vertices, faces


def moved(vertices, scale=1, by=(0, 0, 0)):
    return [tuple(scale * c + b for c, b in zip(v, by)) for v in vertices]


def soup_of(vertices, triangles, random=None, jitter=0):
    """Every triangle with three vertices of its own."""
    soup = [vertices[i] for triangle in triangles for i in triangle]
    if random:
        soup = [tuple(c + random.uniform(-jitter, jitter) for c in single(v)) for v in soup]
    return soup, [(3 * k, 3 * k + 1, 3 * k + 2) for k in range(len(triangles))]


# ---- measures

def single(vertex):
    """The coordinates as floats of 32 bits hold them."""
    return struct.unpack('<3f', struct.pack('<3f', *vertex))


def measures_of(vertices, triangles):
    """Of the triangles as a file of floats has them; volumes are exact sums over tetrahedra to the first vertex."""
    places = [single(v) for v in vertices]
    lengths, areas, volumes, sides = {}, [], [], {}
    for triangle in triangles:
        a, b, c = (places[i] for i in triangle)
        normal = cross(minus(b, a), minus(c, a))
        areas.append(math.hypot(*normal) / 2)
        volumes.append(dot(minus(a, places[0]), normal) / 6)
        for i, j in edges_of(triangle):
            key = min(i, j), max(i, j)
            sides[key] = sides.get(key, 0) + 1
            lengths[key] = math.dist(places[i], places[j])
    return {"edges": len(lengths), "boundary_edges": sum(count == 1 for count in sides.values()),
            "unused": len(vertices) - len({i for triangle in triangles for i in triangle}),
            "area": math.fsum(areas), "volume": math.fsum(volumes),
            "edge_mean": math.fsum(lengths.values()) / len(lengths)}


# ---- files

def ply_header(vertex_count, face_count, form="binary_little_endian", lists="property list uchar int vertex_indices"):
    return (f"ply\nformat {form} 1.0\nelement vertex {vertex_count}\nproperty float x\nproperty float y\n"
            f"property float z\nelement face {face_count}\n{lists}\nend_header\n").encode()


def floats_of(vertices, order="<", kind="f"):
    return b"".join(struct.pack(f"{order}3{kind}", *v) for v in vertices)


def lists_of(faces, order="<", count="B", index="i"):
    return b"".join(struct.pack(f"{order}{count}{len(f)}{index}", len(f), *f) for f in faces)


def binary_ply(vertices, faces, order="<"):
    form = "binary_little_endian" if order == "<" else "binary_big_endian"
    return ply_header(len(vertices), len(faces), form) + floats_of(vertices, order) + lists_of(faces, order)


def rows_of(vertices, faces):
    return [" ".join(f"{c:.9g}" for c in v) for v in vertices] + [" ".join(map(str, (len(f), *f))) for f in faces]


def ascii_ply(vertices, faces, vertex_count=None, face_count=None):
    header = ply_header(len(vertices) if vertex_count is None else vertex_count,
                        len(faces) if face_count is None else face_count, "ascii").decode()
    return header + "\n".join(rows_of(vertices, faces)) + "\n"

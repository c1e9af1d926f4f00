#!/usr/bin/env python3
"""Writes about 100 bad and odd mesh files, the same ones every time, and a manifest.json of what is right for each.

    bad_meshes.py FOLDER

An entry of the manifest has the name of the `file`, `what` it is, and what a careful reader does with it, `parse`:
"ok" reads it, "error" refuses it in a sentence, "ok_or_error" may do either. As far as they are known there are `V` and
`F` (vertices and faces as stored) and `triangles`, `components`, whether it is `closed` (every edge has two triangles,
every vertex one fan), `valid` (closed and outward), `volume` and `volume_sign`, `weld_to` (vertices after welding with
`weld_tolerance`, m), and `closed_after_dropping` triangles without area. `edges`, `area`, `edge_mean`, `boundary_edges`,
`loops` and `unused` (vertices of no face) stand with the two scans. Lengths are metres.
"""

import json
import math
import struct
import sys
from pathlib import Path
from random import Random

from mesh_shapes import (CUBE, TETRAHEDRON, ascii_ply, binary_ply, cut_holes, floats_of, joined, knobbly_torus, lists_of,
                         measures_of, moebius_strip, moved, ply_header, rows_of, scan, shuffled, soup_of, sphere,
                         triangles_of, turned)


class Collection:
    """Files in a folder, and what is known of them."""

    def __init__(self, folder):
        self.folder, self.entries = Path(folder), []
        self.folder.mkdir(parents=True, exist_ok=True)

    def put(self, name, contents, what, parse, **known):
        data = contents.encode() if isinstance(contents, str) else contents
        (self.folder / name).write_bytes(data)
        self.entries.append({"file": name, "what": what, "parse": parse, **known})

    def put_mesh(self, name, mesh, what, **known):
        """A mesh that a reader must take, whatever is wrong with its surface."""
        vertices, faces = mesh
        self.put(name, binary_ply(vertices, faces), what, "ok", V=len(vertices), F=len(faces), **known)

    def finish(self):
        (self.folder / "manifest.json").write_text(json.dumps({"files": self.entries}, indent=1))


def put_surfaces(into):
    """Files that are right, with surfaces that are not, or that are easily taken for wrong."""
    random, ball = Random(5), sphere(2)
    vertices, faces = ball
    into.put_mesh("nonmanifold_edge_4faces.ply", (
        [(0, 0, 0), (1, 0, 0), (.5, 1, 0), (.5, 0, 1), (.5, -1, 0), (.5, 0, -1)],
        [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3), (0, 1, 4), (0, 5, 1), (1, 5, 4), (4, 5, 0)]),
        "two closed tetrahedra share an edge: four faces at it, though each direction finds its partner", closed=False)
    into.put_mesh("nonmanifold_edge_fin.ply", (CUBE[0] + [(0, 0, -1.5)], triangles_of(CUBE[1]) + [(0, 1, 8)]),
                  "closed cube with a fin on an edge: three faces at it", closed=False)
    into.put_mesh("nonmanifold_vertex.ply", (
        TETRAHEDRON[0] + [(-1, 0, 0), (0, -1, 0), (0, 0, -1)],
        TETRAHEDRON[1] + [(0, 4, 5), (0, 6, 4), (4, 6, 5), (0, 5, 6)]),
        "two closed tetrahedra share a vertex: every edge has two faces, vertex 0 two fans", closed=False)
    into.put_mesh("moebius.ply", moebius_strip(), "Moebius strip: cannot be oriented", closed=False)
    into.put_mesh("inside_out.ply", (vertices, turned(faces)), "closed sphere that faces inward", closed=True,
                  volume_sign=-1)
    into.put_mesh("mixed_orientation.ply", (vertices, [f if random.random() < .5 else f[::-1] for f in faces]),
                  "closed sphere, about half of the faces turned: a flood fill mends it", closed=True)
    into.put_mesh("two_components.ply", joined((moved(vertices, .4, (-.6, 0, 0)), faces),
                                               (moved(vertices, .4, (.6, 0, 0)), faces)),
                  "two closed spheres apart", closed=True, components=2)
    into.put_mesh("nested_cavity.ply", joined(ball, (moved(vertices, .5), turned(faces))),
                  "hollow ball: its inner sphere faces inward", closed=True, components=2)
    into.put_mesh("overlapping_components.ply", joined((moved(vertices, .5, (-.2, 0, 0)), faces),
                                                       (moved(vertices, .5, (.2, 0, 0)), faces)),
                  "two closed spheres that overlap", closed=True, components=2)
    into.put_mesh("duplicate_faces.ply",
                  (vertices, faces + faces[:40] + [(b, c, a) for a, b, c in faces[40:60]]),
                  "closed sphere with 60 faces stored twice, 20 of them rotated", closed=False)
    into.put_mesh("isolated_vertices.ply",
                  (vertices + [tuple(5 * random.random() for _ in range(3)) for _ in range(50)], faces),
                  "closed sphere and 50 vertices of no face, some far outside", closed=True)
    into.put_mesh("single_triangle.ply", (TETRAHEDRON[0][:3], [(0, 1, 2)]), "one triangle", closed=False)
    into.put_mesh("points_only.ply", (vertices, []), "vertices, and 0 faces", closed=False)
    into.put("points_no_face_element.ply",
             ply_header(len(vertices), 0).replace(b"element face 0\nproperty list uchar int vertex_indices\n", b"") +
             floats_of(vertices), "vertices, and no face element", "ok", V=len(vertices), F=0, closed=False)
    into.put_mesh("zero_volume_flat.ply", ([(x, y, 0) for x, y, _ in vertices], faces),
                  "closed sphere pressed flat: no volume", closed=True, volume_sign=0)
    into.put_mesh("pillow_2faces.ply", (TETRAHEDRON[0][:3], [(0, 1, 2), (0, 2, 1)]),
                  "two triangles back to back: closed, no volume", closed=True, volume_sign=0)
    into.put_mesh("tetrahedron.ply", TETRAHEDRON, "the smallest closed mesh", closed=True, valid=True, volume=1 / 6)
    put_degenerate(into, ball)
    torus = knobbly_torus()
    into.put_mesh("duplicated_vertices_soup.ply", soup_of(*torus),
                  "torus, three vertices for each face, as STL has them: closed after exact welding", closed=False,
                  weld_to=len(torus[0]))
    into.put_mesh("duplicated_vertices_jitter.ply", soup_of(*torus, random, 1e-6),
                  "the same with noise of 1e-6: closed after welding with a tolerance", closed=False,
                  weld_to=len(torus[0]), weld_tolerance=1e-5)
    for size in ("1e30", "1e-25", "1e-40"):
        into.put_mesh(f"coord_{size}.ply", (moved(vertices, float(size)), faces),
                      f"closed sphere of radius {size}: squares leave the range of float", closed=True)
    into.put_mesh("far_from_origin.ply", (moved(vertices, 1, (1e5, -2e5, 3e5)), faces),
                  "closed unit sphere far from the origin: its volume cancels in float", closed=True)


def put_degenerate(into, ball):
    """Closed spheres with triangles of no area, or nearly none."""
    vertices, faces = ball
    into.put_mesh("degenerate_repeated_index.ply",
                  (vertices, faces + [(faces[7 * i][0], faces[7 * i][0], faces[7 * i][1]) for i in range(10)] +
                   [(i, i, i) for i in range(5)]),
                  "closed sphere, 10 faces (a, a, b) and 5 faces (a, a, a)", closed=False, closed_after_dropping=True)
    a, b, c = faces[0]
    new = len(vertices)
    middle = tuple((p + q) / 2 for p, q in zip(vertices[a], vertices[b]))
    into.put_mesh("degenerate_collinear.ply",
                  (vertices + [middle], [(a, new, c)] + faces[1:] + [(new, b, c), (a, b, new)]),
                  "closed sphere, an edge divided on one side alone, and a face without area in the gap", closed=True)
    for name, part, what in (("zero_length_edge.ply", 0, "of length 0"), ("tiny_edge.ply", 1e-6, "of about 5e-7")):
        place = tuple(p + part * (q - p) for p, q in zip(vertices[a], vertices[b]))
        divided = []
        for face in faces:
            k = next((k for k in range(3) if {face[k], face[(k + 1) % 3]} == {a, b}), None)
            divided += [face] if k is None else [(face[k], new, face[k - 1]), (new, face[(k + 1) % 3], face[k - 1])]
        into.put_mesh(name, (vertices + [place], divided), f"closed sphere with an edge {what}", closed=True)


def put_scans(into):
    """Large, uneven, noisy, numbered at random: as scanned, with holes and vertices of no face, and as repaired."""
    random, rims, unused = Random(11), (80, 61, 40, 30, 12), 1113
    vertices, faces = scan(6, random)
    open_faces = cut_holes(faces, [(16001 * k, rim) for k, rim in enumerate(rims)], random)
    used = len({i for face in open_faces for i in face})
    stray = [tuple(random.uniform(-.1, .2) for _ in range(3)) for _ in range(unused - len(vertices) + used)]
    mesh = shuffled(vertices + stray, open_faces, random)
    known = measures_of(*mesh)
    assert known["unused"] == unused and known["boundary_edges"] == sum(rims)
    into.put_mesh("scan_with_holes.ply", mesh, "scan with 5 holes and 1,113 vertices of no face", closed=False,
                  loops=len(rims), **{key: known[key] for key in ("edges", "area", "boundary_edges", "unused")})
    mesh = shuffled(*scan(5, random), random)
    into.put_mesh("scan_closed.ply", mesh, "scan without holes, measured here in doubles", closed=True, valid=True,
                  loops=0, **measures_of(*mesh))


def put_numbers(into):
    """Numbers and indices that are none."""
    vertices, faces = sphere(2)
    for name, y in (("nan", math.nan), ("inf", math.inf), ("minus_inf", -math.inf)):
        places = [(x, y, z) if k == 17 else (x, v, z) for k, (x, v, z) in enumerate(vertices)]
        into.put(f"coord_{name}_binary.ply", binary_ply(places, faces), f"vertex 17 has y = {y}, binary", "error")
    lines = ascii_ply(vertices, faces).split("\n")
    first = lines.index("end_header") + 1

    def with_line(at, text):
        return "\n".join(lines[:at] + [text] + lines[at + 1:])

    for name, y in (("nan", "nan"), ("overflow", "1e999")):
        x, _, z = lines[first + 17].split()
        into.put(f"coord_{name}_ascii.ply", with_line(first + 17, f"{x} {y} {z}"), f"vertex 17 has y = {y}, ASCII",
                 "error")
    into.put("ascii_garbage_token.ply", with_line(first + 3, "0.1 zero 0.3"), "a word where a number should be", "error")
    into.put("ascii_short_row.ply", with_line(first + 3, "0.1 0.2"), "a vertex of two numbers", "error")
    into.put("ascii_decimal_comma.ply", "\n".join(lines[:first] + [line.replace(".", ",") for line in lines[first:]]),
             "decimal commas", "error")
    for name, index in (("index_out_of_range", len(vertices)), ("index_far_out_of_range", 2**31 - 1),
                        ("index_negative", -1)):
        into.put(f"{name}.ply", binary_ply(vertices, faces + [(0, 1, index)]), f"the last face has index {index}",
                 "error")
    for name, face in (("face_with_2_vertices", (0, 1)), ("face_with_0_vertices", ())):
        into.put(f"{name}.ply", binary_ply(vertices, faces + [face]), f"the last face is {face}", "ok_or_error",
                 V=len(vertices), F=len(faces) + 1)
    into.put("ascii_too_few_faces.ply", ascii_ply(vertices, faces[:-20], face_count=len(faces)),
             "the header promises 20 faces more than there are", "error")
    into.put("ascii_too_many_faces.ply", ascii_ply(vertices, faces, face_count=len(faces) - 20),
             "20 lines more than the header says: a hole of 20 faces", "ok", V=len(vertices), F=len(faces) - 20,
             closed=False)
    into.put("ascii_vertex_count_plus_one.ply", ascii_ply(vertices, faces, len(vertices) + 1),
             "a vertex too many in the header: a face is read as one", "error")
    into.put("ascii_vertex_count_minus_one.ply", ascii_ply(vertices, faces, len(vertices) - 1),
             "a vertex too few in the header: one is read as a face", "error")


def put_damaged(into):
    """PLY files that are cut short, or whose header is wrong."""
    vertices, faces = sphere(2)
    whole = binary_ply(vertices, faces)
    body = whole.index(b"end_header\n") + len(b"end_header\n")
    lists = body + 12 * len(vertices)
    for name, end in (("faces", lists + 13 * 100 + 5), ("vertices", body + 12 * 50 + 7), ("last_byte", len(whole) - 1),
                      ("header", body - 30)):
        into.put(f"truncated_{name}.ply", whole[:end], f"cut short: {name}", "error")
    into.put("trailing_bytes.ply", whole + bytes(37), "37 bytes too many", "ok", V=len(vertices), F=len(faces),
             closed=True, valid=True)
    into.put("face_list_255.ply", whole[:lists] + b"\xff" + whole[lists + 1:],
             "the first face claims 255 vertices, and runs over those behind it", "error")
    into.put("unknown_format.ply", whole.replace(b"little", b"middle"), "an unknown format", "error")

    four, triangle = floats_of(TETRAHEDRON[0]), lists_of([(0, 1, 2)])
    for name, count in (("list_count_int_huge", 2**31 - 1), ("list_count_int_negative", -3)):
        into.put(f"{name}.ply", ply_header(4, 1, lists="property list int int vertex_indices") + four +
                 struct.pack("<4i", count, 0, 1, 2), f"a face of {count} vertices", "error")
    into.put("list_count_float.ply", ply_header(4, 1, lists="property list float int vertex_indices") + four +
             struct.pack("<f3i", 3, 0, 1, 2), "the length of a list is a float", "error")
    for name, count in (("huge_vertex_count", 4000000000), ("count_overflow_u64", 2**64 - 1),
                        ("count_wraps_u64", 1537228672809129302), ("count_overflow_text", "9" * 26),
                        ("count_negative", -4), ("count_not_a_number", "many")):
        into.put(f"{name}.ply", ply_header(count, 1) + four, f"the header has {count} vertices, the body 4", "error")
    into.put("huge_vertex_count_ascii.ply", ply_header(4000000000, 2, "ascii") + b"0 0 0\n1 0 0\n",
             "the header has 4,000,000,000 vertices, the body 2", "error")
    into.put("huge_face_count.ply", ply_header(4, 4000000000) + four + triangle,
             "the header has 4,000,000,000 faces, the body 1", "error")
    into.put("faces_no_vertices.ply", ply_header(0, 1) + triangle, "a face without vertices to name", "error")
    into.put("unknown_type.ply", ply_header(4, 0).replace(b"float z", b"quaternion z") + four, "an unknown type", "error")
    into.put("no_coordinates.ply", ply_header(4, 1).replace(b"float x", b"float u").replace(b"float y", b"float v")
             .replace(b"float z", b"float w") + four + triangle, "vertices without x, y, z", "error")
    into.put("duplicate_vertex_element.ply", ply_header(4, 1).replace(
        b"element face", b"element vertex 2\nproperty float x\nproperty float y\nproperty float z\nelement face") +
        four + four[:24] + triangle, "two vertex elements", "error")
    into.put("property_before_element.ply",
             "ply\nformat ascii 1.0\nproperty float x\nelement vertex 0\nend_header\n", "a property of nothing", "error")
    into.put("empty.ply", "", "nothing", "error")
    into.put("only_magic.ply", "ply\n", "the first line alone", "error")
    into.put("not_a_ply.ply", Random(3).randbytes(4096), "4,096 random bytes", "error")
    into.put("html_instead.ply", "<!DOCTYPE html><html><body>404 Not Found</body></html>\n", "a web page", "error")
    into.put("long_header_line.ply", b"ply\nformat ascii 1.0\ncomment " + b"x" * 300000 +
             b"\nelement vertex 0\nelement face 0\nend_header\n", "a comment of 300,000 characters", "ok_or_error", V=0, F=0)
    into.put("tristrips.ply", ply_header(4, 1, lists="property list int int vertex_indices").replace(
        b"element face", b"element tristrips") + four + struct.pack("<11i", 10, 0, 2, 1, 3, -1, 1, 3, 0, 2, -1),
        "tetrahedron as strips of triangles", "ok_or_error", V=4, F=4, closed=True)


def put_odd(into):
    """PLY files as others write them: unusual, and right."""
    vertices, faces = sphere(2)
    right = {"V": len(vertices), "F": len(faces), "closed": True, "valid": True}
    whole = binary_ply(vertices, faces)
    body = whole.index(b"end_header\n") + len(b"end_header\n")
    text, torus = ascii_ply(vertices, faces), knobbly_torus()
    into.put("ok_big_endian.ply", binary_ply(*torus, ">"), "torus, big-endian", "ok", V=len(torus[0]),
             F=len(torus[1]), closed=True, valid=True)
    into.put("ok_ascii_crlf.ply", text.replace("\n", "\r\n"), "ASCII, lines of Windows", "ok", **right)
    into.put("ok_binary_crlf_header.ply", whole[:body].replace(b"\n", b"\r\n") + whole[body:],
             "binary, with lines of Windows in the header", "ok", **right)
    words = " ".join(rows_of(vertices, faces)).split()
    into.put("ok_ascii_free_layout.ply", text[:text.index("end_header\n")] + "end_header\n" +
             "\n".join("\t".join(words[k:k + 7]) for k in range(0, len(words), 7)),
             "ASCII, seven numbers a line, tabs, no newline at the end", "ok_or_error", V=len(vertices), F=len(faces))
    into.put("ok_double_coords.ply", whole[:body].replace(b"property float", b"property double") +
             floats_of(vertices, kind="d") + lists_of(faces), "coordinates are doubles", "ok", **right)
    into.put("ok_uint_ushort_lists.ply", ply_header(len(vertices), len(faces),
                                                    lists="property list ushort uint vertex_index") +
             floats_of(vertices) + lists_of(faces, count="H", index="I"), "list ushort uint vertex_index", "ok", **right)
    into.put("ok_int8_names.ply", whole.replace(b"property float", b"property float32").replace(
        b"list uchar int", b"list uint8 int32"), "types named float32, uint8, int32", "ok", **right)
    into.put("ok_extra_properties.ply", extra_properties(vertices, faces),
             "x, y, z out of order and of different types among others, lists, elements and comments", "ok", **right)
    into.put("ok_faces_before_vertices.ply",
             "ply\nformat ascii 1.0\nelement face 4\nproperty list uchar int vertex_indices\nelement vertex 4\n"
             "property float x\nproperty float y\nproperty float z\nend_header\n" +
             "\n".join(rows_of(*TETRAHEDRON)[4:] + rows_of(*TETRAHEDRON)[:4]) + "\n", "faces before vertices", "ok",
             V=4, F=4, closed=True, valid=True)
    ring = [(math.cos(2 * math.pi * k / 12), math.sin(2 * math.pi * k / 12)) for k in range(12)]
    into.put_mesh("ok_quads_ngons.ply", prism(ring), "prism of 12 quads and two polygons of 12 corners", closed=True,
                  triangles=44, volume=6 * math.sin(math.pi / 6))
    # Listed from a corner whose fan leaves the polygon.
    into.put_mesh("ok_concave_ngon.ply", prism([(2, 1), (1, 1), (1, 2), (0, 2), (0, 0), (2, 0)]),
                  "prism of the letter L: two concave hexagons", closed=True, triangles=20, volume=3.0)
    into.put_mesh("quads_cube.ply", CUBE, "cube of 6 quads", closed=True, triangles=12, volume=1.0)


def prism(ring):
    n = len(ring)
    return ([(x, y, 0) for x, y in ring] + [(x, y, 1) for x, y in ring],
            [tuple(range(n))[::-1], tuple(range(n, 2 * n))] +
            [(k, (k + 1) % n, n + (k + 1) % n, n + k) for k in range(n)])


def extra_properties(vertices, faces):
    header = f"""ply
format binary_little_endian 1.0
comment element vertex 99, in a comment
obj_info num_cols 512
element vertex {len(vertices)}
property uchar red
property float nx
property double z
property float x
property list uchar short neighbours
property float y
property float confidence
comment between
element material 2
property list uint char name
property int id
element face {len(faces)}
property uchar flags
property list uchar float texcoord
property list uchar int vertex_indices
property int texnumber
element edge 1
property int vertex1
property int vertex2
end_header
"""
    parts = [header.encode()]
    for k, (x, y, z) in enumerate(vertices):
        parts.append(struct.pack(f"<BfdfB{k % 3}hff", k % 256, x, z, x, k % 3, *[7] * (k % 3), y, 1))
    parts += [struct.pack("<I4si", 4, b"skin", 1), struct.pack("<Ii", 0, 2)]
    parts += [struct.pack("<BB6fB3ii", 1, 6, 0, 0, 1, 0, 0, 1, 3, *face, -1) for face in faces]
    return b"".join(parts) + struct.pack("<2i", 0, 1)


def put_objs(into):
    """OBJ files, odd and bad."""
    vertices, quads = CUBE
    cube = {"V": 8, "F": 6, "closed": True, "triangles": 12, "volume": 1.0}
    head = ["# a cube", "mtllib missing.mtl", "o cube", "g side top", "vt 0 0", "vt 1 0", "vt 1 1", "vt 0 1", "vn 0 0 1",
            *(f"v {x:g} {y:g} {z:g}" for x, y, z in vertices), "usemtl nothing", "s off"]

    def face(number, form, ahead=1):
        """`ahead`: 1 counts from the first vertex, -8 from the last."""
        return " ".join(form.format(i + ahead, k + 1, k - 4) for k, i in enumerate(quads[number]))

    lines = [*head, "f " + face(0, "{0}/{1}/1"), "f " + face(1, "{0}/{2}/-1", -8), "f " + face(2, "{0}//1"),
             "f " + face(3, "{0}/{1}", -8), "f " + face(4, "{0}"), "f " + face(5, "{0}", -8), ""]
    into.put("ok_obj_vt_vn_negative.obj", "\n".join(lines), "cube of quads, v/vt/vn in every form", "ok", **cube)
    into.put("ok_obj_crlf.obj", "\r\n".join(lines), "the same with lines of Windows", "ok", **cube)
    corners = face(2, "{0}").split()
    into.put("obj_odd_layout.obj", "\n".join([
        *head, "f " + face(0, "{0}") + "   # a comment", "f " + face(1, "{0}", -8) + "\r",
        f"f {corners[0]} {corners[1]} \\\n  {corners[2]} {corners[3]}", "f\t" + face(3, "{0}", -8).replace(" ", "\t"),
        "   f " + face(4, "{0}/"), "f " + face(5, "{0}") + "  "]),
        "cube: a comment behind a face, a stray CR, a line continued, tabs, no newline at the end", "ok_or_error", **cube)
    four, triangles = TETRAHEDRON
    solid = {"V": 4, "F": 4, "closed": True, "valid": True, "volume": 1 / 6}
    into.put("ok_obj_colours_w.obj", "\n".join(
        [f"v {x} {y} {z} 1.0 0.5 0.25" for x, y, z in four[:2]] + [f"v {x} {y} {z} 1.0" for x, y, z in four[2:]] +
        [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in triangles] + ["l 1 2", "p 3"]),
        "tetrahedron: colours, weights, lines and points", "ok", **solid)
    three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
    into.put("ok_obj_interleaved.obj", three + "f -3 -1 -2\nv 0 0 1\nf -4 -3 -1\nf -3 -2 -1\nf -2 -4 -1\n",
             "tetrahedron: relative indices count from their own line", "ok", **solid)
    for name, indices in (("index_zero", "0 1 2"), ("index_out_of_range", "1 2 4"),
                          ("negative_out_of_range", "-1 -2 -4"), ("index_overflow", f"1 2 {2**32 + 3}")):
        into.put(f"obj_{name}.obj", three + f"f {indices}\n", f"a face {indices} of 3 vertices", "error")
    into.put("obj_forward_reference.obj", "f 1 2 3\n" + three, "a face before its vertices", "ok_or_error", V=3, F=1)
    for name, vertex in (("bad_number", "0 0 zero"), ("nan", "0 0 nan"), ("short_vertex", "0 0")):
        into.put(f"obj_{name}.obj", f"v {vertex}\n" + three[8:] + "f 1 2 3\n", f"a vertex {vertex}", "error")
    into.put("obj_short_face.obj", three + "f 1 2\n", "a face of 2 vertices", "ok_or_error", V=3)
    into.put("obj_no_newline_binary.obj", three.encode() + b"f 1 2 3\0\0\xff\xfe" + bytes(range(256)),
             "binary rubbish behind the faces", "error")
    into.put("empty.obj", "", "nothing", "error")


def write_all(folder):
    into = Collection(folder)
    for put in (put_surfaces, put_scans, put_numbers, put_damaged, put_odd, put_objs):
        put(into)
    into.finish()


if __name__ == "__main__":
    write_all(sys.argv[1])

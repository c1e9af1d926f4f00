#!/usr/bin/env python3
"""Blender opens what Pliant writes, and finds the same volume.

    blender_test.py TOOL

A soft body, far from the origin, is blown up to 1.2 times its volume. Its nodes are renumbered and have an origin of
their own; what is written is in the order of the mesh and in the scene's coordinates. The PLY of frame 0 gets the .pc2
cache by a Mesh Cache modifier; its volume at the last frame, and that of the last frame's PLY, are within 1e-4 of what
`pliant check` says, and its middle is where the body was put. Without Blender (Debian:
blender) the test is skipped (exit code 77).
"""

import json
import math
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

FRAMES = 20
GROWTH = 1.2
PLACE = [3, 2, -1]  # m
SKIPPED = 77

IN_BLENDER = """
import sys
import bmesh, bpy

first, cache, last, frame = sys.argv[sys.argv.index("--") + 1:]


def opened(file):
    bpy.ops.import_mesh.ply(filepath=file)
    return bpy.context.view_layer.objects.active


def look(thing):
    evaluated = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = bmesh.new()
    mesh.from_mesh(evaluated.to_mesh())
    places = [vertex.co for vertex in mesh.verts]
    middle = [sum(place[axis] for place in places) / len(places) for axis in range(3)]
    print("FOUND", mesh.calc_volume(signed=True), *middle)


ball = opened(first)
look(ball)
modifier = ball.modifiers.new("cache", "MESH_CACHE")
modifier.cache_format = "PC2"
modifier.filepath = cache
modifier.interpolation = "NONE"
bpy.context.scene.frame_set(int(frame))
look(ball)
look(opened(last))
"""


def write_ball(file, rings=12, segments=24):
    """An egg, so that no axis is like another: a ball of radius 0.3 m, 1.5 as long along x."""
    places = [(0, 0.3, 0)]
    for ring in range(1, rings):
        a = math.pi * ring / rings
        for k in range(segments):
            b = -2 * math.pi * k / segments
            places.append((0.45 * math.sin(a) * math.cos(b), 0.3 * math.cos(a), 0.3 * math.sin(a) * math.sin(b)))
    places.append((0, -0.3, 0))
    south = len(places) - 1

    def at(ring, k):
        return 1 + (ring - 1) * segments + k % segments

    faces = [(0, at(1, k), at(1, k + 1)) for k in range(segments)]
    faces += [(at(r, k), at(r + 1, k), at(r + 1, k + 1), at(r, k + 1))
              for r in range(1, rings - 1) for k in range(segments)]
    faces += [(at(rings - 1, k + 1), at(rings - 1, k), south) for k in range(segments)]
    lines = [f"v {x:.7g} {y:.7g} {z:.7g}" for x, y, z in places]
    lines += ["f " + " ".join(str(i + 1) for i in face) for face in faces]
    file.write_text("\n".join(lines) + "\n")


def run(*arguments, folder):
    process = subprocess.run(arguments, cwd=folder, capture_output=True, text=True, timeout=300)
    if process.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, arguments))} ends with {process.returncode}:\n"
                         f"{process.stdout}{process.stderr}")
    return process.stdout


def main():
    tool = Path(sys.argv[1]).resolve()
    blender = shutil.which("blender")
    if not blender:
        print("skipped: blender: Blender is not installed; on Debian, install blender")
        return SKIPPED
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_ball(folder / "egg.obj")
        end = FRAMES / 60
        scene = {"pliant": 1, "method": "volume", "gravity": [0, 0, 0],
                 "time": {"duration": end, "frame_rate": 60, "substeps": 16},
                 "bodies": [{"mesh": {"file": "egg.obj"}, "position": PLACE, "node_mass": 0.01,
                             "springs": {"stiffness": 200, "damping": 0.2},
                             "volume": {"target": [{"time": 0, "value": 1}, {"time": end, "value": GROWTH}]}}]}
        (folder / "egg.json").write_text(json.dumps(scene))
        for cache in ["egg.pc2", "egg_%04d.ply"]:
            target = folder / "out"
            target.mkdir(exist_ok=True)
            run(tool, "run", "egg.json", "--backend", "cpu", "--quiet", "--cache", target / cache, folder=folder)
        first, last = target / "egg_0000.ply", target / f"egg_{FRAMES:04d}.ply"
        expected = []
        for file in [first, last]:
            report = run(tool, "check", file, folder=folder)
            expected.append(float(re.search(r"volume: (\S+) m\^3", report)[1]))
        (folder / "look.py").write_text(IN_BLENDER)
        out = run(blender, "--background", "--factory-startup", "--python-exit-code", "1", "--python", folder / "look.py", "--",
                  first, target / "egg.pc2", last, str(FRAMES), folder=folder)
    if not abs(expected[1] / expected[0] / GROWTH - 1) < 1e-3:
        raise SystemExit(f"the volume goes from {expected[0]} to {expected[1]} m^3, not to {GROWTH} times as much")
    found = [[float(word) for word in line.split()] for line in re.findall(r"^FOUND (.*)$", out, re.MULTILINE)]
    if len(found) != 3:
        raise SystemExit(f"Blender looked at {len(found)} meshes, not at 3")
    for what, (volume, *middle), ours in zip(["frame 0", "cache", "last frame"], found, [expected[0], expected[1], expected[1]]):
        print(f"{what}: {volume:.7g} m^3 in Blender, {ours:.7g} m^3 here, middle {middle}")
        if not abs(volume / ours - 1) < 1e-4:
            raise SystemExit(f"{what}: Blender and Pliant disagree")
        # Nothing pushes the body as a whole, and its vertices lie evenly about its middle.
        if not math.dist(middle, PLACE) < 1e-3:
            raise SystemExit(f"{what}: the body is at {middle}, not at {PLACE}")
    return 0


if __name__ == "__main__":
    sys.exit(main())

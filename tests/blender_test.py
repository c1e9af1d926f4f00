#!/usr/bin/env python3
"""Blender opens what Pliant writes, and finds the same volume.

    blender_test.py TOOL

A closed mesh falls on a plane. The PLY of frame 0 gets the .pc2 cache by a Mesh Cache modifier; its volume at the
last frame, and that of the last frame's PLY, are within 1e-4 of what `pliant check` says. Without Blender (Debian:
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
SKIPPED = 77

IN_BLENDER = """
import sys
import bmesh, bpy

first, cache, last, frame = sys.argv[sys.argv.index("--") + 1:]


def opened(file):
    bpy.ops.import_mesh.ply(filepath=file)
    return bpy.context.view_layer.objects.active


def volume(thing):
    evaluated = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = bmesh.new()
    mesh.from_mesh(evaluated.to_mesh())
    return mesh.calc_volume(signed=True)


ball = opened(first)
start = volume(ball)
modifier = ball.modifiers.new("cache", "MESH_CACHE")
modifier.cache_format = "PC2"
modifier.filepath = cache
modifier.interpolation = "NONE"
bpy.context.scene.frame_set(int(frame))
print("VOLUMES", start, volume(ball), volume(opened(last)))
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
        print("skipped: Blender is not installed; on Debian, install blender")
        return SKIPPED
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_ball(folder / "egg.obj")
        scene = {"pliant": 1, "time": {"duration": FRAMES / 60, "frame_rate": 60},
                 "cloths": [{"mesh": {"file": "egg.obj"}, "position": [0, 0.5, 0]}],
                 "colliders": [{"plane": {}}]}
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
        found = [float(word) for word in re.search(r"^VOLUMES (.*)$", out, re.MULTILINE)[1].split()]
    # The springs alone do not keep the volume: the cache shows another one than the mesh it is put on.
    if abs(expected[1] / expected[0] - 1) < 1e-3:
        raise SystemExit(f"the volume stays at {expected}, so that the cache is not seen")
    for what, volume, ours in zip(["frame 0", "cache", "last frame"], found, [expected[0], expected[1], expected[1]]):
        print(f"{what}: {volume:.7g} m^3 in Blender, {ours:.7g} m^3 here")
        if not abs(volume / ours - 1) < 1e-4:
            raise SystemExit(f"{what}: Blender and Pliant disagree")
    return 0


if __name__ == "__main__":
    sys.exit(main())

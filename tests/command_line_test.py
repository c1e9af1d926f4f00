#!/usr/bin/env python3
"""The command line tool from outside: what it refuses and in which words, what it writes, how it ends.

    command_line_test.py TOOL [PART]    only the cases with PART in their name

Messages are tested by what a user needs of them (the path, the value, the unit, the allowed names), not by
their every word.
"""

import copy
import json
import os
import pty
import re
import resource
import shlex
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

TOOL = str(Path(sys.argv[1]).resolve()) if len(sys.argv) > 1 else ""
PATIENCE = 300  # seconds for one call; builds with sanitizers are slow

BAD_INPUT, BAD_USAGE, DIVERGED, DEVICE_FAILURE, INTERRUPTED = 1, 2, 3, 4, 130
NO_DRIVER = {"VK_ICD_FILENAMES": "/nonexistent", "VK_DRIVER_FILES": "/nonexistent"}
OLD = "of an older run\n"
# Words of libraries and of crashes, which no user should meet.
FORBIDDEN = ["terminate called", "what():", "std::", "basic_string", "vector::", "json.exception",
             "Traceback", "Assertion", "Sanitizer", "->", "FAILED", "\x1b"]

SUMMARY_KEYS = ["scene", "method", "backend", "device", "threads", "nodes", "springs", "triangles", "frames",
                "steps", "simulated_seconds", "wall_seconds", "frames_per_second", "real_time_factor",
                "max_stretch", "max_stretch_peak", "mean_stretch", "max_penetration", "finite", "state_hash",
                "passes"]
STATISTICS_COLUMNS = ["frame", "time_s", "max_stretch", "mean_stretch", "max_penetration_m",
                      "max_speed_m_per_s", "kinetic_energy_J", "elastic_energy_J", "potential_energy_J",
                      "non_finite_nodes", "wall_ms", "newton", "iterations", "residual", "active_constraints",
                      "energy_lost_J"]
RUN_OPTIONS = ["--backend", "--device", "--threads", "--instruction-set", "--frames", "--set", "--stats",
               "--summary", "--cache", "--render", "--stills", "--check", "--quiet"]
SCENES = ["cloth_sphere", "hanging", "flag", "parity"]

# 12 nodes that fall for three frames, and pictures of them that are drawn at once.
GOOD = {
    "pliant": 1,
    "time": {"duration": 0.05, "frame_rate": 60},
    "cloths": [{"sheet": {"rows": 3, "columns": 4}, "position": [0, 0.5, 0]}],
    "camera": {"width": 96, "height": 64},
}
ROWS, COLUMNS, FRAMES = 3, 4, 3
TRIANGLE_OBJ = "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n"
MESH = {"mesh": {"file": "triangle.obj"}}
SPHERE = {"centre": [0, 0, 0], "radius": 1}

# --- what is refused ------------------------------------------------------------------------------

# Command lines: (arguments, exit code, words of the message). They find what write_inputs makes; CLOSED is a
# folder that takes no new files.
BAD_COMMANDS = [
    ("", BAD_USAGE, ["subcommand", "--help"]),
    ("frobnicate", BAD_USAGE, ["--help"]),
    ("--frobnicate", BAD_USAGE, ["--help"]),
    ("run", BAD_USAGE, ["scene", "required"]),
    ("list scene.json", BAD_USAGE, ["scene.json", "not expected"]),
    ("info --verbose", BAD_USAGE, ["--verbose", "not expected"]),
    ("check", BAD_USAGE, ["file", "required"]),
    ("run scene.json --summary scene.json", BAD_USAGE, ["the scene", "--summary", "scene.json"]),
    ("run scene.json --stats a.csv --summary ./a.csv", BAD_USAGE, ["--stats", "--summary", "a.csv"]),
    ("run scene.json --cache a.pc2 --stats a.obj", BAD_USAGE, ["--stats", "a.obj"]),
    ("run scene.json another.json", BAD_USAGE, ["another.json", "not expected"]),
    ("run scene.json --seed 3", BAD_USAGE, ["--seed", "not expected"]),
    ("run scene.json --stats", BAD_USAGE, ["--stats"]),
    ("run scene.json --frames 0", BAD_USAGE, ["--frames", "0", "1", "1000000000"]),
    ("run scene.json --frames -5", BAD_USAGE, ["--frames", "-5"]),
    ("run scene.json --frames 1.5", BAD_USAGE, ["--frames", "1.5"]),
    ("bench nonsense", BAD_USAGE, ["nonsense", "mss", "constraint", "acad", "volume", "stability", "all"]),
    ("bench --threads 0", BAD_USAGE, ["--threads", "0", "1"]),
    ("bench stability --json a.json --csv a.json", BAD_USAGE, ["--json", "--csv", "a.json"]),
    ("bench mss --csv a.csv --plot a.csv", BAD_USAGE, ["--csv", "--plot", "a.csv"]),
    ("bench mss --sizes 100,many", BAD_USAGE, ["--sizes", "many"]),
    ("bench mss --sizes 3", BAD_USAGE, ["--sizes", "3", "16"]),
    ("bench volume --sizes 100", BAD_USAGE, ["--sizes", "100", "1,000 to 500,000"]),
    ("bench acad --sizes 100", BAD_USAGE, ["--sizes", "acad", "mss"]),
    ("bench stability --json nowhere/a.json", BAD_INPUT, ["nowhere"]),
    ("run scene.json --frames many", BAD_USAGE, ["--frames", "many"]),
    ("run scene.json --frames 99999999999999999999", BAD_USAGE, ["--frames", "99999999999999999999"]),
    ("run scene.json --frames 2 --frames 3", BAD_USAGE, ["--frames"]),
    ("run scene.json --threads 0", BAD_USAGE, ["--threads", "0", "1024"]),
    ("run scene.json --threads 100000", BAD_USAGE, ["--threads", "100000", "1024"]),
    ("run scene.json --backend gpu", BAD_USAGE, ["--backend", "gpu", "auto", "cpu", "vulkan", "reference"]),
    ("run scene.json --backend 1", BAD_USAGE, ["--backend", "1", "auto", "cpu", "vulkan", "reference"]),
    ("run scene.json --device -1", BAD_USAGE, ["--device", "-1"]),
    ("run scene.json --backend vulkan --device 999", DEVICE_FAILURE, ["999", "pliant info"]),
    ("run scene.json --backend cpu --instruction-set mmx", BAD_USAGE, ["mmx", "this machine has"]),
    ("run scene.json --set time.duration", BAD_USAGE, ["time.duration", "path=value"]),
    ("run scene.json --set =3", BAD_USAGE, ["=3", "path=value"]),
    ("run scene.json --set cloths[.density=3", BAD_USAGE, ["cloths[.density=3", "path=value"]),
    ("run scene.json --set cloths[4].density=3", BAD_USAGE, ["element 4", "cloths", "has 1"]),
    ("run scene.json --set cloths.density=3", BAD_USAGE, ["cloths.density=3", "array of 1"]),
    ("run scene.json --set time.duration.x=3", BAD_USAGE, ["time.duration.x=3", "must be an object"]),
    ("run scene.json --set time.durration=3", BAD_INPUT, ["time.durration=3", "unknown", '"duration"']),
    ("run scene.json --set time.duration=long", BAD_INPUT, ["time.duration", '"long"', "1e6 s"]),
    ("run scene.json --set cloths[0].sheet.rows=1", BAD_INPUT, ["cloths[0].sheet.rows", "1 node", "2"]),
    ("run scene.json --set cloths[0].density=null --set cloths[0].mass=1", BAD_INPUT,
     ["cloths[0].mass", "unknown"]),
    ("run scene.json --set cloths[0].springs.structural.damping=1e6", BAD_INPUT,
     ["time.substeps", "100000", "softer springs"]),
    ("run cloth_spere", BAD_INPUT, ["cloth_spere", '"cloth_sphere"', "pliant list"]),
    ("run no/such/scene.json", BAD_INPUT, ["no/such/scene.json", "pliant list"]),
    ("run ''", BAD_INPUT, ['""', "pliant list"]),
    ("run folder", BAD_INPUT, ["folder", "directory"]),
    ("run triangle.obj", BAD_INPUT, ["triangle.obj", "line 1"]),
    ("check no_such_scene", BAD_INPUT, ["no_such_scene", "pliant list"]),
    ("check scene.json --set time.duration=0", BAD_INPUT, ["time.duration", "0 s", "above 0"]),
    ("check no.ply", BAD_INPUT, ["no.ply", "no such file"]),
    ("check triangle.3ds", BAD_INPUT, ["triangle.3ds", ".ply", ".obj", ".stl", ".off", ".gltf", ".glb"]),
    ("check no.stl", BAD_INPUT, ["no.stl", "no such file"]),
    ("check triangle.obj --weld 1e-5", BAD_USAGE, ["--weld", "--repair"]),
    ("check triangle.obj --fill-holes", BAD_USAGE, ["--fill-holes", "--repair"]),
    ("check triangle.obj --out a.ply", BAD_USAGE, ["--out", "--repair"]),
    ("check triangle.obj --repair --weld -1", BAD_USAGE, ["--weld", "-1", "10000"]),
    ("check triangle.obj --repair --weld wide", BAD_USAGE, ["--weld", "wide"]),
    ("check triangle.obj --repair --out a.stl", BAD_INPUT, ["a.stl", ".ply", ".obj"]),
    ("check triangle.obj --repair --out nowhere/a.ply", BAD_INPUT, ["nowhere"]),
    ("check triangle.obj --repair --out ./triangle.obj", BAD_USAGE, ["--out", "triangle.obj", "another name"]),
    ("check scene.json --repair", BAD_USAGE, ["--repair", "scene.json", "mesh"]),
    ("check broken.obj", BAD_INPUT, ["broken.obj", "line 4", "9"]),
    ("check broken.ply", BAD_INPUT, ["broken.ply", "vertex"]),
    ("check triangle.obj --set time.duration=1", BAD_USAGE, ["--set", "triangle.obj"]),
    # Outputs that cannot be: known before the run, so that none of the others is written.
    ("run scene.json --stats no/s.csv --summary new.json", BAD_INPUT, ["no/s.csv", "folder 'no'"]),
    ("run scene.json --stats folder", BAD_INPUT, ["'folder'", "it is a folder"]),
    ("run scene.json --stats CLOSED/s.csv", BAD_INPUT, ["CLOSED/s.csv", "permission"]),
    ("run scene.json --stats ''", BAD_USAGE, ["--stats"]),
    ("run scene.json --summary no/s.json --stats stats.csv", BAD_INPUT, ["no/s.json", "folder 'no'"]),
    ("run scene.json --summary folder --stats stats.csv", BAD_INPUT, ["'folder'", "it is a folder"]),
    ("run scene.json --summary CLOSED/s.json --cache new.pc2", BAD_INPUT, ["CLOSED/s.json", "permission"]),
    ("run scene.json --stats same.txt --summary same.txt", BAD_USAGE, ["same.txt", "--stats", "--summary"]),
    ("run scene.json --render same.png --render same.png", BAD_USAGE, ["same.png"]),
    ("run scene.json --cache c.abc", BAD_USAGE, ["c.abc", ".pc2", "%04d.ply", "%04d.obj"]),
    ("run scene.json --cache c.ply", BAD_USAGE, ["c.ply", "%04d.ply"]),
    ("run scene.json --cache c_%s.obj", BAD_USAGE, ["c_%s.obj", "%04d"]),
    ("run scene.json --cache c_%d_%d.obj", BAD_USAGE, ["c_%d_%d.obj", "%04d"]),
    ("run scene.json --cache no/c.pc2 --stats stats.csv", BAD_INPUT, ["no/c.pc2", "folder 'no'"]),
    ("run scene.json --cache no/c_%d.ply --stats stats.csv", BAD_INPUT, ["no/c_", "folder 'no'"]),
    ("run scene.json --cache folder.pc2 --stats stats.csv", BAD_INPUT, ["folder.obj", "it is a folder"]),
    ("run scene.json --cache CLOSED/c.pc2", BAD_INPUT, ["CLOSED/c.pc2", "permission"]),
    ("run scene.json --render p.gif", BAD_USAGE, ["p.gif", "x.png", "frames_%04d.png", "x.mp4"]),
    ("run scene.json --render p_%s.png", BAD_USAGE, ["p_%s.png", "%04d"]),
    ("run scene.json --render no/p.png --stats stats.csv", BAD_INPUT, ["no/p.png", "folder 'no'"]),
    ("run scene.json --render no/v.mp4", BAD_INPUT, ["no/v.mp4", "folder 'no'"]),
    ("run scene.json --render folder.png", BAD_INPUT, ["folder.png", "it is a folder"]),
    ("run scene.json --render CLOSED/p_%04d.png", BAD_INPUT, ["CLOSED/p_", "permission"]),
    ("run scene.json --stills p.png", BAD_USAGE, ["p.png", "%04d"]),
    ("run scene.json --stills p.mp4", BAD_USAGE, ["p.mp4", "%04d"]),
]

# Scenes: (what is wrong, path into GOOD, value put there, words of the message). None takes the key away.
# Every message also names the file.
BAD_SCENES = [
    ("no version", "pliant", None, ["pliant", "missing", '"pliant": 1']),
    ("a later version", "pliant", 2, ["pliant", "2", "must be 1"]),
    ("no cloths", "cloths", None, ["cloths", "at least one"]),
    ("an empty list of cloths", "cloths", [], ["cloths", "at least one"]),
    ("cloths as an object", "cloths", {}, ["cloths", "an object", "array"]),
    ("an unknown key", "gravitiy", [0, -9.81, 0], ["gravitiy", "unknown", '"gravity"']),
    ("an unknown method", "method", "xpbd", ["method", '"xpbd"', "mass_spring, constraint, acad"]),
    ("a mistyped method", "method", "constrain", ["method", '"constrain"', '"constraint"']),
    ("an unknown solver", "solver", "jacobi", ["solver", '"jacobi"', "newton_multigrid, paper"]),
    ("no iterations", "newton_multigrid", {"newton_iterations": 0},
     ["newton_multigrid.newton_iterations", "0 iterations", "between 1 and 1000"]),
    ("colliders of no stiffness", "newton_multigrid", {"contact_stiffness": 0},
     ["newton_multigrid.contact_stiffness", "0 N/m", "above 0"]),
    ("a tolerance of zero", "paper", {"tolerance": 0}, ["paper.tolerance", "0", "above 0"]),
    ("a stretch in per cent", "acad", {"activate_at": 10},
     ["acad.activate_at", "10", "above 0 and at most 1"]),
    ("a stretch upside down", "acad", {"activate_at": 0.05, "deactivate_at": 0.1},
     ["acad.deactivate_at", "0.1", "activate_at, 0.05"]),
    ("a flag in numbers", "acad", {"compression": 1}, ["acad.compression", "1", "true or false"]),
    ("a name with a slash", "name", "../evil", ["name", '"../evil"', "slash"]),
    ("a duration of zero", "time.duration", 0, ["time.duration", "0 s", "above 0"]),
    ("a duration in words", "time.duration", "5 s", ["time.duration", '"5 s"', "a number"]),
    ("a frame rate below one", "time.frame_rate", 0.5, ["time.frame_rate", "0.5 1/s", "between 1 and 10000"]),
    ("broken substeps", "time.substeps", 1.5, ["time.substeps", "1.5 steps", "whole number"]),
    ("negative substeps", "time.substeps", -1, ["time.substeps", "-1 steps", "0", "100000"]),
    ("dt and frame_rate", "time", {"dt": 0.001, "frame_rate": 60, "substeps": 10}, ["time.dt", "frame_rate"]),
    ("dt without substeps", "time", {"dt": 0.001}, ["time.dt", "substeps"]),
    ("a frame too long", "time", {"dt": 0.5, "substeps": 3}, ["time.dt", "0.5 s", "1.5 s"]),
    ("gravity as a number", "gravity", -9.81, ["gravity", "-9.81", "3 numbers", "m/s2"]),
    ("gravity of two numbers", "gravity", [0, -9.81], ["gravity", "array of 2", "3 numbers"]),
    ("gravity in words", "gravity", [0, "down", 0], ["gravity[1]", '"down"', "m/s2"]),
    ("gravity of a star", "gravity", [0, -1e7, 0], ["gravity[1]", "-1e7 m/s2", "-10000", "10000"]),
    ("air of negative density", "air", {"density": -1.2}, ["air.density", "-1.2 kg/m3", "between 0"]),
    ("no shape", "cloths.0", {}, ["cloths[0]", "sheet", "mesh", "exactly one"]),
    ("two shapes", "cloths.0.mesh", {"file": "triangle.obj"}, ["cloths[0].mesh", "sheet", "exactly one"]),
    ("one row", "cloths.0.sheet.rows", 1, ["cloths[0].sheet.rows", "1 nodes", "2"]),
    ("no columns", "cloths.0.sheet.columns", None, ["cloths[0].sheet.columns", "missing"]),
    ("too many nodes", "cloths.0.sheet", {"rows": 8192, "columns": 8192},
     ["cloths[0]", "67108864 nodes", "16777216"]),
    ("a width of zero", "cloths.0.sheet.width", 0, ["cloths[0].sheet.width", "0 m", "above 0"]),
    ("a negative stiffness", "cloths.0.springs", {"shear": {"stiffness": -5}},
     ["cloths[0].springs.shear.stiffness", "-5 N/m", "between 0 and 1e9"]),
    ("a mistyped key", "cloths.0.springs", {"shear": {"stifness": 5}},
     ["cloths[0].springs.shear.stifness", "unknown", '"stiffness"']),
    ("an endless stiffness", "cloths.0.springs", {"structural": {"stiffness": 1e300}},
     ["stiffness", "1e300 N/m"]),
    ("an unknown role", "cloths.0.springs", {"bend": {"role": "sping"}},
     ["cloths[0].springs.bend.role", '"sping"', '"spring"']),
    ("a constraint without its method", "cloths.0.springs", {"shear": {"role": "constraint"}},
     ["cloths[0].springs.shear.role", "mass_spring", "method constraint"]),
    ("a compliance of zero", "cloths.0.springs", {"shear": {"compliance": 0}},
     ["cloths[0].springs.shear.compliance", "0 m/N", "between 1e-9 and 1 m/N"]),
    ("springs that are no object", "cloths.0.springs", 7, ["cloths[0].springs", "7", "an object"]),
    ("density and node_mass", "cloths.0", {"sheet": {"rows": 2, "columns": 2}, "density": 1, "node_mass": 1},
     ["cloths[0].node_mass", "density"]),
    ("a density of zero", "cloths.0.density", 0, ["cloths[0].density", "0 kg/m2", "above 0"]),
    ("too much damping", "cloths.0.damping", 2000, ["cloths[0].damping", "2000 1/s", "1000"]),
    ("an unknown formulation", "cloths.0.formulation", "node-centric",
     ["cloths[0].formulation", '"node-centric"', "node_centric", "spring_list"]),
    ("an unknown corner", "cloths.0.pins", [{"corner": "topleft"}],
     ["cloths[0].pins[0].corner", '"topleft"', '"top_left"']),
    ("a pin that moves back in time", "cloths.0.pins",
     [{"corner": "top_left", "keyframes": [{"time": 2}, {"time": 1}]}],
     ["cloths[0].pins[0].keyframes[1].time", "1 s", "2 s"]),
    ("a pin beyond the nodes", "cloths.0.pins", [{"index": 12}],
     ["cloths[0].pins[0].index", "12", "0 to 11"]),
    ("a negative pin", "cloths.0.pins", [{"index": -1}], ["cloths[0].pins[0].index", "-1"]),
    ("a pin of two kinds", "cloths.0.pins", [{"corner": "top_left", "index": 0}],
     ["cloths[0].pins[0]", "exactly one"]),
    ("a box without max", "cloths.0.pins", [{"box": {"min": [0, 0, 0]}}],
     ["cloths[0].pins[0].box.max", "missing"]),
    ("a box inside out", "cloths.0.pins", [{"box": {"min": [1, 0, 0], "max": [0, 1, 1]}}],
     ["cloths[0].pins[0].box.min", "[1, 0, 0] m", "[0, 1, 1] m"]),
    ("a mesh without a file", "cloths.0", {"mesh": {}}, ["cloths[0].mesh.file", "missing"]),
    ("a mesh that is not there", "cloths.0", {"mesh": {"file": "no.obj"}},
     ["cloths[0].mesh.file", "no.obj", "no such"]),
    ("a broken mesh", "cloths.0", {"mesh": {"file": "broken.obj"}},
     ["cloths[0].mesh.file", "broken.obj", "line 4"]),
    ("a corner of a mesh", "cloths.0", {**MESH, "pins": [{"corner": "top_left"}]},
     ["cloths[0].pins[0].corner", "mesh", "index or box"]),
    ("node-centric on a mesh", "cloths.0", {**MESH, "formulation": "node_centric"},
     ["cloths[0].formulation", "node_centric", "spring_list"]),
    ("an unknown collider", "colliders", [{"torus": {}}],
     ["colliders[0].torus", "unknown", "sphere", "capsule"]),
    ("a collider of two shapes", "colliders", [{"sphere": SPHERE, "plane": {}}],
     ["colliders[0].plane", "sphere"]),
    ("a sphere without a radius", "colliders", [{"sphere": {"centre": [0, 0, 0]}}],
     ["colliders[0].sphere.radius"]),
    ("a sphere inside out", "colliders", [{"sphere": {**SPHERE, "radius": -1}}],
     ["colliders[0].sphere.radius", "-1 m", "above 0"]),
    ("a flat normal", "colliders", [{"plane": {"normal": [0, 0, 0]}}],
     ["colliders[0].plane.normal", "[0, 0, 0]"]),
    ("friction beyond its range", "colliders", [{"plane": {"friction": 11}}],
     ["colliders[0].plane.friction", "11", "10"]),
    ("an unknown response", "colliders", [{"plane": {"response": "sticky"}}],
     ["colliders[0].plane.response", '"sticky"', "coulomb", "paper"]),
    ("keyframes out of order", "colliders", [{"plane": {"keyframes": [{"time": 2}, {"time": 1}]}}],
     ["colliders[0].plane.keyframes[1].time", "1 s", "2 s"]),
    ("a camera in its own target", "camera", {"position": [1, 2, 3], "target": [1, 2, 3]},
     ["camera.target", "[1, 2, 3] m", "position"]),
    ("a picture too large", "camera.width", 10000, ["camera.width", "10000 pixels", "8192"]),
    ("an unknown check", "check", {"max_strech": [0, 1]}, ["check.max_strech", "unknown", '"max_stretch"']),
    ("a check of one number", "check", {"max_stretch": [1]},
     ["check.max_stretch", "array of 1", "[min, max]"]),
    ("a check upside down", "check", {"max_stretch": [1, 0]}, ["check.max_stretch", "[1, 0]", "order"]),
]

# Texts of scene files that are no scenes: (what is wrong, bytes, words).
BAD_TEXTS = [
    ("an empty file", b"", ["line 1"]),
    ("plain text", b"a sheet falls on a sphere", ["line 1", "column 1"]),
    ("a comma too few", b'{\n  "pliant": 1,\n  "time": {}\n  "cloths": []\n}', ["line 4", "column"]),
    ("an end too early", b'{"pliant": 1,\n "cloths": [', ["line 2"]),
    ("a comment without an end", b'{"pliant": 1 /* and so on', ["line 1", "comment"]),
    ("an array", b"[1, 2, 3]", ["array of 3", "an object"]),
    ("a key given twice", b'{"pliant": 1, "time": {"duration": 1, "duration": 2}}',
     ["time.duration", "twice"]),
    ("a number beyond all bounds", b'{"pliant": 1, "time": {"duration": 1e999}}',
     ["time.duration", "1.8e308"]),
    ("not a number", b'{"pliant": 1, "time": {"duration": NaN}}', ["line 1", "column"]),
    ("broken UTF-8", b'{"pliant": 1, "name": "\xff\xfe"}', ["line 1"]),
    ("zeros", bytes(64), ["line 1"]),
    ("a thousand brackets", b'{"pliant": 1, "cloths": ' + b"[" * 1000, ["32 levels"]),
]

# --- helpers --------------------------------------------------------------------------------------

CASES = []  # (name, function of an empty folder)


def case(function):
    CASES.append((function.__name__.replace("_", " "), function))
    return function


def expect(condition, complaint):
    if not condition:
        raise AssertionError(complaint)


def expect_words(text, words):
    for word in words:
        expect(word in text, f"'{word}' is missing in: {text.strip()}")


class Outcome:
    def __init__(self, process):
        self.code, self.out, self.err = process.returncode, process.stdout, process.stderr

    def expect(self, code):
        expect(self.code == code, f"exit code {self.code} instead of {code}: {self.out}{self.err}")
        for word in FORBIDDEN:
            expect(word not in self.err, f"'{word}' in: {self.err}")
        return self

    def error(self):
        """The one line that says what was wrong."""
        lines = [line for line in self.err.splitlines() if not line.startswith("warning: ")]
        errors = [line for line in lines if line.startswith("pliant: ")]
        expect(len(errors) == 1 and lines == errors, f"not exactly one line of error: {self.err}")
        return errors[0]


def call(folder, arguments, tool=TOOL, env=None, **options):
    """The tool in a folder; arguments as a list, or as they are typed."""
    words = shlex.split(arguments) if isinstance(arguments, str) else arguments
    return Outcome(subprocess.run([tool, *words], cwd=folder, env={**os.environ, **(env or {})},
                                  stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                  text=True, errors="replace", timeout=PATIENCE, **options))


def simulate(folder, arguments="", **options):
    """The usual run, of scene.json."""
    return call(folder, f"run scene.json --backend cpu --quiet {arguments}", **options)


def changed(scene, path, value):
    """A copy of the scene with `value` at "a.0.b"; None takes the key away."""
    scene = copy.deepcopy(scene)
    *way, last = [int(part) if part.isdigit() else part for part in path.split(".")]
    place = scene
    for part in way:
        place = place[part]
    if value is None:
        del place[last]
    else:
        place[last] = value
    return scene


def write_scene(folder, scene=None, name="scene.json"):
    (folder / name).write_text(json.dumps(GOOD if scene is None else scene, indent=2))


def write_inputs(folder):
    """All that the tables speak of, and results of older runs."""
    write_scene(folder)
    (folder / "triangle.obj").write_text(TRIANGLE_OBJ)
    (folder / "triangle.stl").write_text("solid triangle\nendsolid\n")
    (folder / "broken.obj").write_text(TRIANGLE_OBJ.replace("f 1 2 3", "f 1 2 9"))
    header = ["ply", "format ascii 1.0", "element vertex 3", "property float x", "end_header"]
    (folder / "broken.ply").write_text("\n".join([*header, "1\n"]))
    for name in ["folder", "folder.png", "folder.obj"]:
        (folder / name).mkdir()
    for name in ["stats.csv", "summary.json", "cloth.pc2", "cloth.obj", "picture.png"]:
        (folder / name).write_text(OLD)


def snapshot(folder):
    return {str(path.relative_to(folder)): path.read_bytes() if path.is_file() else None
            for path in sorted(folder.rglob("*"))}


def closed_folder(folder):
    """A folder that takes no new files, not even from root."""
    if os.geteuid() == 0:
        return "/proc"
    closed = folder / "closed"
    closed.mkdir(exist_ok=True)
    closed.chmod(0o555)
    return str(closed)


def refuse(folder, arguments, code, words):
    before = snapshot(folder)
    outcome = call(folder, arguments).expect(code)
    expect_words(outcome.error(), words)
    expect(outcome.out == "", f"a refusal prints: {outcome.out.strip()}")
    after = snapshot(folder)
    left = sorted(set(after) - set(before))
    expect(not left, f"{left} left behind")
    lost = [name for name in before if after.get(name) != before[name]]
    expect(not lost, f"{lost} changed")


def statistics_of(file):
    """The rows of a CSV file by column, after a look at its header and its numbers."""
    header, *lines = file.read_text().splitlines()
    expect(header.split(",") == STATISTICS_COLUMNS, f"{file.name} starts with {header}")
    rows = [dict(zip(STATISTICS_COLUMNS, map(float, line.split(",")), strict=True)) for line in lines]
    expect([row["frame"] for row in rows] == list(range(len(rows))), f"{file.name} does not count its frames")
    return rows


def summary_of(file):
    def refuse_constant(word):
        raise AssertionError(f"{file.name} holds {word}, which is no JSON")

    summary = json.loads(file.read_text(), parse_constant=refuse_constant)
    missing = [key for key in SUMMARY_KEYS if key not in summary]
    expect(not missing, f"{file.name} is without {missing}")
    return summary


def pc2_of(file):
    """Numbers of points and of samples of a point cache, after a look at its header and its size."""
    data = file.read_bytes()
    magic, version, points, start, rate, samples = struct.unpack("<12siiffi", data[:32])
    expect((magic, version, start, rate) == (b"POINTCACHE2\0", 1, 0, 1), f"{file.name} starts {data[:32]}")
    expect(len(data) == 32 + 12 * points * samples,
           f"{file.name} has {len(data)} bytes for {samples} samples of {points} points")
    return points, samples


def expect_png(file, width=96, height=64):
    data = file.read_bytes()
    expect(data.startswith(b"\x89PNG\r\n\x1a\n") and b"IEND" in data[-8:], f"{file.name} is no complete PNG")
    size = struct.unpack(">II", data[16:24])
    expect(size == (width, height), f"{file.name} has {size} pixels instead of {(width, height)}")


def video_of(file):
    """Width, height and number of frames, by decoding all of them."""
    command = shlex.split("ffprobe -v error -count_frames -select_streams v:0 -of csv=p=0 -show_entries")
    process = subprocess.run([*command, "stream=width,height,nb_read_frames", str(file)], timeout=PATIENCE,
                             check=True, capture_output=True, text=True)
    return tuple(int(number) for number in process.stdout.strip().split(","))


def expect_no_temporary(folder):
    left = [path.name for path in folder.iterdir() if path.name.startswith(".") or path.suffix == ".part"]
    expect(not left, f"{left} left behind")


def info_lines(word):
    """Lines of `pliant info` that start with --backend WORD."""
    out = call("/", "info").expect(0).out
    return [line for line in out.splitlines() if line.startswith(f"--backend {word}")]


def software_device():
    """Arguments for Vulkan on the CPU."""
    for line in info_lines("vulkan --device"):
        if "software" in line:
            return "--backend vulkan --device " + re.search(r"--device (\d+)", line)[1]
    raise AssertionError("no software Vulkan device; on Debian, install mesa-vulkan-drivers")


# --- what is refused: the tables above ------------------------------------------------------------

def add_refusals():
    def command(arguments, code, words):
        def test(folder):
            write_inputs(folder)
            closed = closed_folder(folder)
            split = [word.replace("CLOSED", closed) for word in shlex.split(arguments)]
            refuse(folder, split, code, [word.replace("CLOSED", closed) for word in words])
        CASES.append((f"refused: pliant {arguments}", test))

    def scene_file(what, content, words):
        outputs = "--stats stats.csv --summary summary.json --cache cloth.pc2 --render picture.png"

        def test(folder):
            write_inputs(folder)
            (folder / "bad.json").write_bytes(content)
            refuse(folder, f"run bad.json --backend cpu {outputs}", BAD_INPUT, ["bad.json", *words])
            refuse(folder, "check bad.json", BAD_INPUT, ["bad.json", *words])
        CASES.append((f"refused: {what}", test))

    for arguments, code, words in BAD_COMMANDS:
        command(arguments, code, words)
    for what, path, value, words in BAD_SCENES:
        scene_file(what, json.dumps(changed(GOOD, path, value)).encode(), words)
    for what, text, words in BAD_TEXTS:
        scene_file(what, text, words)


add_refusals()


@case
def a_full_disk_keeps_the_old_files(folder):
    write_inputs(folder)
    before = snapshot(folder)

    def limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))  # stands for a disk that is full after 4 KiB

    # Without restore_signals the limit is an error, as on a full disk, and not a signal.
    outcome = simulate(folder, "--frames 200 --stats stats.csv --summary summary.json", preexec_fn=limit,
                       restore_signals=False).expect(BAD_INPUT)
    expect_words(outcome.error(), ["stats.csv", "disk"])
    expect(snapshot(folder) == before, "files have changed")


@case
def a_failed_check_is_bad_input(folder):
    write_scene(folder, {**GOOD, "check": {"max_stretch": [0.5, 0.75], "finite": [1, 1]}})
    outcome = simulate(folder, "--check").expect(BAD_INPUT)
    expect_words(outcome.err, ["max_stretch", "0.5", "0.75"])
    expect("finite" not in outcome.err, "a check that holds is named as failed")


# --- what is good ---------------------------------------------------------------------------------

@case
def list_names_every_scene(folder):
    outcome = call(folder, "list").expect(0)
    expect(outcome.err == "", outcome.err)
    rows = dict(line.split(None, 1) for line in outcome.out.splitlines())
    expect(set(SCENES) <= set(rows), f"only {sorted(rows)}")
    expect(all(len(description) > 10 for description in rows.values()), "a scene without a description")


@case
def info_names_backends_and_limits(folder):
    outcome = call(folder, "info").expect(0)
    expect(re.match(r"pliant \d+\.\d+\.\d+\n", outcome.out), "no version")
    for backend in ["cpu", "reference", "vulkan"]:
        expect_words(outcome.out, [f"--backend {backend}"])
    expect_words(outcome.out, ["instruction sets"])
    for line in info_lines("vulkan --device"):
        expect_words(line, ["Vulkan 1.", "MiB"])


@case
def version_and_help(folder):
    version = call(folder, "--version").expect(0).out
    expect(re.fullmatch(r"pliant \d+\.\d+\.\d+\n", version), f"--version prints {version!r}")
    text = call(folder, "--help").expect(0).out
    expect_words(text, ["run", "list", "info", "check", "Exit codes", "diverged", "device failure"])
    expect(call(folder, "-h").expect(0).out == text, "-h is not --help")
    text = call(folder, "run --help").expect(0).out
    expect_words(text, [*RUN_OPTIONS, "auto|cpu|vulkan|reference"])
    expect_words(text, [".pc2", "%04d.ply", "%04d.obj", ".png", "%04d.png", ".mp4"])
    expect_words(call(folder, "check --help").expect(0).out,
                 ["SCENE|MESH", ".ply", ".obj", ".stl", "--set", "--repair", "--weld", "--fill-holes", "--out"])


@case
def check_a_built_in_scene(folder):
    outcome = call(folder, "check parity").expect(0)
    expect_words(outcome.out, ["parity", "1551", "steps", "ms", "stable", "good"])
    expect(outcome.err == "", outcome.err)
    expect(list(folder.iterdir()) == [], "check writes files")


@case
def check_a_scene_file(folder):
    write_scene(folder)
    expect_words(call(folder, "check scene.json").expect(0).out, ["nodes 12", "triangles 12", "good"])
    larger = call(folder, "check scene.json --set cloths[0].sheet.rows=5").expect(0)
    expect_words(larger.out, ["nodes 20"])
    risky = call(folder, "check scene.json --set time.substeps=1 --set "
                         "cloths[0].springs.structural.stiffness=1e6").expect(0)
    expect_words(risky.out, ["warning", "largest safe", "substeps"])


@case
def check_a_mesh_of_the_tool(folder):
    write_scene(folder)
    for ending in ["ply", "obj"]:
        simulate(folder, f"--cache seq_%d.{ending}").expect(0)
        outcome = call(folder, f"check seq_{FRAMES}.{ending}").expect(0)
        expect_words(outcome.out, ["12 vertices", "12 triangles", "1 component", "not closed"])


@case
def check_tells_what_repair_would_do_and_repair_does_it(folder):
    # A tetrahedron as STL has it, inside out and without one side.
    corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    sides = [(0, 1, 2), (0, 3, 1), (1, 3, 2)]
    stl = bytes(80) + struct.pack("<I", len(sides))
    for side in sides:
        stl += struct.pack("<12fH", 0, 0, 0, *[x for corner in side for x in corners[corner]], 0)
    (folder / "cut.stl").write_bytes(stl)
    preview = call(folder, "check cut.stl").expect(0).out
    expect_words(preview, ["4 vertices", "3 boundary edges", "1 boundary loop\n",
                           "of 3 edges, 3.41421 m long, at vertex", "--repair would change nothing",
                           "--fill-holes would do this as well, after which it is closed",
                           "volume of 0.166667 m^3", "holes filled: 1"])
    expect(not list(folder.glob("*.ply")), "check writes files")
    unkept = call(folder, "check cut.stl --repair --fill-holes").expect(0).out
    expect_words(unkept, ["nothing was written", "--out"])
    done = call(folder, "check cut.stl --repair --fill-holes --out whole.ply").expect(0).out
    expect_words(done, ["repaired:", "holes filled: 1", "triangles added: 1", "written: whole.ply"])
    expect_words(call(folder, "check whole.ply").expect(0).out,
                 ["closed, consistently oriented outward", "genus 0", "volume: 0.166667 m^3",
                  "--repair would change nothing"])
    expect_no_temporary(folder)


@case
def quiet_prints_nothing(folder):
    write_scene(folder)
    outcome = simulate(folder, "--stats stats.csv --summary summary.json").expect(0)
    expect(outcome.out + outcome.err == "", f"it prints {outcome.out + outcome.err!r}")


@case
def a_plain_run_says_what_it_did(folder):
    write_scene(folder)
    outcome = call(folder, "run scene.json --backend cpu --threads 2 --stats stats.csv").expect(0)
    expect_words(outcome.out, ["12 nodes", "3 frames", "CPU", "2 threads", "real time", "stretch"])
    expect_words(outcome.out, ["wrote stats.csv"])
    expect("pictures" not in outcome.out, f"it speaks of pictures: {outcome.out}")
    expect(re.search(r"100 %.*frame 3 of 3", outcome.err), f"no progress in {outcome.err!r}")
    expect("\r" not in outcome.err, "a progress bar without a terminal")


@case
def a_terminal_gets_a_progress_bar(folder):
    write_scene(folder)
    try:
        master, slave = pty.openpty()
    except OSError as error:  # a container without /dev/pts has no terminals to show a bar on
        print(f"a terminal gets a progress bar: not looked at, since there is no terminal ({error})")
        return
    try:
        process = subprocess.run([TOOL, "run", "scene.json", "--backend", "cpu"], cwd=folder,
                                 stdout=subprocess.DEVNULL, stderr=slave, timeout=PATIENCE)
        os.set_blocking(master, False)
        shown = os.read(master, 65536).decode()
    finally:
        os.close(master)
        os.close(slave)
    expect(process.returncode == 0, f"exit code {process.returncode}")
    expect(re.search(r"\r\[#+\] 100 %.*3 of 3", shown), f"it shows {shown!r}")
    expect(shown.endswith("\r\x1b[K"), f"the bar stays: {shown!r}")


@case
def a_run_with_all_outputs(folder):
    write_scene(folder)
    frames = 12
    simulate(folder, f"--frames {frames} --stats stats.csv --summary summary.json --cache cloth.pc2 "
                     "--render last.png --render frames_%04d.png --render video.mp4 "
                     "--stills still_%02d.png").expect(0)

    rows = statistics_of(folder / "stats.csv")
    expect(len(rows) == frames + 1, f"{len(rows)} rows of statistics")
    expect(abs(rows[-1]["time_s"] - frames / 60) < 1e-6, f"the last row is of {rows[-1]['time_s']} s")
    expect(all(row["non_finite_nodes"] == 0 for row in rows), "nodes that are not finite")
    expect(rows[-1]["max_speed_m_per_s"] > 1, "the sheet does not fall")

    summary = summary_of(folder / "summary.json")
    expected = {"scene": "scene", "backend": "cpu", "nodes": ROWS * COLUMNS, "frames": frames, "finite": True,
                "triangles": 2 * (ROWS - 1) * (COLUMNS - 1)}
    for key, value in expected.items():
        expect(summary[key] == value, f"{key} is {summary[key]} instead of {value}")
    expect(re.fullmatch(r"[0-9a-f]{16}", summary["state_hash"]), f"state_hash is {summary['state_hash']}")
    expect(abs(summary["simulated_seconds"] - frames / 60) < 1e-6, "simulated_seconds")
    expect(summary["threads"] >= 1 and summary["wall_seconds"] > 0, "threads or wall_seconds")
    expect(summary["passes"] and all(ms >= 0 for ms in summary["passes"].values()), "passes")
    expect(summary["max_stretch_peak"] >= summary["max_stretch"] >= summary["mean_stretch"], "stretch")

    expect(pc2_of(folder / "cloth.pc2") == (ROWS * COLUMNS, frames + 1), "cloth.pc2")
    vertices = re.findall(r"^v ", (folder / "cloth.obj").read_text(), re.MULTILINE)
    expect(len(vertices) == ROWS * COLUMNS, f"cloth.obj has {len(vertices)} vertices")
    expect_png(folder / "last.png")
    for frame in range(frames + 1):
        expect_png(folder / f"frames_{frame:04d}.png")
    last = (folder / f"frames_{frames:04d}.png").read_bytes()
    expect((folder / "last.png").read_bytes() == last, "last.png is not the last frame")
    expect((folder / "frames_0000.png").read_bytes() != last, "the first and the last frame look the same")
    expect(video_of(folder / "video.mp4") == (96, 64, frames), "video.mp4 is not every frame at 96 x 64")
    stills = sorted(folder.glob("still_*.png"))
    expect([still.name for still in stills] == [f"still_{frames * k // 5:02d}.png" for k in range(6)],
           f"the stills are {[still.name for still in stills]}")
    for still in stills:
        expect_png(still)
    named = {"scene.json", "stats.csv", "summary.json", "cloth.pc2", "cloth.obj", "last.png", "video.mp4"}
    numbered = {path.name for path in folder.glob("frames_*.png")} | {still.name for still in stills}
    expect(set(snapshot(folder)) == named | numbered, f"written: {sorted(snapshot(folder))}")
    expect(len(numbered) == frames + 1 + 6, f"pictures: {sorted(numbered)}")


@case
def sequences_of_meshes(folder):
    write_scene(folder)
    for ending in ["ply", "obj"]:
        simulate(folder, f"--cache seq_%04d.{ending}").expect(0)
        names = sorted(path.name for path in folder.glob(f"seq_*.{ending}"))
        expect(names == [f"seq_{frame:04d}.{ending}" for frame in range(FRAMES + 1)], f"written: {names}")
        contents = {path.read_bytes() for path in folder.glob(f"seq_*.{ending}")}
        expect(len(contents) == FRAMES + 1, f"the frames of seq_*.{ending} are not different")
    expect_no_temporary(folder)


@case
def frames_of_odd_size_make_a_video(folder):
    write_scene(folder, changed(changed(GOOD, "camera.width", 97), "camera.height", 65))
    simulate(folder, "--render v.mp4 --render p.png").expect(0)
    expect_png(folder / "p.png", 97, 65)
    video = video_of(folder / "v.mp4")
    expect(video in [(98, 66, FRAMES), (97, 65, FRAMES)], f"width, height, frames: {video}")


@case
def a_good_run_replaces_older_files(folder):
    write_inputs(folder)
    outputs = "--stats stats.csv --summary summary.json --cache cloth.pc2 --render picture.png"
    refusal = simulate(folder, outputs).expect(1).err  # a mesh that somebody modelled is not ours to replace
    expect("cloth.obj" in refusal and "another name" in refusal, refusal)
    (folder / "cloth.obj").unlink()
    simulate(folder, outputs).expect(0)
    simulate(folder, outputs).expect(0)  # but one that Pliant wrote is
    expect(len(statistics_of(folder / "stats.csv")) == FRAMES + 1, "stats.csv")
    summary_of(folder / "summary.json")
    pc2_of(folder / "cloth.pc2")
    expect_png(folder / "picture.png")
    expect_no_temporary(folder)


@case
def overrides_change_the_run(folder):
    write_scene(folder)
    simulate(folder, "--summary s.json --set time.duration=0.1 --set cloths[0].sheet.rows=7 --set name=other "
                     "--set 'cloths[0].pins=[{\"edge\": \"top\"}]'").expect(0)
    summary = summary_of(folder / "s.json")
    found = [summary[key] for key in ["scene", "frames", "nodes"]]
    expect(found == ["other", 6, 28], f"the run was of {found}")
    expect(summary["highest_height"] == 0.5, "the top edge is not pinned")


@case
def every_backend_runs(folder):
    write_scene(folder)
    ways = {"--backend cpu": ["cpu"], "--backend reference": ["reference"], software_device(): ["vulkan"],
            "--backend auto": ["cpu", "vulkan"], "": ["cpu", "vulkan"]}
    for way, backends in ways.items():
        call(folder, f"run scene.json --quiet --summary s.json {way}").expect(0)
        backend = summary_of(folder / "s.json")["backend"]
        expect(backend in backends, f"{way} ran on {backend}")


@case
def the_state_does_not_depend_on_threads_or_backend(folder):
    (cpu,) = info_lines("cpu")
    sets = re.search(r"instruction sets (.+)$", cpu)[1].split(", ")
    ways = [f"--backend cpu --threads {threads}" for threads in [1, 2, 3, 7]]
    ways += [f"--backend cpu --instruction-set {name}" for name in sets]
    ways += [software_device()]
    hashes = {}
    for way in ways:
        call(folder, f"run parity --frames 10 --quiet --summary s.json {way}").expect(0)
        summary = summary_of(folder / "s.json")
        expect(summary["frames"] == 10, f"{summary['frames']} frames")
        value = way.split()[-1]
        if "--threads" in way:
            expect(summary["threads"] == int(value), f"{way} ran on {summary['threads']} threads")
        if "--instruction-set" in way:
            expect(value in summary["device"], f"{way} ran on {summary['device']}")
        hashes[way] = summary["state_hash"]
    expect(len(set(hashes.values())) == 1, f"the state differs: {hashes}")


@case
def every_backend_draws(folder):
    write_scene(folder)
    for backend in ["--backend cpu", "--backend reference", software_device()]:
        call(folder, f"run scene.json --quiet --render picture.png {backend}").expect(0)
        expect_png(folder / "picture.png")
        (folder / "picture.png").unlink()


# --- where it is called ---------------------------------------------------------------------------

@case
def scenes_are_found_from_anywhere(folder):
    arguments = "run free_fall --frames 1 --quiet"
    call("/", arguments).expect(0)
    (folder / "link").symlink_to(TOOL)
    call(folder, arguments, tool="./link").expect(0)
    shutil.copy(TOOL, folder / "copy")  # scenes and shaders are inside
    call(folder, f"{arguments} {software_device()} --render p.png", tool="./copy").expect(0)


@case
def files_are_found_from_where_they_are_named(folder):
    inside = folder / "a folder" / "scenes"
    (inside / "meshes").mkdir(parents=True)
    (inside / "meshes" / "triangle.obj").write_text(TRIANGLE_OBJ)
    write_scene(inside, changed(GOOD, "cloths.0", {"mesh": {"file": "meshes/triangle.obj"}}), "my scene.json")
    for where, name in [(folder, "a folder/scenes/my scene.json"), (inside, "my scene.json"),
                        (inside, "./my scene.json"), ("/", inside / "my scene.json")]:
        call(where, f"run '{name}' --backend cpu --quiet --summary '{folder}/s.json'").expect(0)
        expect(summary_of(folder / "s.json")["nodes"] == 3, "not the mesh")


# --- without a driver -----------------------------------------------------------------------------

@case
def without_a_driver_a_run_goes_on_without_pictures(folder):
    write_scene(folder)
    outputs = "--summary s.json --render p.png --render v.mp4 --stills s_%d.png"
    for backend in ["--backend cpu", ""]:
        outcome = call(folder, f"run scene.json {backend} {outputs}", env=NO_DRIVER).expect(0)
        expect_words(outcome.err, ["warning", "without pictures", "Vulkan", "mesa-vulkan-drivers"])
        expect("wrote p.png" not in outcome.out, "it says that it wrote a picture")
        expect(summary_of(folder / "s.json")["backend"] == "cpu", "not on cpu")
        expect(set(snapshot(folder)) == {"scene.json", "s.json"}, f"written: {sorted(snapshot(folder))}")


@case
def without_a_driver_vulkan_is_a_device_failure(folder):
    write_inputs(folder)
    before = snapshot(folder)
    outcome = call(folder, "run scene.json --backend vulkan --stats stats.csv", env=NO_DRIVER)
    outcome.expect(DEVICE_FAILURE)
    expect_words(outcome.error(), ["Vulkan", "mesa-vulkan-drivers", "--backend cpu"])
    expect(snapshot(folder) == before, "files have changed")


@case
def without_a_driver_info_says_so(folder):
    outcome = call(folder, "info", env=NO_DRIVER).expect(0)
    expect_words(outcome.out, ["--backend cpu", "no driver", "mesa-vulkan-drivers"])


# --- ends before the end --------------------------------------------------------------------------

@case
def a_run_that_diverges(folder):
    scene = changed(GOOD, "cloths.0.springs", {"structural": {"stiffness": 1e5, "damping": 0}})
    scene = changed(scene, "cloths.0.pins", [{"corner": "top_left"}])
    write_scene(folder, scene)
    outputs = "--stats stats.csv --summary summary.json --cache cloth.pc2 --render video.mp4"
    outcome = simulate(folder, f"--frames 100 --set time.substeps=1 {outputs}").expect(DIVERGED)
    summary = summary_of(folder / "summary.json")
    expect(summary["finite"] is False, "the summary says that all is finite")
    last = summary["frames"]
    expect(1 < last < 100, f"it diverges in frame {last}")

    warning = outcome.err.splitlines()[0]
    expect(warning.startswith("warning: "), f"no warning before the run: {outcome.err}")
    expect_words(warning, [f"{1 / 60:.3g} s", f"{summary['stable_step_seconds']:.3g} s", "substeps"])
    message = outcome.error()
    expect_words(message, ["diverged", f"frame {last}", "'cloth'", "time.substeps", "softer", "heavier"])
    node = re.search(r"node (\d+)", message)
    expect(node and int(node[1]) < ROWS * COLUMNS, f"no node in: {message}")

    rows = statistics_of(folder / "stats.csv")
    expect(len(rows) == last + 1, f"{len(rows)} rows of statistics for {last} frames")
    expect(rows[-1]["non_finite_nodes"] > 0, "the statistics do not end with the bad frame")
    expect(all(row["non_finite_nodes"] == 0 for row in rows[:-1]), "the run went on after a bad frame")
    expect(pc2_of(folder / "cloth.pc2") == (ROWS * COLUMNS, last), "cloth.pc2 does not hold the good frames")
    width, height, pictures = video_of(folder / "video.mp4")  # nodes far off are not drawn any more
    expect((width, height) == (96, 64) and 1 <= pictures < last, f"video.mp4 holds {pictures} frames of {last}")
    expect_no_temporary(folder)

    advice = re.search(r"at least (\d+) substeps", message)
    expect(advice, f"no number of substeps in: {message}")
    simulate(folder, f"--frames 100 --set time.substeps={advice[1]}").expect(0)


def interrupt(folder, arguments, times=1):
    """Starts a run that has no end, lets it go for a second, and ends it as Ctrl-C in a terminal does."""
    command = [TOOL, *shlex.split(f"run parity --backend cpu --frames 1000000 {arguments}")]
    process = subprocess.Popen(command, cwd=folder, start_new_session=True, text=True,
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    try:
        expect("parity" in process.stdout.readline(), "the run does not say that it starts")
        time.sleep(1)
        for _ in range(times):
            os.killpg(process.pid, signal.SIGINT)
        out, err = process.communicate(timeout=PATIENCE)
    finally:
        if process.poll() is None:
            process.kill()
            process.communicate()
    return Outcome(subprocess.CompletedProcess([], process.returncode, out, err))


@case
def ctrl_c_leaves_complete_files(folder):
    small = "--set camera.width=96 --set camera.height=64"
    files = "--stats stats.csv --summary summary.json --cache cloth.pc2"
    outcome = interrupt(folder, f"{small} {files} --render video.mp4 --render last.png").expect(INTERRUPTED)
    summary = summary_of(folder / "summary.json")
    frames = summary["frames"]
    expect(frames >= 1 and summary["finite"] is True, f"{frames} frames")
    expect_words(outcome.err, ["interrupted", f"frame {frames}"])
    expect(len(statistics_of(folder / "stats.csv")) == frames + 1, "stats.csv")
    expect(pc2_of(folder / "cloth.pc2") == (33 * 47, frames + 1), "cloth.pc2")
    expect(video_of(folder / "video.mp4") == (96, 64, frames), "video.mp4")
    expect((folder / "last.png").exists(), "the picture of the last frame is missing")
    expect_png(folder / "last.png")
    expect_no_temporary(folder)


@case
def impatient_ctrl_c_leaves_complete_files(folder):
    interrupt(folder, "--stats stats.csv --summary summary.json", times=3).expect(INTERRUPTED)
    frames = summary_of(folder / "summary.json")["frames"]
    expect(len(statistics_of(folder / "stats.csv")) == frames + 1, "stats.csv")
    expect_no_temporary(folder)


# --- run all --------------------------------------------------------------------------------------

def main():
    if not TOOL:
        print(f"usage: {sys.argv[0]} TOOL [PART]")
        return 2
    part = sys.argv[2] if len(sys.argv) > 2 else ""
    passed = failed = 0
    for name, test in CASES:
        if part not in name:
            continue
        with tempfile.TemporaryDirectory(prefix="pliant-test-") as folder:
            try:
                test(Path(folder))
                passed += 1
            except Exception as error:  # whatever it is, the other cases go on
                failed += 1
                print(f"FAILED: {name}: {type(error).__name__}: {error}".replace("\n", " | "))
    print(f"{passed} passed, {failed} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())

"""What command_line_test.py calls and looks at the tool with."""

import copy
import json
import os
import re
import shlex
import struct
import subprocess
import sys
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

#!/usr/bin/env python3
"""`pliant check` on the bad and odd meshes of bad_meshes.py: as their manifest says, within a second and 256 MiB.

    bad_meshes_test.py TOOL [SANITIZERS]

The second is one of processor time, which a busy machine does not lengthen; neither limit holds for a build with
sanitizers.
"""

import json
import os
import re
import resource
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

from bad_meshes import write_all

TOOL = Path(sys.argv[1]).resolve()
SANITIZED = len(sys.argv) > 2 and sys.argv[2] != ""
MEMORY = 256 * 2**20  # bytes
PATIENCE = 120        # seconds of wall time; a call that takes longer hangs

# What --repair makes of files that need it: options, vertices, triangles, words of the report of the result.
WHOLE = ["surface: closed, consistently oriented outward"]
REPAIRS = {
    "duplicated_vertices_soup.ply": ("", 800, 1600, [*WHOLE, "genus 1", "volume: 2.37692"]),
    "duplicated_vertices_jitter.ply": ("--weld 1e-5", 800, 1600, [*WHOLE, "genus 1", "volume: 2.3769"]),
    "inside_out.ply": ("", 162, 320, [*WHOLE, "volume: 4.04704"]),
    "mixed_orientation.ply": ("", 162, 320, [*WHOLE, "volume: 4.04704"]),
    "duplicate_faces.ply": ("", 162, 320, [*WHOLE, "volume: 4.04704"]),
    "degenerate_repeated_index.ply": ("", 162, 320, [*WHOLE, "volume: 4.04704"]),
    "degenerate_collinear.ply": ("", 163, 322, [*WHOLE, "volume: 4.04704"]),
    "zero_length_edge.ply": ("", 162, 320, [*WHOLE, "volume: 4.04704"]),
    "tiny_edge.ply": ("--weld 1e-5", 162, 320, [*WHOLE, "volume: 4.04704"]),
    "isolated_vertices.ply": ("", 162, 320, [*WHOLE, "volume: 4.04704"]),
    "nested_cavity.ply": ("", 324, 640, [*WHOLE, "volume: 3.54116"]),
    "two_components.ply": ("", 324, 640, [*WHOLE, "2 components"]),
    "overlapping_components.ply": ("", 324, 640, [*WHOLE, "2 components"]),
    "pillow_2faces.ply": ("", 3, 2, ["surface: closed", "volume: 0 m^3"]),
    "zero_volume_flat.ply": ("", 162, 320, ["surface: closed", "volume: 0 m^3"]),
    "moebius.ply": ("--fill-holes", 48, 48, ["not closed", "not orientable"]),
    "nonmanifold_edge_4faces.ply": ("", 6, 8, ["not closed", "1 non-manifold edge"]),
    "nonmanifold_edge_fin.ply": ("", 9, 13, ["not closed", "1 non-manifold edge"]),
    "nonmanifold_vertex.ply": ("", 7, 8, ["not closed", "1 non-manifold vertex"]),
    "ascii_too_many_faces.ply": ("--fill-holes", 159, 314, [*WHOLE, "genus 0"]),
    "scan_with_holes.ply": ("--fill-holes", 40790, 81576, [*WHOLE, "genus 0"]),
}

failures, worst = [], {"seconds": 0.0, "MiB": 0.0}


def limits():
    if not SANITIZED:
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def call(arguments):
    """Exit code, output and errors of the tool; its time and memory are held against the limits."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        process = subprocess.Popen([str(TOOL), *arguments], stdout=out, stderr=err, preexec_fn=limits)
        watchdog = threading.Timer(PATIENCE, process.kill)
        watchdog.start()
        _, status, usage = os.wait4(process.pid, 0)
        watchdog.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        texts = []
        for stream in (out, err):
            stream.seek(0)
            texts.append(stream.read().decode(errors="replace"))
    what = " ".join(arguments)
    seconds, size = usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024
    worst["seconds"], worst["MiB"] = max(worst["seconds"], seconds), max(worst["MiB"], size)
    if not SANITIZED:
        expect(seconds < 1, f"{what}: takes {seconds:.2f} s of processor time")
        expect(size < 256, f"{what}: takes {size:.0f} MiB")
    expect(process.returncode in (0, 1), f"{what}: ends with {process.returncode}: {texts[1][:200]}")
    return process.returncode, *texts


def expect(holds, message):
    if not holds:
        failures.append(message)


def expect_words(text, words, what):
    for word in words:
        expect(word in text, f"{what}: {word!r} is not in\n{text}")


def check_as_stored(entry, path):
    """Accepted or refused as the manifest says, with its counts."""
    name = entry["file"]
    code, out, err = call(["check", str(path)])
    if code != 0:
        expect(entry["parse"] != "ok", f"{name}: refused: {err}")
        expect(err.startswith("pliant: ") and err.count("\n") == 1 and name in err, f"{name}: says {err!r}")
        return False
    expect(entry["parse"] != "error", f"{name}: accepted:\n{out}")
    expect(err == "", f"{name}: warns {err!r}")
    counts = re.search(r"(\d+) (?:vertex|vertices), \d+ edges?, (\d+) triangles? in (\d+) comp", out)
    vertices, triangles, components = (int(count) for count in counts.groups())
    expect(vertices == entry.get("V", vertices), f"{name}: {vertices} vertices")
    expect(triangles == entry.get("triangles", entry.get("F", triangles)), f"{name}: {triangles} triangles")
    expect(components == entry.get("components", components), f"{name}: {components} components")
    for key, words in (("edges", "edges, "), ("boundary_edges", "boundary edges\n"), ("loops", "boundary loops\n"),
                       ("unused", "vertices used by no triangle")):
        if entry.get(key):
            expect_words(out, [f"{entry[key]} {words}"], name)
    if "area" in entry:
        expect_words(out, [f"area: {entry['area']:.6g} m^2"], name)
    if "closed" in entry and triangles > 0:
        expect_words(out, ["surface: closed" if entry["closed"] else "surface: not closed"], name)
    if "volume" in entry:
        expect_words(out, [f"volume: {entry['volume']:.6g} m^3"], name)
    if entry.get("volume_sign") == -1:
        expect_words(out, ["volume: -", "inside out"], name)
    if entry.get("valid"):
        expect_words(out, [*WHOLE, "--repair would change nothing"], name)
    return True


def check_repaired(name, path, folder):
    options, vertices, triangles, words = REPAIRS[name]
    fixed = folder / "fixed.ply"
    code, out, err = call(["check", str(path), "--repair", *options.split(), "--out", str(fixed)])
    expect(code == 0, f"{name}: cannot be repaired: {err}")
    if code != 0:
        return
    expect_words(out, ["written: "], name)
    out = call(["check", str(fixed)])[1]
    expect_words(out, [f"{vertices} vertices", f" {triangles} triangles", *words], f"{name}, repaired")
    fixed.unlink()


def main():
    accepted = 0
    with tempfile.TemporaryDirectory() as temporary:
        folder, bad = Path(temporary), Path(temporary) / "bad"
        write_all(bad)
        entries = json.loads((bad / "manifest.json").read_text())["files"]
        for entry in entries:
            if check_as_stored(entry, bad / entry["file"]):
                accepted += 1
                if entry["file"] in REPAIRS:
                    check_repaired(entry["file"], bad / entry["file"], folder)
    expect(accepted >= 48, f"only {accepted} files are read")
    missing = set(REPAIRS) - {entry["file"] for entry in entries}
    expect(not missing, f"not in the manifest: {missing}")
    print(f"{len(entries)} files, {accepted} read, {len(REPAIRS)} repaired; at most {worst['seconds']:.2f} s of "
          f"processor time and {worst['MiB']:.0f} MiB")
    for failure in failures:
        print("FAILED", failure)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())

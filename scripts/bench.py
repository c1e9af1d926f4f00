#!/usr/bin/env python3
"""Times the mass-spring step on every backend of this machine: scripts/bench.py PLIANT [--frames N] [--repeats N].

Every backend runs the same scene in turn, several times over; the table gives the median (least, largest) time of the
pass that steps the sheet, so that set-up, files and statistics do not count. Machines are noisy: compare rows of one
table, not of two.
"""
import argparse
import json
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path


def backends(tool):
    """(label, arguments) of each backend: the reference, each instruction set with one and all threads, each device."""
    found = []
    for line in subprocess.run([tool, "info"], check=True, capture_output=True, text=True).stdout.splitlines():
        words = line.split()
        if line.startswith("--backend vulkan --device"):
            name = line.split(": ", 1)[1].split(" (")[0]
            found.append((f"vulkan, {name}", ["--backend", "vulkan", "--device", words[3].rstrip(":")]))
        elif line.startswith("--backend cpu"):
            for name in line.split("instruction sets ", 1)[1].split(", "):
                found.append((f"cpu, {name}, 1 thread", ["--backend", "cpu", "--instruction-set", name, "--threads", "1"]))
            found.append((f"cpu, {name}, all threads", ["--backend", "cpu", "--instruction-set", name]))
        elif line.startswith("--backend reference"):
            found.append(("reference, double, serial", ["--backend", "reference"]))
    return found


def nanoseconds_per_node_and_step(tool, scene, arguments, frames):
    with tempfile.TemporaryDirectory() as folder:
        summary = Path(folder) / "summary.json"
        subprocess.run([tool, "run", scene, "--quiet", "--frames", str(frames), "--summary", summary, *arguments],
                       check=True)
        result = json.loads(summary.read_text())
    return result["passes"]["sheet_step"] * 1e6 / (result["nodes"] * result["steps"]), result


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("tool", help="the built program, build/release/bin/pliant")
    parser.add_argument("--scene", default="cloth_sphere", help="a scene of one node-centric sheet (default: %(default)s)")
    parser.add_argument("--frames", type=int, default=2, help="frames of a run (default: %(default)s)")
    parser.add_argument("--repeats", type=int, default=5, help="runs of each backend (default: %(default)s)")
    options = parser.parse_args()

    rows = {label: [] for label, _ in backends(options.tool)}
    result = None
    for repeat in range(options.repeats):
        for label, arguments in backends(options.tool):
            if sys.stderr.isatty():
                print(f"\rrun {repeat + 1} of {options.repeats}: {label:50}", end="", file=sys.stderr, flush=True)
            time, result = nanoseconds_per_node_and_step(options.tool, options.scene, arguments, options.frames)
            rows[label].append(time)
    if sys.stderr.isatty():
        print("\r" + 80 * " " + "\r", end="", file=sys.stderr)
    print(f"{options.scene}: {result['nodes']} nodes, {result['steps']} steps of {result['step_seconds'] * 1e6:.3g} us")
    print(f"{'backend':44} {'ns per node and step: median (least, largest)'}")
    for label, times in rows.items():
        print(f"{label:44} {statistics.median(times):9.2f} ({min(times):.2f}, {max(times):.2f})")


if __name__ == "__main__":
    main()

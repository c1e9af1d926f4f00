#!/usr/bin/env python3
"""Every suite of `pliant bench` with tiny sizes: bench_test.py PLIANT SUITE.

Figures of tiny sizes say nothing; looked at is what a reader of the files counts on: the keys of a row, numbers that agree
with each other, the same rows in both files, a plot that is well-formed, and what does not depend on the machine.
"""
import csv
import json
import math
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml
from pathlib import Path

ALWAYS = {"suite", "case", "method", "backend", "device", "threads", "nodes", "springs", "triangles", "stiffness_n_per_m",
          "step_seconds", "simulated_seconds_per_second"}
TIMED = {"ms_per_step_median", "ms_per_step_min", "ms_per_step_max", "repeats", "ns_per_node_step"}
STEPPED = {"bytes_per_node_step", "gigabytes_per_second", "max_stretch_peak", "state_hash"}
COMPARED = {"ratio_to_serial", "copy_bandwidth_fraction"}
LEAST_REPEATS = 7
BASELINES = {"serial", "btSoftBody"}


def expect(condition, message):
    if not condition:
        raise AssertionError(message)


def look_at(row):
    expect(ALWAYS <= row.keys(), f"{ALWAYS - row.keys()} are missing in {row}")
    expect(row["nodes"] > 0 and row["springs"] > 0 and (row["threads"] > 0 or row["backend"] == "vulkan"), f"an empty row: {row}")
    expect(all(value is not None for value in row.values()), f"a key without a value: {row}")
    for measured in row.get("measured", []):
        expect(measured["unit"] and math.isfinite(measured["value"]), f"nothing was measured: {measured}")
        expect(measured["verdict"] in (["met", "missed"] if measured["bar"] else [""]), f"no verdict: {measured}")
    if "ms_per_step_median" not in row:
        return
    expect(TIMED <= row.keys(), f"{TIMED - row.keys()} are missing in {row}")
    expect(0 < row["ms_per_step_min"] <= row["ms_per_step_median"] <= row["ms_per_step_max"], f"no median: {row}")
    expect(row["repeats"] >= LEAST_REPEATS, f"too few repeats: {row}")
    expect(math.isclose(row["ns_per_node_step"], 1e6 * row["ms_per_step_median"] / row["nodes"], rel_tol=1e-5),
           f"ns per node do not agree with ms: {row}")


def look_at_steps(rows):
    """Suites of explicit steps: each case beside its baseline, and the same bits on any number of threads."""
    hashes = {}
    for row in rows:
        if row["backend"] in BASELINES or "ms_per_step_median" not in row:
            continue
        expect(STEPPED <= row.keys(), f"{STEPPED - row.keys()} are missing in {row}")
        expect(re.fullmatch(r"[0-9a-f]{16}", row["state_hash"]), f"no hash: {row}")
        if " by " not in row["case"]:  # on every backend, without baselines
            expect(COMPARED <= row.keys() and row["ratio_to_serial"] > 0, f"compared with nothing: {row}")
            hashes.setdefault((row["case"], row["nodes"]), set()).add(row["state_hash"])
    expect(hashes and all(len(each) == 1 for each in hashes.values()), f"bits depend on threads: {hashes}")
    expect(sum(row["backend"] == "serial" for row in rows) >= len(hashes), "a case without its baseline")
    for row in rows:
        expect(row.get("max_stretch_peak", 0) < 0.1, f"not stepped as it should be: {row}")
        for measured in row.get("measured", []):
            if measured["measured"] == "same bits as the first":
                expect(measured["verdict"] == "met", f"missed: {row}")


def main():
    tool, suite = sys.argv[1:]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        outcome = subprocess.run([tool, "bench", suite, "--quick", "--backend", "cpu", "--threads", "2", "--json", "b.json",
                                  "--csv", "b.csv", "--plot", "b.svg"], cwd=folder, capture_output=True, text=True)
        expect(outcome.returncode == 0, f"exit code {outcome.returncode}: {outcome.stderr}")
        expect(re.search(r"100 %.*case (\d+) of \1", outcome.stderr), f"no progress in {outcome.stderr!r}")
        document = json.loads((folder / "b.json").read_text())
        rows = document["rows"]
        expect(document["quick"] is True and document["machine"] and rows, f"no rows: {document}")
        expect(f"{suite}: {len(rows)} rows" in outcome.stdout, outcome.stdout)
        for row in rows:
            expect(row["suite"] == suite and row["case"] in outcome.stdout, f"not in the table: {row}")
            look_at(row)
        if suite in ("mss", "volume"):
            look_at_steps(rows)
        for row in rows:  # what does not depend on the machine
            for measured in row.get("measured", []):
                if measured["measured"] == "V-cycles, smoothing 3" or suite == "stability":
                    expect(measured["verdict"] == "met", f"missed: {row}")
            if suite == "volume" and row["method"] == "volume" and row["backend"] == "cpu":
                expect(row["volume_error_max"] < 1e-5, f"the volume is not kept: {row}")

        lines = list(csv.DictReader((folder / "b.csv").open(newline="")))
        expect(len(lines) == sum(max(1, len(row.get("measured", []))) for row in rows), "b.csv has other rows")
        for line in lines:
            row = rows[int(line["row"])]
            expect(None not in line and None not in line.values(), f"a line of another length: {line}")
            expect(line["case"] == row["case"] and line["state_hash"] == row.get("state_hash", ""), f"differs: {line}")
        plot = xml.parse(folder / "b.svg").getroot()
        expect(plot.tag.endswith("svg"), "b.svg is no SVG")
        points = len(plot.findall(".//{http://www.w3.org/2000/svg}circle"))
        timed = sum("ms_per_step_median" in row and suite != "acad" and " by " not in row["case"] for row in rows)
        expect(points == timed, f"{points} points in the plot of {timed} rows")
        expect({path.name for path in folder.iterdir()} == {"b.json", "b.csv", "b.svg"}, "other files were left")


if __name__ == "__main__":
    main()

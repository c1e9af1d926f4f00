#!/usr/bin/env python3
"""The table of speed in README.md, made from what `pliant bench` measured.

    speed_table.py              checks that README.md has the table of the newest file in benchmarks/results/*.json;
                                ends with 'N passed, N failed'
    speed_table.py --write      writes the table
    speed_table.py --measure NAME [PLIANT]
                                measures (10 minutes on two cores, with nothing else at work), keeps
                                benchmarks/results/NAME.json with machine, date and commit, and writes the table
"""
import datetime
import json
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
RESULTS = ROOT / "benchmarks/results"
BEGIN, END = "<!-- speed: made by scripts/speed_table.py -->", "<!-- end of speed -->"
RUNS = [
    ["mss", "--backend", "cpu", "--sizes", "1024,16384,262144,1048576", "--only", "sheet"],
    ["mss", "--only", "backend"],
    ["mss", "--backend", "cpu", "--only", "mesh"],
    ["constraint", "--backend", "cpu", "--sizes", "4096,16384,65536,262144", "--only", "hanging"],
    ["constraint", "--backend", "cpu", "--only", "garment"],
    ["constraint", "--backend", "cpu", "--only", "one thread"],
    ["acad", "--backend", "cpu", "--only", "over 10"],
    ["volume", "--backend", "cpu", "--sizes", "31112"],
]


def measure(name, program):
    rows, head = [], {}
    for arguments in RUNS:
        print("pliant bench", *arguments, flush=True)
        with tempfile.NamedTemporaryFile(suffix=".json") as file:
            subprocess.run([program, "bench", *arguments, "--json", file.name], check=True, stdout=subprocess.DEVNULL)
            head = json.loads(Path(file.name).read_text())
        rows += [row for row in head["rows"] if row not in rows]
    commit = subprocess.run(["git", "-C", ROOT, "describe", "--always", "--dirty", "--exclude=*"], check=True,
                            capture_output=True, text=True).stdout.strip()
    result = {"machine": head["machine"], "date": datetime.date.today().isoformat(), "commit": commit,
              "pliant": head["pliant"], "rows": rows}
    (RESULTS / f"{name}.json").write_text(json.dumps(result, indent=1) + "\n")


def newest():
    results = [json.loads(file.read_text()) for file in sorted(RESULTS.glob("*.json"))]
    return max(results, key=lambda result: result["date"])


def number(value):
    """Three digits, as people write them."""
    if value >= 1000:
        return f"{round(value, 2 - len(str(int(value)))):,.0f}"
    return f"{value:.3g}"


def value_of(row, name):
    return next((m["value"] for m in row.get("measured", []) if m["measured"] == name), None)


def table(result):
    rows = result["rows"]
    most = max((row.get("threads") or 0) for row in rows if row["backend"] == "cpu")

    def find(suite, case, backend="cpu", threads=most, nodes=None, method=None):
        for row in rows:
            if (row["suite"] == suite and row["case"].startswith(case) and row["backend"] == backend and
                    (threads is None or row.get("threads") == threads) and nodes in (None, row["nodes"]) and
                    method in (None, row["method"]) and "ms_per_step_median" in row):
                return row
        return None

    lines = [f"Measured on {result['date']} (commit {result['commit']}): {result['machine']}. Median of the steps of a run.", "",
             "| method, backend | what is stepped | time | against others in the same run |", "| --- | --- | --- | --- |"]

    def add(what, case, row, beside=""):
        ms = row["ms_per_step_median"]
        time = f"{number(ms)} ms a step"
        if row["suite"] == "mss" or row["suite"] == "volume":
            time += f", {number(row['ns_per_node_step'])} ns a node"
        elif row["suite"] == "constraint":
            time = f"{number(ms)} ms a frame, {number(1000 / ms)} frames/s"
        lines.append(f"| {what} | {case} | {time} | {beside} |")

    for nodes in (1024, 16384, 262144, 1048576):
        if row := find("mss", "sheet", nodes=nodes):
            beside = f"{number(row['ratio_to_serial'])} x the papers' serial program"
            if "ratio_to_soft_body" in row:
                beside += f", {number(row['ratio_to_soft_body'])} x Bullet's `btSoftBody`"
            add(f"`mass_spring`, `cpu`, {most} threads", f"sheet, {nodes:,} nodes", row, beside)
    if row := find("mss", "mesh, spring list"):
        add(f"`mass_spring`, `cpu`, {most} threads", f"triangle mesh, {row['nodes']:,} nodes", row,
            f"{number(row['ratio_to_serial'])} x the papers' serial program")
    for row in rows:
        case = row["case"]
        if row["suite"] == "mss" and case.startswith("sheet by") and "ms_per_step_median" in row:
            name = case.removeprefix("sheet by ").removeprefix("CPU, ")
            if "dispatch" in name or "fast" in name or (row["backend"] == "cpu" and row["threads"] != 1):
                continue
            remark = "software; for correctness alone" if "llvmpipe" in name else ""
            add(f"`mass_spring`, `{row['backend']}`, {name.split(' (')[0]}", f"sheet, {row['nodes']:,} nodes", row, remark)
    for row in rows:
        if row["suite"] == "constraint" and row["case"].startswith("hanging") and row["backend"] == "cpu":
            stretch = value_of(row, "stretch, ever")
            add(f"`constraint`, `cpu`, {row['threads']} threads", f"hanging sheet, {row['nodes']:,} nodes", row,
                f"stretch {number(stretch)} % at most, ever" if stretch is not None else "")
    one = find("constraint", "one thread, 96 x 96", threads=None)
    if one:
        add("`constraint`, `cpu`, 1 thread", "hanging sheet, 96 x 96 nodes, 1 kg/m2", one,
            f"stretch {number(value_of(one, 'stretch, ever'))} %; NvCloth on another day and machine: 15.9 ms at 5.6 %, "
            "where Pliant took 7.8 ms")
    for row in rows:
        if row["suite"] == "constraint" and row["case"].startswith("garment") and row.get("threads") == most:
            ratio = value_of(row, "time / sheet's")
            add(f"`constraint`, `cpu`, {most} threads", f"{row['case'].split(', ')[1]}, {row['nodes']:,} nodes", row,
                f"{number(ratio)} x the time of a sheet of as many; stretch {number(value_of(row, 'stretch, ever'))} %")
    if row := find("acad", "no spring over", method="acad"):
        add(f"`acad`, `cpu`, {most} threads", f"sheet, {row['nodes']:,} nodes, nothing over its threshold", row,
            f"{number(value_of(row, 'acad / mass_spring'))} x the time of `mass_spring`")
    for case, what in (("figure, springs alone", "soft body without its constraint"), ("figure, volume", "soft body")):
        if row := find("volume", case):
            add(f"`{row['method']}`, `cpu`, {most} threads", f"{what}, {row['nodes']:,} nodes", row,
                f"{number(row['ratio_to_serial'])} x a serial program")
    return "\n".join(lines)


def main():
    arguments = sys.argv[1:]
    if arguments[:1] == ["--measure"] and len(arguments) in (2, 3):
        measure(arguments[1], arguments[2] if len(arguments) == 3 else str(ROOT / "build/release/bin/pliant"))
    elif arguments not in ([], ["--write"]):
        sys.exit(__doc__)
    readme = (ROOT / "README.md").read_text()
    before, rest = readme.split(BEGIN)
    after = rest.split(END)[1]
    wanted = f"{before}{BEGIN}\n{table(newest())}\n{END}{after}"
    if arguments:
        (ROOT / "README.md").write_text(wanted)
    good = wanted == (ROOT / "README.md").read_text()
    if not good:
        print("README.md has another table of speed; scripts/speed_table.py --write makes it")
    print(f"{int(good)} passed, {int(not good)} failed")
    sys.exit(0 if good else 1)


main()

#!/usr/bin/env python3
"""pliant reproduce from outside: every experiment is there, a second run measures nothing, what was cut off is done
again, and the report says what its files say.

    reproduce_test.py TOOL SOURCES
"""
import csv
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
from html.parser import HTMLParser
from pathlib import Path

TOOL, SOURCES = str(Path(sys.argv[1]).resolve()), Path(sys.argv[2])
PATIENCE = 1500  # seconds for one call; builds with sanitizers are slow
BAD_INPUT, BAD_USAGE, INTERRUPTED = 1, 2, 130

# The figures and tables that the papers have and we reproduce.
EXPERIMENTS = {
    "cloth": ["fig07", "fig08", "fig09", "fig10", "fig11", "fig12", "fig13", "fig14", "fig15", "integrators", "tables"],
    "volume": ["fig01", "fig06", "fig07", "fig09", "fig10", "fig11"],  # fig07 has figure 8, too
}
IDS = [f"{paper}_{item}" for paper, items in EXPERIMENTS.items() for item in items]


def call(*arguments, **options):
    return subprocess.run([TOOL, "reproduce", *map(str, arguments)], capture_output=True, text=True, timeout=PATIENCE,
                          **options)


def expect(condition, what):
    if not condition:
        raise AssertionError(what)


def without_matplotlib(folder):
    """An environment in which Python has none; figures are also what takes longest to start."""
    (folder / "none").mkdir()
    (folder / "none" / "matplotlib.py").write_text("raise ImportError('not here')\n")
    return {**os.environ, "PYTHONPATH": str(folder / "none")}


def documents(folder):
    return {file.stem: json.loads(file.read_text()) for file in (folder / "data").glob("*.json")}


def stamps(folder):
    return {str(file): file.stat().st_mtime_ns for part in ("data", "pictures") for file in (folder / part).iterdir()}


class Tables(HTMLParser):
    """The cells of every table of a page."""

    def __init__(self, text):
        super().__init__()
        self.tables, self.cell = [], None
        self.feed(text)

    def handle_starttag(self, tag, _):
        if tag == "table":
            self.tables.append([])
        elif tag == "tr":
            self.tables[-1].append([])
        elif tag in ("td", "th"):
            self.cell = ""

    def handle_endtag(self, tag):
        if tag in ("td", "th"):
            self.tables[-1][-1].append(self.cell)
            self.cell = None

    def handle_data(self, data):
        if self.cell is not None:
            self.cell += data


def markdown_tables(text):
    tables = []
    for block in text.split("\n\n"):
        rows = [line for line in block.splitlines() if line.startswith("|")]
        if rows:
            tables.append([[cell.strip() for cell in row[1:-1].split("|")] for row in rows if not row.startswith("| ---")])
    return tables


# --- what is tested --------------------------------------------------------------------------------

def lists_every_experiment(_):
    for paper, items in EXPERIMENTS.items():
        names = [line.split()[0] for line in call(paper, "--list").stdout.splitlines()]
        expect(names == [f"{paper}_{item}" for item in items], f"--list of {paper}: {names}")


def refuses_what_it_cannot_use(folder):
    (folder / "file").write_text("mine\n")
    for arguments, code, words in [
            (["nonsense"], BAD_USAGE, ["nonsense", "cloth", "volume", "all"]),
            (["--only", "fig99"], BAD_USAGE, ["fig99", "cloth_fig07"]),
            (["volume", "--only", "cloth_fig07"], BAD_USAGE, ["cloth_fig07", "volume"]),
            (["--out", ""], BAD_USAGE, ["--out", "empty"]),
            (["--quick", "--out", folder / "file"], BAD_INPUT, ["--out", "file"]),
            (["--quick", "--out", folder / "file" / "deeper"], BAD_INPUT, ["--out", "deeper"]),
            (["--quick", "--meshes", folder / "nowhere"], BAD_INPUT, ["--meshes", "nowhere"])]:
        result = call(*arguments, cwd=folder)
        expect(result.returncode == code, f"{arguments}: exit code {result.returncode}: {result.stderr}")
        for word in words:
            expect(word in result.stderr, f"{arguments}: no '{word}' in {result.stderr}")
        expect("Traceback" not in result.stderr and "json" not in result.stderr, result.stderr)
    expect((folder / "file").read_text() == "mine\n", "a file was written over")
    expect(sorted(os.listdir(folder)) == ["file"], f"left behind: {os.listdir(folder)}")


def quick_run_is_whole_and_consistent(folder):
    result = call("--quick", "--out", folder)
    expect(result.returncode == 0, result.stderr)
    found = documents(folder)
    expect(sorted(found) == sorted(IDS), f"experiments: {sorted(found)}")
    leftover = [str(file) for file in folder.rglob("*") if ".part" in file.name]
    expect(not leftover, f"left behind: {leftover}")

    page, text = (folder / "report.html").read_text(), (folder / "report.md").read_text()
    expect("<script" not in page and not re.search(r'(src|href)="(?!data:|#)', page), "the page needs other files")
    in_page, in_text = Tables(page).tables, markdown_tables(text)
    numbers = 0
    for name, document in found.items():
        files = sorted((folder / "data").glob(f"{name}*.csv"))
        expect(len(files) == len(document["tables"]), f"{name}: {files}")
        for file in files:
            rows = list(csv.reader(file.open()))[1:]
            expect(rows, f"{file.name} is empty")
            expect(any(table[1:] == rows for table in in_page), f"{file.name} is not in the page as it is")
            expect(any(table[1:] == rows for table in in_text), f"{file.name} is not in the Markdown as it is")
            numbers += sum(bool(re.fullmatch(r"[-+.0-9e]+", cell)) for row in rows for cell in row)
        for picture in document["pictures"]:
            bytes_of = (folder / "pictures" / picture["file"]).read_bytes()
            expect(bytes_of.startswith(b"\x89PNG") and bytes_of.endswith(b"IEND\xaeB`\x82"), picture["file"])
    expect(numbers > 200, f"only {numbers} numbers in all tables")
    drawn = "there are no figures" not in result.stderr
    for name, document in found.items():
        if "plot" in document and drawn:
            figure = (folder / "figures" / f"{name}.svg").read_text()
            expect("GTX 1070" in figure and figure.rstrip().endswith("</svg>"), f"{name}.svg")

    # What the papers claim, and whether ours holds it, at the size of a quick run.
    def column(name, title):
        table = found[name]["tables"][0]
        k = next(k for k, column in enumerate(table["columns"]) if column["title"] == title)
        return [row[k] for row in table["rows"]]
    diverged = column("cloth_fig15", "ours: diverged in frame")
    expect(diverged[0] != "-" and diverged[1] == "-", f"figure 15: mass-spring and ACAD diverged in {diverged}")
    expect(float(column("cloth_fig15", "ours: largest stretch")[1]) < 12, "figure 15: ACAD holds 10 %")
    integrators = column("cloth_integrators", "integrator")
    longest = dict(zip(integrators, column("cloth_integrators", "cpu: longest step")))
    expect(longest["implicit Euler"] == "over 100", f"implicit Euler stands any step: {longest}")
    expect(10 * float(longest["explicit Euler"]) < float(longest["symplectic Euler"]) < float(longest["Runge-Kutta 4"]),
           f"explicit < symplectic < Runge-Kutta: {longest}")
    # Waves of a flat sheet of 12 springs have omega^2 = 8 k / m at most, 2 / omega = 3.5 ms; a fold is stiffer.
    expect(2 < float(longest["symplectic Euler"]) < 4, f"symplectic Euler near 2 / omega: {longest}")
    losses = [float(text) for text in column("volume_fig07", "ours: largest loss")]
    methods = column("volume_fig07", "method")
    for loss, method in zip(losses, methods):
        expect(loss < 0.01 if method == "VPC" else loss > 10, f"figure 7: {method} loses {loss} %")

    # A part of it: the report stays whole.
    part = call("cloth", "--quick", "--out", folder, "--only", "tables")
    expect(part.returncode == 0 and len(Tables((folder / "report.html").read_text()).tables) == len(in_page), part.stderr)

    # Once more: nothing is measured, and the numbers stay.
    before = stamps(folder)
    again = call("--quick", "--out", folder)
    expect(again.returncode == 0 and again.stdout.count("done before") == len(IDS) + 1, again.stdout)
    expect(stamps(folder) == before, "a second run wrote measurements again")


def measures_again_what_is_not_whole(folder):
    arguments = ["--quick", "--out", folder, "--only", "tables", "--only", "cloth_fig15"]
    environment = without_matplotlib(folder)
    expect(call(*arguments, env=environment).returncode == 0, "first run")
    file = folder / "data" / "cloth_fig15.json"
    whole = file.read_text()
    for damage in (lambda: file.write_text(whole[:len(whole) // 2]),        # cut off
                   lambda: file.write_text("[]"),                           # something else
                   lambda: file.write_text(re.sub('"key": "..', '"key": "zz', whole)),  # of other settings
                   lambda: next((folder / "pictures").iterdir()).unlink()):
        damage()
        result = call(*arguments, env=environment)
        expect(result.returncode == 0 and "cloth_tables: done before" in result.stdout, result.stderr)
        expect("cloth_fig15: done before" not in result.stdout, "a damaged experiment was taken for done")
        measured = json.loads(file.read_text())
        expect(measured["tables"] == json.loads(whole)["tables"], "another result for the same settings")


def goes_on_after_an_interruption(folder):
    arguments = ["--quick", "--out", folder, "--only", "tables", "--only", "volume_fig10"]
    running = subprocess.Popen([TOOL, "reproduce", *map(str, arguments)], stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True)
    deadline = time.time() + PATIENCE
    while not (folder / "data" / "cloth_tables.json").exists() and time.time() < deadline:
        time.sleep(0.01)
    time.sleep(0.2)  # into the next experiment
    running.send_signal(signal.SIGINT)
    _, said = running.communicate(timeout=PATIENCE)
    expect(running.returncode == INTERRUPTED and "interrupted" in said, f"{running.returncode}: {said}")
    expect(sorted(documents(folder)) == ["cloth_tables"], f"after the interruption: {sorted(documents(folder))}")
    expect((folder / "report.html").exists(), "no report of what was done")
    result = call(*arguments)
    expect(result.returncode == 0 and "2 of 2 experiments, 1 of them done before" in result.stdout, result.stdout)
    expect("cloth_tables: done before" in result.stdout and "volume_fig10: done before" not in result.stdout,
           result.stdout)
    expect(sorted(documents(folder)) == ["cloth_tables", "volume_fig10"], "the second run did not finish")


def reports_without_matplotlib(folder):
    result = call("--quick", "--out", folder / "out", "--only", "tables", "--only", "cloth_fig15",
                  env=without_matplotlib(folder))
    expect(result.returncode == 0, result.stderr)
    expect(result.stderr.count("python3-matplotlib") == 1, result.stderr)
    for name in ("report.md", "report.html"):
        text = (folder / "out" / name).read_text()
        expect("python3-matplotlib" in text and ".svg" not in text and "ACAD" in text, name)


def papers_numbers_have_a_place(_):
    """Each number says where it is from and belongs to an experiment; passes and planes that are named exist."""
    text = (SOURCES / "apps/pliant/reproduce/papers.json").read_text()
    papers = json.loads("\n".join(line for line in text.splitlines() if not line.strip().startswith("//")))
    for name, numbers in papers["numbers"].items():
        expect(name in IDS, f"numbers of {name}")
        for number in numbers:
            expect(number["where"] and isinstance(number["value"], (int, float)), f"{name}: {number}")
    passes = re.findall(r"^(?:PAPER|SINGLE)_PASS\((\w+)", (SOURCES / "src/solve/passes.def").read_text(), re.M)
    named = [name for kernel in papers["kernels"] for name in kernel["ours"]]
    expect(len(papers["kernels"]) == 11 and set(named) <= set(passes), f"kernels: {named}")


def main():
    failures = 0
    tests = [lists_every_experiment, refuses_what_it_cannot_use, papers_numbers_have_a_place,
             quick_run_is_whole_and_consistent, measures_again_what_is_not_whole, goes_on_after_an_interruption,
             reports_without_matplotlib]
    for test in tests:
        with tempfile.TemporaryDirectory() as folder:
            start = time.time()
            try:
                test(Path(folder))
                print(f"{test.__name__}: {time.time() - start:.1f} s", flush=True)
            except (AssertionError, OSError, subprocess.TimeoutExpired) as failure:
                failures += 1
                print(f"FAILED {test.__name__}: {failure}", flush=True)
    print(f"{len(tests) - failures} passed, {failures} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""Compares the tables of passes in docs/architecture.md with src/solve/passes.def, from which they are generated. Ends with
'N passed, N failed'.

    pass_table.py            compares
    pass_table.py --write    writes the tables anew, between <!-- passes --> and <!-- end of passes -->
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TABLE, DOCUMENT = ROOT / "src/solve/passes.def", ROOT / "docs/architecture.md"
BEGIN, END = "<!-- passes -->\n", "<!-- end of passes -->"
SHORT = {"position": "P", "velocity": "V", "next_position": "P'", "next_velocity": "V'"}
SECTION = re.compile(r"^// --- (?P<title>.*?) -*$", re.M)
ROW = re.compile(r"^(?P<family>[A-Z]+)_PASS\((?P<name>\w+),(?P<columns>[^()]*),\s*READS\((?P<reads>[^)]*)\),\s*"
                 r"WRITES\((?P<writes>[^)]*)\)(?:,\s*(?:SUMS\((?P<sum>\w+), (?P<count>\d)\)|NO_SUMS))?\)", re.M)
NAMED = re.compile(r'^(UNIT|RESOURCE)\((\w+), "([^"]*)"\)', re.M)


def words(text):
    return [word.strip() for word in text.split(",") if word.strip()]


def row_of(match):
    columns, family = words(match["columns"]), match["family"]
    explicit = family in ("CLOTH", "BODY")
    unit = columns[1] if family == "SINGLE" else columns[0]
    reads, writes = words(match["reads"]), words(match["writes"])
    if unit.startswith("live_"):
        reads.append("flags")
    if match["sum"]:
        writes.append("sums")
    names = lambda resources: ", ".join(SHORT.get(name, name) for name in resources)
    text = f"shaders/{match['name']}.comp" if explicit else f"{columns[2]}.kernel.glsl"
    return f"| `{match['name']}` | {unit} | {names(reads)} | {names(writes)} | {text} |"


def tables(definition):
    """The text between the markers, and the number of its passes."""
    parts, passes = [], 0
    starts = list(SECTION.finditer(definition))
    for start, end in zip(starts, [s.start() for s in starts[1:]] + [len(definition)]):
        section = definition[start.end():end]
        title = re.sub(r": (UNIT|RESOURCE)\(.*\)$", "", start["title"]).strip()
        title = title[0].upper() + title[1:]
        named, rows = NAMED.findall(section), list(ROW.finditer(section))
        if named:
            header = "| name | what |\n| --- | --- |\n"
            lines = [f"| {SHORT.get(name, name)} | {what} |" for _, name, what in named]
        else:
            header = "| pass | one invocation: | reads | writes | text |\n| --- | --- | --- | --- | --- |\n"
            lines = [row_of(row) for row in rows]
            passes += len(rows)
        parts.append(f"**{title}.**\n\n{header}" + "\n".join(lines) + "\n")
    return "\n" + "\n".join(parts) + "\n", passes


def main():
    definition, document = TABLE.read_text(), DOCUMENT.read_text()
    text, passes = tables(definition)
    failures = []
    listed = len(re.findall(r"^[A-Z]+_PASS\(\w+,", definition, re.M))
    if passes != listed or passes == 0:
        failures.append(f"src/solve/passes.def has {listed} rows, of which this script can read {passes}")
    before, found, rest = document.partition(BEGIN)
    old, ended, after = rest.partition(END)
    if not found or not ended:
        failures.append(f"docs/architecture.md has no {BEGIN.strip()} with {END} behind it")
    elif "--write" in sys.argv[1:]:
        DOCUMENT.write_text(before + BEGIN + text + END + after)
    elif old != text:
        failures.append("docs/architecture.md has other tables of passes than src/solve/passes.def makes; "
                        "write them anew by scripts/pass_table.py --write")
    for failure in failures:
        print(failure)
    print(f"{passes - len(failures)} passed, {len(failures)} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())

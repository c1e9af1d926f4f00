#!/usr/bin/env python3
"""Checks that the table of passes in docs/architecture.md says what src/solve/passes.def says, and that every pass has
its shader. Ends with 'N passed, N failed'."""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SHORT = {"position": "P", "velocity": "V", "next_position": "P'", "next_velocity": "V'"}  # as the table abbreviates


def row_of(name, size, reads, writes):
    names = lambda text: ", ".join(SHORT.get(word.strip(), word.strip()) for word in text.split(","))
    return f"| `{name}` | {size} | {names(reads)} | {names(writes)} |"


def main():
    text = (ROOT / "src/solve/passes.def").read_text()
    passes = re.findall(r"^PASS\((\w+), (\w+),\s+READS\(([^)]*)\),\s*WRITES\(([^)]*)\)\)", text, re.M)
    document = (ROOT / "docs/architecture.md").read_text()
    failures = []
    for name, size, reads, writes in passes:
        row = row_of(name, size, reads, writes)
        if row not in document:
            failures.append(f"docs/architecture.md has no row that begins with: {row}")
        if not (ROOT / f"src/backend/vulkan/shaders/{name}.comp").exists():
            failures.append(f"src/backend/vulkan/shaders/{name}.comp does not exist")
    if len(passes) != len(re.findall(r"^PASS\(", text, re.M)):
        failures.append("src/solve/passes.def has a row that this script cannot read")
    if not passes:
        failures.append("src/solve/passes.def has no passes")
    for failure in failures:
        print(failure)
    print(f"{2 * len(passes) - len(failures)} passed, {len(failures)} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())

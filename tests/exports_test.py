#!/usr/bin/env python3
"""What shared libraries of Pliant show: symbols that include/pliant declares as PLIANT_API, and those inside that are marked
PLIANT_INSIDE for another of its libraries. Ends with 'N passed, N failed'.

    exports_test.py ROOT LIBRARY...
"""
import re
import subprocess
import sys
from pathlib import Path

root, libraries = Path(sys.argv[1]), sys.argv[2:]
MARK = re.compile(r"\b(PLIANT_API|PLIANT_INSIDE)\s+([^;{]*)")


def marked(folder):
    """Names of functions, and of classes, that headers mark."""
    functions, classes = set(), set()
    for file in sorted((root / folder).rglob("*.hpp")):
        for _, text in MARK.findall(file.read_text().split("#define PLIANT_INSIDE")[-1]):
            if (of_class := re.match(r"(\w+)\s*(?:final\s*)?(?::|$)", text.strip())) and "(" not in text:
                classes.add(of_class[1])
            elif (of_function := re.search(r"(\w+)\(", text)):
                functions.add(of_function[1])
    return functions, classes


functions, classes = (a | b for a, b in zip(marked("include/pliant"), marked("src")))
passed = failed = 0


def expect(good, message):
    global passed, failed
    passed, failed = passed + bool(good), failed + (not good)
    if not good:
        print("failed:", message)


expect("read_scene" in functions and "Simulation" in classes, "the marks of the headers are not found")
for library in libraries:
    text = subprocess.run(["nm", "-DC", "--defined-only", library], check=True, capture_output=True, text=True).stdout
    shown = 0
    for line in text.splitlines():
        kind, name = line.split(maxsplit=2)[1:]
        if kind in "WwVu":  # weak: inline functions and templates of the standard library
            if not re.match(r"(typeinfo|vtable)", name):
                continue
        name = re.sub(r"^(typeinfo name for|typeinfo for|vtable for|non-virtual thunk to) ", "", name)
        name = re.sub(r"\[abi:\w+\]", "", name)
        if name.startswith("std::"):
            continue  # a template over a type that is shown
        inside = re.match(r"(?:pliant::)((?:\w+::)*)(~?\w+)", name)
        if not inside:
            expect(False, f"{Path(library).name} shows {name}")
            continue
        path = inside[1].rstrip(":").split("::") + [inside[2]]
        good = any(part in classes for part in path) or path[-1] in functions
        expect(good, f"{Path(library).name} shows {name}, which no header marks")
        shown += 1
    expect(shown > 3, f"{Path(library).name} shows {shown} symbols")
print(f"{passed} passed, {failed} failed")
sys.exit(1 if failed else 0)

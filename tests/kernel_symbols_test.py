#!/usr/bin/env python3
"""What is compiled with wide instructions must stay where it is. Of the many equal copies of an inline function
the linker keeps any one, so a function of the standard library, of Laws<float> or of a layout in kernels_avx512
could end up in programs that run on machines without AVX-512. Looks at the symbols of these objects: every
function that other files can see must be made of the file's own packs (PLIANT_PACKS), and of no other file's.
Kernels that only tests run hold instructions of every machine, but slow ones: their packs are their own, too.

    kernel_symbols_test.py OBJECT...    objects of the library, also as one list with ';' in between
"""

import platform
import re
import subprocess
import sys
from pathlib import Path

WIDE = {"kernels_avx2.cpp.o": "packs_of_avx2", "kernels_avx512.cpp.o": "packs_of_avx512",
        "kernels_avx2_fast.cpp.o": "packs_of_avx2_fast", "kernels_avx512_fast.cpp.o": "packs_of_avx512_fast"}
PACKS = {**WIDE, "kernels_lanes8.cpp.o": "packs_of_lanes", "kernels_lanes16.cpp.o": "packs_of_lanes"}
FUNCTION_TYPES = "TWi"  # of nm: global, weak, chosen at run time; data carry no instructions


def visible_functions(object_file):
    """The functions that other files can see, and the other names they can see, both demangled."""
    listing = subprocess.run(["nm", "--demangle", "--defined-only", object_file], check=True, timeout=60,
                             capture_output=True, text=True).stdout
    symbols = re.findall(r"^[0-9a-f]* +(\w) (.+)$", listing, re.MULTILINE)
    functions = [name for kind, name in symbols if kind in FUNCTION_TYPES]
    others = [name for kind, name in symbols if kind.isupper() and kind not in FUNCTION_TYPES]
    return functions, others


def complaints_about(object_file):
    packs, wide = PACKS[object_file.name], object_file.name in WIDE
    functions, others = visible_functions(object_file)
    table = "pliant::cpu::" + object_file.name.removesuffix(".cpp.o")
    if table not in others:
        yield f"it does not define the table {table}"
    for function in functions:
        found = set(re.findall(r"\bpliant::(packs_of_\w+)::", function))
        if found != {packs} and (found or wide):
            yield f"other files may get its copy of {function}"


def main():
    objects = [Path(name) for argument in sys.argv[1:] for name in argument.split(";") if name]
    if not objects:
        print(f"usage: {sys.argv[0]} OBJECT...")
        return 2
    passed = failed = wide = 0
    for object_file in objects:
        if object_file.name not in PACKS:
            continue
        complaints = list(complaints_about(object_file))
        for complaint in complaints:
            print(f"FAILED: {object_file.name}: {complaint}")
        passed += not complaints
        failed += bool(complaints)
        wide += object_file.name in WIDE
    if wide == 0:
        print("this build has no kernels for wide instruction sets")
        failed += platform.machine() in ("x86_64", "AMD64")  # where it must
    print(f"{passed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

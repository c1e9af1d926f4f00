#!/usr/bin/env python3
"""What is compiled with wide instructions must stay where it is. Of the many equal copies of an inline function
the linker keeps any one, so a function of the standard library, of Laws<float> or of a layout in kernels_avx512
could end up in programs that run on machines without AVX-512. Looks at the symbols of these objects: every
function that other files can see must be a template of the file's own Pack width. And what is compiled with fast
arithmetic must be a template of fast packs.

    kernel_symbols_test.py OBJECT...    objects of the library, also as one list with ';' in between
"""

import platform
import re
import subprocess
import sys
from pathlib import Path

WIDTHS = {"kernels_avx2.cpp.o": 8, "kernels_avx512.cpp.o": 16,
          "kernels_avx2_fast.cpp.o": 8, "kernels_avx512_fast.cpp.o": 16}
FUNCTION_TYPES = "TWi"  # of nm: global, weak, chosen at run time; data carry no instructions


def visible_functions(object_file):
    """The functions that other files can see, and the other names they can see, both demangled."""
    listing = subprocess.run(["nm", "--demangle", "--defined-only", object_file], check=True, timeout=60,
                             capture_output=True, text=True).stdout
    symbols = re.findall(r"^[0-9a-f]* +(\w) (.+)$", listing, re.MULTILINE)
    functions = [name for kind, name in symbols if kind in FUNCTION_TYPES]
    others = [name for kind, name in symbols if kind.isupper() and kind not in FUNCTION_TYPES]
    return functions, others


def belongs_to(width, fast, function):
    widths = re.findall(r"\b(?:Pack|PackMask|LaneTypes)<(\d+)[,>]", function)
    fastness = re.findall(r"\bPack<\d+, (true|false)>", function)
    return (bool(widths) and all(int(found) == width for found in widths)
            and all((found == "true") == fast for found in fastness))


def complaints_about(object_file, width):
    functions, others = visible_functions(object_file)
    table = "pliant::cpu::" + object_file.name.removesuffix(".cpp.o")
    if table not in others:
        yield f"it does not define the table {table}"
    for function in functions:
        if not belongs_to(width, object_file.name.endswith("_fast.cpp.o"), function):
            yield f"other files may get its copy of {function}"


def main():
    objects = [Path(name) for argument in sys.argv[1:] for name in argument.split(";") if name]
    if not objects:
        print(f"usage: {sys.argv[0]} OBJECT...")
        return 2
    passed = failed = 0
    for object_file in objects:
        if object_file.name not in WIDTHS:
            continue
        complaints = list(complaints_about(object_file, WIDTHS[object_file.name]))
        for complaint in complaints:
            print(f"FAILED: {object_file.name}: {complaint}")
        passed += not complaints
        failed += bool(complaints)
    if passed + failed == 0:
        print("this build has no kernels for wide instruction sets")
        failed += platform.machine() in ("x86_64", "AMD64")  # where it must
    print(f"{passed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

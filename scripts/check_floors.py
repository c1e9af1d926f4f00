#!/usr/bin/env python3
"""Checks that the table of docs/architecture.md, "The floors of the house", holds: a file includes only its own folder
and the folders in its row; a row lists only rows above it, and only folders that some file needs. Also checks libraries
that only one place may use. Ends with 'N passed, N failed'.

    check_floors.py [ROOT]      ROOT: another copy of the project; default: the script's own
"""
import os
import re
import sys
from pathlib import Path

ROOT = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent)
SOURCES = {".cpp", ".hpp", ".inl", ".def", ".glsl", ".comp", ".vert", ".frag"}
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]+(["<])([^">]+)[">]', re.M)
# Where quoted names are searched after the file's own folder; generated files belong to no floor.
SEARCHED = ["src", "include", "apps/pliant", "benchmarks", "src/laws", "src/backend/vulkan/shaders", "src/render/shaders"]
GENERATED = "shaders/"
# Libraries, and the only folders or files that may use them.
CONFINED = {
    "assimp/": ["src/mesh_file/assimp_reader.cpp"],
    "GLFW/": ["apps/pliant/viewer"],
    "imgui": ["apps/pliant/viewer"],
    "CLI/": ["apps/pliant/main.cpp"],
    "tbb/": ["src/backend/cpu"],
    "vulkan/": ["src/backend/vulkan", "src/render", "src/simulation/device_list.cpp", "apps/pliant/viewer"],
}
# A file that may include more than its row lists: the sub-command that starts the viewer.
DOORS = {("apps/pliant/view_command.cpp", "apps/pliant/viewer")}
# The text of the kernels uses laws by name; the including file provides them.
UNSEEN = {("src/kernels", "src/laws")}


def is_under(path, folder):
    return path == folder or path.startswith(folder + "/")


def read_floors():
    """By folder of the table, from the bottom up: the folders that its files may include."""
    document = (ROOT / "docs/architecture.md").read_text()
    section = document.split("## The floors of the house")[1].split("\n\n**")[0]
    rows = re.findall(r"^\| `([\w/]+)` \|[^|]*\| ([^|]+) \|$", section, re.M)
    floors = {}
    for folder, may in rows:
        names = re.findall(r"`([\w/]+)`", may)
        allowed = []
        for name in names:
            if may.startswith("as ") and name in floors:
                allowed += [*floors[name], name]
            else:
                allowed.append({"include": "include/pliant"}.get(name, name if name in floors else "src/" + name))
        floors[folder] = allowed
    return floors


def floor_of(path, floors):
    """The row of a file: the innermost folder of the table that contains it."""
    return max((folder for folder in floors if is_under(path, folder)), key=len, default=None)


def find_included(path, name):
    for folder in [os.path.dirname(path), *SEARCHED]:
        found = os.path.normpath(os.path.join(folder, name))
        if (ROOT / found).is_file():
            return found
    return None


def check_order(floors):
    """A row may list only rows above it."""
    above = []
    for folder, allowed in floors.items():
        for name in allowed:
            if not any(is_under(name, other) for other in above):
                yield f"docs/architecture.md: the row of {folder} names {name}, which does not stand above it"
        above.append(folder)


def check_file(path, floors, used):
    own = floor_of(path, floors)
    if own is None:
        yield f"{path}: lies in no folder of the table"
        return
    for quote, name in INCLUDE.findall((ROOT / path).read_text()):
        for library, places in CONFINED.items():
            if name.startswith(library) and not any(is_under(path, place) for place in places):
                yield f"{path}: includes {name}, which only {' and '.join(places)} may know"
        if quote == "<":
            continue
        included = find_included(path, name)
        if included is None:
            if not name.startswith(GENERATED) and not name.startswith(tuple(CONFINED)):
                yield f"{path}: includes {name}, which is not there"
        elif floor_of(included, floors) != own and (path, floor_of(included, floors)) not in DOORS:
            allowed = next((folder for folder in floors[own] if is_under(included, folder)), None)
            if allowed is None:
                yield f"{path}: includes {included}, which the row of {own} does not name"
            used.add((own, allowed))


def main():
    floors = read_floors()
    failures, used, files = list(check_order(floors)), set(), 0
    for root in ("include", "src", "benchmarks", "apps"):
        for source in sorted((ROOT / root).rglob("*")):
            if source.suffix in SOURCES:
                files += 1
                failures += check_file(str(source.relative_to(ROOT)), floors, used)
    for folder, allowed in floors.items():
        if folder != "apps/pliant/viewer":  # it shares the row of apps/pliant
            failures += [f"docs/architecture.md: no file of {folder} needs {name}" for name in allowed
                         if (folder, name) not in used | UNSEEN]
    if len(floors) < 10 or files < 200:
        failures.append(f"only {len(floors)} folders and {files} files were read")
    for failure in failures:
        print(failure)
    print(f"{files - len(failures)} passed, {len(failures)} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())

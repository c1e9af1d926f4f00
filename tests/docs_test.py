#!/usr/bin/env python3
"""The documents: every relative link leads to a file and, where it names one, to a heading of it, as GitHub makes anchors;
every scene of the manual passes `pliant check`; and code of a page with a program
beside it is part of that program. Ends with 'N passed, N failed'.

    docs_test.py TOOL [ROOT]      TOOL: the program pliant. ROOT: another copy of the project
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from urllib.parse import unquote

if len(sys.argv) < 2:
    sys.exit(__doc__)
TOOL = str(Path(sys.argv[1]).resolve())
ROOT = Path(sys.argv[2] if len(sys.argv) > 2 else Path(__file__).resolve().parent.parent).resolve()
PATIENCE = 300  # seconds for one call; builds with sanitizers are slow

FENCE = re.compile(r"^ {0,3}(```|~~~)")
HEADING = re.compile(r"^ {0,3}#{1,6}\s+(.*?)\s*#*\s*$")
# [text](target) and ![text](target), the text may itself have a picture in brackets; and [name]: target.
LINK = re.compile(r"\]\(\s*<?([^()\s>]+(?:\([^()\s]*\)[^()\s>]*)*)>?(?:\s+\"[^\"]*\")?\s*\)")
REFERENCE = re.compile(r"^ {0,3}\[[^\]]+\]:\s+<?(\S+?)>?\s*$")
# Code of a page that has a program beside it, in a folder of its name, must be part of that program.
CODE = re.compile(r"^```(?:cpp|cmake)\n(.*?)^```", re.S | re.M)
SCENE = re.compile(r"^```json\n(.*?)^```", re.S | re.M)


def without_indent(text):
    return re.sub(r"^[ \t]+", "", text, flags=re.M)


def prose(path):
    """Numbered lines outside of fenced blocks."""
    fence = None
    for number, line in enumerate(path.read_text().splitlines(), 1):
        mark = FENCE.match(line)
        if mark and fence in (None, mark.group(1)):
            fence = None if fence else mark.group(1)
        elif not fence:
            yield number, line


def anchors(path):
    """Anchors of the headings of a file: lower case, spaces to '-', punctuation left out, '-1' for the second of a name."""
    found = set()
    for _, line in prose(path):
        found.update(re.findall(r"<a (?:id|name)=\"([^\"]+)\"", line))
        heading = HEADING.match(line)
        if not heading:
            continue
        text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading.group(1)).replace("`", "").replace("*", "")
        anchor = re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", "-")
        name, count = anchor, 0
        while name in found:
            count += 1
            name = f"{anchor}-{count}"
        found.add(name)
    return found


def links(path):
    for number, line in prose(path):
        line = re.sub(r"(`+).*?\1", "", line)
        for target in LINK.findall(line) + REFERENCE.findall(line):
            if not re.match(r"[a-zA-Z][a-zA-Z0-9+.-]*:|//", target):
                yield number, target


def fault_of_link(page, target):
    """What is wrong with a link, or nothing."""
    name, _, anchor = unquote(target).partition("#")
    if name.startswith("/"):
        return "begins with /, which GitHub and a checkout take for different folders"
    file = (page.parent / name).resolve() if name else page
    if ROOT not in (file, *file.parents):
        return "leads out of the project"
    if not file.exists():
        return "has no such file"
    if anchor and file.suffix == ".md" and anchor not in anchors(file):
        return "has no such heading"
    return None


def fault_of_scene(text, folder):
    file = Path(folder) / "scene.json"
    file.write_text(text)
    done = subprocess.run([TOOL, "check", str(file)], capture_output=True, text=True, timeout=PATIENCE)
    return None if done.returncode == 0 else f"pliant check ends with {done.returncode}: {done.stderr.strip()}"


def main():
    pages = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
    passed, failed = 0, 0

    def count(place, fault):
        nonlocal passed, failed
        if fault:
            failed += 1
            print(f"FAILED: {place}: {fault}")
        else:
            passed += 1

    for page in pages:
        for number, target in links(page):
            count(f"{page.relative_to(ROOT)}:{number}: {target}", fault_of_link(page, target))
    scenes = 0
    with tempfile.TemporaryDirectory() as folder:
        for page in sorted((ROOT / "docs/manual").rglob("*.md")):
            for number, text in enumerate(SCENE.findall(page.read_text()), 1):
                scenes += 1
                count(f"{page.relative_to(ROOT)}: scene {number}", fault_of_scene(text, folder))
        for page in sorted((ROOT / "docs/manual").rglob("*.md")):
            program = page.with_suffix("")
            if not program.is_dir():
                continue
            text = "".join(without_indent(file.read_text()) for file in sorted(program.iterdir()))
            blocks = CODE.findall(page.read_text())
            for number, code in enumerate(blocks, 1):
                count(f"{page.relative_to(ROOT)}: code {number}",
                      None if without_indent(code) in text else f"it is not in {program.relative_to(ROOT)}")
            if not blocks:
                count(page.relative_to(ROOT), "it shows nothing of its program")
    if passed == 0 or scenes == 0:
        count("documents", "no link or no scene was found")
    print(f"{passed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

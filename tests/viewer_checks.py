"""What the tests of `pliant view` have in common: the tool, checks that count, and how a test begins and ends."""
import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

TOOL = sys.argv[1]
ROOT = Path(__file__).resolve().parent.parent
SCENE = str(ROOT / "tests/data/viewer_cloth.json")
SKIPPED = 77
failures = []


def check(condition, what):
    if not condition:
        failures.append(what)


def lines_of(log):
    """The log of a viewer, a dictionary for each frame; none where there is no file."""
    return [json.loads(line) for line in log.read_text().splitlines()] if log.exists() else []


def run(test, *programs):
    """Runs a test in a folder of its own, and returns its exit code: 0, 1 where a check failed, or SKIPPED."""
    missing = [program for program in programs if not shutil.which(program)]
    if missing:
        print(f"skipped: {Path(sys.argv[0]).stem}: not installed: {', '.join(missing)}")
        return SKIPPED
    if "vulkan" not in subprocess.run([TOOL, "info"], capture_output=True, text=True).stdout:
        print(f"skipped: {Path(sys.argv[0]).stem}: there is no Vulkan device")
        return SKIPPED
    with tempfile.TemporaryDirectory() as name:
        test(Path(name))
    for failure in failures:
        print(failure)
    print(f"{len(failures)} failed")
    return 1 if failures else 0

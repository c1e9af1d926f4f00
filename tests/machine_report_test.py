"""pliant info --report: what it writes fits its schema, and its hashes are those of runs.

    machine_report_test.py PLIANT"""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import jsonschema

from command_line_tools import changed

ROOT = Path(__file__).resolve().parent.parent
SCHEMA = json.loads((ROOT / "docs/machine_report.schema.json").read_text())
PLIANT = sys.argv[1]


def call(*arguments):
    return subprocess.run([PLIANT, *arguments], capture_output=True, text=True)


def fits(report):
    return not list(jsonschema.Draft202012Validator(SCHEMA).iter_errors(report))


def main():
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "report.json")
        outcome = call("info", "--report", file)
        assert outcome.returncode == 0, outcome.stderr
        assert f"wrote {file}" in outcome.stdout, outcome.stdout
        assert "every scene has the same hash everywhere" in outcome.stdout, outcome.stdout
        assert "100 %" in outcome.stderr, outcome.stderr  # progress
        report = json.loads(Path(file).read_text())
        jsonschema.validate(report, SCHEMA, jsonschema.Draft202012Validator)

        kinds = {place["backend"] for place in report["places"]}
        assert kinds == {"cpu", "vulkan"}, kinds
        sets = [place["instruction_set"] for place in report["places"] if place["backend"] == "cpu"]
        assert sets == report["machine"]["instruction_sets"], sets
        scenes = {}
        for place in report["places"]:
            for run in place["runs"]:
                assert "error" not in run, run
                assert len(run["frame_seconds"]) == run["frames"], run
                scenes.setdefault((run["scene"], run["frames"]), set()).add(run["state_hash"])
        assert len(scenes) == 5, scenes
        assert all(len(hashes) == 1 for hashes in scenes.values()), scenes
        assert report["differing"] == [], report["differing"]
        for (scene, frames), hashes in scenes.items():
            summary = os.path.join(folder, "summary.json")
            assert call("run", scene, "--frames", str(frames), "--backend", "cpu", "--quiet",
                        "--summary", summary).returncode == 0
            assert hashes == {json.loads(Path(summary).read_text())["state_hash"]}, scene

        # The schema refuses what is wrong.
        device = next(i for i, place in enumerate(report["places"]) if place["backend"] == "vulkan")
        for path, value in [("pliant", None), ("machine_report", 2), ("machine.user", "me"),
                            ("places", []), (f"places.{device}.limits", {}),
                            (f"places.{device}.promise", None), (f"places.{device}.runs", []),
                            (f"places.{device}.surprise", 1), ("places.0.runs.0.state_hash", None),
                            ("places.0.runs.0.state_hash", "xyz"),
                            ("places.0.runs.0.error", "both"),
                            ("places.0.runs.0.frames", 0), ("refused", [{"name": "no reason"}])]:
            assert not fits(changed(report, path, value)), path

        # A device that fails a scene, and one that is refused, fit.
        failed = changed(report, f"places.{device}.runs.2", {"scene": "tablecloth", "frames": 1, "error": "lost"})
        assert fits(failed)
        refused = {**{k: v for k, v in report["places"][device].items() if k not in ("index", "runs")},
                   "refusal": "it has Vulkan 1.0, and 1.1 is needed"}
        assert fits(changed(report, "refused", [refused]))

        # A file that cannot be written is told before the work, not after.
        outcome = call("info", "--report", os.path.join(folder, "no", "such", "folder.json"))
        assert outcome.returncode == 1 and "%" not in outcome.stderr, outcome.stderr
    print("good")


main()

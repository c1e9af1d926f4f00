#!/usr/bin/env python3
"""A scripted session of `pliant view` without a window: every event is held against its effect, as
the log tells it."""
import json
import math
import shutil
import subprocess
import sys

from viewer_checks import ROOT, TOOL, check, lines_of, run


def session(folder, name, events, frames, *options, scene="tests/data/viewer_cloth.json"):
    """Runs a script; returns the log, a dictionary for each frame."""
    script, log = folder / f"{name}.json", folder / f"{name}.jsonl"
    script.write_text(json.dumps({"events": events}))
    command = [TOOL, "view", str(ROOT / scene) if "/" in scene else scene, "--headless", "--frames", str(frames),
               "--script", str(script), "--log", str(log), "--size", "200x120", *options]
    done = subprocess.run(command, capture_output=True, text=True, cwd=folder)
    check(done.returncode == 0, f"{name}: exit code {done.returncode}: {done.stderr.strip()}")
    return lines_of(log)


def distance(a, b):
    return math.dist(a, b)


def frame_at(seconds):
    return round(seconds * 60)


def run_events(folder, backend):
    """One session that does a bit of everything."""
    name = f"session_{backend}"
    node = 19 * 24 + 23  # a corner of the free edge
    events = [
        {"at": 0.02, "key": "h"},     # the panel would take what the mouse does
        {"at": 0.1, "key": "space"},  # it was started paused
        {"at": 0.5, "key": "space"},  # paused
        {"at": 0.6, "key": "."},
        {"at": 0.7, "method": "mass_spring"},
        {"at": 0.8, "method": "acad"},
        {"at": 0.9, "key": "space"},  # goes on
        {"at": 1.0, "move_to_node": [0, node]},  # it swings: a moment later it is elsewhere
        {"at": 1.0, "press": "right"},
        {"at": 1.05, "move": [125, 30]},
        {"at": 2.0, "release": "right"},
        {"at": 2.1, "key": "space"},  # paused
        {"at": 2.15, "move_to_node": [0, 100]},
        {"at": 2.2, "key": "p"},
        {"at": 2.3, "key": "p"},
        {"at": 2.4, "key": "1"},
        {"at": 2.45, "key": "8"},
        {"at": 2.5, "key": "4"},  # takes the place of strain
        {"at": 2.6, "key": "9"},
        {"at": 2.65, "move": [195, 115]},
        {"at": 2.7, "press": "left"},
        {"at": 2.72, "move": [175, 100]},
        {"at": 2.75, "release": "left"},
        {"at": 2.8, "scroll": 3},
        {"at": 2.85, "press": "middle"},
        {"at": 2.87, "move": [190, 110]},
        {"at": 2.9, "release": "middle"},
        {"at": 3.0, "move_to_node": [0, node]},
        {"at": 3.05, "press": "left"},
        {"at": 3.1, "release": "left"},
        {"at": 3.15, "press": "left"},
        {"at": 3.2, "release": "left"},
        {"at": 3.3, "key": "f"},
        {"at": 3.35, "key": "h"},
        {"at": 3.4, "key": "F1"},
        {"at": 3.45, "screenshot": f"{name}.png"},
        {"at": 3.5, "key": "r"},
        {"at": 3.6, "set": "acad.activate_at=0.02"},
        {"at": 3.7, "resize": [160, 100]},
        {"at": 3.8, "drop": str(ROOT / "tests/data/viewer_mesh.obj")},
        {"at": 3.9, "scene": "chain"},
        {"at": 4.0, "key": "escape"},
    ]
    log = session(folder, name, events, 600, "--backend", backend, "--paused", "--validation")
    if not log:
        return
    at = lambda seconds: log[frame_at(seconds)]
    start = log[0]["hash"]
    check(at(0.09)["hash"] == start, "paused at the start, the state changes")
    hashes = [line["hash"] for line in log[frame_at(0.1):frame_at(0.5)]]
    check(len(set(hashes)) == len(hashes), "running, the state does not change in every frame")
    check(abs(at(0.49)["time"] - 24 / 60) < 1e-9, "24 frames are not 24 / 60 s")
    check(at(0.5)["paused"] and at(0.5)["hash"] == at(0.59)["hash"], "pause does not stop the state")
    check(at(0.6)["hash"] != at(0.59)["hash"], "the period makes no step")
    check(at(0.6)["hash"] == at(0.69)["hash"], "the period makes more than one step")
    check(abs(at(0.6)["time"] - at(0.59)["time"] - 1 / 60) < 1e-9, "one step is not one frame")
    check(at(0.7)["method"] == "mass_spring" and at(0.8)["method"] == "acad", "the method is not changed")
    check(at(0.8)["hash"] == at(0.69)["hash"], "another method does not keep positions and velocities")
    check(at(1.0).get("held") == [0, node], f"the node under the cursor is not held: {at(1.0).get('held')}")
    check(distance(at(1.0)["held_position"], at(1.0)["hand"]) < 0.02, "the hand is not where the node is")
    moved = distance(at(1.0)["hand"], at(1.1)["hand"])
    check(moved > 0.1, f"the hand does not follow the cursor: {moved} m")
    # The spring of the hand (100 N/m) carries some of the cloth's 6 N.
    gap = distance(at(1.95)["held_position"], at(1.95)["hand"])
    check(gap < 0.08, f"the held node does not follow the cursor: {gap} m are left of {moved} m")
    check("held" not in at(2.0), "the node is not released")
    pins = at(2.15)["pins"]
    check(pins == 20, f"an edge of 20 nodes has {pins} pins")
    check(at(2.2)["pins"] in (19, 21) and at(2.3)["pins"] == 20, "P does not pin and release")
    check(at(2.4)["overlays"] == ["strain"], "1 does not show strain")
    check(at(2.45)["overlays"] == ["strain", "wireframe"], "8 does not show wires")
    check(at(2.5)["overlays"] == ["multipliers", "wireframe"], "4 does not replace strain")
    check(at(2.6)["overlays"] == [], "9 does not clear overlays")
    cameras = {seconds: at(seconds)["camera"] for seconds in (2.7, 2.75, 2.8, 2.9, 3.2, 3.3)}
    radius = lambda camera: distance(camera["position"], camera["target"])
    check(cameras[2.75]["position"] != cameras[2.7]["position"] and
          abs(radius(cameras[2.75]) - radius(cameras[2.7])) < 1e-9, "left drag does not orbit")
    check(abs(radius(cameras[2.8]) / radius(cameras[2.75]) - 0.9 ** 3) < 1e-9, "the wheel does not dolly")
    check(distance(cameras[2.9]["target"], cameras[2.8]["target"]) > 0.01 and
          abs(radius(cameras[2.9]) - radius(cameras[2.8])) < 1e-9, "middle drag does not pan")
    check(distance(cameras[3.2]["target"], cameras[2.9]["target"]) > 0.05 and
          distance(cameras[3.2]["target"], at(3.2)["centre"]) < at(3.2)["radius"] * 1.01,
          "a double click does not set the centre")
    check(distance(cameras[3.3]["target"], at(3.3)["centre"]) < 1e-6, "F does not frame the cloth")
    check(log[0]["panel"] and not at(0.02)["panel"] and at(3.35)["panel"] and at(3.4)["help"],
          "H and F1 do not hide and show")
    check((folder / f"{name}.png").exists(), "there is no screenshot")
    check(at(3.5)["hash"] == start and at(3.5)["time"] == 0, "reset does not restore the start")
    check(at(3.6)["notice"] == "", f"a parameter cannot be set: {at(3.6)['notice']}")
    check(at(3.7)["size"] == [160, 100], "resize does not resize")
    check(at(3.8)["scene"] == "viewer_mesh", f"a mesh that is dropped is not opened: {at(3.8)['notice']}")
    check(at(3.9)["scene"] == "chain", "the scene is not opened")
    check(len(log) == frame_at(4.0), "Escape does not end it")
    check(log[-1]["validation_messages"] == 0, "the validation layer complains")


def run_grab(folder):
    """Parameters of the scene count from the next step on, and keep what is there."""
    events = [{"at": 0.3, "set": "gravity=[0,0,0]"}, {"at": 0.3, "set": "cloths[0].damping=20"}]
    log = session(folder, "set", events, 60, "--backend", "cpu")
    if log:
        check(log[18]["time"] > log[17]["time"], "time does not go on over a change")
        check(distance(log[59]["centre"], log[40]["centre"]) < distance(log[17]["centre"], log[0]["centre"]) / 4,
              "without gravity and with damping it falls on")


def run_files(folder):
    """Keys that write files, into the current folder."""
    events = [{"at": 0.1, "key": "s"}, {"at": 0.2, "key": "v"}, {"at": 0.5, "key": "v"}]
    log = session(folder, "files", events, 36, "--backend", "cpu", scene="chain")
    check((folder / "pliant_0001.png").exists(), "S writes no screenshot")
    if shutil.which("ffmpeg"):
        video = folder / "pliant_0002.mp4"
        check(video.exists() and video.stat().st_size > 500, "V writes no video")
        check(log and log[-1]["notice"] == "", f"V: {log[-1]['notice'] if log else ''}")


def test(folder):
    run_events(folder, "cpu")
    run_grab(folder)
    run_files(folder)
    usage = subprocess.run([TOOL, "view", "chain", "--headless"], capture_output=True, text=True)
    check(usage.returncode == 2 and "--frames" in usage.stderr, "--headless without --frames is not refused")


if __name__ == "__main__":
    sys.exit(run(test))

#!/usr/bin/env python3
"""`pliant view` in a window of a virtual display: a script with resizes and a minimised window, with the validation layer,
and keys that a real X server sends."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

TOOL = sys.argv[1]
ROOT = Path(__file__).resolve().parent.parent
SCENE = str(ROOT / "tests/data/viewer_cloth.json")
failures = []


def check(condition, what):
    if not condition:
        failures.append(what)


class Display:
    """An X server of its own, on a number that is free."""

    def __enter__(self):
        reading, writing = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-screen", "0", "1024x768x24", "-nolisten", "tcp"],
                                       pass_fds=[writing], stderr=subprocess.DEVNULL)
        os.close(writing)
        with os.fdopen(reading) as pipe:
            self.number = pipe.readline().strip()
        return dict(os.environ, DISPLAY=f":{self.number}", WAYLAND_DISPLAY="", XDG_SESSION_TYPE="x11")

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait()


def run_script(folder, environment):
    script, log, picture = folder / "window.json", folder / "window.jsonl", folder / "window.png"
    events = [{"at": 0.1, "resize": [500, 300]}, {"at": 0.3, "resize": [320, 240]}, {"at": 0.4, "key": "1"},
              {"at": 0.5, "resize": [0, 0]}, {"at": 0.7, "resize": [640, 360]}, {"at": 0.8, "scene": "chain"},
              {"at": 1.0, "screenshot": str(picture)}]
    script.write_text(json.dumps({"events": events}))
    done = subprocess.run([TOOL, "view", SCENE, "--frames", "90", "--script", str(script), "--log", str(log), "--size",
                           "400x240", "--backend", "cpu", "--validation"],
                          capture_output=True, text=True, env=environment, timeout=500)
    check(done.returncode == 0, f"exit code {done.returncode}: {done.stderr.strip()}")
    lines = [json.loads(line) for line in log.read_text().splitlines()] if log.exists() else []
    check(len(lines) == 90, f"{len(lines)} frames instead of 90")
    if lines:
        check(lines[0]["size"] == [400, 240], f"the window is {lines[0]['size']}")
        check(lines[-1]["size"] == [640, 360], f"resized, the window is {lines[-1]['size']}")
        check([320, 240] in [line["size"] for line in lines], "the second size was never seen")
        check(lines[-1]["validation_messages"] == 0, "the validation layer complains")
    check(picture.exists() and picture.stat().st_size > 2000, "there is no screenshot")


def press_keys(environment):
    """Escape, by the X server, ends it; and so does nothing before."""
    view = subprocess.Popen([TOOL, "view", SCENE, "--size", "320x200", "--backend", "cpu"], env=environment,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        found = subprocess.run(["xdotool", "search", "--sync", "--name", "pliant: viewer_cloth"], env=environment,
                               capture_output=True, text=True, timeout=120)
        window = found.stdout.split()
        check(window != [], "the window with the scene's name does not appear")
        if not window:
            return
        for attempt in range(60):
            check(view.poll() is None or attempt > 0, "it ends by itself")
            subprocess.run(["xdotool", "windowfocus", window[0], "key", "--window", window[0], "Escape"], env=environment,
                           capture_output=True, timeout=60)
            try:
                view.wait(timeout=1)
                break
            except subprocess.TimeoutExpired:
                pass
        check(view.poll() == 0, f"Escape does not end it: {view.poll()}")
    finally:
        if view.poll() is None:
            view.kill()
        view.communicate()


def main():
    if not shutil.which("Xvfb") or not shutil.which("xdotool"):
        print("Xvfb or xdotool is not installed: skipped")
        return 77
    with tempfile.TemporaryDirectory() as name, Display() as environment:
        run_script(Path(name), environment)
        press_keys(environment)
        without = dict(environment, DISPLAY=":9999")
        done = subprocess.run([TOOL, "view", SCENE], capture_output=True, text=True, env=without, timeout=120)
        check(done.returncode == 4 and "--headless" in done.stderr, f"without a display: {done.returncode}, {done.stderr}")
    for failure in failures:
        print(failure)
    print(f"{len(failures)} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""`pliant view` in a window of a virtual display: keys and mouse as an X server sends them, asserted by what the viewer
writes of each frame, and a script with sizes, a minimised window and a lost surface. With the validation layer."""
import json
import math
import os
import queue
import subprocess
import sys
import threading
import time

from viewer_checks import SCENE, TOOL, check, lines_of, run

PATIENCE = 60  # s, for what takes a frame or two: machines may be busy


class Display:
    """An X server of its own, on a number that is free."""

    def __enter__(self):
        reading, writing = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-screen", "0", "1024x768x24", "-nolisten", "tcp"],
                                       pass_fds=[writing], stderr=subprocess.DEVNULL)
        os.close(writing)
        with os.fdopen(reading) as pipe:
            number = pipe.readline().strip()
        return dict(os.environ, DISPLAY=f":{number}", WAYLAND_DISPLAY="", XDG_SESSION_TYPE="x11")

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait()


class Window:
    """A viewer in a window, and a hand at its keys and mouse."""

    def __init__(self, environment, *options):
        self.environment = environment
        self.lines, self.last = queue.Queue(), {}
        self.view = subprocess.Popen([TOOL, "view", *options, "--log", "-"], env=environment, stdout=subprocess.PIPE,
                                     stderr=subprocess.PIPE, text=True)
        threading.Thread(target=self.read, daemon=True).start()
        found = self.xdo("search", "--sync", "--onlyvisible", "--name", "pliant: viewer_cloth")
        self.window = found.split()[0] if found else None
        if self.window:
            self.xdo("windowfocus", "--sync", self.window)

    def read(self):
        for line in self.view.stdout:
            if line.startswith("{"):
                self.lines.put(json.loads(line))
        self.lines.put(None)

    def xdo(self, *words):
        return subprocess.run(["xdotool", *words], env=self.environment, capture_output=True, text=True, timeout=120).stdout

    def move(self, x, y):
        self.xdo("mousemove", "--window", self.window, str(x), str(y))

    def until(self, condition, what):
        """The first frame from now on of which it is true."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            try:
                line = self.lines.get(timeout=1)
            except queue.Empty:
                continue
            if line is None:
                break
            self.last = line
            if condition(line):
                return line
        check(False, what)
        return self.last

    def next(self):
        """A frame that was begun after now."""
        while not self.lines.empty():
            self.lines.get()
        return self.until(lambda line: True, "no frame follows")

    def end(self):
        try:
            self.view.wait(timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            self.view.kill()
        return self.view.returncode, self.view.stderr.read()


def touch(environment):
    """Every input that an X server can send."""
    window = Window(environment, SCENE, "--size", "400x300", "--backend", "cpu", "--validation")
    check(window.window, "the window with the scene's name does not appear")
    if not window.window:
        window.view.kill()
        return
    window.until(lambda line: line["time"] > 0.1, "nothing moves")
    window.xdo("key", "h")
    window.until(lambda line: not line["panel"], "H does not hide the panel")
    window.xdo("key", "space")
    window.until(lambda line: line["paused"] and "hash" in line, "Space does not pause")
    still = [window.next() for _ in range(3)]
    check(len({line["hash"] for line in still}) == 1, "paused, the state changes")
    window.xdo("key", "period")
    stepped = window.until(lambda line: line.get("hash", still[0]["hash"]) != still[0]["hash"], "the period makes no step")
    check(abs(stepped["time"] - still[0]["time"] - 1 / 60) < 1e-6, "the period makes another step than one frame")

    # The middle of the picture is on the cloth.
    window.move(200, 150)
    window.xdo("mousedown", "3")
    held = window.until(lambda line: "held" in line, "the right button does not grab")
    window.xdo("key", "space")
    window.move(230, 90)
    moved = window.until(lambda line: "hand" in line and math.dist(line["hand"], held["hand"]) > 0.05,
                         "the hand does not follow the mouse")
    reach = math.dist(moved["hand"], held["held_position"])
    window.until(lambda line: "held" in line and math.dist(line["held_position"], line["hand"]) < reach / 2,
                 "the held node does not follow the hand")
    window.xdo("mouseup", "3")
    window.until(lambda line: "hash" in line and "held" not in line, "the node is not released")

    camera = window.next()["camera"]
    window.move(30, 30)
    window.xdo("mousedown", "1")
    window.move(90, 60)
    window.until(lambda line: line["camera"]["position"] != camera["position"], "left drag does not orbit")
    window.xdo("mouseup", "1")

    for width, height in ((520, 340), (300, 420), (440, 260)):
        window.xdo("windowsize", window.window, str(width), str(height))
        window.until(lambda line: line["size"] == [width, height], f"the picture does not become {width} x {height}")
    frame = window.next()["frame"]
    window.xdo("windowunmap", "--sync", window.window)
    window.xdo("windowmap", "--sync", window.window)
    window.until(lambda line: line["frame"] > frame + 3, "it does not go on when it was out of sight")
    window.xdo("windowfocus", "--sync", window.window)
    window.xdo("key", "1")
    window.until(lambda line: line["overlays"] == ["strain"], "keys are not heard any more")
    last = window.next()
    window.xdo("key", "Escape")
    code, errors = window.end()
    check(code == 0, f"Escape: exit code {code}: {errors}")
    check(last["validation_messages"] == 0, "the validation layer complains")


def run_script(folder, environment):
    script, log, picture = folder / "window.json", folder / "window.jsonl", folder / "window.png"
    events = [{"at": 0.1, "resize": [500, 300]}, {"at": 0.3, "lose_surface": True}, {"at": 0.4, "resize": [320, 240]},
              {"at": 0.5, "resize": [0, 0]}, {"at": 0.7, "resize": [640, 360]}, {"at": 0.75, "lose_surface": True},
              {"at": 0.8, "scene": "chain"}, {"at": 1.0, "screenshot": str(picture)}]
    script.write_text(json.dumps({"events": events}))
    done = subprocess.run([TOOL, "view", SCENE, "--frames", "70", "--script", str(script), "--log", str(log), "--size",
                           "400x240", "--backend", "cpu", "--validation"],
                          capture_output=True, text=True, env=environment, timeout=500)
    check(done.returncode == 0, f"exit code {done.returncode}: {done.stderr.strip()}")
    lines = lines_of(log)
    check(len(lines) == 70, f"{len(lines)} frames instead of 70")
    if lines:
        check(lines[0]["size"] == [400, 240], f"the window is {lines[0]['size']}")
        check([320, 240] in [line["size"] for line in lines], "the second size was never seen")
        check(lines[-1]["size"] == [640, 360], f"resized, the window is {lines[-1]['size']}")
        check(lines[-1]["validation_messages"] == 0, "the validation layer complains")
    check(picture.exists() and picture.stat().st_size > 2000, "there is no screenshot")


def test(folder):
    with Display() as environment:
        touch(environment)
        run_script(folder, environment)
        without = dict(environment, DISPLAY=":9999")
        done = subprocess.run([TOOL, "view", SCENE], capture_output=True, text=True, env=without, timeout=120)
        check(done.returncode == 4 and "--headless" in done.stderr, f"without a display: {done.returncode}, {done.stderr}")


if __name__ == "__main__":
    sys.exit(run(test, "Xvfb", "xdotool"))

"""SwiftShader, a second Vulkan driver in software: what llvmpipe computes, another compiler has to compute, too.

    second_driver_test.py tests PROGRAM [arguments]         a program of tests on it
    second_driver_test.py scenes PLIANT SCENE:FRAMES[:PATH=VALUE ...] ...
                                                            scenes on it and on the CPU: one hash

Debian's package chromium-common has it. Skipped with a reason where it is not installed."""
import json
import os
import subprocess
import sys
import tempfile

DRIVER = "/usr/lib/chromium/vk_swiftshader_icd.json"
NAME = "SwiftShader"


def environment():
    return {**os.environ, "VK_DRIVER_FILES": DRIVER, "VK_ICD_FILENAMES": DRIVER, "PLIANT_EXPECT_DEVICE": NAME}


def summary(pliant, folder, scene, frames, overrides, backend):
    file = os.path.join(folder, f"{backend}.json")
    values = [argument for override in overrides for argument in ("--set", override)]
    result = subprocess.run([pliant, "run", scene, "--frames", frames, *values, "--backend", backend,
                             "--no-pipeline-cache", "--quiet", "--summary", file],
                            env=environment(), capture_output=True, text=True)
    if result.returncode != 0 or result.stderr:
        sys.exit(f"{scene} on {backend}: exit code {result.returncode}\n{result.stderr}")
    with open(file) as opened:
        return json.load(opened)


def scenes(pliant, names):
    assert names
    failed = []
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            scene, frames, *overrides = name.split(":")
            ours, theirs = (summary(pliant, folder, scene, frames, overrides, backend) for backend in ("cpu", "vulkan"))
            assert NAME in theirs["device"], theirs["device"]
            assert ours["frames"] == int(frames), ours["frames"]
            same = ours["state_hash"] == theirs["state_hash"]
            if not same:
                failed.append(scene)
            print(f"{scene}, {frames} frames: cpu {ours['state_hash']}, {NAME} {theirs['state_hash']}",
                  f"in {theirs['simulation_seconds']:.1f} s", "" if same else "DIFFERENT", flush=True)
    if failed:
        sys.exit("not the CPU's bits: " + ", ".join(failed))


def main():
    if not os.path.exists(DRIVER):
        print(f"skipped: {NAME}: {DRIVER} is missing; on Debian, install chromium-common")
        sys.exit(77)
    what, program, *arguments = sys.argv[1:]
    if what == "scenes":
        scenes(program, arguments)
    else:
        os.execve(program, [program, *arguments], environment())


main()

"""Devices that lack one thing each (tests/limits_layer/devices.cpp, tiny_...) are refused with a sentence that names it.
One that lacks nothing runs, and so does one that allows a single allocation of memory, with the CPU's bits.

    limits_refusals_test.py PLIANT LAYER_PATH"""
import json
import os
import subprocess
import sys
import tempfile

PLIANT, LAYER_PATH = sys.argv[1:]

# Device, scene, and what the sentence has to name.
REFUSALS = [
    ("tiny_version", "falling_sheet", "it has Vulkan 1.0, and 1.1 is needed"),
    ("tiny_stage_buffers", "falling_sheet", "its limit maxPerStageDescriptorStorageBuffers is 4"),
    ("tiny_set_buffers", "falling_sheet", "its limit maxDescriptorSetStorageBuffers is 4"),
    ("tiny_invocations", "falling_sheet", "its limit maxComputeWorkGroupInvocations is 128"),
    ("tiny_group", "falling_sheet", "its limit maxComputeWorkGroupSize[0] is 128"),
    ("tiny_shared", "falling_sheet", "its limit maxComputeSharedMemorySize is 4096"),
    ("tiny_push", "falling_sheet", "its limit maxPushConstantsSize is 4"),
    ("tiny_range", "cloth_sphere", "limit maxStorageBufferRange is 65536"),
    ("no_allocations", "falling_sheet", "does not fit on no_allocations over"),
]


def call(device, *arguments):
    layers = {"VK_LAYER_PATH": LAYER_PATH, "VK_INSTANCE_LAYERS": "VK_LAYER_PLIANT_limits",
              "PLIANT_TEST_DEVICE": device, "VK_LOADER_DRIVERS_SELECT": "*lvp*"}
    return subprocess.run([PLIANT, *arguments], env={**os.environ, **layers}, capture_output=True, text=True)


def run(device, scene, backend, *arguments):
    return call(device, "run", scene, "--frames", "2", "--backend", backend, "--no-pipeline-cache", "--quiet",
                *arguments)


def refusals():
    for device, scene, sentence in REFUSALS:
        outcome = run(device, scene, "vulkan")
        lines = outcome.stderr.splitlines()
        assert outcome.returncode == 4, (device, outcome.returncode, outcome.stderr)
        assert len(lines) == 1 and lines[0].startswith("pliant: ") and sentence in lines[0], (device, outcome.stderr)
        assert "backend" in lines[0], (device, outcome.stderr)  # what to do
        assert outcome.stdout == "", (device, outcome.stdout)


def info_has_the_reason():
    for device, _, sentence in REFUSALS[:-2]:  # whatever a scene asks of the others
        outcome = call(device, "info")
        assert outcome.returncode == 0 and sentence in outcome.stdout, (device, outcome.stdout)


def those_that_have_enough_run():
    with tempfile.TemporaryDirectory() as folder:
        for device, scene in [("quest3", "moving_sphere"), ("tiny_allocations", "falling_sheet")]:
            hashes = set()
            for backend in ("cpu", "vulkan"):
                summary = os.path.join(folder, backend + ".json")
                outcome = run(device, scene, backend, "--summary", summary)
                assert outcome.returncode == 0 and outcome.stderr == "", (device, backend, outcome.stderr)
                with open(summary) as file:
                    result = json.load(file)
                hashes.add(result["state_hash"])
            assert result["device"].startswith(device + " over "), result["device"]
            assert len(hashes) == 1, (device, hashes)


refusals()
info_has_the_reason()
those_that_have_enough_run()
print("good")

#!/usr/bin/env python3
"""Renders the pictures of docs/manual. The scenes are the ```json blocks of its pages, found by their "name".

    manual_pictures.py TOOL [NAME...]      TOOL: the program pliant. NAME: only these pictures, as stiffness_200

It needs ffmpeg, which reduces each picture to 96 colours. Ends with the number of pictures and their size.
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

MANUAL = Path(__file__).resolve().parent.parent / "docs/manual"
IMAGES = MANUAL / "images"
BLOCK = re.compile(r"^```json\n(.*?)^```", re.S | re.M)
CLOTH = "cloths[0]."
STRUCTURAL, SHEAR = CLOTH + "springs.structural.", CLOTH + "springs.shear."

# Name of the picture, scene, changes, and further options of `pliant render`.
PICTURES = [("towel", "towel", [], [])]
PICTURES += [(f"stiffness_{k}", "hung", [f"{STRUCTURAL}stiffness={k}", f"{SHEAR}stiffness={k // 2}"], ["--overlay", "strain"])
             for k in (200, 1000, 10000)]
PICTURES += [(f"bending_{b}", "post", [f"{CLOTH}springs.bending_stiffness={b}"], []) for b in ("1e-6", "1e-3", "3e-2")]
PICTURES += [(f"damping_{d}", "swing", [f"{CLOTH}damping={d}"], []) for d in (0, 2, 10)]
PICTURES += [(f"friction_{f}", "slope", [f"colliders[0].box.friction={f}"], []) for f in ("0", "0.3", "0.6")]
PICTURES += [(f"thickness_{t}", "cover", [f"{CLOTH}thickness={t}"], []) for t in ("0.002", "0.02", "0.08")]
PICTURES += [(f"air_{v}", "banner", [f"air.velocity=[{v},0,1]"], []) for v in (0, 4, 12)]
PICTURES += [(f"substeps_{n}", "swing", [f"time.substeps={n}", "time.duration=2.6"], []) for n in (1, 4, 16)]
PICTURES += [(f"limit_{s}", "elastic", [f"{STRUCTURAL}limit={s}", f"{SHEAR}limit={s}"], ["--overlay", "strain"])
             for s in ("0", "0.05", "0.2")]
PICTURES += [(f"volume_{v}", "ball", [f'bodies[0].volume.target=[{{"time":0,"value":1}},{{"time":0.5,"value":{v}}}]'], [])
             for v in ("0.5", "1", "2")]
PICTURES += [("volume_springs", "ball", ["method=mass_spring"], [])]


def scenes():
    """The text of each scene in the manual, by name."""
    found = {}
    for page in sorted(MANUAL.glob("*.md")):
        for block in BLOCK.findall(page.read_text()):
            name = re.search(r'"name": "(\w+)"', block)
            if name:
                found[name.group(1)] = block
    return found


def make(tool, folder, name, scene, changes, options):
    path = folder / f"{scene}.json"
    path.write_text(scenes()[scene])
    large = folder / f"{name}.png"
    command = [tool, "render", str(path), "--quiet", "--size", "480x270", "--out", str(large)] + options
    for change in changes:
        command += ["--set", change]
    subprocess.run(command, check=True)
    small = IMAGES / f"{name}.png"
    subprocess.run(["ffmpeg", "-v", "error", "-y", "-i", str(large), "-vf",
                    "split[a][b];[a]palettegen=max_colors=96:reserve_transparent=0[p];[b][p]paletteuse=dither=none",
                    str(small)], check=True)
    return small.stat().st_size


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    tool = str(Path(sys.argv[1]).resolve())
    wanted = sys.argv[2:]
    unknown = set(wanted) - {picture[0] for picture in PICTURES}
    if unknown:
        sys.exit(f"no picture is named {', '.join(sorted(unknown))}")
    IMAGES.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        sizes = [make(tool, Path(folder), *picture) for picture in PICTURES if not wanted or picture[0] in wanted]
    print(f"{len(sizes)} pictures, {sum(sizes) // 1024} KiB")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""The JSON Schema of scenes: it accepts every built-in scene and the example of the reference, refuses what
is wrong, and the reference explains every key of it. Needs python3-jsonschema."""

import copy
import json
import re
import sys
from pathlib import Path

import jsonschema

ROOT = Path(__file__).resolve().parent.parent
SCHEMA = json.loads((ROOT / "scenes/scene.schema.json").read_text())
REFERENCE = (ROOT / "docs/scenes.md").read_text()

GOOD = {"pliant": 1, "cloths": [{"sheet": {"rows": 3, "columns": 4}}]}

# (what is done, values put at paths into GOOD)
ALSO_GOOD = [
    ("a constraint of the method constraint",
     {"method": "constraint", "cloths.0.springs.bend": {"role": "constraint", "limit": 0.1}}),
    ("springs that are off", {"method": "acad", "cloths.0.springs.bend.role": "off"}),
    ("a soft body", {"cloths": None, "method": "volume", "bodies": [{"icosphere": {"frequency": 4}, "node_mass": 1}]}),
    ("a body beside a cloth", {"bodies": [{"mesh": {"file": "a.ply", "weights": "give"}, "springs": {"internal": {"kind": "opposite"}}}]}),
    ("a material and a bending energy", {"cloths.0.material": "silk", "cloths.0.springs.bend_model": "quadratic",
                                         "cloths.0.springs.bending_stiffness": 1e-6, "cloths.0.sheet.border": "half"}),
    ("an integrator", {"integrator": "runge_kutta_4"}),
    ("a disc", {"cloths.0": {"disc": {"rings": 8}, "formulation": "spring_list"}}),
    ("a pin that moves", {"cloths.0.pins": [{"index": 0, "keyframes": [{"time": 0}, {"time": 1}]}]}),
]

# (what is wrong, path into GOOD, value put there)
BAD = [
    ("no version", "pliant", None),
    ("a later version", "pliant", 2),
    ("no cloths", "cloths", None),
    ("an empty list of cloths", "cloths", []),
    ("an unknown key", "colour", "red"),
    ("an unknown method", "method", "xpbd"),
    ("an unknown integrator", "integrator", "verlet"),
    ("an unknown material", "cloths.0.material", "paper"),
    ("an unknown model of bending", "cloths.0.springs.bend_model", "cubic"),
    ("a negative bending stiffness", "cloths.0.springs.bending_stiffness", -1),
    ("an unknown border", "cloths.0.sheet.border", "none"),
    ("an unknown solver", "solver", "jacobi"),
    ("no Newton iterations", "newton_multigrid.newton_iterations", 0),
    ("broken V-cycles", "newton_multigrid.linear_iterations", 2.5),
    ("a tolerance above one", "newton_multigrid.newton_tolerance", 1.5),
    ("too much smoothing", "newton_multigrid.smoothing", 9),
    ("an unknown direction", "newton_multigrid.resists", "compression"),
    ("colliders of a negative stiffness", "newton_multigrid.contact_stiffness", -1),
    ("a third order", "newton_multigrid.order", 3),
    ("friction at no speed", "newton_multigrid.friction_speed", 0),
    ("an option of another solver", "newton_multigrid.max_iterations", 5),
    ("a tolerance of zero", "paper.tolerance", 0),
    ("too many iterations", "paper.max_iterations", 200000),
    ("a negative compliance", "paper.compliance", -1),
    ("a stretch in per cent", "acad.activate_at", 10),
    ("a negative stretch", "acad.deactivate_at", -0.1),
    ("a flag in numbers", "acad.compression", 1),
    ("an unknown target", "acad.target", "half"),
    ("a constraint without compliance", "acad.compliance", 0),
    ("a name with a slash", "name", "a/b"),
    ("a duration of zero", "time.duration", 0),
    ("a duration in words", "time.duration", "5 s"),
    ("a frame rate below one", "time.frame_rate", 0.5),
    ("broken substeps", "time.substeps", 1.5),
    ("dt and frame_rate", "time", {"dt": 0.001, "frame_rate": 60, "substeps": 10}),
    ("dt without substeps", "time", {"dt": 0.001}),
    ("dt with zero substeps", "time", {"dt": 0.001, "substeps": 0}),
    ("gravity as a number", "gravity", -9.81),
    ("gravity of two numbers", "gravity", [0, -9.81]),
    ("air of negative density", "air.density", -1.2),
    ("no shape", "cloths.0.sheet", None),
    ("two shapes", "cloths.0.mesh", {"file": "a.obj"}),
    ("one row", "cloths.0.sheet.rows", 1),
    ("no columns", "cloths.0.sheet.columns", None),
    ("a width of zero", "cloths.0.sheet.width", 0),
    ("a mesh without a file", "cloths.0", {"mesh": {}}),
    ("node-centric on a mesh", "cloths.0", {"mesh": {"file": "a.obj"}, "formulation": "node_centric"}),
    ("a corner of a mesh", "cloths.0", {"mesh": {"file": "a.obj"}, "pins": [{"corner": "top_left"}]}),
    ("a disc without rings", "cloths.0", {"disc": {"radius": 1}}),
    ("a disc of too many rings", "cloths.0", {"disc": {"rings": 2365}}),
    ("a disc of no size", "cloths.0", {"disc": {"rings": 3, "radius": 0}}),
    ("an edge of a disc", "cloths.0", {"disc": {"rings": 3}, "pins": [{"edge": "top"}]}),
    ("a sheet and a disc", "cloths.0.disc", {"rings": 3}),
    ("a body of two shapes", "bodies", [{"icosphere": {}, "torus": {}}]),
    ("a body of no shape", "bodies", [{"node_mass": 1}]),
    ("a body held at a corner", "bodies", [{"icosphere": {}, "pins": [{"corner": "top_left"}]}]),
    ("a target without a time", "bodies", [{"icosphere": {}, "volume": {"target": [{"value": 1}]}}]),
    ("an unknown kind of internal springs", "bodies", [{"icosphere": {}, "springs": {"internal": {"kind": "all"}}}]),
    ("density and node_mass", "cloths.0", {"sheet": {"rows": 2, "columns": 2}, "density": 1, "node_mass": 1}),
    ("a negative stiffness", "cloths.0.springs.shear.stiffness", -5),
    ("a mistyped key", "cloths.0.springs.shear.stifness", 5),
    ("an unknown role", "cloths.0.springs.bend.role", "rod"),
    ("a constraint of the method mass_spring", "cloths.0.springs.shear.role", "constraint"),
    ("a limit in per cent", "cloths.0.springs.shear.limit", 5),
    ("a compliance of zero", "cloths.0.springs.shear.compliance", 0),
    ("too much damping", "cloths.0.damping", 2000),
    ("an unknown corner", "cloths.0.pins", [{"corner": "topleft"}]),
    ("a pin of two kinds", "cloths.0.pins", [{"corner": "top_left", "index": 0}]),
    ("a pin of no kind", "cloths.0.pins", [{"keyframes": [{"time": 0}]}]),
    ("a pin that moves at no time", "cloths.0.pins", [{"index": 0, "keyframes": [{"position": [0, 1, 0]}]}]),
    ("a box without max", "cloths.0.pins", [{"box": {"min": [0, 0, 0]}}]),
    ("an unknown collider", "colliders", [{"torus": {}}]),
    ("a collider of two shapes", "colliders", [{"sphere": {"centre": [0, 0, 0], "radius": 1}, "plane": {}}]),
    ("a sphere without a radius", "colliders", [{"sphere": {"centre": [0, 0, 0]}}]),
    ("a flat normal", "colliders", [{"plane": {"normal": [0, 0, 0]}}]),
    ("a box of no depth", "colliders", [{"box": {"centre": [0, 0, 0], "size": [1, 1, 0]}}]),
    ("friction beyond its range", "colliders", [{"plane": {"friction": 11}}]),
    ("an unknown response", "colliders", [{"plane": {"response": "sticky"}}]),
    ("a keyframe without a time", "colliders", [{"plane": {"keyframes": [{"position": [0, 0, 0]}]}}]),
    ("a picture too large", "camera.width", 10000),
    ("an unknown check", "check.max_strech", [0, 1]),
    ("a check of one number", "check.max_stretch", [1]),
]


def without_comments(text):
    """Comments go, strings stay as they are."""
    token = re.compile(r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/', re.DOTALL)
    return token.sub(lambda match: match[0] if match[0].startswith('"') else " ", text)


def changed(scene, path, value):
    """A copy of the scene with `value` at "a.0.b"; None takes the key away."""
    scene = copy.deepcopy(scene)
    *way, last = [int(part) if part.isdigit() else part for part in path.split(".")]
    place = scene
    for part in way:
        place = place[part] if isinstance(part, int) else place.setdefault(part, {})
    if value is None:
        del place[last]
    else:
        place[last] = value
    return scene


def keys_of(schema):
    """Every key that a scene may have, at any depth."""
    if isinstance(schema, dict):
        yield from schema.get("properties", {})
        for part in schema.values():
            yield from keys_of(part)
    elif isinstance(schema, list):
        for part in schema:
            yield from keys_of(part)


def main():
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    validator = jsonschema.Draft202012Validator(SCHEMA)
    passed, failures = 0, []

    def expect(condition, complaint):
        nonlocal passed
        if condition:
            passed += 1
        else:
            failures.append(complaint)

    def accept(name, text):
        errors = validator.iter_errors(json.loads(without_comments(text)))
        complaints = [f"{error.json_path}: {error.message}" for error in errors]
        expect(not complaints, f"{name} is refused: {'; '.join(complaints)}")

    files = sorted((ROOT / "scenes").glob("*.json"))
    scenes = [file for file in files if not file.name.endswith(".schema.json")]
    expect(len(scenes) >= 11, f"only {len(scenes)} built-in scenes found")
    for file in scenes:
        accept(file.name, file.read_text())
        expect(f"`{file.stem}`" in REFERENCE, f"docs/scenes.md does not list {file.stem}")
    for example in re.findall(r"```json\n(.*?)```", REFERENCE, re.DOTALL):
        accept("the example in docs/scenes.md", example)
    accept("the smallest scene", json.dumps(GOOD))
    for what, changes in ALSO_GOOD:
        scene = GOOD
        for path, value in changes.items():
            scene = changed(scene, path, value)
        accept(what, json.dumps(scene))
    for what, path, value in BAD:
        expect(not validator.is_valid(changed(GOOD, path, value)), f"{what} is accepted")
    for key in sorted(set(keys_of(SCHEMA))):
        expect(f"`{key}`" in REFERENCE, f"docs/scenes.md does not explain {key}")

    for failure in failures:
        print("FAILED:", failure)
    print(f"{passed} passed, {len(failures)} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""PrusaSlicer judges whether the parts of fusee print without supports.

    judge_print.py build/forearm …          folders of `fusee build`: each file of the manifest's "print", else pulley.stl
    judge_print.py part.stl …               or files in print orientation
    judge_print.py --designs 100 --seed 1 --fusee path/to/fusee
                                            this number of feasible random designs, by default FUSEE_PRINT_DESIGNS; they depend only on
                                            the seed
    judge_print.py --self-test              the judge must detect unsupported parts

Exit 0: no supports; 1: supports, one line per file on stdout; 77: not installed, or no designs requested.

Supports are on, automatic, below 45° (PrusaSlicer takes that as "below 46°"), layers of 0.2 mm, since its default of 0.3 mm is milder. It does not support
bridges. Supports are found in its G-code: each connected piece is one block.
"""

import argparse
import collections
import json
import math
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
from judge_mesh import SKIPPED, NotInstalled, printed_by, write_stl  # noqa: E402

SETTINGS = ["--support-material", "--support-material-auto", "--support-material-threshold", "45",
            "--layer-height", "0.2", "--first-layer-height", "0.2",
            "--bed-shape", "0x0,1000x0,1000x1000,0x1000", "--center", "500,500"]


class NotSliced(Exception):
    pass


def supports(stl):
    """Number of support blocks by kind, and the height of the highest one. NotSliced without G-code."""
    with tempfile.TemporaryDirectory() as folder:
        gcode = pathlib.Path(folder, "part.gcode")
        text = printed_by("prusa-slicer", *SETTINGS, "--export-gcode", "-o", gcode, stl)
        if not gcode.exists():
            raise NotSliced(text.strip()[-300:])
        blocks, height, highest = collections.Counter(), 0.0, 0.0
        with open(gcode, encoding="utf-8") as lines:
            for line in lines:
                if line.startswith(";Z:"):
                    height = float(line[3:])
                elif line.startswith(";TYPE:Support material"):
                    blocks["interface" if "interface" in line else "support"] += 1
                    highest = max(highest, height)
        return blocks, highest


def report(name, stl):
    """Prints the supports; true if there are any."""
    try:
        blocks, highest = supports(stl)
    except NotSliced as error:
        print(f"{name}: not sliced: {error}")
        return True
    found = sum(blocks.values())
    print(f"{name}: {found} support blocks" +
          (f" ({blocks['interface']} of them interface), up to z = {highest:.2f} mm" if found else ""), flush=True)
    return found > 0


def parts_of(path):
    """The part files for the printer."""
    if not path.is_dir():
        return [path]
    manifest = json.loads((path / "manifest.json").read_text(encoding="utf-8"))
    return [path / part["file"] for part in manifest.get("print", [{"file": "pulley.stl"}])]


def needing_supports(paths):
    return sum([report(part, part) for path in paths for part in parts_of(path)])


# Random designs: plausible values, finger to arm ----------------------------------------------------------

def design(rng):
    def log_uniform(low, high):
        return math.exp(rng.uniform(math.log(low), math.log(high)))

    length = log_uniform(25, 250)
    diameter = min(max(length * log_uniform(.004, .02), .3), 3)
    half_range = rng.uniform(10, 35)
    values = collections.defaultdict(dict)
    values["joint"] = {"length_mm": length, "range_deg": [-half_range * rng.choice([1, rng.uniform(.3, 1)]), half_range]}
    side = length * rng.uniform(.3, .75)
    values["guides"] = {"EB_mm": side, "ED_mm": rng.choice([side, length * rng.uniform(.3, .75)]),
                        "OE_mm": length * rng.uniform(-.45, .05), "radius_mm": rng.choice([0, diameter * rng.uniform(.5, 3)])}
    values["tendon"]["diameter_mm"] = diameter
    values["pulley"]["EF_mm"] = length * rng.uniform(.75, 1.5)
    if rng.random() < .7:
        values["pulley"]["r1_mm"] = length * rng.uniform(.11, .2)
    else:
        values["pulley"] |= {"law": "linear", "ratio": rng.uniform(2.4, 4.5)}
    choices = {"groove": ["u", "v", "flat"], "flange": ["follow", "round"], "bore": ["round", "d", "hex", "square", "keyway"],
               "marks": ["engraved", "raised", "none"], "set_screw": ["none", "M3", "M4"], "nut_trap": [True, False],
               "groove_angle_deg": [rng.uniform(20, 90)], "groove_depth_mm": [rng.uniform(.8, 4)],
               "flange_thickness_mm": [rng.uniform(.8, 3)], "hub_height_mm": [0, rng.uniform(3, 12)],
               "bore_diameter_mm": [rng.uniform(3, 8)]}
    for key, options in choices.items():
        if rng.random() < .3:
            values["body"][key] = rng.choice(options)
    return values


def toml_of(name, values):
    def text(value):
        return f"{value:.6g}" if isinstance(value, float) else json.dumps(value)

    def line(key, value):
        return f"{key} = [{', '.join(map(text, value))}]\n" if isinstance(value, list) else f"{key} = {text(value)}\n"

    tables = "".join(f"\n[{table}]\n" + "".join(line(*item) for item in keys.items()) for table, keys in values.items() if keys)
    return f'schema = 1\nname = "{name}"\n{tables}'


def is_refused(run):
    """Infeasible (exit 4), or a failed check (exit 5) unrelated to printing."""
    prints_wrongly = re.search(r"check '\w*(overhang|unsupported_step|bridge|island)\w*' failed", run.stderr)
    return run.returncode == 4 or (run.returncode == 5 and not prints_wrongly)


def needing_supports_of_designs(wanted, seed, fusee):
    """`wanted` feasible designs."""
    made = number = faults = 0
    with tempfile.TemporaryDirectory() as folder:
        while made < wanted:
            number += 1
            name = f"print_{seed}_{number}"
            file, out = pathlib.Path(folder, name + ".toml"), pathlib.Path(folder, name)
            file.write_text(toml_of(name, design(random.Random(f"{seed}/{number}"))), encoding="utf-8")
            run = subprocess.run([fusee, "build", file, "-o", out, "--force"], capture_output=True, text=True, timeout=300, check=False)
            if is_refused(run):
                if number > 100 + 20 * wanted:
                    print(f"of {number} designs only {made} can be made: the generator is wrong, or fusee")
                    return faults + 1
                continue
            made += 1
            wrong = run.returncode != 0
            if wrong:
                print(f"{name}: exit {run.returncode}: {run.stderr.strip()[-300:]}")
            else:
                wrong = sum([report(f"{name}/{part.name}", part) for part in parts_of(out)]) > 0
            if wrong:
                faults += 1
                print(file.read_text(encoding="utf-8"))
    print(f"{faults} of {made} designs need supports or failed; {number - made} were refused")
    return faults


# Self-test: the judge must be able to fail -----------------------------------------------------------------------

def turned(profile, around=96):
    """A part from rings (radius, z), bottom to top."""
    vertices = [(r * math.cos(2 * math.pi * i / around), r * math.sin(2 * math.pi * i / around), z)
                for r, z in profile for i in range(around)]
    faces = [(0, i + 1, i) for i in range(1, around - 1)]
    for first in range(0, (len(profile) - 1) * around, around):
        for i in range(around):
            a, b = first + i, first + (i + 1) % around
            faces += [(a, b, b + around), (a, b + around, a + around)]
    top = (len(profile) - 1) * around
    faces += [(top, top + i, top + i + 1) for i in range(1, around - 1)]
    return vertices, faces


def cone(slope_deg):
    return [(5, 0), (5, 2), (5 + 6 / math.tan(math.radians(slope_deg)), 8)]


PRINTABLE = {"a cylinder": [(10, 0), (10, 5)], "a cone of 47°": cone(47), "a step of 0.15 mm": [(10, 0), (10, 4), (10.15, 4), (10.15, 6)]}
NEEDS_SUPPORTS = {"a mushroom": [(4, 0), (4, 5), (9, 5), (9, 7)], "a cone of 44°": cone(44),
            "a step of 0.4 mm": [(10, 0), (10, 4), (10.4, 4), (10.4, 6)]}


def self_test():
    faults = 0
    with tempfile.TemporaryDirectory() as folder:
        for name, profile in {**PRINTABLE, **NEEDS_SUPPORTS}.items():
            path = pathlib.Path(folder, "part.stl")
            write_stl(path, *turned(profile))
            if report(name, path) == (name in PRINTABLE):
                print(f"the judge is wrong about {name}")
                faults += 1
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("paths", nargs="*", type=pathlib.Path)
    parser.add_argument("--designs", type=int, nargs="?", const=int(os.environ.get("FUSEE_PRINT_DESIGNS", 0)))
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--fusee", default="fusee")
    parser.add_argument("--self-test", action="store_true")
    arguments = parser.parse_args()
    if bool(arguments.paths) + (arguments.designs is not None) + arguments.self_test != 1:
        parser.error("folders or files, or --designs, or --self-test")
    if arguments.designs == 0:
        print("no designs: FUSEE_PRINT_DESIGNS says how many")
        return SKIPPED
    try:
        if arguments.self_test:
            faults = self_test()
        elif arguments.designs:
            faults = needing_supports_of_designs(arguments.designs, arguments.seed, arguments.fusee)
        else:
            faults = needing_supports(arguments.paths)
    except NotInstalled as program:
        print(f"{program} is not installed")
        return SKIPPED
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

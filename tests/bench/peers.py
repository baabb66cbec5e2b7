"""Times of `fusee build`, `kit` and `model`, and of OpenSCAD for the same part: for its pulley.scad, and for a simple union
of two drums with floors, flanges, hub and bore, but without groove sections and tie-offs.

usage: peers.py FUSEE SPEC.toml
"""

import csv
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time


def measured(command):
    """Wall time and processor time, s, and peak memory, MB, of one run."""
    start = time.perf_counter()
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    if status != 0:
        sys.exit(f"{command[0]} ended with status {os.waitstatus_to_exitcode(status)}")
    return time.perf_counter() - start, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1000


def best(command, runs):
    """The run with the least wall time: other load on the machine only increases it."""
    return min(measured(command) for _ in range(runs))


def two_drums(folder):
    """The drums as a user would write them: each a floor between two flanges with its outline."""
    with open(f"{folder}/manifest.json") as file:
        manifest = json.load(file)
    with open(f"{folder}/pulley.scad") as file:
        numbers = {name: float(value) for name, value in re.findall(r"^(\w+) = ([\d.]+);", file.read(), re.M)}
    with open(f"{folder}/profile.csv") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    tendon, depth, flange = manifest["tendon"]["diameter_mm"], numbers["groove_depth"], numbers["flange_thickness"]
    text = f"$fn = {numbers['facets']:.0f};\nmodule drum(pitch, z) {{\n"
    text += f"  translate([0, 0, z - {tendon}]) linear_extrude({2 * tendon}) offset(delta = {-tendon / 2}) polygon(pitch);\n"
    for z in (-tendon - flange, tendon):
        text += f"  translate([0, 0, z + {z}]) linear_extrude({flange}) offset(r = {depth - tendon / 2}) polygon(pitch);\n"
    text += "}\ndifference() {\n  union() {\n"
    top = 0
    for groove in manifest["grooves"]:
        points = ", ".join(f"[{row['x_mm']}, {row['y_mm']}]" for row in rows if row["pulley"] == groove["pulley"])
        text += f"    drum([{points}], {groove['z_mm']});\n"
        top = max(top, groove["z_mm"] + tendon + flange)
    text += f"    cylinder(h = {top + numbers['hub_height']}, d = {max(numbers['hub_diameter'], numbers['bore'] + 4)});\n  }}\n"
    text += f"  translate([0, 0, -100]) cylinder(h = 300, d = {numbers['bore'] + numbers['hole_compensation']});\n}}\n"
    return text


def main():
    fusee, spec = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as folder:
        seconds, processor, memory = best([fusee, "build", spec, "-o", folder + "/out"], 5)
        print(f"fusee build, every format and every check: {seconds:.3f} s ({processor:.3f} s of processor), {memory:.0f} MB")
        kit, kit_processor, kit_memory = best([fusee, "kit", spec, "-o", folder + "/kit"], 5)
        print(f"fusee kit, every part checked (limit 2 s): {kit:.3f} s ({kit_processor:.3f} s of processor), {kit_memory:.0f} MB")
        model, model_processor, model_memory = best([fusee, "model", spec, "-o", folder + "/model"], 5)
        print(f"fusee model, every file checked (limit 0.2 s): {model:.3f} s ({model_processor:.3f} s of processor), {model_memory:.0f} MB")
        if shutil.which("openscad") is None:
            print("openscad is not installed")
            return
        with open(folder + "/drums.scad", "w") as file:
            file.write(two_drums(folder + "/out"))
        for name, scad, runs in (("pulley.scad", folder + "/out/pulley.scad", 1), ("a plain union of two drums", folder + "/drums.scad", 3)):
            scad_seconds, scad_processor, scad_memory = best(["openscad", "-o", folder + "/scad.stl", scad], runs)
            print(f"openscad on {name}, STL alone: {scad_seconds:.2f} s ({scad_processor:.2f} s of processor), {scad_memory:.0f} MB: "
                  f"fusee is {scad_seconds / seconds:.1f} times faster, {scad_processor / processor:.1f} times in processor time")


if __name__ == "__main__":
    main()

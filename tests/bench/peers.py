"""Times `fusee build` against OpenSCAD on the pulley.scad of the same part, in the same run.

usage: peers.py FUSEE SPEC.toml
"""

import os
import shutil
import subprocess
import sys
import tempfile
import time


def measured(command):
    """Seconds and peak memory in MB of one run."""
    start = time.perf_counter()
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    if status != 0:
        sys.exit(f"{command[0]} ended with status {os.waitstatus_to_exitcode(status)}")
    return time.perf_counter() - start, usage.ru_maxrss / 1000


def best(command, runs):
    return min(measured(command) for _ in range(runs))


def main():
    fusee, spec = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as folder:
        seconds, memory = best([fusee, "build", spec, "-o", folder + "/out"], 5)
        print(f"fusee build, every format and every check: {seconds:.3f} s, {memory:.0f} MB")
        if shutil.which("openscad") is None:
            print("openscad is not installed")
            return
        scad_seconds, scad_memory = best(["openscad", "-o", folder + "/scad.stl", folder + "/out/pulley.scad"], 1)
        print(f"openscad on pulley.scad, STL alone: {scad_seconds:.1f} s, {scad_memory:.0f} MB")
        print(f"fusee is {scad_seconds / seconds:.0f} times faster")


if __name__ == "__main__":
    main()

"""OpenSCAD as a judge of pulley.scad: rendered as it is, it must be the part of pulley.stl (box within 0.01 mm, volume within 0.5 %); rendered with
another bore and another groove, the part must change by what that means.
Usage: judge_scad.py FOLDER ...   (each with pulley.scad, pulley.stl; round bores for the changed bore)"""
import math
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile


def triangles(path):
    data = path.read_bytes()
    if data[:5] == b"solid":
        numbers = [float(x) for line in re.findall(rb"vertex (.*)", data) for x in line.split()]
        return [tuple(numbers[k : k + 9]) for k in range(0, len(numbers), 9)]
    (count,) = struct.unpack_from("<I", data, 80)
    return [struct.unpack_from("<9f", data, 84 + 50 * k + 12) for k in range(count)]


def measure(path):
    """Volume and the box's corners."""
    low, high, volume = [math.inf] * 3, [-math.inf] * 3, 0.0
    for t in triangles(path):
        a, b, c = t[0:3], t[3:6], t[6:9]
        volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
        for p in (a, b, c):
            low = [min(x, y) for x, y in zip(low, p)]
            high = [max(x, y) for x, y in zip(high, p)]
    return volume, low + high


def render(scad, out, **parameters):
    arguments = [f"-D{name}={value}" for name, value in parameters.items()]
    run = subprocess.run(["openscad", "-o", str(out), *arguments, str(scad)], capture_output=True, text=True, timeout=300)
    words = [line for line in run.stderr.splitlines() if "WARNING" in line or "ERROR" in line]
    if words or run.returncode or "Simple:        yes" not in run.stderr:
        raise ValueError("OpenSCAD says: " + " / ".join(words or run.stderr.splitlines()[-3:]))
    return measure(out)


def number(scad, name):
    return float(re.search(rf"^{name} = ([-0-9.]+);", scad.read_text(), re.M).group(1))


def faults(folder, scratch):
    scad = folder / "pulley.scad"
    volume, box = render(scad, scratch / "as_it_is.stl")
    made, made_box = measure(folder / "pulley.stl")
    off = max(abs(a - b) for a, b in zip(box, made_box))
    print(f"{folder}: volume {volume:.1f} mm³, {100 * (volume / made - 1):+.3f} % of the mesh's; box off by {off:.4f} mm")
    if off > 0.01:
        yield f"the box is off by {off:.4f} mm"
    if abs(volume / made - 1) > 0.005:
        yield f"the volume is {volume:.1f} mm³ and should be {made:.1f}"
    if 'bore_shape = "round"' in scad.read_text():
        yield from changed_bore(scad, scratch, volume)
    lip = number(scad, "groove_depth")
    shallow, shallow_box = render(scad, scratch / "shallow.stl", groove_depth=0.8 * lip)
    if not shallow < volume or not shallow_box[3] < box[3] - 0.15 * lip:
        yield "a shallower groove does not make a smaller part"


def changed_bore(scad, scratch, volume):
    """Tie-offs and set screw away, so that only the bore's polygon changes, whose area is known."""
    bore, clearance = number(scad, "bore"), number(scad, "hole_compensation")

    def area(diameter):
        sides = max(8, math.floor(2 * diameter + 0.5))
        return sides * (diameter / 2) ** 2 * math.tan(math.pi / sides)

    plain = {"tie_offs": "[]", "set_screw": "false"}
    before, box = render(scad, scratch / "plain.stl", **plain)
    after, _ = render(scad, scratch / "bored.stl", bore=bore + 1, **plain)
    expected = (area(bore + 1 + clearance) - area(bore + clearance)) * (box[5] - box[2])
    if abs((before - after) / expected - 1) > 0.01:
        yield f"a bore 1 mm wider takes {before - after:.2f} mm³ and should take {expected:.2f}"


def main():
    if not shutil.which("openscad"):
        print("openscad is not installed")
        return 77
    wrong = 0
    for name in sys.argv[1:]:
        with tempfile.TemporaryDirectory() as scratch:
            try:
                for fault in faults(pathlib.Path(name), pathlib.Path(scratch)):
                    print(f"{name}: {fault}")
                    wrong += 1
            except (ValueError, OSError, subprocess.TimeoutExpired) as error:
                print(f"{name}: {error}")
                wrong += 1
    return 1 if wrong or len(sys.argv) < 2 else 0


sys.exit(main())

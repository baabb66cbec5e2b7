"""OpenSCAD as a judge of pulley.scad.

    judge_scad.py part FOLDER             the rendered part must equal pulley.stl: box within 0.01 mm (several turns: 0.025 mm),
                                          volume within 0.5 %; "P1", "P2" and "print" must show the files that the manifest lists
                                          for printing; another bore (if round) and a shallower groove must change the volume
    judge_scad.py part FOLDER --self-test the judge must detect faults in a pulley of two printed parts
    judge_scad.py preview FOLDER          the quick preview must look like the full render, from five sides
    judge_scad.py preview --self-test     the judge must detect a polyhedron without its convexity
    judge_scad.py customizer FOLDER       each parameter has a description and a range, a list or a tick box; at the ends and in
                                          the middle of its range the part renders without complaints

FOLDER is the output of `fusee build`. Exit 0: no faults; 1: faults, on stdout; 77: a program is not installed."""
import argparse
import concurrent.futures
import contextlib
import json
import math
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile

SKIPPED = 77

def triangles(path):
    data = path.read_bytes()
    if data[:5] == b"solid":
        numbers = [float(x) for line in re.findall(rb"vertex (.*)", data) for x in line.split()]
        return [tuple(numbers[k : k + 9]) for k in range(0, len(numbers), 9)]
    (count,) = struct.unpack_from("<I", data, 80)
    return [struct.unpack_from("<9f", data, 84 + 50 * k + 12) for k in range(count)]


def measure(path):
    """Volume and bounding box."""
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
    text = printed_by_openscad(scad, "-o", out, *arguments)
    if "Simple:        yes" not in text:
        raise ValueError("OpenSCAD says: " + " / ".join(text.splitlines()[-3:]))
    return measure(out)


def printed_by_openscad(scad, *arguments, environment=None):
    run = subprocess.run(["openscad", *map(str, arguments), str(scad)], capture_output=True, text=True, timeout=300, env=environment)
    words = [line for line in run.stderr.splitlines() if re.search("WARNING|ERROR|DEPRECATED", line)]
    if words or run.returncode:
        raise ValueError("OpenSCAD says: " + " / ".join(words[:3] or run.stderr.splitlines()[-3:]))
    return run.stderr


def number(scad, name):
    return float(re.search(rf"^{name} = ([-0-9.]+);", scad.read_text(), re.M).group(1))


# The part ------------------------------------------------------------------------------------------------------------

BETWEEN_PARTS = 5.0  # mm, distance on the printer


def size_faults(what, found, expected, tolerance=0.01):
    """Compares volume and box with the expected ones. `tolerance`: of the box, mm."""
    (volume, box), (expected_volume, expected_box) = found, expected
    off = max(abs(a - b) for a, b in zip(box, expected_box))
    print(f"{what}: volume {volume:.1f} mm³, {100 * (volume / expected_volume - 1):+.3f} % of the mesh's; box off by {off:.4f} mm")
    if off > tolerance:
        yield f"{what}: the box is off by {off:.4f} mm"
    if abs(volume / expected_volume - 1) > 0.005:
        yield f"{what}: the volume is {volume:.1f} mm³ and should be {expected_volume:.1f}"


def side_by_side(first, second):
    (volume, box), (other_volume, other) = first, second
    shift = box[3] + BETWEEN_PARTS - other[0]
    low = [box[0], min(box[1], other[1]), min(box[2], other[2])]
    high = [other[3] + shift, max(box[4], other[4]), max(box[5], other[5])]
    return volume + other_volume, low + high


def printed_faults(folder, scratch):
    """The parts of a pulley in two, in print orientation."""
    pieces = json.loads((folder / "manifest.json").read_text())["print"]
    offered = re.search(r'^show = "assembled"; // \[(.*)\]$', (folder / "pulley.scad").read_text(), re.M).group(1)
    shows = ["assembled", "print"] + [piece["part"] for piece in pieces if "part" in piece]
    if offered != ", ".join(shows):
        yield f"show offers {offered}, and should offer {', '.join(shows)}"
    if len(pieces) != 2:
        return
    made = [measure(folder / piece["file"]) for piece in pieces]
    for show, expected in zip(shows[1:], [side_by_side(*made), *made]):
        yield from size_faults(show, render(folder / "pulley.scad", scratch / f"{show}.stl", show=f'"{show}"'), expected)


def part_faults(folder, scratch):
    scad = folder / "pulley.scad"
    volume, box = render(scad, scratch / "assembled.stl")
    is_helical = "\ncolumns = " in scad.read_text()
    # A helix has no fixed extreme points: its corners are within the program's sagitta of the mesh's.
    yield from size_faults("assembled", (volume, box), measure(folder / "pulley.stl"), 0.025 if is_helical else 0.01)
    if not is_helical:
        yield from printed_faults(folder, scratch)
    if 'bore_shape = "round"' in scad.read_text():
        yield from changed_bore(scad, scratch, volume)
    depth = number(scad, "groove_depth")
    shallow, shallow_box = render(scad, scratch / "shallow.stl", groove_depth=0.8 * depth)
    # The radius shrinks by 0.2 of the depth; at least 0.15 is required.
    if not shallow < volume or not shallow_box[3] < box[3] - 0.15 * depth:
        yield "a shallower groove does not make a smaller part"


# For a pulley in two parts: the fault, the text and its faulty replacement, and the view in which it must be detected.
BROKEN = (("a ceiling of another slope", "slope = supports ? 0 : overhang_deg + 2.5", "slope = overhang_deg - 10", "assembled"),
          ("P1 not turned over", "rotate([piece == 1 ? 180 : 0, 0, 0])", "", "P1"),
          ("a part without its pockets", "if (knot_pocket > 0) pocket(t)", "", "P2"),
          ("no place for P2 to lie", "near_side(p2_rings) + 5", "near_side(p2_rings)", "print"))


def part_self_test(folder, scratch):
    for name in ("manifest.json", "pulley.stl", "pulley_p1.stl", "pulley_p2.stl"):
        shutil.copy(folder / name, scratch)
    text = (folder / "pulley.scad").read_text()
    for what, right, wrong, view in BROKEN:
        if text.count(right) != 1:
            yield f"pulley.scad no longer contains {right!r}"
            continue
        (scratch / "pulley.scad").write_text(text.replace(right, wrong))
        if not any(fault.startswith(view + ": ") for fault in part_faults(scratch, scratch)):
            yield f"{what} was accepted"


def changed_bore(scad, scratch, volume):
    """Without tie-offs and set screw only the bore's polygon changes, whose area is known."""
    bore, clearance, scale = (number(scad, name) for name in ("bore", "hole_compensation", "print_scale"))

    def area(diameter):
        # Holes of pulley.scad are polygons outside the circle, with two sides per millimetre of diameter and at least eight.
        sides = max(8, math.floor(2 * diameter + 0.5))
        return sides * (scale * diameter / 2) ** 2 * math.tan(math.pi / sides)

    without_cuts = {"channels": "[]", "face_holes": "[]", "tail_slots": "[]", "clamp_pilots": "[]", "set_screw": "false"}
    before, box = render(scad, scratch / "plain.stl", **without_cuts)
    after, _ = render(scad, scratch / "bored.stl", bore=bore + 1, **without_cuts)
    expected = (area(bore + 1 + clearance) - area(bore + clearance)) * (box[5] - box[2])
    if abs((before - after) / expected - 1) > 0.01:
        yield f"a bore 1 mm wider takes {before - after:.2f} mm³ and should take {expected:.2f}"


# The preview ---------------------------------------------------------------------------------------------------------

# Views by rotation about x, y and z, degrees: from above, from below, level, and along the axis in both directions.
SIDES = ("60,0,30", "125,0,210", "90,0,120", "0,0,0", "180,0,0")
SIZE = "480,360"
# Limit for single pixels at edges: up to 0.01 % on seven profiles. A wrong convexity changes 33 % of the forearm's
# pulley.
MOST_DIFFERENT_PIXELS = 0.002
SAME_COLOUR = 40  # of 255, for each channel


@contextlib.contextmanager
def display():
    """A private X server, which chooses a free display number."""
    read_end, write_end = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(write_end), "-screen", "0", "800x600x24"], pass_fds=[write_end],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(write_end)
    try:
        with os.fdopen(read_end) as number:
            yield {**os.environ, "DISPLAY": ":" + number.readline().strip()}
    finally:
        server.terminate()
        server.wait()


def picture(scad, side, mode, scratch, environment):
    """An image of one side. `mode`: "preview" or "render"."""
    from PIL import Image

    png = scratch / f"{mode}.png"
    printed_by_openscad(scad, "--" + mode, "-o", png, "--imgsize", SIZE, "--camera", f"0,0,0,{side},100", "--viewall", "--autocenter",
                        environment=environment)
    with Image.open(png) as image:
        return image.convert("RGB")


def different_pixels(a, b):
    """Share of differing pixels among those that show the part in either image."""
    background = a.getpixel((0, 0))
    pairs = list(zip(a.getdata(), b.getdata()))
    part = sum(1 for p, q in pairs if p != background or q != background)
    different = sum(1 for p, q in pairs if max(abs(x - y) for x, y in zip(p, q)) > SAME_COLOUR)
    return different / part if part > 0.02 * len(pairs) else 1.0


def preview_difference(scad, scratch):
    """The largest share over all views, and the view."""
    with display() as environment:
        return max((different_pixels(*(picture(scad, side, mode, scratch, environment) for mode in ("preview", "render"))), side) for side in SIDES)


def preview_faults(folder, scratch):
    different, side = preview_difference(folder / "pulley.scad", scratch)
    print(f"{folder}: {100 * different:.2f} % of the part's pixels differ, turned by {side}")
    if different > MOST_DIFFERENT_PIXELS:
        yield f"the preview differs from the full render in {100 * different:.1f} % of the part's pixels, turned by {side}"


# Two plates on a stem as one polyhedron, which a line of sight enters twice.
SPOOL = """
function ring(r, z) = [for (i = [0 : 23]) [r * cos(15 * i), r * sin(15 * i), z]];
rings = [ring(10, 0), ring(10, 3), ring(4, 3), ring(4, 8), ring(10, 8), ring(10, 11)];
sides = [for (k = [0 : 4]) for (i = [0 : 23]) let (j = (i + 1) % 24, a = 24 * k, b = a + 24)
  each [[a + i, b + j, a + j], [a + i, b + i, b + j]]];
difference() {
  polyhedron([for (r = rings) each r], concat(sides, [[for (i = [0 : 23]) i], [for (i = [23 : -1 : 0]) 120 + i]])CONVEXITY);
  translate([0, 0, -1]) cylinder(d = 3, h = 20);
}
"""


def preview_self_test(_, scratch):
    for convexity, good in ((", convexity = 4", True), ("", False)):
        scad = scratch / "spool.scad"
        scad.write_text(SPOOL.replace("CONVEXITY", convexity))
        different, side = preview_difference(scad, scratch)
        print(f"spool{convexity}: {100 * different:.2f} % differ, turned by {side}")
        if (different <= MOST_DIFFERENT_PIXELS) != good:
            yield f"a spool {'with' if good else 'without'} convexity was {'refused' if good else 'accepted'}"


# The Customizer ------------------------------------------------------------------------------------------------------

def customizer(scad):
    """(name, value, text behind it, text above it) of each parameter."""
    lines = scad.read_text().split("/* [Hidden] */")[0].splitlines()
    for above, line in zip(lines, lines[1:]):
        match = re.match(r"(\w+) = (.*?);(?: // (.*))?$", line)
        if match:
            yield *match.groups(), above[3:] if above.startswith("// ") else ""


def choices(value, behind):
    """Parameter values of the Customizer to test; ValueError if it offers none."""
    if value in ("true", "false"):
        return ["true", "false"]
    if value.startswith('"'):
        names = [f'"{name.strip()}"' for name in (behind or "").strip("[]").split(",")]
        if value not in names:
            raise ValueError("its value is none of its list")
        return names
    match = re.fullmatch(r"\[([-0-9.]+):([0-9.]+):([0-9.]+)\]", behind or "")
    if not match:
        raise ValueError("has no range")
    low, step, high = map(float, match.groups())
    steps = (float(value) - low) / step
    if not low <= float(value) <= high or abs(steps - round(steps)) > 1e-6:
        raise ValueError(f"{value} is no place of its slider {behind}, which would move it")
    middle = low + step * round((high - low) / 2 / step)
    return [f"{x:.6g}" for x in (low, middle, high)]


def customizer_faults(folder, scratch):
    scad = folder / "pulley.scad"
    renders = []  # parameter and value
    for name, value, behind, words in customizer(scad):
        if not words:
            yield f"{name} has no description"
        try:
            renders += [(name, choice) for choice in choices(value, behind) if choice != value]
        except ValueError as fault:
            yield f"{name}: {fault}"
    print(f"{folder}: {len(renders)} renders")

    def complaint(number):
        name, choice = renders[number]
        try:
            printed_by_openscad(scad, "-o", scratch / f"{number}.off", f"-D{name}={choice}")
        except ValueError as fault:
            return f"{name} = {choice}: {fault}"
        return None

    with concurrent.futures.ThreadPoolExecutor(max_workers=2) as pool:
        yield from filter(None, pool.map(complaint, range(len(renders))))


# ---------------------------------------------------------------------------------------------------------------------

FAULTS = {"part": part_faults, "preview": preview_faults, "customizer": customizer_faults}
SELF_TESTS = {"part": part_self_test, "preview": preview_self_test}


def missing_program(aspect):
    if not shutil.which("openscad"):
        return "openscad"
    if aspect == "preview":
        if not shutil.which("Xvfb"):
            return "Xvfb"
        try:
            import PIL  # noqa: F401
        except ImportError:
            return "python3-pil"
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("aspect", choices=FAULTS)
    parser.add_argument("folder", nargs="?", type=pathlib.Path)
    parser.add_argument("--self-test", action="store_true")
    arguments = parser.parse_args()
    needs_folder = not arguments.self_test or arguments.aspect == "part"
    if (arguments.folder is None) == needs_folder or (arguments.self_test and arguments.aspect == "customizer"):
        parser.error("a folder, or preview --self-test, or part FOLDER --self-test")
    if program := missing_program(arguments.aspect):
        print(f"{program} is not installed")
        return SKIPPED
    found = []
    with tempfile.TemporaryDirectory() as scratch:
        try:
            judge = (SELF_TESTS if arguments.self_test else FAULTS)[arguments.aspect]
            for fault in judge(arguments.folder, pathlib.Path(scratch)):
                found.append(fault)
        except (ValueError, OSError, subprocess.TimeoutExpired) as error:
            found.append(error)
    for fault in found:
        print(f"{arguments.folder or 'self-test'}: {fault}")
    return 1 if found else 0


sys.exit(main())

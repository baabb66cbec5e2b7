"""FreeCAD as a judge of pulley.step: it must open as one valid solid, in mm, with the box, the volume and the
groove sections of pulley.stl. A face of P1 and one of P2 have their names and colours.

    judge_step.py FOLDER [--self-test]   what `fusee build --step` wrote; --self-test: the judge must detect a broken file

Exit 0: no faults; 1: faults, on stdout; 77: FreeCAD is not installed, or this fusee cannot write the file."""
import json
import math
import pathlib
import re
import struct
import sys
import tempfile

SKIPPED = 77
FREECAD_FOLDERS = ["/usr/lib/freecad-python3/lib", "/usr/lib/freecad/lib"]
SAGITTA = 0.004  # mm, of the triangles that FreeCAD makes of the faces
SAGITTA_OF_TURNS = 0.012  # mm, for several turns: with 0.004 mm FreeCAD would take minutes for the floors of helical grooves
NEAR = 0.02  # mm: two tolerances of the mesh
LEAST_COLOURS = 2  # of P1 and P2; a hub has a third


def triangles_of_stl(path):
    data = path.read_bytes()
    (count,) = struct.unpack_from("<I", data, 80)
    for k in range(count):
        numbers = struct.unpack_from("<9f", data, 84 + 50 * k + 12)
        yield numbers[0:3], numbers[3:6], numbers[6:9]


def triangles_of_shape(shape, sagitta):
    points, facets = shape.tessellate(sagitta)
    points = [(p.x, p.y, p.z) for p in points]
    for a, b, c in facets:
        yield points[a], points[b], points[c]


def volume_of(triangles):
    return sum(a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
               for a, b, c in triangles) / 6


def area_of(triangles):
    def twice_area(a, b, c):
        u, v = [b[k] - a[k] for k in range(3)], [c[k] - a[k] for k in range(3)]
        return math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    return sum(twice_area(*t) for t in triangles) / 2


def section_area(triangles, z):
    """Area of the solid's section at height z: the sum of x dy − y dx over the segments in which the plane cuts the facets, halved."""
    total = 0.0
    for t in triangles:
        above = [p[2] > z for p in t]
        if sum(above) in (0, 3):
            continue
        alone = above.index(sum(above) == 1)  # the corner that is alone on its side of the plane
        ends = []
        for step in (1, 2):
            p, q = t[alone], t[(alone + step) % 3]
            share = (p[2] - z) / (p[2] - q[2])
            ends.append((p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1])))
        (x0, y0), (x1, y1) = ends
        total += (x0 * y1 - x1 * y0) * (-0.5 if above[alone] else 0.5)
    return abs(total)


def faults_of(step, folder, part_module):
    shape = part_module.Shape()
    try:
        shape.read(str(step))
    except Exception as error:  # FreeCAD's exception types are not importable
        yield f"FreeCAD does not read it: {error}"
        return
    if len(shape.Solids) != 1:
        yield f"{len(shape.Solids)} solids"
        return
    mesh = list(triangles_of_stl(folder / "pulley.stl"))
    # Checked before triangulation, which would never end for a part in metres.
    size = max(max(abs(x) for x in t[0]) for t in mesh)
    if abs(shape.BoundBox.DiagonalLength) > 10 * size:
        yield f"it is {shape.BoundBox.DiagonalLength:.0f} mm large"
        return
    if not shape.isValid():
        yield "FreeCAD finds it invalid"
    if not shape.isClosed():
        yield "it is not closed"
    is_helical = not (folder / "plates.dxf").exists()
    facets = list(triangles_of_shape(shape, SAGITTA_OF_TURNS if is_helical else SAGITTA))
    surface = area_of(mesh)
    difference = abs(volume_of(facets) - volume_of(mesh))
    # A print's holes are circumscribed polygons, and circles in CAD.
    if difference > NEAR * surface:
        yield f"its volume is {difference:.1f} mm3 off that of pulley.stl"
    for k, name in enumerate("xyz"):
        for extreme, words in ((max, "most"), (min, "least")):
            a, b = (extreme(p[k] for t in triangles for p in t) for triangles in (mesh, facets))
            if abs(a - b) > NEAR:
                yield f"its {words} {name} is {b:.3f} mm, and {a:.3f} in pulley.stl"
    manifest = json.loads((folder / "manifest.json").read_text())
    for groove in manifest["grooves"]:
        # Just above the groove's middle: a plane through a ring of corners would have no clear side.
        a, b = (section_area(triangles, groove["z_mm"] + 1e-6) for triangles in (mesh, facets))
        if abs(a - b) > 0.005 * a:
            yield f"at groove {groove['pulley']} its section has {b:.2f} mm2, and {a:.2f} in pulley.stl"
    text = step.read_text()
    for name in ("P1", "P2"):
        if f"ADVANCED_FACE('{name}'" not in text:
            yield f"no face is named {name}"
    if len(re.findall(r"COLOUR_RGB\(", text)) < LEAST_COLOURS:
        yield "its faces have no colours"
    if "AUTOMOTIVE_DESIGN" not in text:
        yield "it is not AP214"


def without_a_face(text):
    """The shell without one face, as an exporter makes it if two faces do not share an edge."""
    return re.sub(r"(CLOSED_SHELL\('[^']*',\()#\d+,", r"\1", text, count=1)


def in_metres(text):
    return text.replace(".MILLI.", "$", 1)


def self_test(folder, part_module):
    right = (folder / "pulley.step").read_text()
    with tempfile.TemporaryDirectory() as scratch:
        for what, wrong in (("a face that is missing", without_a_face(right)), ("metres", in_metres(right)),
                            ("no names", right.replace("'P1'", "''"))):
            broken = pathlib.Path(scratch) / "broken.step"
            broken.write_text(wrong)
            if wrong == right:
                yield f"the self-test did not make {what}"
            elif not list(faults_of(broken, folder, part_module)):
                yield f"{what} was not seen"


def main():
    folder = pathlib.Path(sys.argv[1])
    if not (folder / "pulley.step").exists():
        print("there is no pulley.step: this fusee was built without")
        return SKIPPED
    sys.path += [place for place in FREECAD_FOLDERS if pathlib.Path(place).is_dir()]
    try:
        import FreeCAD  # noqa: F401  must be imported before its modules
        import Part
    except ImportError as error:
        print("FreeCAD is not installed:", error)
        return SKIPPED
    judge = self_test(folder, Part) if "--self-test" in sys.argv else faults_of(folder / "pulley.step", folder, Part)
    faults = list(judge)
    print(*faults, sep="\n")
    return 1 if faults else 0


sys.exit(main())

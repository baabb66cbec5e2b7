"""ezdxf as a judge: each DXF must load and pass its audit without errors or repairs, in mm, with closed contours only on cut layers.

Round features must be exact: bores, dowel holes, knot pockets and screw holes are circles, and the round part of D and keyway bores is one arc
about the axis. Centres and diameters are compared with pulley.scad and the manifest. Pitch curves are circles or arcs, compared with profile.csv.

Usage: judge_dxf.py FILE.dxf   any drawing; judge_dxf.py FOLDER   with profile.dxf, plates.dxf, pulley.scad, manifest.json; or
judge_dxf.py FOLDER --self-test: the judge must detect a polygon in place of a circle, a wrong diameter and a shifted centre.
Prints the faults; exit 1 if there are any, 77 without ezdxf."""
import argparse
import csv
import json
import math
import pathlib
import re
import sys

try:
    import ezdxf
    from ezdxf.math import Vec2, bulge_center, bulge_radius, is_point_in_polygon_2d
except ImportError:
    print("ezdxf is not installed")
    sys.exit(77)

CONTOURS = {"P1_PITCH", "P2_PITCH", "P1_FLOOR", "P2_FLOOR", "BORE", "CUT_OUTER", "CUT_INNER", "CHECK_10MM", "SHEET"}
NEAR = 2e-5  # mm: pulley.scad has five decimals


def is_closed(entity):
    if entity.dxftype() == "CIRCLE":
        return True
    return entity.closed if entity.dxftype() == "LWPOLYLINE" else entity.is_closed


def drawing_faults(document):
    audit = document.audit()
    yield from (f"error: {e.message}" for e in audit.errors)
    yield from (f"had to be mended: {f.message}" for f in audit.fixes)
    if document.header.get("$INSUNITS") != 4:
        yield "$INSUNITS is not 4 (mm)"
    layers = {layer.dxf.name for layer in document.layers}
    entities = list(document.modelspace())
    if not entities:
        yield "is empty"
    for entity in entities:
        if entity.dxf.layer not in layers:
            yield f"names layer {entity.dxf.layer}, which it does not hold"
        if entity.dxftype() not in ("LWPOLYLINE", "POLYLINE", "CIRCLE"):
            yield f"holds a {entity.dxftype()}"
        elif entity.dxf.layer in CONTOURS and not is_closed(entity):
            yield f"has an open contour on {entity.dxf.layer}"


# Round features ------------------------------------------------------------------------------------------------------

def vertices(entity):
    """The vertices of a polyline: (point, bulge). The bulge is the tangent of a quarter of the arc's angle."""
    if entity.dxftype() == "LWPOLYLINE":
        return [(Vec2(x, y), bulge) for x, y, bulge in entity.get_points("xyb")]
    return [(Vec2(v.dxf.location), v.dxf.bulge) for v in entity.vertices]


class Expected:
    """The holes of pulley.scad, without compensation for printing."""

    def __init__(self, folder):
        text = (folder / "pulley.scad").read_text()
        mechanism = json.loads((folder / "manifest.json").read_text())["mechanism"]

        def value(name):
            return json.loads(re.search(rf"^{name} = (.*?);", text, re.M).group(1))

        self.shape = value("bore_shape")
        self.bore = value("bore")
        # The highest straight edge above the axis, mm: the flat, or the ground of the key.
        self.top = 0.0
        if self.shape == "d":
            self.top = value("bore_flat") - self.bore / 2
        elif self.shape == "keyway":
            self.top = self.bore / 2 + value("key_depth")
        self.key_width = value("key_width") if self.shape == "keyway" else 0
        self.screws = [(Vec2(x, y), d) for x, y, d in value("horn_holes")]
        self.tie_offs = [Vec2(*map(float, pair)) for pair in re.findall(r"^\s*\[[12], \[([-0-9.]+), ([-0-9.]+)\]", text, re.M)]
        self.kerf = mechanism["cut"]["kerf_mm"]

    def bore_faults(self, entity, axis, kerf):
        """The bore, drawn smaller by `kerf`."""
        if self.shape in ("round", "horn"):
            if entity.dxftype() != "CIRCLE":
                yield f"draws the bore as a {entity.dxftype()}"
            elif abs(2 * entity.dxf.radius - (self.bore - kerf)) > NEAR or Vec2(entity.dxf.center).distance(axis) > NEAR:
                yield f"has a bore of {2 * entity.dxf.radius} mm about {entity.dxf.center}, expected {self.bore - kerf} about {axis}"
            return
        corners = {"hex": 6, "square": 4, "d": 2, "keyway": 4}[self.shape]
        points = vertices(entity)
        if len(points) != corners:
            yield f"draws the {self.shape} bore with {len(points)} corners, expected {corners}"
        arcs = [k for k, (_, bulge) in enumerate(points) if bulge != 0]
        if len(arcs) != (1 if self.shape in ("d", "keyway") else 0):
            yield f"draws the {self.shape} bore with {len(arcs)} arcs"
        for k in arcs:
            (start, bulge), (end, _) = points[k], points[(k + 1) % len(points)]
            centre, radius = bulge_center(start, end, bulge), bulge_radius(start, end, bulge)
            if centre.distance(axis) > NEAR or abs(2 * radius - (self.bore - kerf)) > NEAR:
                yield f"has an arc of {2 * radius} mm about {centre}, expected {self.bore - kerf} about {axis}"
        highest = max(place.y for place, _ in points) - axis.y
        if self.shape in ("d", "keyway") and abs(highest - (self.top - kerf / 2)) > NEAR:
            yield f"has the flat or the key's ground at {highest} mm, expected {self.top - kerf / 2}"
        width = max(place.x for place, _ in points[-2:]) - min(place.x for place, _ in points[-2:])
        if self.shape == "keyway" and abs(width - (self.key_width - kerf)) > NEAR:
            yield f"has a keyway of {width} mm, expected {self.key_width - kerf}"


def circle_of(entity):
    return Vec2(entity.dxf.center), 2 * entity.dxf.radius


def same(a, b):
    return a[0].distance(b[0]) <= NEAR and abs(a[1] - b[1]) <= NEAR


def without(circles, expected):
    """`circles` without the expected ones, and the expected ones that are missing."""
    missing = [e for e in expected if not any(same(c, e) for c in circles)]
    return [c for c in circles if not any(same(c, e) for e in expected)], missing


def profile_faults(document, expected):
    bores = document.modelspace().query('*[layer=="BORE"]')
    yield from expected.bore_faults(bores[0], Vec2(0, 0), 0)
    screws = [circle_of(e) for e in bores[1:] if e.dxftype() == "CIRCLE"]
    unexpected, missing = without(screws, expected.screws)
    if unexpected or missing or len(screws) != len(bores) - 1:
        yield f"has {len(bores) - 1} further holes, {len(unexpected)} of them unexpected, {len(missing)} missing"


def distance_to_curve(point, entity):
    """Distance of a point from a circle, or from the nearest segment of a closed polyline of arcs."""
    if entity.dxftype() == "CIRCLE":
        return abs(point.distance(Vec2(entity.dxf.center)) - entity.dxf.radius)
    corners = vertices(entity)
    nearest = math.inf
    for k, (start, bulge) in enumerate(corners):
        end = corners[(k + 1) % len(corners)][0]
        # Far from the segment: a point on a flat arc is at most half a chord from the chord's middle.
        if point.distance((start + end) / 2) > 0.51 * start.distance(end) + 1e-3:
            continue
        if bulge == 0:
            nearest = min(nearest, abs((end - start).normalize().det(point - start)))
        else:
            nearest = min(nearest, abs(point.distance(bulge_center(start, end, bulge)) - bulge_radius(start, end, bulge)))
    return nearest


def curve_faults(document, folder):
    """Compares the pitch curves with profile.csv: within 0.0005 mm, and with far fewer segments than points."""
    with open(folder / "profile.csv") as table:
        rows = list(csv.DictReader(table))
    for pulley in ("P1", "P2"):
        points = [Vec2(float(row["x_mm"]), float(row["y_mm"])) for row in rows if row["pulley"] == pulley]
        for entity in document.modelspace().query(f'*[layer=="{pulley}_PITCH"]'):
            worst = max(distance_to_curve(point, entity) for point in points)
            if worst > 0.0005 + NEAR:
                yield f"draws {pulley}_PITCH {worst} mm off profile.csv"
            if entity.dxftype() != "CIRCLE" and 2 * len(vertices(entity)) > len(points):
                yield f"draws {pulley}_PITCH in {len(vertices(entity))} pieces"
            radii = [point.magnitude for point in points]
            if max(radii) - min(radii) < 1e-5 and entity.dxftype() != "CIRCLE":
                yield f"draws a round {pulley} as a {entity.dxftype()}"


def pocket_diameters(document):
    return [circle_of(e) for e in document.modelspace().query('CIRCLE[layer=="MARK_ANCHOR"]')]


def plates_faults(document, expected, pockets):
    kerf = expected.kerf
    space = document.modelspace()
    holes = list(space.query('*[layer=="CUT_INNER"]'))
    common = None  # dowel holes of the first plate, which every plate must have
    for outer in space.query('*[layer=="CUT_OUTER"]'):
        outline = [place for place, _ in vertices(outer)]
        inside = [e for e in holes if is_point_in_polygon_2d(circle_of(e)[0] if e.dxftype() == "CIRCLE" else vertices(e)[0][0], outline) > 0]
        if not inside:
            yield "has a plate without a bore"
            continue
        bore = inside[0]  # fusee draws it first
        if bore.dxftype() == "CIRCLE":
            axis = circle_of(bore)[0]
        else:
            points = vertices(bore)
            axis = (bulge_center(points[0][0], points[1][0], points[0][1]) if points[0][1]
                    else Vec2(sum(p.x for p, _ in points), sum(p.y for p, _ in points)) / len(points))
        yield from expected.bore_faults(bore, axis, kerf)
        polygons = [e for e in inside[1:] if e.dxftype() != "CIRCLE"]
        if polygons:
            yield f"has {len(polygons)} holes that are no circles"
        circles = [(centre - axis, d + kerf) for centre, d in (circle_of(e) for e in inside[1:] if e.dxftype() == "CIRCLE")]
        others, missing = without(circles, expected.screws)
        if missing:
            yield f"lacks {len(missing)} of the horn's holes"
        dowels, _ = without(others, [p for p in pockets if any(p[0].distance(t) <= NEAR for t in expected.tie_offs)])
        common = dowels if common is None else common
        if len(dowels) not in (0, 2) or any(without(dowels, common)):
            yield f"has dowel holes {dowels} in one plate and {common} in another"


def round_faults(profile, plates, expected):
    yield from (f"profile.dxf: {fault}" for fault in profile_faults(profile, expected))
    yield from (f"plates.dxf: {fault}" for fault in plates_faults(plates, expected, pocket_diameters(profile)))


# ---------------------------------------------------------------------------------------------------------------------

def read(folder):
    return [ezdxf.readfile(folder / name) for name in ("profile.dxf", "plates.dxf")]


def faults(folder):
    if folder.suffix == ".dxf":
        yield from drawing_faults(ezdxf.readfile(folder))
        return
    profile, plates = read(folder)
    for name, document in (("profile.dxf", profile), ("plates.dxf", plates)):
        yield from (f"{name}: {fault}" for fault in drawing_faults(document))
    yield from round_faults(profile, plates, Expected(folder))
    yield from (f"profile.dxf: {fault}" for fault in curve_faults(profile, folder))


def as_polygon(document, circle):
    centre, diameter = circle_of(circle)
    corners = [(centre + Vec2.from_angle(2 * math.pi * k / 24, diameter / 2)) for k in range(24)]
    if document.dxfversion == "AC1009":
        return document.modelspace().add_polyline2d(corners, close=True, dxfattribs={"layer": circle.dxf.layer})
    return document.modelspace().add_lwpolyline(corners, close=True, dxfattribs={"layer": circle.dxf.layer})


def self_test(folder):
    expected = Expected(folder)

    def polygon(document, circle):
        as_polygon(document, circle)
        document.modelspace().delete_entity(circle)

    def wider(_, circle):
        circle.dxf.radius += 0.01

    def shifted(_, circle):
        circle.dxf.center += (0.01, 0, 0)

    for spoil in (polygon, wider, shifted):
        for drawing, layer in ((0, "BORE"), (1, "CUT_INNER")):
            documents = read(folder)
            # The last circle: holes are measured from the one around the axis.
            spoil(documents[drawing], list(documents[drawing].modelspace().query(f'CIRCLE[layer=="{layer}"]'))[-1])
            if not list(round_faults(*documents, expected)):
                yield f"the judge accepts a {spoil.__name__} circle on {layer}"
    profile, _ = read(folder)
    for entity in list(profile.modelspace().query('CIRCLE[layer=="P1_PITCH"]')):
        polygon(profile, entity)
        if not list(curve_faults(profile, folder)):
            yield "the judge accepts a round P1 as a polygon"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--self-test", action="store_true")
    arguments = parser.parse_args()
    found = list((self_test if arguments.self_test else faults)(arguments.folder))
    for fault in found:
        print(f"{arguments.folder}: {fault}")
    return 1 if found else 0


sys.exit(main())

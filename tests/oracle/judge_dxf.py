"""ezdxf as a judge: each DXF must load and audit with no error and nothing to mend, hold only closed polylines where something is cut,
in mm. Usage: judge_dxf.py FILE.dxf ...   Prints what is wrong; exit 1 when anything is,
77 without ezdxf."""
import sys

try:
    import ezdxf
except ImportError:
    print("ezdxf is not installed")
    sys.exit(77)

CONTOURS = {"P1_PITCH", "P2_PITCH", "P1_FLOOR", "P2_FLOOR", "BORE", "CUT_OUTER", "CUT_INNER", "CHECK_10MM", "SHEET"}


def faults(path):
    document = ezdxf.readfile(path)
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
        if entity.dxftype() not in ("LWPOLYLINE", "POLYLINE"):
            yield f"holds a {entity.dxftype()}"
        if entity.dxf.layer not in layers:
            yield f"names layer {entity.dxf.layer}, which it does not hold"
        closed = entity.closed if entity.dxftype() == "LWPOLYLINE" else entity.is_closed
        if entity.dxf.layer in CONTOURS and not closed:
            yield f"has an open contour on {entity.dxf.layer}"


def main():
    wrong = 0
    for path in sys.argv[1:]:
        for fault in faults(path):
            print(f"{path}: {fault}")
            wrong += 1
    print(f"{len(sys.argv) - 1} drawings, {wrong} faults")
    return 1 if wrong or len(sys.argv) < 2 else 0


sys.exit(main())

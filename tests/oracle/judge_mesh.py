#!/usr/bin/env python3
"""Independent programs judge a mesh of fusee.

    judge_mesh.py admesh pulley.stl
    judge_mesh.py prusa-slicer pulley.3mf --like .
    judge_mesh.py openscad pulley.stl
    judge_mesh.py draco pulley.drc --like pulley.stl
    judge_mesh.py assimp pulley.obj --like pulley.stl
    judge_mesh.py admesh --self-test       the judge must reject broken meshes

Exit 0: no faults; 1: faults, on stdout; 77: the program is not installed.

The exit codes of these programs do not depend on the mesh, and they repair meshes silently, so their output is read. Each has a time
limit, since admesh can loop for ever.
"""

import argparse
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
TIME_LIMIT_S = 300


class NotInstalled(Exception):
    pass


def printed_by(program, *arguments):
    """The output of `program`, or a fault if it does not end in time."""
    path = shutil.which(program)
    if path is None:
        raise NotInstalled(program)
    try:
        run = subprocess.run([path, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                             timeout=TIME_LIMIT_S, check=False)
    except subprocess.TimeoutExpired:
        return f"ERROR: {program} did not end within {TIME_LIMIT_S} s"
    return run.stdout.decode("utf-8", "replace")


def facets_of(stl):
    """Number of facets in the header of a binary STL."""
    with open(stl, "rb") as file:
        return struct.unpack("<I", file.read(84)[80:])[0]


def files_to_print(folder):
    """The part files for the printer, from the manifest."""
    manifest = json.loads(pathlib.Path(folder, "manifest.json").read_text(encoding="utf-8"))
    return [pathlib.Path(folder, part["file"]) for part in manifest["print"]]


# The judges: each returns a list of faults --------------------------------------------------------------------------

def judge_by_admesh(mesh, like=None):
    text = printed_by("admesh", mesh)
    if "Results produced by ADMesh" not in text:
        return ["admesh gave no results: " + text.strip()[-300:]]
    faults = []
    for label in ("Total disconnected facets", "Degenerate facets", "Edges fixed", "Facets removed", "Facets added",
                 "Facets reversed", "Backwards edges", "Normals fixed"):
        count = int(re.search(re.escape(label) + r"\s*:\s*(\d+)", text)[1])
        if count:
            faults.append(f"admesh: {label}: {count}")
    volume = float(re.search(r"Volume\s*:\s*(\S+)", text)[1])
    if "volume is negative" in text or not volume > 0:
        faults.append(f"admesh: the volume is {volume} mm³ or was negative")
    facets = int(re.search(r"Number of facets\s*:\s*(\d+)", text)[1])
    return faults + differing_facets("admesh", facets, like)


def differing_facets(program, facets, like):
    """`like`: STL files that together have as many triangles."""
    if like is None:
        return []
    stls = [like] if isinstance(like, (str, os.PathLike)) else like
    expected = sum(facets_of(stl) for stl in stls)
    return [] if facets == expected else [f"{program}: {facets} facets, expected {expected} as in {', '.join(map(str, stls))}"]


def judge_by_prusa_slicer(mesh, like=None):
    text = printed_by("prusa-slicer", "--info", mesh)
    values = dict(re.findall(r"^(\w+)\s*=\s*(\S+)$", text, re.MULTILINE))
    if "manifold" not in values:
        return ["prusa-slicer gave no results: " + text.strip()[-300:]]
    faults = [] if values["manifold"] == "yes" else ["prusa-slicer: manifold = " + values["manifold"]]
    # It prints these lines only after a repair.
    for name, value in values.items():
        if name.startswith("facets_") or name in ("open_edges", "edges_fixed", "degenerate_facets", "backwards_edges"):
            faults.append(f"prusa-slicer: {name} = {value}")
    if not float(values["volume"]) > 0:
        faults.append("prusa-slicer: volume = " + values["volume"])
    return faults + differing_facets("prusa-slicer", int(values["number_of_facets"]), like)


def judge_by_openscad(mesh, like=None):
    """It checks a mesh only within a boolean operation."""
    with tempfile.TemporaryDirectory() as folder:
        program = pathlib.Path(folder, "judge.scad")
        path = str(pathlib.Path(mesh).resolve()).replace("\\", "\\\\").replace('"', '\\"')
        program.write_text(f'intersection() {{ import("{path}"); cube(500, center = true); }}\n')
        text = printed_by("openscad", "-o", pathlib.Path(folder, "judge.off"), program)
    faults = ["openscad: " + line for line in text.splitlines() if "ERROR" in line or "WARNING" in line]
    if not re.search(r"Simple:\s*yes", text):
        faults.append("openscad: expected 'Simple: yes', a 2-manifold solid")
    return faults


def judge_converted(convert, mesh, like):
    """Lets a program convert `mesh` to an STL, which admesh checks."""
    with tempfile.TemporaryDirectory() as folder:
        converted = pathlib.Path(folder, "converted.stl")
        text = convert(converted)
        if not converted.exists():
            return [f"no STL came of {mesh}: " + text.strip()[-300:]]
        return judge_by_admesh(converted, like)


def judge_by_draco(mesh, like=None):
    return judge_converted(lambda stl: printed_by("draco_decoder", "-i", mesh, "-o", stl), mesh, like)


def judge_by_assimp(mesh, like=None):
    return judge_converted(lambda stl: printed_by("assimp", "export", mesh, stl, "-fstlb"), mesh, like)


JUDGES = {"admesh": judge_by_admesh, "prusa-slicer": judge_by_prusa_slicer, "openscad": judge_by_openscad,
          "draco": judge_by_draco, "assimp": judge_by_assimp}


# Self-test: the judge must be able to fail ----------------------------------------------------------------------

def torus(around=16, across=8):
    vertices = []
    faces = []
    for i in range(around):
        for j in range(across):
            u, v = 2 * math.pi * i / around, 2 * math.pi * j / across
            r = 20 + 6 * math.cos(v)
            vertices.append((r * math.cos(u), r * math.sin(u), 6 * math.sin(v)))

    def at(i, j):
        return i % around * across + j % across

    for i in range(around):
        for j in range(across):
            faces.append((at(i, j), at(i + 1, j), at(i + 1, j + 1)))
            faces.append((at(i, j), at(i + 1, j + 1), at(i, j + 1)))
    return vertices, faces


def normal(a, b, c):
    u = [b[k] - a[k] for k in range(3)]
    v = [c[k] - a[k] for k in range(3)]
    n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    length = math.hypot(*n)
    return [x / length for x in n]


def write_stl(path, vertices, faces):
    with open(path, "wb") as file:
        file.write(b"self-test of a judge".ljust(80) + struct.pack("<I", len(faces)))
        for face in faces:
            corners = [vertices[i] for i in face]
            file.write(struct.pack("<12fH", *normal(*corners), *(x for corner in corners for x in corner), 0))


def write_obj(path, vertices, faces):
    with open(path, "w", encoding="ascii") as file:
        file.writelines(f"v {x} {y} {z}\n" for x, y, z in vertices)
        file.writelines(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in faces)


def write_drc(path, vertices, faces):
    obj = path.with_suffix(".obj")
    write_obj(obj, vertices, faces)
    printed_by("draco_encoder", "-i", obj, "-o", path)


WRITERS = {"admesh": write_stl, "prusa-slicer": write_stl, "openscad": write_stl, "draco": write_drc, "assimp": write_obj}

BREAKS = {
    "a missing facet": lambda faces: faces[1:],
    "a flipped facet": lambda faces: [faces[0][::-1]] + faces[1:],
    "an inverted mesh": lambda faces: [face[::-1] for face in faces],
    "a duplicate facet": lambda faces: faces + faces[:1],
}
# None of these programs detects a mesh that crosses itself; fusee's own check does.
UNDETECTED = {"openscad": ["an inverted mesh", "a duplicate facet"]}


def self_test(judge):
    """Faults of the judge itself."""
    vertices, faces = torus()
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        ending = {"draco": ".drc", "assimp": ".obj"}.get(judge, ".stl")

        def verdict(name, broken):
            path = pathlib.Path(folder, name.replace(" ", "_") + ending)
            WRITERS[judge](path, vertices, broken)
            return JUDGES[judge](path)

        complaints = verdict("a good mesh", faces)
        if complaints:
            faults.append(f"{judge} rejects a good mesh: {complaints}")
        for name, break_it in BREAKS.items():
            if name not in UNDETECTED.get(judge, []) and not verdict(name, break_it(faces)):
                faults.append(f"{judge} accepts {name}")
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("judge", choices=JUDGES)
    parser.add_argument("mesh", nargs="?")
    parser.add_argument("--like", metavar="STL", help="a binary STL with as many facets, or the folder of a build: all that it prints")
    parser.add_argument("--self-test", action="store_true")
    arguments = parser.parse_args()
    if (arguments.mesh is None) != arguments.self_test:
        parser.error("either a mesh or --self-test")
    if arguments.like is not None and os.path.isdir(arguments.like):
        arguments.like = files_to_print(arguments.like)
    try:
        faults = self_test(arguments.judge) if arguments.self_test else JUDGES[arguments.judge](arguments.mesh, arguments.like)
    except NotInstalled as program:
        print(f"{program} is not installed")
        return SKIPPED
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

"""MuJoCo and urdfdom as judges of the files of `fusee model`.

    judge_model.py mujoco FOLDER --law transmission.csv   MuJoCo loads joint.xml and joint_tendons.xml and drives the motor over the
                                                          range in both directions: θ(α) must be that of `fusee build` within the
                                                          error that the file states, and both tendons must have the lengths of
                                                          strings round their pins
    judge_model.py urdf FOLDER                            check_urdf reads joint.urdf and joint_ros2_control.urdf; the keys of
                                                          ros2_control must be where its parser reads them
    either with --self-test                               the judge must detect a wrong file

Exit 0: no faults; 1: faults, on stdout; 77: the judge is not installed."""
import argparse
import csv
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET

HERE = pathlib.Path(__file__).resolve().parent
# Added to the stated error: MuJoCo's constraints are slightly compliant, and the law is interpolated between rows.
TOLERANCE_DEG = 0.001


def not_installed(what):
    print(f"{what} is not installed")
    sys.exit(77)


def mujoco_library():
    """The pinned version, installed by .ci/setup."""
    if not shutil.which("node"):
        not_installed("node")
    library = pathlib.Path.home() / ".cache/fusee-judges/node_modules/@mujoco/mujoco/mujoco.js"
    if library.is_file():
        return library
    not_installed("MuJoCo (npm @mujoco/mujoco, see .ci/setup)")


def law_of(path):
    """θ(α) in degrees, interpolated by cubics through four rows of transmission.csv."""
    with open(path, newline="") as file:
        rows = [(float(row["alpha_deg"]), float(row["theta_deg"])) for row in csv.DictReader(file)]

    def theta(alpha):
        i = min(max(sum(row[0] < alpha for row in rows) - 2, 0), len(rows) - 4)
        four = rows[i:i + 4]
        return sum(y * math.prod((alpha - other) / (x - other) for other, _ in four if other != x) for x, y in four)

    return theta, rows[0][0], rows[-1][0]


def stated_error(text):
    """The error that the file's comment states, deg."""
    return float(re.search(r"misses theta\(alpha\)\s+by ([0-9.e+-]+) deg at most", text).group(1))


def follow(library, path):
    """The motion in MuJoCo. Each of its rows: time, s; commanded α, α and θ, rad; lengths of the tendons, m."""
    script = subprocess.run(["node", HERE / "follow_model.mjs", library, path], capture_output=True, text=True)
    if script.returncode != 0:
        raise SystemExit(f"{path.name}: MuJoCo does not take it: {script.stderr.strip()[-2000:]}")
    return json.loads(script.stdout)


def taut_length(a, b, cylinder):
    """Length of the path from a over the outer side of a cylinder to b: two tangents and an arc. `cylinder`: its centre, its radius and a
    point beside it, on the side where the tendon passes."""
    x, y, rho, beside = cylinder
    side = math.copysign(1, (b[0] - a[0]) * (beside[1] - y) - (b[1] - a[1]) * (beside[0] - x))

    def tangent(px, py, turn):
        """Direction of the tangent point from the centre, and length of the tangent."""
        distance = math.hypot(px - x, py - y)
        return math.atan2(py - y, px - x) + turn * math.acos(min(1, rho / distance)), math.sqrt(distance**2 - rho**2)

    first_angle, first_length = tangent(*a, -side)
    last_angle, last_length = tangent(*b, side)
    arc = (side * (first_angle - last_angle)) % (2 * math.pi)
    # An arc of almost a whole turn is a slightly negative one: the path does not touch the cylinder.
    return first_length + last_length + rho * (arc if arc < 1.9 * math.pi else 0)


def path_faults(path, motion):
    """Compares tendon lengths with a taut string from site to site, around the geometry in between."""
    root = ET.parse(path).getroot()
    position = lambda node: [float(x) for x in node.get("pos").split()][:2]
    link = next(body for body in root.iter("body") if body.get("name") == "link")

    def at(kind, name, theta):
        """In the world's frame, or rotated with the link, which turns clockwise."""
        own = next((node for node in link.findall(kind) if node.get("name") == name), None)
        if own is None:
            return position(next(node for node in root.find("worldbody").findall(kind) if node.get("name") == name))
        x, y = position(own)
        return [x * math.cos(theta) + y * math.sin(theta), y * math.cos(theta) - x * math.sin(theta)]

    for i, tendon in enumerate(root.find("tendon").findall("spatial")):
        def length(theta):
            total, last, geom = 0.0, None, None
            for step in tendon:
                if step.tag == "geom":
                    geom = step
                    continue
                here = at("site", step.get("site"), theta)
                if geom is not None:
                    cylinder = next(g for g in root.iter("geom") if g.get("name") == geom.get("geom"))
                    around = (*at("geom", geom.get("geom"), theta), float(cylinder.get("size").split()[0]), at("site", geom.get("sidesite"), theta))
                    total += taut_length(last, here, around)
                elif last is not None:
                    total += math.dist(last, here)
                last, geom = here, None
            return total

        worst = max(abs(row[4 + i] - length(row[3])) for row in motion["rows"])
        if worst > 1e-8:  # m
            yield f"{tendon.get('name')} is {worst * 1e3:.2g} mm from a string round what it is wrapped on"


def following_faults(library, path, law, low, high):
    text = path.read_text()
    limit = stated_error(text) + TOLERANCE_DEG
    motion = follow(library, path)
    shown = [(math.degrees(row[2]), math.degrees(row[3])) for row in motion["rows"]]
    span = high - low
    if min(a for a, _ in shown) > low + 0.01 * span or max(a for a, _ in shown) < high - 0.01 * span:
        yield f"the motor came from {min(a for a, _ in shown):.3f} to {max(a for a, _ in shown):.3f} deg only, of {low:.3f} to {high:.3f}"
    worst = max((abs(theta - law(alpha)), alpha) for alpha, theta in shown if low <= alpha <= high)
    print(f"{path.name}: MuJoCo {motion['version']}, {len(shown)} places, off by {worst[0]:.6f} deg at most (stated: {limit - TOLERANCE_DEG:g})")
    if worst[0] > limit:
        yield f"off by {worst[0]:.6f} deg at alpha = {worst[1]:.2f}, more than the {limit:.6f} that is stated"
    if path.name == "joint_tendons.xml":
        yield from path_faults(path, motion)


def mujoco_faults(folder, law_file):
    library = mujoco_library()
    law, low, high = law_of(law_file)
    for name in ("joint.xml", "joint_tendons.xml"):
        if (folder / name).exists():
            yield from (f"{name}: {fault}" for fault in following_faults(library, folder / name, law, low, high))


def urdf_faults(folder, _):
    program = shutil.which("check_urdf") or not_installed("check_urdf (liburdfdom-tools)")
    for name in ("joint.urdf", "joint_ros2_control.urdf"):
        checked = subprocess.run([program, folder / name], capture_output=True, text=True)
        words = checked.stdout + checked.stderr
        if "Successfully Parsed XML" not in words or re.search(r"error", words, re.I):
            yield f"{name}: check_urdf says: {words.strip()}"
        if "child(1):" not in words:
            yield f"{name}: check_urdf sees no link: {words.strip()}"
    # Requirements of hardware_interface/src/component_parser.cpp in ros2_control.
    try:
        control = ET.parse(folder / "joint_ros2_control.urdf").getroot().find("ros2_control")
        assert control.get("name") and control.get("type") in ("system", "actuator", "sensor"), "ros2_control: name and type"
        assert control.find("hardware/plugin").text, "hardware: plugin"
        joints = {joint.get("name") for joint in control.findall("joint")}
        for joint in control.findall("joint"):
            assert {i.get("name") for i in joint.findall("state_interface")} == {"position", "velocity", "effort"}, "state interfaces"
        for transmission in control.findall("transmission"):
            assert transmission.get("name") and transmission.find("plugin").text == "transmission_interface/SimpleTransmission", "plugin"
            assert [a.get("role") for a in transmission.findall("actuator")] == ["actuator1"], "actuator: role"
            joint = transmission.find("joint")
            assert joint.get("role") == "joint1" and joint.get("name") in joints, "joint: role, and a name of the component's"
            assert math.isfinite(float(joint.find("mechanical_reduction").text)) and float(joint.find("mechanical_reduction").text) != 0, "reduction"
            assert math.isfinite(float(joint.find("offset").text)), "offset"
        assert control.findall("transmission"), "no transmission"
    except (AttributeError, AssertionError, TypeError, ValueError, ET.ParseError) as error:
        yield f"joint_ros2_control.urdf: ros2_control would not take it: {error!r}"


def broken_copies(judge, folder, scratch):
    """Folders with a fault that must be detected."""
    def copy(name, change):
        target = scratch / name
        shutil.copytree(folder, target)
        change(target)
        return target

    def replace(file, pattern, replacement):
        def change(target):
            text = (target / file).read_text()
            changed = re.sub(pattern, replacement, text, count=1)
            assert changed != text, f"{file}: nothing to change"
            (target / file).write_text(changed)
        return change

    if judge == "mujoco":
        yield copy("gain", replace("joint.xml", r'polycoef="(\S+) (\S+)', lambda m: f'polycoef="{m[1]} {float(m[2]) * 1.01}'))
        if 'name="drum"' in (folder / "joint_tendons.xml").read_text():
            yield copy("drum", replace("joint_tendons.xml", r'name="drum" type="cylinder" pos="0 0 0" size="(\S+)', lambda m: m[0][:-len(m[1])] + str(0.98 * float(m[1]))))
            yield copy("side", replace("joint_tendons.xml", r'sidesite="beside_drum_1"', 'sidesite="off_drum_2"'))
            return
        yield copy("pin", replace("joint_tendons.xml", r'name="pin_([BD])" type="cylinder" pos="(\S+) (\S+)', lambda m: f'name="pin_{m[1]}" type="cylinder" pos="{float(m[2]) * 1.05} {m[3]}'))
        yield copy("side", replace("joint_tendons.xml", r'sidesite="outer_1"', 'sidesite="anchor_2"'))
    else:
        yield copy("parent", replace("joint.urdf", r'<parent link="base_link"', '<parent link="nowhere"'))
        yield copy("role", replace("joint_ros2_control.urdf", r' role="joint1"', ""))
        yield copy("tag", replace("joint_ros2_control.urdf", r"</robot>", ""))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("judge", choices=["mujoco", "urdf"])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--law", type=pathlib.Path)
    parser.add_argument("--self-test", action="store_true")
    arguments = parser.parse_args()
    judge = {"mujoco": mujoco_faults, "urdf": urdf_faults}[arguments.judge]
    if arguments.self_test:
        missed = []
        with tempfile.TemporaryDirectory() as scratch:
            for folder in broken_copies(arguments.judge, arguments.folder, pathlib.Path(scratch)):
                try:
                    found = list(judge(folder, arguments.law))
                except SystemExit as refused:
                    if refused.code == 77:
                        raise
                    found = [refused.code]
                print(f"{folder.name}: {found or 'not seen'}")
                missed += [] if found else [folder.name]
        sys.exit(1 if missed else 0)
    faults = list(judge(arguments.folder, arguments.law))
    for fault in faults:
        print(fault)
    sys.exit(1 if faults else 0)


main()

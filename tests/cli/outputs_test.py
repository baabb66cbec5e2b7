"""Files of a build, successful or not: complete files or none."""

import fcntl
import hashlib
import math
import os
import pathlib
import random
import re
import shutil
import signal
import struct
import subprocess
import time
import unittest

import harness

OUTPUTS = {"pulley.stl", "pulley.obj", "pulley.3mf", "pulley.drc", "pulley.scad", "profile.dxf", "plates.dxf",
           "profile.csv", "profile_p1.csv", "profile_p2.csv", "transmission.csv", "mechanism.toml", "report.html",
           "manifest.json"}
ELBOW = """schema = 1
name = "arm"

[joint]
length_mm = 250
range_deg = [-10, 120]
drum_radius_mm = 58.8
attachment1_mm = [-52.266, 27.587]
attachment2_mm = [-43.799, 39.679]

[guides]
EB_mm = 62.9
ED_mm = 62.9
OE_mm = 103
radius_mm = 14.4
kind = "idler"
bearing_radius_mm = 3.3
bearing_friction = 0.003

[pulley]
EF_mm = 38.2
r1_mm = 15.2
law = "compensate"

[tendon]
diameter_mm = 1.2
modulus_MPa = 57300
pretension_N = 38
bend_ratio = 25
strength_N = 1220

[load]
tip_force_N = 19.6133

[motor]
model = "NEMA17-48mm"

[body]
shaft = "nema17-d5"
room_diameter_mm = 120
"""  # the motor is too weak: an elbow of 250 mm that lifts 2 kg
PARTS = {"pulley_p1.stl", "pulley_p2.stl"}  # of a pulley printed in two parts, like that of arm.toml


class Build(harness.Scratch):
    def test_writes_exactly_its_files(self):
        files = self.build()
        self.assertEqual(set(files), OUTPUTS | PARTS)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["arm.toml", "out"])
        self.assertTrue(all(files.values()))

    def test_one_part_has_no_part_files(self):
        self.assertEqual(set(self.build("one", "--set print.parts=one")), OUTPUTS)
        self.build("again")
        self.assertEqual(set(self.build("again", "--set print.parts=one")), OUTPUTS)

    def test_trial_has_its_own_folder(self):
        self.expect("build arm.toml", 0)
        before = self.files("out/arm")
        self.expect("build arm.toml --set pulley.r1_mm=15", 0, "files +in out/arm.pulley.r1_mm=15", "not replaced")
        self.assertEqual(self.files("out/arm"), before)
        trial = self.files("out/arm.pulley.r1_mm=15")
        self.assertNotEqual(trial["pulley.stl"], before["pulley.stl"])
        manifest = harness.json.loads(trial["manifest.json"])
        self.assertEqual(manifest["input"]["set"], {"pulley.r1_mm": 15})
        # Values that differ only in characters no name may have get different folders.
        for name in ["a/b", "a:b"]:
            self.expect(f"build arm.toml --set name={name}", 0)
        self.assertEqual(len([path for path in (self.folder / "out").iterdir() if path.name.startswith("arm.name=a_b")]), 2)

    def test_setting_supplies_missing_key(self):
        text = (self.folder / "arm.toml").read_text()
        (self.folder / "less.toml").write_text(re.sub(r"(?m)^r1_mm.*$", "", text))
        self.expect("build less.toml", 3, "^$", "r1_mm")
        self.expect("build less.toml --set pulley.r1_mm=16 -o less", 0)
        self.expect("build less/mechanism.toml -o again", 0)
        self.assertEqual(self.files("less")["pulley.stl"], self.files("again")["pulley.stl"])

    def test_print_opens_again(self):
        self.expect("build arm.toml --set pulley.r1_mm=15 -o trial", 0)
        self.expect("new --from trial/pulley.3mf -o again.toml", 0, "again.toml", "^$")
        self.expect("build again.toml -o again", 0)
        trial, again = self.files("trial"), self.files("again")
        for name in ["pulley.stl", "pulley.obj", "pulley.3mf", "pulley.drc", "mechanism.toml"]:
            self.assertEqual(trial[name], again[name], name)
        self.expect("new --from trial/pulley.3mf -o again.toml", 6, "^$", "exists.*--force")
        self.expect("new --from trial/pulley.3mf --set pulley.r1_mm=16", 0, "r1_mm = 16")
        self.expect("new --from trial/pulley.stl", 3, "^$", "zip archive")
        self.expect("new --from trial/pulley.3mf forearm", 2, "^$", "no template")
        self.expect("new --from trial/pulley.3mf --ask", 2, "^$", "exclude")
        self.expect("new -o x.toml", 2, "^$", "needs a TEMPLATE")

    def test_print_keeps_table_of_law(self):
        for name in ["gripper.toml", "gripper_law.csv"]:
            shutil.copy(harness.SOURCE / "profiles" / name, self.folder)
        self.expect("build gripper.toml -o one", 0)
        shutil.copy(self.folder / "one/pulley.3mf", self.folder / "part.3mf")
        self.expect("new --from part.3mf", 0, "gripper_law.csv", "needs the table gripper_law.csv.*-o")
        (self.folder / "new").mkdir()
        self.expect("new --from part.3mf -o new/part.toml", 0)
        self.expect("build new/part.toml -o two", 0)
        self.assertEqual(self.files("one")["pulley.stl"], self.files("two")["pulley.stl"])
        self.assertEqual(self.files("one")["gripper_law.csv"], self.files("two")["gripper_law.csv"])

    def test_template_is_written_with_its_table(self):
        done = self.expect("new gripper", 0, 'table = "gripper_law.csv"', "note: its law needs the table gripper_law.csv beside it.*fusee new gripper -o gripper.toml")
        (self.folder / "gripper.toml").write_bytes(done.stdout)
        self.expect("build gripper.toml --dry-run", 3, "^$", "gripper_law.csv: cannot be read.*'fusee new gripper -o gripper.toml' writes the template's table")
        (self.folder / "new").mkdir()
        self.expect("new gripper -o new/jaw.toml", 0, "", "^$")
        self.assertEqual(self.files("new")["gripper_law.csv"], (harness.SOURCE / "profiles/gripper_law.csv").read_bytes())
        self.expect("build new/jaw.toml --dry-run", 0)
        self.expect("new gripper --set joint.length_mm=90", 0, "length_mm = 90")
        self.expect("new forearm", 0, "", "^$")

    def test_writes_step_on_request(self):
        done = self.fusee("build arm.toml -o out/cad --step")
        if b"built without STEP" in done.stderr:
            self.assertEqual(done.returncode, 3)
            self.assertFalse((self.folder / "out").exists())
            return
        self.assertEqual(done.returncode, 0)
        names = {path.name for path in (self.folder / "out/cad").iterdir()}
        self.assertEqual(names, OUTPUTS | PARTS | {"pulley.step"})
        # The next run without --step removes the older pulley.step.
        self.expect("build arm.toml -o out/cad", 0, "pulley.scad")
        self.assertFalse((self.folder / "out/cad/pulley.step").exists())

    def test_plates_report_what_they_lack(self):
        for settings, words in (("cut.kerf_mm=6", "plates.dxf: the bore is omitted: a kerf of 6 mm is wider"),
                                ("cut.kerf_mm=6", "plates.dxf: a tendon channel is omitted"),
                                ("cut.dowel_mm=20", "plates.dxf: no dowels: there is no space for two of 20 mm"),
                                ("cut.sheet_width_mm=20", "plates.dxf: a sheet of 20 x ")):
            self.expect(f"build arm.toml --dry-run --set {settings}", 0, "", "note: " + words)
        self.assertNotIn("plates.dxf", self.expect("build arm.toml --dry-run", 0).stderr.decode())

    def test_is_reproducible(self):
        first = self.build("one")
        os.environ["TZ"] = "Pacific/Chatham"
        self.assertEqual(first, self.build("two"))

    def test_summary_fits_narrow_terminal(self):
        done = self.expect("build arm.toml", 0, "alpha.*r2.*as built.*checks.*report.html")
        self.assertLessEqual(max(len(line) for line in done.stdout.decode().splitlines()), 80)

    def test_document_agrees_with_the_manifest(self):
        document = self.expect_json("build arm.toml", 0)
        manifest = harness.json.loads((self.folder / "out/arm/manifest.json").read_bytes())
        self.assertEqual(document["as_built"], manifest["as_built"])
        self.assertEqual([check["name"] for check in document["checks"]], [check["name"] for check in manifest["checks"]])
        self.assertEqual([output["file"] for output in document["outputs"]],
                         [output["file"] for output in manifest["outputs"]] + ["manifest.json"])

    def test_dry_run_writes_nothing(self):
        self.expect("build arm.toml --dry-run", 0, r"none written \(--dry-run\)")
        self.assertEqual([path.name for path in self.folder.iterdir()], ["arm.toml"])

    def test_outputs_pass_check_and_rewind(self):
        self.build("p")
        for name in ["pulley.stl", "pulley.obj", "pulley.3mf", "pulley.drc", "profile.dxf", "plates.dxf"]:
            self.expect(f"check p/{name}", 0, "valid")
        for name in ["pulley.stl", "pulley.obj", "pulley.3mf", "pulley.drc", "profile.dxf"]:
            self.expect(f"rewind arm.toml p/{name}", 0, "theta within")

    def test_check_shows_size_and_volume(self):
        self.build("p")
        self.expect("check p/pulley.stl", 0, r"\nsize \d+\.?\d* × \d+\.?\d* × \d+\.?\d* mm, volume \d+\.?\d* cm³\n", "^$")
        self.expect("check p/profile.dxf", 0, r"\nsize \d+\.?\d* × \d+\.?\d* mm, \d+ closed paths, marks included\n", "^$")
        document = self.expect_json("check p/pulley.stl", 0)
        x, y, z = document["size_mm"]
        self.assertTrue(0 < document["volume_mm3"] < x * y * z)
        self.move("p/pulley.stl", "inches.stl", scale=1 / 25.4)
        self.expect("check inches.stl", 0, "volume", r"inches.stl: warning: .*looks like inches \(× 25.4 = ")
        for axis, size in zip((x, y, z), self.expect_json("check inches.stl", 0)["size_mm"]):
            self.assertAlmostEqual(axis / 25.4, size, 5)

    def test_check_tests_room_of_mechanism(self):
        self.build("p")
        room = "check p/pulley.stl --mechanism arm.toml --set body.room_diameter_mm="
        size = self.expect_json("build arm.toml --dry-run", 0)["size_mm"]["diameter"]
        self.expect(f"{room}{size + 1}", 0, r"room_diameter .*\n\nvalid")
        document = self.expect_json(f"{room}{size - 1}", 5)
        (check,) = [check for check in document["checks"] if check["name"] == "room_diameter"]
        self.assertAlmostEqual(check["value"], size, 2)
        self.assertEqual((check["limit"], check["ok"]), (size - 1, False))
        # Print shrinkage is compensated in the mesh: the part's size counts.
        self.expect("build arm.toml --set material.shrinkage_percent=2 -o large", 0)
        self.expect(f"check large/pulley.stl --mechanism arm.toml --set material.shrinkage_percent=2 --set body.room_diameter_mm={size + 0.01}", 0)
        self.expect(f"check large/pulley.stl --mechanism arm.toml --set body.room_diameter_mm={size + 0.01}", 5, "room_diameter", "about the z axis")
        self.expect("check p/pulley.stl --mechanism arm.toml", 0, "valid", "arm.toml: note: the room is not tested: the file has no")
        self.expect("check p/plates.dxf --mechanism arm.toml --set body.room_diameter_mm=5", 0, "valid", "note: the room is not tested: the outlines")

    def test_check_warns_about_scaled_part(self):
        self.build("p")
        self.assertEqual(self.expect_json("check p/pulley.stl --mechanism arm.toml", 0)["scale"], 1)
        for scale, words in ((1.01, "larger"), (0.985, "smaller")):
            self.move("p/pulley.stl", "scaled.stl", scale=scale)
            self.expect("check scaled.stl", 0, "valid", "^$")
            self.expect("check scaled.stl --mechanism arm.toml", 0, "valid", rf"scaled.stl: warning: it is [\d.]+ % {words} than the mechanism file's pulley(.|\n)*fusee rewind")
            self.assertAlmostEqual(self.expect_json("check scaled.stl --mechanism arm.toml", 0)["scale"], scale, delta=3e-4)
            self.expect("check scaled.stl --mechanism arm.toml --strict", 5)
        # The mesh is larger by the shrinkage that it compensates.
        self.expect("build arm.toml --set material.shrinkage_percent=2 -o large", 0)
        self.assertEqual(self.expect_json("check large/pulley.stl --mechanism arm.toml --set material.shrinkage_percent=2", 0)["scale"], 1)

    def move(self, source, target, turn=0.0, by=(0.0, 0.0, 0.0), scale=1.0, mirror=1, keep=lambda z: True):
        """Moves a binary STL as a slicer does: mirrored in x (mirror=-1), turned about z (deg), scaled, then shifted (mm).
        Keeps only facets whose corners all have a z that `keep` accepts."""
        cosine, sine = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        data = (self.folder / source).read_bytes()
        facets = []
        for at in range(84, len(data), 50):  # after header and count; a facet has 50 bytes
            numbers = struct.unpack("<12fH", data[at:at + 50])  # normal, three corners, attribute
            if not all(keep(z) for z in numbers[5:12:3]):
                continue
            corners = []
            for x, y, z in (numbers[3:6], numbers[6:9], numbers[9:12]):
                x *= mirror
                corners.append((scale * (cosine * x - sine * y) + by[0], scale * (sine * x + cosine * y) + by[1], scale * z + by[2]))
            flat = [number for corner in corners[::mirror] for number in corner]
            facets.append(struct.pack("<12fH", 0, 0, 0, *flat, 0))
        (self.folder / target).write_bytes(data[:80] + struct.pack("<I", len(facets)) + b"".join(facets))

    def test_rewind_finds_moved_part(self):
        self.build("a/long/path/p")
        stl = "a/long/path/p/pulley.stl"
        unmoved = self.expect_json(f"rewind arm.toml {stl}", 0)
        self.assertEqual(unmoved["placements"], [])
        self.move(stl, "moved.stl", turn=90, by=(125, 105, -3))
        done = self.expect("rewind arm.toml moved.stl", 0, r"^moved.stl: theta within .*\n  found from its grooves: its axis at\s+\(125, 105\)\s+mm,\s+turned\s+by\s+90°\s+about\s+it;\s+grooves\s+P1\s+at\s+z\s+= ", "note: the part was moved after the build.*--as-is")
        moved = self.expect_json("rewind arm.toml moved.stl", 0)
        self.assertAlmostEqual(moved["placements"][0]["turned_deg"], 90, 4)
        self.assertAlmostEqual(moved["as_built"]["max_theta_error_deg"], unmoved["as_built"]["max_theta_error_deg"], 4)
        self.assertNotEqual(self.fusee("rewind arm.toml moved.stl --as-is").returncode, 0)
        below, above = (groove["z_mm"] for groove in harness.json.loads((self.folder / stl).with_name("manifest.json").read_bytes())["grooves"])
        self.move(stl, "upper.stl", turn=30, keep=lambda z: z > (below + above) / 2)
        done = self.expect("rewind arm.toml upper.stl", 0, r"the file has only P2: only tendon\s+2\s+was\s+wound", "^((?!mirrored).)*$")
        self.assertNotIn("length within", done.stdout.decode())
        alone = self.expect_json("rewind arm.toml upper.stl", 0)
        self.assertEqual((alone["alone"], [check["name"] for check in alone["checks"]]), ("P2", ["theta_error"]))
        self.move(stl, "mirrored_upper.stl", mirror=-1, keep=lambda z: z > (below + above) / 2)
        self.expect("rewind arm.toml mirrored_upper.stl", 0, "upside down", "warning: a single groove")
        self.move(stl, "mirrored.stl", mirror=-1)
        self.expect("rewind arm.toml mirrored.stl", 3, "^$", "mirrored.stl: error: the part is the mirror image.*--as-is")
        self.expect("rewind arm.toml mirrored.stl --as-is", 5, "mirrored.stl: theta within", "check 'excess_length' failed")
        self.expect(f"rewind arm.toml {stl} --as-is", 0, "^pulley.stl: theta within", "^$")

    def test_tight_limits_fail_build(self):
        self.expect("build arm.toml --max-theta-error-deg 0", 5, "FAILED|of", "check 'theta_error' failed")
        document = self.expect_json("rewind arm.toml out/arm/pulley.stl --max-slack-mm 0", 5)
        self.assertTrue(document["points"])

    def test_failed_check_keeps_earlier_run(self):
        earlier = self.build()
        self.expect("build arm.toml --max-theta-error-deg 0", 5, "keeps its earlier run", "were kept.*--force")
        self.assertEqual(self.files("out/arm"), earlier)
        self.expect("build arm.toml --max-theta-error-deg 0 --force", 5, "report.html")
        self.assertNotEqual(self.files("out/arm"), earlier)

    def test_hints_name_their_cost(self):
        # A small pulley holds the load with less motor torque, but it bends the cable and has no hub.
        (self.folder / "elbow.toml").write_text(ELBOW)
        hints = re.findall(r"try (pulley\.r1_mm = [^;]*)", self.expect("build elbow.toml --dry-run", 0).stderr.decode())
        self.assertTrue(any("which omits the hub, the set screw" in hint and "bends the tendon more tightly than tendon.bend_ratio" in hint
                            for hint in hints), hints)

    def test_infeasible_design_has_advice(self):
        document = self.expect_json("build arm.toml --set pulley.r1_mm=60", 4)
        broken = [condition for condition in document["conditions"] if not condition["ok"]]
        self.assertTrue(broken)
        self.assertTrue(document["advice"])
        for change in document["advice"]:
            self.assertEqual(set(change) - {"until"}, {"key", "from", "to", "unit", "text"})  # until: if the other end is near
        self.assertFalse((self.folder / "out").exists())

    def test_advice_builds(self):
        advice = self.expect_json("build arm.toml --set pulley.r1_mm=60", 4)["advice"]
        r1 = [change for change in advice if change["key"] == "pulley.r1_mm"]
        self.assertTrue(r1)
        self.expect(f"build arm.toml --dry-run --set pulley.r1_mm={r1[0]['to']}", 0)

    def test_paper_method_is_reported_not_failed(self):
        document = self.expect_json("build arm.toml --set pulley.method=paper", 0)
        names = [check["name"] for check in document["checks"]]
        self.assertIn("theta_error_reported", names)
        self.assertNotIn("theta_error", names)
        self.assertGreater(document["as_built"]["max_slack_mm"], 0.05)


class ForeignFiles(harness.Scratch):
    def test_require_force(self):
        (self.folder / "mine").mkdir()
        (self.folder / "mine/pulley.stl").write_text("a week of work")
        self.expect("build arm.toml -o mine", 6, "^$", "fusee did not write: pulley.stl.*--force")
        self.assertEqual(self.files("mine"), {"pulley.stl": b"a week of work"})
        self.expect("build arm.toml -o mine --force", 0)

    def test_unrelated_files_are_kept(self):
        (self.folder / "mine").mkdir()
        (self.folder / "mine/notes.txt").write_text("notes")
        files = self.build("mine")
        self.assertEqual(files.pop("notes.txt"), b"notes")
        self.assertEqual(set(files), OUTPUTS | PARTS)

    def test_edited_outputs_are_detected(self):
        self.build()
        (self.folder / "out/arm/pulley.scad").write_text("my changes")
        self.expect("build arm.toml", 6, "^$", "changed after fusee wrote them: pulley.scad")
        self.assertEqual((self.folder / "out/arm/pulley.scad").read_text(), "my changes")

    def test_own_files_are_replaced(self):
        first = self.build()
        second = self.build(arguments="--set pulley.r1_mm=15")
        self.assertNotEqual(first["pulley.stl"], second["pulley.stl"])

    def test_file_at_output_folder_is_refused(self):
        (self.folder / "out").write_text("a file")
        self.expect("build arm.toml", 6, "^$", "out.*not a folder")

    def test_folder_at_output_file_is_refused(self):
        (self.folder / "out/arm/pulley.stl").mkdir(parents=True)
        self.expect("build arm.toml", 6, "^$", "pulley.stl")

    @unittest.skipIf(os.geteuid() == 0, "root may write anywhere")
    def test_unwritable_folder_is_reported(self):
        (self.folder / "locked").mkdir(mode=0o500)
        self.expect("build arm.toml -o locked", 6, "^$", "locked")

    def test_unwritable_place_is_reported(self):
        self.expect("build arm.toml -o /proc/fusee", 6, "^$", "/proc")


class FullDisk(harness.Scratch):
    def setUp(self):
        super().setUp()
        self.disk = self.folder / "disk"
        self.disk.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", self.disk], stderr=subprocess.DEVNULL).returncode:
            self.skipTest("a small disk needs root")
        self.addCleanup(subprocess.run, ["umount", self.disk], check=True)

    def test_leaves_nothing(self):
        self.expect("build arm.toml -o disk/parts", 6, "^$", "disk is full|No space left")
        self.assertEqual(list(self.disk.iterdir()), [])


class LargestFile(harness.Scratch):
    """Files at the limit of `ulimit -f`."""

    def test_keeps_earlier_files(self):
        earlier = self.build()
        for blocks in (0, 1, 20, 100, 300):
            done = subprocess.run(["bash", "-c", f"ulimit -f {blocks}; exec fusee build arm.toml --set pulley.r1_mm=15 -q 2>&1 | cat; exit ${{PIPESTATUS[0]}}"],
                                  cwd=self.folder, env=harness.ENVIRONMENT, stdout=subprocess.PIPE, timeout=120)
            self.assertEqual(done.returncode, 6, done.stdout)
            self.assertIn(b"File too large", done.stdout)
            self.assertEqual(self.files("out/arm"), earlier)
            self.assertEqual([path.name for path in (self.folder / "out").iterdir()], ["arm"])

    def test_leaves_no_partial_file(self):
        done = subprocess.run(["bash", "-c", "ulimit -f 1; fusee analyze arm.toml -q -o table.csv 2>&1 | cat; exit ${PIPESTATUS[0]}"],
                              cwd=self.folder, env=harness.ENVIRONMENT, stdout=subprocess.PIPE, timeout=120)
        self.assertEqual(done.returncode, 6, done.stdout)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["arm.toml"])


class DotNames(harness.Scratch):
    def test_dotted_mechanism_has_own_folder(self):
        for name, folder in {"..toml": "..toml", "...toml": "...toml", "....toml": "...", "arm..toml": "arm.", ".toml": ".toml"}.items():
            (self.folder / name).write_bytes((self.folder / "arm.toml").read_bytes())
            self.expect(["build", name, "-q"], 0)
            self.assertTrue((self.folder / "out" / folder / "manifest.json").exists(), name)
        self.assertFalse((self.folder / "manifest.json").exists())
        self.assertFalse((self.folder / "out/manifest.json").exists())

    def test_dotted_folder_is_written(self):
        for name in ("...", "..x", "x..", ".hidden"):
            self.assertEqual(set(self.build(name)), OUTPUTS | PARTS)
        for name in (".", "..", "x/.."):
            self.expect(["analyze", "arm.toml", "-o", name, "--force"], 2, "^$", "ending")
        (self.folder / "folder.csv").mkdir()
        self.expect("analyze arm.toml -o folder.csv --force", 6, "^$")
        self.expect("analyze arm.toml -o .table.csv", 0)
        self.assertTrue((self.folder / ".table.csv").exists())

    def test_working_folder_is_not_replaced(self):
        inode = self.folder.stat().st_ino
        for _ in range(2):
            self.expect("build arm.toml -o .", 0)
        self.assertEqual(self.folder.stat().st_ino, inode)
        self.assertEqual({path.name for path in self.folder.iterdir()}, OUTPUTS | PARTS | {"arm.toml"})


class Streams(harness.Scratch):
    """stdout and stderr closed, full or broken: a defined exit, and never a message inside an output file."""

    def shell(self, line):
        return subprocess.run(["bash", "-c", line], cwd=self.folder, env=harness.ENVIRONMENT, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, timeout=120)

    def test_full_stdout_is_reported(self):
        done = self.shell("fusee explain > /dev/full")
        self.assertEqual(done.returncode, 6)
        self.assertRegex(done.stderr.decode(), "could not be written to stdout: No space left")

    def test_broken_pipe_has_defined_exit(self):
        done = self.shell("fusee explain | true; exit ${PIPESTATUS[0]}")
        self.assertIn(done.returncode, (0, 6))

    def test_closed_streams_have_defined_exits(self):
        self.assertEqual(self.shell("fusee explain >&-").returncode, 6)
        self.assertEqual(self.shell("fusee explain 2>&-").returncode, 0)
        self.assertEqual(self.shell("fusee bild 2>&-").returncode, 2)
        self.assertEqual(self.shell("fusee explain <&-").returncode, 0)

    def test_closed_streams_leave_files_intact(self):
        good = self.build("good")
        self.assertEqual(self.shell("fusee build arm.toml -o bad -v <&- >&- 2>&-").returncode, 6)
        self.assertEqual(self.files("bad"), good)

    def test_plain_output_without_terminal(self):
        for line in ["fusee build arm.toml --force", "fusee build missing.toml"]:
            self.assertNotIn(b"\x1b", self.shell(line).stderr)

    def terminal(self, line):
        """The terminal output of `line`."""
        try:
            ours, theirs = os.openpty()
        except OSError as error:
            self.skipTest(f"no terminal to be had: {error}")
        process = subprocess.Popen(["bash", "-c", f"TERM=xterm {line}"], cwd=self.folder, env=harness.ENVIRONMENT,
                                   stdin=theirs, stdout=theirs, stderr=theirs)
        os.close(theirs)
        shown = b""
        try:
            while part := os.read(ours, 4096):
                shown += part
        except OSError:
            pass  # the other end was closed
        os.close(ours)
        process.wait(timeout=120)
        return shown

    def test_colours_on_a_terminal(self):
        self.assertIn(b"\x1b[1;31merror:", self.terminal("fusee build missing.toml"))
        self.assertNotIn(b"\x1b", self.terminal("fusee build missing.toml --no-color"))
        self.assertNotIn(b"\x1b", self.terminal("NO_COLOR=1 fusee build missing.toml"))
        self.assertIn("finding both pitch curves …".encode(), self.terminal("fusee build arm.toml"))

    def test_names_are_escaped(self):
        done = self.fusee(["build", "\x1b[31mred.toml"])
        self.assertEqual(done.returncode, 3)
        self.assertNotIn(b"\x1b", done.stderr)

    def test_prints_no_control_characters(self):
        unfit = "a\x1b[2J\x9b\u202e\x7f"
        spec = (self.folder / "arm.toml").read_text()
        (self.folder / f"{unfit}.toml").write_text(spec)
        for words, code in [(["build", f"{unfit}.toml", "-o", f"o{unfit}"], 0), (["build", f"{unfit}.toml", "-o", f"o{unfit}", "--json"], 0),
                            (["explain", unfit], 3), (["build", "arm.toml", "--set", f"name={unfit}"], 3), (["check", unfit, "-v"], 3)]:
            done = self.fusee(words)
            shown = done.stdout + done.stderr
            self.assertEqual(done.returncode, code, shown)
            for one in unfit[1], *unfit[5:]:
                self.assertNotIn(one.encode(), shown)
        document = harness.json.loads(self.fusee(["check", f"o{unfit}/pulley.stl", "--json"]).stdout)
        self.assertEqual(document["file"], f"o{unfit}/pulley.stl")  # escaped in the document

    def test_accepts_names_that_are_not_utf8(self):
        done = self.fusee([b"build", b"\xff\xfe.toml", b"--json"])
        self.assertEqual(harness.json.loads(done.stdout)["exit"], 3)


class Leftovers(harness.Scratch):
    """Staging folders that fusee did not make; 3999999 is not a process."""

    def tree(self):
        return {str(path.relative_to(self.folder)): path.read_bytes() if path.is_file() else b"" for path in self.folder.rglob("*")}

    def plant(self, folder, withdrawn, journal=None):
        """A journal of fusee 0.1, which lists files for removal with correct hashes."""
        (self.folder / "doc").mkdir(exist_ok=True)
        (self.folder / "doc/t").write_text("data")
        leftover = self.folder / folder / ".fusee-3999999-x"
        leftover.mkdir(parents=True)
        outputs = [{"file": pathlib.Path(withdrawn).name, "sha256": hashlib.sha256(b"data").hexdigest()}]
        text = harness.json.dumps({"tool": "fusee", "outputs": outputs, "withdrawn": [withdrawn]})
        (leftover / ".publishing").write_text(text if journal is None else journal)

    def test_reading_changes_nothing(self):
        self.build("dl")
        for withdrawn in ("../doc/t", str(self.folder / "doc/t")):
            self.plant("dl", withdrawn)
            before = self.tree()
            self.expect("check dl/pulley.stl", 0)
            self.expect("build arm.toml -o dl --dry-run", 0)
            self.assertEqual(self.tree(), before)
            shutil.rmtree(self.folder / "dl/.fusee-3999999-x")

    def test_building_removes_nothing_elsewhere(self):
        self.build("dl")
        self.plant("dl", "../doc/t")
        self.expect("build arm.toml -o dl", 0, "", "note: .*fusee-3999999-x is ignored")
        self.assertEqual((self.folder / "doc/t").read_text(), "data")

    def test_malformed_journals_are_ignored(self):
        self.build("dl")
        for journal in ("", "{", "[]", '{"tool":"fusee","outputs":[],"withdrawn":7}', "\0" * 100):
            self.plant("dl", "t", journal)
            self.expect("check dl/pulley.stl", 0, "valid", "^$")
            self.expect("build arm.toml -o dl", 0)
            shutil.rmtree(self.folder / "dl/.fusee-3999999-x")

    def test_foreign_locks_do_not_block(self):
        for place in (".", "out"):
            (self.folder / place).mkdir(exist_ok=True)
            lock = os.open(self.folder / place, os.O_RDONLY)
            fcntl.flock(lock, fcntl.LOCK_EX)
            self.addCleanup(os.close, lock)
        started = time.monotonic()
        self.build()
        self.assertLess(time.monotonic() - started, 30)


class Machine(harness.Scratch):
    """Missing resources of the machine are reported, and are not bugs."""

    def test_missing_temporary_folder_is_reported(self):
        bundle = self.folder / "bug.zip"
        self.expect(f"explain name --bundle {bundle}", 0)
        (self.folder / "file").write_text("x")
        for temporary in ("/no/such/folder", self.folder / "file"):
            for words in ("build arm.toml --dry-run", "replay bug.zip", "build arm.toml --dry-run --json"):
                done = self.fusee(words, env={**harness.ENVIRONMENT, "TMPDIR": str(temporary)})
                self.assertEqual(done.returncode, 6, done.stderr)
                self.assertIn(b"TMPDIR", done.stderr)

    def test_lack_of_memory_is_reported(self):
        self.build("made")
        self.expect("plan arm.toml -q", 0)
        refused = set()
        for words in ("build arm.toml -o little", "check made/pulley.stl", "plan arm.toml -o p", "kit arm.toml -o k", "analyze arm.toml -o a.csv",
                      "rewind arm.toml made/pulley.stl", "simulate arm.toml out/arm_plan/run_1.csv -o s.csv", "model arm.toml", "explain name",
                      "build arm.toml --dry-run --bundle bug.zip"):
            for limit in (50_000, 80_000, 110_000):
                done = subprocess.run(["bash", "-c", f"ulimit -v {limit}; exec fusee {words} -q --force"], cwd=self.folder, env=harness.ENVIRONMENT, capture_output=True)
                if done.returncode == 127 or b"error while loading shared libraries" in done.stderr:
                    continue  # the system's own message: no memory to start the program
                self.assertIn(done.returncode, (0, 6), (words, limit, done.stderr))
                if done.returncode == 6:
                    self.assertIn(b"not enough memory", done.stderr)
                    refused.add(words.split()[0])
        self.assertIn("build", refused)


class Kill(harness.Scratch):
    """When killed at any moment, the earlier files are complete, and the next run cleans up."""

    DELAYS = [0.005, 0.02, 0.05, 0.08, 0.11, 0.15, 0.2, 0.3]  # s

    def start(self, arguments="-o out/arm"):
        line = [harness.PROGRAM, "build", "arm.toml", "--set", "pulley.r1_mm=15", *arguments.split()]
        return subprocess.Popen(line, cwd=self.folder, env=harness.ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def test_killed_build_keeps_complete_files(self):
        """FUSEE_KILLS=200 kills more often; tests/base/kill_test.cpp kills before every call that changes a file."""
        later = self.build(arguments="--set pulley.r1_mm=15")
        earlier = self.build()
        started = time.monotonic()
        self.build()
        duration = time.monotonic() - started
        generator = random.Random(4)
        # Most changes of files are near the end of a build.
        delays = self.DELAYS + [generator.uniform(0.5, 1.1) * duration for _ in range(int(os.environ.get("FUSEE_KILLS", "4")))]
        for delay in delays:
            process = self.start()
            time.sleep(delay)
            process.kill()
            process.communicate()
            present = self.files("out/arm")
            self.assertIn(present, (earlier, later), delay)
            if present == later:
                self.build()
        self.assertEqual(self.build(), earlier)
        self.assertEqual([path.name for path in (self.folder / "out").iterdir()], ["arm"])

    def interrupt(self, number):
        earlier = self.build()
        later = self.build("later", "--set pulley.r1_mm=15")
        for delay in self.DELAYS:
            process = self.start("--json -o out/arm")
            time.sleep(delay)
            process.send_signal(number)
            out, _ = process.communicate(timeout=60)
            self.assertIn(process.returncode, (0, 130, -number), delay)
            if process.returncode == -number:
                continue  # killed before the program began
            self.assertEqual(harness.json.loads(out)["exit"], process.returncode)
            self.assertEqual(self.files("out/arm"), later if process.returncode == 0 else earlier, (delay, process.returncode))
            if process.returncode == 0:
                self.build()

    def test_interrupt_keeps_complete_files(self):
        self.interrupt(signal.SIGINT)

    def test_termination_keeps_complete_files(self):
        self.interrupt(signal.SIGTERM)

    def test_late_interrupt_is_ignored(self):
        """All files are in place and stdout is blocked: exit 130 would wrongly mean that the earlier files remain."""
        later = self.build("later", "--set pulley.r1_mm=15")
        self.build()
        reading, writing = os.pipe()
        os.set_blocking(writing, False)
        with self.assertRaises(BlockingIOError):
            while True:
                os.write(writing, b" " * 4096)
        os.set_blocking(writing, True)
        process = subprocess.Popen([harness.PROGRAM, "build", "arm.toml", "-o", "out/arm", "--set", "pulley.r1_mm=15", "--json"],
                                   cwd=self.folder, env=harness.ENVIRONMENT, stdout=writing, stderr=subprocess.PIPE)
        for _ in range(1000):
            time.sleep(0.02)
            if self.files("out/arm") == later:
                break
        time.sleep(0.2)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=60)
        os.close(reading), os.close(writing)
        self.assertEqual(process.returncode, 6, err)
        self.assertIn(b"could not be written to stdout", err)
        self.assertEqual(self.files("out/arm"), later)

    def test_two_equal_builds_agree(self):
        runs = [self.start("-o both"), self.start("-o both")]
        for run in runs:
            out, err = run.communicate(timeout=120)
            self.assertEqual(run.returncode, 0, err)
        self.assertEqual(self.files("both"), self.build("alone", "--set pulley.r1_mm=15"))

    def test_two_different_builds_never_mix(self):
        sets = [self.build(f"r1_{r1}", f"--set pulley.r1_mm={r1}") for r1 in (16, 15)]
        for _ in range(3):
            runs = [subprocess.Popen([harness.PROGRAM, "build", "arm.toml", "-o", "both", "--set", f"pulley.r1_mm={r1}"],
                                     cwd=self.folder, env=harness.ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                    for r1 in (16, 15)]
            for run in runs:
                out, err = run.communicate(timeout=120)
                self.assertEqual(run.returncode, 0, err)
            self.assertIn(self.files("both"), sets)


class KeptFiles(harness.Scratch):
    def test_refused_target_leaves_no_table(self):
        (self.folder / "gripper.toml").write_bytes(self.fusee("new gripper").stdout)
        shutil.copy(harness.SOURCE / "profiles/gripper_law.csv", self.folder)
        self.expect("build gripper.toml -o made", 0)
        other = self.folder / "other"
        other.mkdir()
        (other / "mine.toml").write_text("mine")
        self.expect("new --from made/pulley.3mf -o other/mine.toml", 6)
        self.assertEqual([path.name for path in other.iterdir()], ["mine.toml"])
        self.assertEqual((other / "mine.toml").read_text(), "mine")
        self.expect("new --from made/pulley.3mf -o other/mine.toml --force", 0)
        self.assertEqual(len(list(other.iterdir())), 2)


class Pages(harness.Scratch):
    def build(self, settings=""):
        self.expect(f"build arm.toml -o page {settings} --force", 0)
        return (self.folder / "page/report.html").read_text()

    def test_page_of_inch_file_has_inches(self):
        (self.folder / "arm.toml").write_bytes(self.fusee("new finger_mcp --set units=inch").stdout)
        page = self.build()
        body = page[page.index("<body"):]
        self.assertIn("try body.hub_diameter_mm = 0.433 (now automatic, 0.283)", body)
        self.assertRegex(body, r">9\.055 in</td>")  # cut length of tendon 1: 230 mm
        self.assertRegex(body, r">[\d.]+ in</text>")  # scale bars
        self.assertNotRegex(re.sub(r"<script.*?</script>", "", body, flags=re.S), r">[\d.]+ mm</(td|text)>")

    def test_summary_and_page_report_taut_tendons(self):
        (self.folder / "arm.toml").write_bytes(self.fusee("new forearm").stdout)
        for settings, taut in (("", True), ("--set load.tip_force_N=100", False)):
            summary = self.expect(f"build arm.toml --dry-run {settings}", 0).stdout.decode()
            self.assertEqual(bool(re.search(r"both tendons taut: [\d.]+ N or more, least at alpha = ", summary)), taut)
            page = self.build(settings)
            self.assertEqual("Both tendons stay taut over the whole range: the least tension is " in page, taut)
            self.assertNotIn("with tendon 1 slack", page)


if __name__ == "__main__":
    harness.main()

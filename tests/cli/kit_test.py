"""`fusee kit` from the user's view: a test rig, or colliding parts with advice."""

import csv
import hashlib
import io
import json
import os
import re

import harness

RATIO = 'schema = 1\nname = "joint"\n[transmission]\nkind = "ratio"\nratio = 4.0\n'


class Kit(harness.Scratch):
    def test_writes_all_files(self):
        document = self.expect_json("kit arm.toml -o model", 0)
        files = self.files("model")
        manifest = json.loads(files["manifest.json"])
        self.assertEqual(manifest["status"], "done")
        self.assertTrue(all(check["ok"] for check in manifest["checks"]))
        self.assertEqual({output["file"] for output in manifest["outputs"]}, set(files) - {"manifest.json"})
        for output in manifest["outputs"]:
            self.assertEqual(hashlib.sha256(files[output["file"]]).hexdigest(), output["sha256"])
        for part in manifest["parts"]:
            self.assertIn(part["file"], files)
            self.assertIn(part["file"].replace(".stl", ".3mf"), files)
        for name in ["base_plate", "link", "post", "tensioner_slide", "magnet_cap", "bracket", "scale_plate", "fit_coupon"]:
            self.assertIn(name + ".stl", files)
        self.assertTrue({"kit.dxf", "kit.html", "bom.csv", "run_1.csv"} <= set(files))
        self.assertEqual(document["published"], True)
        page = files["kit.html"].decode()
        self.assertNotRegex(page, r'(src|href)=|http://(?!www\.w3\.org)|https://|<script')
        # The page and the document agree.
        for tendon in manifest["tendons_at_home"]:
            self.assertIn(f"{tendon['cut_length_mm']:.0f}\u00a0mm", page)
        for row in csv.DictReader(io.StringIO(files["bom.csv"].decode())):
            self.assertGreater(int(row["count"]), 0)
        self.expect("check model/link.stl", 0, "valid")
        self.expect("check model/kit.dxf", 0, "valid")

    def test_names_only_the_motor_of_the_file(self):
        for settings, name, mount, words in (
            ("", None, "NEMA 17", "none named: mount as of NEMA 17"),
            (" --set body.shaft=nema17-round5", "NEMA 17", "NEMA 17", "NEMA 17\n"),
            (" --set motor.model=NEMA17-40mm", "NEMA17-40mm", "NEMA 17", "NEMA17-40mm: mount as of NEMA 17"),
        ):
            self.expect(f"kit arm.toml --force -o kit{settings}", 0, rf"motor +{words}")
            places = json.loads(self.files("kit")["manifest.json"])["places"]
            self.assertEqual((places["motor"], places["motor_mount"]), (name, mount))
            page = self.files("kit")["kit.html"].decode()
            self.assertEqual("Screw the motor under the plate" in page, name is None)
            self.assertEqual("holes for it are an assumption, those of NEMA 17" in page, name != mount)
            bill = self.files("kit")["bom.csv"].decode()
            self.assertEqual("motor: the file names none" in bill, name is None)

    def test_picture_has_the_letters_of_every_layout(self):
        for template in ("forearm", "finger_mcp", "elbow_idlers", "wrist_sheath"):
            (self.folder / "joint.toml").write_bytes(self.fusee(f"new {template}").stdout)
            self.expect("kit joint.toml --force -o kit", 0)
            page = (self.folder / "kit/kit.html").read_text()
            for letter in "OBDGC":
                self.assertRegex(page, rf"<text[^>]*halo[^>]*>{letter}</text>", template)

    def test_inch_file_has_an_inch_kit(self):
        inch = (self.folder / "arm.toml").read_text().replace("schema = 1", 'schema = 1\nunits = "inch"')
        for key, length in re.findall(r"^(\w+_mm) = (-?[\d.]+)", inch, re.M):
            inch = re.sub(rf"^{key} = {re.escape(length)}\b", f"{key} = {float(length) / 25.4:.6g}", inch, flags=re.M)
        (self.folder / "inch.toml").write_text(inch)
        self.expect("kit inch.toml -o model", 0, r"clearance +[\d.]+ in or more, .* \(required: [\d.]+ in\)")
        files = self.files("model")
        bill = files["bom.csv"].decode()
        self.assertNotRegex(bill, r"\d mm")
        self.assertRegex(bill, r"#4-40 × [\d /]+ in with low head")
        page = re.sub(r"<style.*?</style>", "", files["kit.html"].decode(), flags=re.S).replace("\u00a0", " ")
        self.assertNotRegex(page, r"\d mm")
        # The coupon's steps are 0.1 mm.
        self.assertRegex(page, r"body\.anchor_hole_mm = [\d.]+ in \+ 0\.00394 in × that number")
        self.assertIn("material.hole_compensation_mm 0.00394 in larger", page)
        self.assertIn("(1 − measured / 3.15 in)", page)

    def test_is_reproducible(self):
        self.expect("kit arm.toml -o one", 0)
        os.environ["TZ"] = "Pacific/Chatham"
        self.expect("kit arm.toml -o two", 0)
        self.assertEqual(self.files("one"), self.files("two"))

    def test_dry_run_writes_nothing(self):
        self.expect("kit arm.toml --dry-run", 0, r"none written \(--dry-run\)")
        self.assertEqual([path.name for path in self.folder.iterdir()], ["arm.toml"])

    def test_colliding_parts_are_refused_with_advice(self):
        self.expect("kit arm.toml --set pulley.EF_mm=60 -o model", 4, "^$", r"pulley\.EF_mm larger by")
        self.assertFalse((self.folder / "model").exists())
        document = self.expect_json("kit arm.toml --set guides.radius_mm=0", 4)
        failed = [condition for condition in document["conditions"] if not condition["ok"]]
        self.assertTrue(any("guides.radius_mm" in condition["message"] for condition in failed))

    def test_advice_builds(self):
        for change in ("pulley.EF_mm=60", "guides.radius_mm=0"):
            document = self.expect_json(f"kit arm.toml --set {change}", 4)
            self.assertTrue(document["advice"], change)
            for advised in document["advice"]:
                self.expect(f"kit arm.toml --set {change} --set {advised['key']}={advised['to']!r} --dry-run", 0)

    def test_infeasible_pulley_is_refused_like_build(self):
        self.expect("kit arm.toml --set pulley.r1_mm=25 -o model", 4, "^$", "try ")
        self.assertFalse((self.folder / "model").exists())

    def test_rejects_ratio_joint(self):
        (self.folder / "ratio.toml").write_text(RATIO)
        for words in ("kit ratio.toml", "build ratio.toml", "rewind ratio.toml part.stl", "analyze ratio.toml"):
            self.expect(words, 3, err=r"ratio.toml: error: a joint with \[transmission\] has no tendons to ")

    def test_keeps_edited_files(self):
        self.expect("kit arm.toml -o model", 0)
        (self.folder / "model/link.stl").write_text("mine")
        self.expect("kit arm.toml -o model", 6, "^$", "link.stl")
        self.assertEqual((self.folder / "model/link.stl").read_text(), "mine")
        self.expect("kit arm.toml -o model --force", 0)

    def test_removes_sleeve_of_earlier_pin(self):
        self.expect("kit arm.toml -o model --set guides.radius_mm=4", 0)
        self.assertIn("pin_b_sleeve.stl", self.files("model"))
        self.expect("kit arm.toml -o model", 0)
        self.assertNotIn("pin_b_sleeve.stl", self.files("model"))

    def test_removes_parts_of_another_joint(self):
        self.expect("kit arm.toml -o model", 0)
        self.expect(f"kit {harness.SOURCE}/profiles/finger_mcp.toml -o model", 0)
        self.assertNotIn("link.stl", self.files("model"))
        self.assertIn("link_template.stl", self.files("model"))

    def test_replays_bundle(self):
        self.expect("kit arm.toml -o model --bundle bug.zip", 0)
        self.expect("replay bug.zip", 0)


if __name__ == "__main__":
    harness.main()

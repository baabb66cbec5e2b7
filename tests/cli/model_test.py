"""`fusee model` from the view of its users: files, refusals, and the header compiled for 32-bit arithmetic."""

import csv
import hashlib
import io
import json
import os
import random
import re
import shutil
import subprocess
import xml.etree.ElementTree

import harness

RATIO = 'schema = 1\nname = "joint"\n[transmission]\nkind = "ratio"\nratio = 4.0\n'
WARNINGS = "-Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Wfloat-conversion -Wshadow -Wundef -Werror -O2".split()
FILES = {"joint.xml", "joint_tendons.xml", "joint.urdf", "joint_ros2_control.urdf", "joint_table.h", "joint_table.json", "manifest.json"}
COMPENSATION = "theta_deg,alpha_up_deg,alpha_down_deg\n" + "".join(f"{t},{4 * t + 0.5},{4 * t - 0.5}\n" for t in range(-25, 26, 5))


class Model(harness.Scratch):
    def compiled(self, body, folder="m", compiler="gcc", standard="c99"):
        """Output of a C program that includes the header of `folder`."""
        suffix = "c" if compiler == "gcc" else "cpp"
        source = self.folder / f"main.{suffix}"
        source.write_text(f'#include "{folder}/joint_table.h"\n#include <stdio.h>\nint main(void) {{\n{body}\n  return 0;\n}}\n')
        subprocess.run([compiler, f"-std={standard}", *WARNINGS, source.name, "-o", "main"], cwd=self.folder, check=True)
        output = subprocess.run(["./main"], cwd=self.folder, check=True, capture_output=True, text=True).stdout
        return [[float(word) for word in line.split()] for line in output.splitlines()]

    def stated(self, folder="m"):
        """The header's stated errors of θ, read from the motor and sent to it."""
        text = (self.folder / folder / "joint_table.h").read_text()
        return [float(x) for x in re.search(r"by\n \*\s+(\S+) deg at most in theta read.*\n \*\s+(\S+) deg at most", text).groups()]

    def test_files_state_their_errors(self):
        document = self.expect_json("model arm.toml -o m", 0)
        files = self.files("m")
        self.assertEqual(set(files), FILES)
        manifest = json.loads(files["manifest.json"])
        self.assertTrue(manifest["checks"] and all(check["ok"] for check in manifest["checks"]))
        for output in manifest["outputs"]:
            self.assertEqual(hashlib.sha256(files[output["file"]]).hexdigest(), output["sha256"])
        for name, error in document["theta_error_deg"].items():
            if name.endswith((".xml", ".urdf")):
                stated = float(re.search(r"misses theta\(alpha\)\s+by\s+(\S+) deg at most", files[name].decode()).group(1))
                self.assertLessEqual(error, stated)
                self.assertLess(stated, 1.2 * error + 2e-6)

    def header_against_transmission_csv(self, spec, name, folder):
        self.expect(f"build {spec} -o {folder}_built -q", 0)
        self.expect(f"model {spec} -o {folder}", 0)
        with open(self.folder / f"{folder}_built/transmission.csv", newline="") as file:
            rows = [(row["alpha_deg"], row["theta_deg"], float(row["r2_mm"]) / float(row["m2_mm"])) for row in csv.DictReader(file)]
        body = "".join(f'  printf("%.9g %.9g %.9g\\n", (double){name}_theta_deg({a}f), (double){name}_alpha_deg({t}f), (double){name}_slope({a}f));\n' for a, t, _ in rows)
        of_theta, returned = self.stated(folder)
        for compiler, standard in (("gcc", "c99"), ("g++", "c++17")):
            for (alpha, theta, slope), (read, sent, g) in zip(rows, self.compiled(body, folder, compiler, standard), strict=True):
                # The CSV has six decimals; requested and reported limits have seven digits.
                rounding = 2e-6 + 6e-8 * (abs(float(alpha)) * slope + abs(float(theta)))
                self.assertLessEqual(abs(read - float(theta)), of_theta + rounding)
                self.assertLessEqual(abs(sent - float(alpha)) * slope, 1.02 * returned + rounding)
                self.assertAlmostEqual(g / slope, 1, 3)

    def test_header_matches_transmission_csv(self):
        self.header_against_transmission_csv("arm.toml", "arm", "m")

    def test_header_matches_multi_turn(self):
        shutil.copy(harness.SOURCE / "profiles/elbow_capstan.toml", self.folder)
        self.header_against_transmission_csv("elbow_capstan.toml", "elbow_capstan", "turns")

    def test_header_is_monotonic_and_clamped(self):
        self.expect("model arm.toml -o m", 0)
        rows = self.compiled('  int i;\n  for (i = -2000; i <= 2000; ++i) printf("%.9g %.9g\\n", (double)arm_theta_deg(0.1f * (float)i), (double)arm_alpha_deg(0.03f * (float)i));\n'
                             '  printf("%.9g %.9g\\n", (double)arm_theta_deg(1e30f), (double)arm_alpha_deg(1e30f));\n'
                             '  printf("%.9g %.9g\\n", (double)arm_theta_deg(0.0f / (float)(i - 2001)), (double)arm_alpha_deg(-1e30f));')
        for before, after in zip(rows[:4000], rows[1:4001]):
            self.assertLessEqual(before[0], after[0])
            self.assertLessEqual(before[1], after[1])
        self.assertEqual([rows[0][0], rows[4001][0]], [-30, 30])
        self.assertEqual(rows[4002][0], -30)  # not a number: it gives an end of the table, and no access outside of it
        self.assertEqual(rows[4002][1], rows[0][1])

    def test_counts_are_continuous(self):
        for ticks, zero in ((4096, 2048), (-4096, 100), (16384, -70000)):
            self.expect(f"model arm.toml -o m --ticks-per-turn {ticks} --zero-ticks {zero} --force", 0)
            rows = self.compiled(f'  int i;\n  for (i = -1200; i <= 1200; ++i) {{\n    const int32_t count = {zero} + i;\n'
                                 '    printf("%d %.9g %d\\n", (int)count, (double)arm_theta_deg(count), (int)arm_count(arm_theta_deg(count)));\n  }\n'
                                 f'  printf("%d %d %d\\n", (int)arm_unwrap(3, {2 * abs(ticks) - 2}), (int)arm_unwrap({abs(ticks) - 1}, -{abs(ticks)}), (int)arm_unwrap(0, -3));\n'
                                 '  printf("%.9g %.9g 0\\n", (double)arm_theta_deg(INT32_MAX), (double)arm_theta_deg(INT32_MIN));')
            self.compiled('  printf("%.9g\\n", (double)arm_slope(0));', "m", "g++", "c++17")
            law = json.loads((self.folder / "m/joint_table.json").read_text())
            sign = 1 if ticks > 0 else -1
            inside = [row for row in rows[:2401] if abs(row[1]) < 29.9]
            self.assertGreater(len(inside), 100)
            for count, theta, back in inside:
                self.assertLessEqual(abs(back - count), 1)
            for before, after in zip(inside, inside[1:]):
                self.assertGreater(sign * (after[1] - before[1]), 0)
            at_home = next(row for row in rows if row[0] == zero)
            self.assertAlmostEqual(at_home[1], 0, 3)
            self.assertEqual(rows[2401], [2 * abs(ticks) + 3, -abs(ticks) - 1, 0])
            for value, expected in zip(rows[2402], (sign * 30, -sign * 30)):
                self.assertAlmostEqual(value, expected, 4)
            self.assertEqual(law["motor_unit"], {"name": "count", "per_turn": ticks, "zero": zero})

    def test_holds_heavy_load(self):
        self.expect("model arm.toml -o m --set load.mass_kg=0.5 --set load.lever_mm=80 --set load.tilt_deg=90", 0)
        rows = self.compiled('  printf("%.9g %.9g\\n", (double)arm_holding_torque_Nmm(0.0f), (double)arm_motor_torque(0.0f, 1.0f));')
        self.assertAlmostEqual(rows[0][0], 0.5 * 9.80665 * 80 * rows[0][1], 2)  # m g lever, N mm, times the slope
        self.assertIn('gravity="-9.80665 ', (self.folder / "m/joint.xml").read_text())

    def test_compensation_has_both_directions(self):
        (self.folder / "c.csv").write_text(COMPENSATION)
        self.expect("model arm.toml -o m --compensation c.csv --set pulley.law=linear --set pulley.ratio=4", 0, "in both directions")
        rows = self.compiled("".join(f'  printf("%.9g %.9g %.9g %.9g\\n", (double)arm_alpha_up_deg({t}.0f), (double)arm_alpha_down_deg({t}.0f), (double)arm_alpha_deg({t}.0f), (double)arm_theta_up_deg({4 * t}.0f));\n'
                                     for t in range(-24, 25, 3)))
        for t, (up, down, middle, theta) in zip(range(-24, 25, 3), rows):
            for value, expected in ((up, 4 * t + 0.5), (down, 4 * t - 0.5), (middle, 4 * t), (theta, t - 0.125)):
                self.assertLess(abs(value - expected), 0.002)

    def test_reports_lines_of_bad_compensation(self):
        for text, message in (("", "fewer than two rows"), ("a,b,c\n1,2,3\n", "c.csv:1:1.*theta_deg"), (COMPENSATION + "26,x,3\n", "c.csv:13:1.*'x'"),
                           (COMPENSATION + "20,90,90\n", "must increase"), (COMPENSATION + "27\n", "is not an angle"), ("\0" * 50, "c.csv:1"), (COMPENSATION + "nan,1,2\n", "c.csv:13")):
            (self.folder / "c.csv").write_text(text)
            self.expect("model arm.toml -o m --compensation c.csv", 3, "^$", message)
        self.expect("model arm.toml -o m --compensation nowhere.csv", 3, "^$", "nowhere.csv")
        self.assertFalse((self.folder / "m").exists())

    def test_identified_joint_has_hysteresis(self):
        document = self.expect_json("model arm.toml -o m --set identified.backlash_deg=2", 0)
        self.assertGreater(document["loop_deg"], 0.1)
        rows = self.compiled('  printf("%.9g %.9g\\n", (double)arm_alpha_up_deg(5.0f), (double)arm_alpha_down_deg(5.0f));')
        self.assertAlmostEqual(rows[0][0] - rows[0][1], 2, 1)  # the play, and the friction of the pins
        declared = self.expect_json("model arm.toml -o m --set identified.backlash_deg=2 --declared", 0)
        self.assertEqual(declared["loop_deg"], 0)

    def test_finds_compensation_of_calibrate(self):
        shutil.copy(self.folder / "arm.toml", self.folder / "corrected.toml")
        (self.folder / "compensation.csv").write_text(COMPENSATION)
        outputs = [{"file": name, "bytes": 0, "sha256": hashlib.sha256((self.folder / name).read_bytes()).hexdigest()} for name in ("corrected.toml", "compensation.csv")]
        self.expect("model corrected.toml -o m", 0, "of the target motion")
        (self.folder / "manifest.json").write_text(json.dumps({"outputs": outputs}))
        self.expect("model corrected.toml -o m", 0, "of compensation.csv")
        self.expect("model corrected.toml -o m --compensation none", 0, "of the target motion")
        (self.folder / "compensation.csv").write_text(COMPENSATION + "# edited\n")
        self.expect("model corrected.toml -o m", 0, "of the target motion")
        for text in ("[]", '{"outputs": 3}', '{"outputs": [1, {"file": 2}]}', "{"):
            (self.folder / "manifest.json").write_text(text)
            self.expect("model corrected.toml -o m --dry-run", 0, "of the target motion")

    def test_coarse_polynomial_is_refused_with_advice(self):
        document = self.expect_json("model arm.toml -o m --max-error-deg 0.001", 4)
        self.assertFalse((self.folder / "m").exists())
        self.assertEqual(len(document["advice"]), 3)
        for advice in document["advice"]:
            option = "--max-error-deg 0.001 " + advice["text"]
            if "key" in advice:
                option = f"--max-error-deg 0.001 --set '{advice['key']}={advice['value']}'"
            elif "max" in advice["text"]:
                option = advice["text"]  # a larger limit
            self.expect(f"model arm.toml -o m --force {option}", 0)
        self.expect("model arm.toml -o m --max-error-deg 0.001", 4, "^$", "theta error of joint.xml would be")
        self.expect("model arm.toml -o m --force --no-polynomial", 0)
        self.assertEqual(set(self.files("m")), FILES - {"joint.xml"})

    def test_coarse_table_is_refused_with_advice(self):
        document = self.expect_json("model arm.toml -o m --max-table-error-deg 0.000001", 4)
        self.assertEqual(len(document["advice"]), 1)
        self.expect(f"model arm.toml -o m {document['advice'][0]['text']}", 0)

    def test_rejects_joint_without_law(self):
        self.expect("model arm.toml -o m --set joint.range_deg=[-89,89]", 4, "^$", "try ")
        (self.folder / "ratio.toml").write_text(RATIO)
        self.expect("model ratio.toml", 3, "^$", r"\[transmission\]")

    def test_reports_infeasible_pulley(self):
        self.expect("model arm.toml -o m --set pulley.r1_mm=25", 0, "", "no pulley can have this law")

    def test_names_are_valid_identifiers(self):
        for name in ('"*/ \\"--> <&\\\\ ??/"', '"42"', '""', '"größe"', '"int"'):
            self.expect(f"model arm.toml -o m --force --set 'name={name}'", 0)
            prefix = re.search(r"(\w+)_slope_table", (self.folder / "m/joint_table.h").read_text()).group(1)
            self.compiled(f'  printf("%.9g\\n", (double){prefix}_theta_deg(1.0f));')
            for file in ("joint.xml", "joint_tendons.xml", "joint.urdf", "joint_ros2_control.urdf"):
                xml.etree.ElementTree.parse(self.folder / "m" / file)
        self.expect("model arm.toml -o m --force --prefix left_elbow", 0)
        self.assertIn("left_elbow_theta_deg(float", (self.folder / "m/joint_table.h").read_text())

    def test_rejects_invalid_options(self):
        for option, message in (("--ticks-per-turn 0", "2 or more"), ("--ticks-per-turn 4096.5", "whole number"), ("--ticks-per-turn 1e9", "from"), ("--zero-ticks 3", "ticks-per-turn"),
                             ("--ticks-per-turn 4096 --zero-ticks 1e30", "from"), ("--max-error-deg 0", "from"), ("--max-error-deg nan", "number"), ("--max-table-error-deg -1", "from"),
                             ("--prefix 3d", "for example"), ("--prefix a-b", "left|a_b"), ("--prefix ''", "prefix"), ("--max-eror-deg 1", "--max-error-deg")):
            self.expect(f"model arm.toml -o m {option}", 2, "^$", message)
        self.expect("model arm.toml -o m --ticks-per-turn 100000000 --zero-ticks 990000000 --set pulley.r1_mm=16", 0)
        self.assertEqual([path.name for path in self.folder.iterdir() if path.name not in ("arm.toml", "m")], [])

    def test_survives_any_options(self):
        numbers = ["0", "-1", "1", "2", "-4096", "4096", "1e-7", "0.001", "1e308", "nan", "inf", "", "x", "4096.5", "99999999"]
        files = ["none", "arm.toml", "nowhere", ".", "/dev/null", ""]
        choice = random.Random(20261122)
        for _ in range(60):
            words = ["model", "arm.toml", "-o", "m", "--force"]
            for option in choice.sample(["--max-error-deg", "--max-table-error-deg", "--ticks-per-turn", "--zero-ticks", "--compensation", "--prefix", "--declared", "--no-polynomial", "--dry-run"], choice.randrange(1, 5)):
                words += [option] if option in ("--declared", "--no-polynomial", "--dry-run") else [option, choice.choice(files if option == "--compensation" else numbers)]
            if choice.random() < 0.3:
                words += ["--set", choice.choice(["joint.range_deg=[-1e-3,1e-3]", "joint.range_deg=[0,5]", "pulley.r1_mm=0.2", "pulley.law=linear", "identified.slack_mm=50", "identified.stretch=1e6", "load.tip_force_N=1e5", "load.mass_kg=1e4"])]
            document = json.loads(self.fusee([*words, "--json"]).stdout)
            self.assertIn(document["exit"], (0, 2, 3, 4), words)
            if document["exit"] == 0 and "--dry-run" not in words:
                self.assertTrue(all(check["ok"] for check in json.loads(self.files("m")["manifest.json"])["checks"]), words)

    def test_is_reproducible_and_a_dry_run_leaves_nothing(self):
        self.expect("model arm.toml -o one", 0)
        os.environ["TZ"] = "Pacific/Chatham"
        self.expect("model arm.toml -o two", 0)
        self.assertEqual(self.files("one"), self.files("two"))
        self.expect("model arm.toml --dry-run", 0, r"none written \(--dry-run\)")
        self.assertFalse((self.folder / "out").exists())

    def test_keeps_edited_files_and_removes_old_ones(self):
        self.expect("model arm.toml -o m", 0)
        self.expect("model arm.toml -o m --no-polynomial", 0)
        self.assertNotIn("joint.xml", self.files("m"))
        (self.folder / "m/joint.urdf").write_text("mine")
        self.expect("model arm.toml -o m", 6, "^$", "joint.urdf")
        self.assertEqual((self.folder / "m/joint.urdf").read_text(), "mine")

    def test_replays_bundle(self):
        self.expect("model arm.toml -o m --bundle bug.zip", 0)
        self.expect("replay bug.zip", 0)


if __name__ == "__main__":
    harness.main()

"""`fusee plan` and `fusee simulate` from the user's view."""

import csv
import json
import os
import re
import unittest

import harness

COLUMNS = ["time_s", "alpha_deg", "theta_deg", "load_N", "tension1_N", "tension2_N", "motor_torque_Nmm", "tension1_joint_N",
           "tension2_joint_N", "loose_deg", "joint_deg", "status"]
RATIO = 'schema = 1\nname = "joint"\n[transmission]\nkind = "ratio"\nratio = 4.0\n'


def rows_of(text):
    return list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))


class Plan(harness.Scratch):
    def test_writes_page_document_and_runs(self):
        document = self.expect_json("plan arm.toml -o bench", 0)
        files = self.files("bench")
        written = json.loads(files["plan.json"])
        for key, value in written.items():
            self.assertEqual(document[key], value, key)
        runs = [step["file"] for step in written["steps"] if step["kind"] == "run"]
        self.assertEqual(set(files), {"plan.json", "plan.html", "manifest.json", *runs})
        self.assertTrue(runs)
        for step in written["steps"]:
            self.assertLessEqual(step["by_minute"], 15 + 1e-9)  # the default of --minutes
        for name in runs:
            rows = rows_of(files[name].decode())
            self.assertTrue(all(row["theta_deg"] == "" and row["alpha_deg"] for row in rows))
        self.assertNotRegex(files["plan.html"].decode(), r'(src|href)=|http://(?!www\.w3\.org)|https://')
        self.assertEqual(files["plan.html"].decode().count('class="box"'), len(written["steps"]))

    def test_page_of_inch_file_is_in_inches(self):
        (self.folder / "inch.toml").write_bytes(self.fusee("new finger_mcp --set units=inch").stdout)
        self.expect("plan inch.toml -o bench --loads 0,5", 0)
        page = (self.folder / "bench/plan.html").read_text()
        self.assertIn("a disc of radius 3.54 in on the joint", page)  # 90 mm
        self.assertNotRegex(page, r"\d mm\b")

    def test_is_reproducible(self):
        self.expect("plan arm.toml -o one", 0)
        os.environ["TZ"] = "Pacific/Chatham"
        self.expect("plan arm.toml -o two", 0)
        self.assertEqual(self.files("one"), self.files("two"))

    def test_unfilled_run_is_reported(self):
        self.expect("plan arm.toml -o bench", 0)
        self.expect("calibrate arm.toml bench/run_1.csv --dry-run", 0, r"not_testable.*no\s+measured\s+rows:\s+theta\s+is\s+empty")

    def test_shorter_plan_removes_runs(self):
        self.expect("plan arm.toml -o bench", 0)
        (self.folder / "bench/mine.csv").write_text("mine")
        self.expect("plan arm.toml -o bench --minutes 2 --loads 0", 0)
        document = json.loads((self.folder / "bench/plan.json").read_text())
        runs = {step["file"] for step in document["steps"] if step["file"]}
        self.assertEqual(set(self.files("bench")), {"plan.json", "plan.html", "manifest.json", "mine.csv", *runs})

    def test_filled_run_is_protected(self):
        self.expect("plan arm.toml -o bench", 0)
        filled = self.folder / "bench/run_1.csv"
        filled.write_text(filled.read_text().replace(",0,\n", ",0,1.5\n"))
        self.expect("plan arm.toml -o bench", 6, "^$", "changed after fusee wrote them: run_1.csv")

    def test_short_time_has_advice(self):
        done = self.expect("plan arm.toml --minutes 0.2", 3, "^$", r"nothing can be measured in 0\.2 minutes: the first run takes .*by minute .*(detects|distinguishes|reduces)")
        self.assertNotIn("Traceback", done.stderr.decode())
        self.assertFalse((self.folder / "out").exists())
        self.assertTrue(self.expect_json("plan arm.toml --minutes 0.2", 3)["more_minutes"])

    def test_rejects_bad_options(self):
        for words in ["--minutes -1", "--minutes nan", "--noise-deg 0", "--noise-deg x", "--loads 1,,2", "--loads nan", "--loads 1e99",
                      "--speeds 0", "--speeds -3", "--range-deg 5", "--range-deg 9,3", "--loads " + ",".join(map(str, range(20)))]:
            with self.subTest(words):
                self.expect(f"plan arm.toml {words}", 2, "^$", "error: ")

    def test_refuses_load_without_equilibrium(self):
        self.expect("plan arm.toml --loads 0,999999", 3, "^$", "no equilibrium under a load of 999999 N.*choose smaller loads: a tendon bears")
        self.assertFalse((self.folder / "out").exists())

    def test_reports_joint_without_law(self):
        self.expect("plan arm.toml --set joint.range_deg=[-170,170]", 4, "^$", "error")

    def test_plans_ratio_joint(self):
        (self.folder / "joint.toml").write_text(RATIO)
        document = self.expect_json("plan joint.toml -o bench --loads 0,2", 0)
        self.assertIn("backlash", [cause["name"] for cause in document["causes"]])
        self.assertEqual({step["load"] for step in document["steps"] if step["kind"] == "run"}, {0, 2})


class Simulate(harness.Scratch):
    def log(self, text, name="log.csv"):
        (self.folder / name).write_text(text)
        return name

    def sweep(self, header="time_s,alpha_deg,load_N", load="5", strokes=6, pace=1.0):
        lines = [header]
        for i in range(60 * strokes + 1):
            share = i % 120 / 60
            alpha = -40 + 80 * (share if share <= 1 else 2 - share)
            lines.append(f"{i / 10 / pace},{alpha:.4f},{load}")
        return self.log("\n".join(lines) + "\n")

    def test_has_one_row_per_log_row(self):
        done = self.expect(f"simulate arm.toml {self.sweep()}", 0, "", "^$")
        rows = rows_of(done.stdout.decode())
        self.assertEqual(list(rows[0]), COLUMNS)
        self.assertEqual(len(rows), 361)  # the first row, and 6 strokes of 60 steps
        self.assertTrue(all(row["status"] == "held" and float(row["tension2_N"]) > 0 for row in rows))
        columns = self.expect_json("simulate arm.toml log.csv", 0)["columns"]
        self.assertEqual(list(columns), COLUMNS)
        self.assertAlmostEqual(columns["theta_deg"][7], float(rows[7]["theta_deg"]), 5)

    def test_simulated_effect_is_identified(self):
        for number, (load, pace) in enumerate([("0", 1.0), ("5", 1.0), ("0", 6.0)], 1):
            self.sweep(load=load, pace=pace)
            self.expect(f"simulate arm.toml log.csv -o run_{number}.csv --noise-deg 0.01 --seed {number} --set identified.backlash_deg=1.5", 0, "rows +361")
        document = self.expect_json("calibrate arm.toml run_1.csv run_2.csv run_3.csv --dry-run", 0)
        found = {effect["name"]: effect for effect in document["effects"]}
        self.assertIn("backlash", found)
        self.assertAlmostEqual(found["backlash"]["parameters"]["width_deg"]["value"], 1.5, delta=0.1)

    def test_corrected_pulley_reduces_error(self):
        self.sweep(load="0")
        def theta(words):
            return self.expect_json(f"simulate arm.toml log.csv {words}", 0)["columns"]["theta_deg"]
        declared, faulty = theta(""), theta("--set identified.pulley_scale_percent=-2")
        corrected = theta("--set identified.pulley_scale_percent=-2 --corrected")
        apart = lambda one, other: max(abs(a - b) for a, b in zip(one, other))
        self.assertGreater(apart(declared, faulty), 0.1)
        self.assertLess(apart(declared, corrected), 0.02 * apart(declared, faulty))

    def test_marks_loose_rows(self):
        self.sweep(load="0")
        done = self.expect("simulate arm.toml log.csv --set identified.slack_mm=4", 0, ",loose\n", "warning: the joint is loose in")
        self.assertTrue(any(float(row["loose_deg"]) > 0 for row in rows_of(done.stdout.decode()) if row["status"] == "loose"))

    def test_marks_rows_beyond_range(self):
        self.log("alpha_deg\n0\n100\n5000\n")
        self.expect("simulate arm.toml log.csv", 5, ",no_equilibrium\n", "error: there is no equilibrium in")

    def test_simulates_planned_runs(self):
        self.expect("plan arm.toml -o bench", 0)
        self.expect("simulate arm.toml bench/run_1.csv -o shown.csv", 0, "tensions")
        self.expect("calibrate arm.toml shown.csv --dry-run", 0)

    def test_files_are_complete(self):
        self.sweep()
        (self.folder / "mine.csv").write_text("mine")
        self.expect("simulate arm.toml log.csv -o mine.csv", 6, "^$", "mine.csv")
        self.assertEqual((self.folder / "mine.csv").read_text(), "mine")
        self.expect("simulate arm.toml log.csv -o mine.csv --force", 0)
        self.expect("simulate arm.toml log.csv -o other.csv --dry-run", 0)
        self.assertFalse((self.folder / "other.csv").exists())

    def test_rejects_bad_logs(self):
        for text, words in [("", "has no header"), ("alpha_deg\n", "no row has alpha"), ("alpha_deg\nnan\n", "no row has alpha"),
                            ("theta_deg\n1\n", "no column alpha_deg"), ("alpha_deg,load_N\n1,x\n", 'log.csv:2:3: error: load_N: "x"'),
                            ("alpha_deg\n1e300\n", "log.csv:2:1: error"), ("\0\1\2", "binary"),
                            ("alpha_deg,joint_sensor_turned_deg\n1,0\n2,90\n", "changes within the run")]:
            with self.subTest(text):
                self.log(text)
                self.expect("simulate arm.toml log.csv", 3, "^$", re.escape(words))
        self.expect("simulate arm.toml none.csv", 3, "^$", "No such file")
        self.expect("simulate arm.toml log.csv --noise-deg -1", 2, "^$", "noise-deg")
        self.expect("simulate arm.toml", 2)


if __name__ == "__main__":
    harness.main()

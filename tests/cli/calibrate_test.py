"""`fusee calibrate` as a person meets it: what it reads, refuses, leaves behind and says."""

import csv
import json
import math

import harness

RATIO = 'schema = 1\nname = "joint"  # mine\n[transmission]\nkind = "ratio"\nratio = 4.0\n'


def run_csv(lash=0.0, strokes=8, rows=60, seed=1):
    """A joint behind a play of `lash` deg of alpha, with a little repeatable noise."""
    lines = ["alpha_deg,theta_deg"]
    pulley, state = -40.0, seed
    for i in range(strokes * rows + 1):
        share = i % (2 * rows) / rows
        alpha = -40 + 80 * (share if share <= 1 else 2 - share)
        pulley = min(max(pulley, alpha - lash / 2), alpha + lash / 2)
        state = (1103515245 * state + 12345) % 2**31
        lines.append(f"{alpha:.4f},{pulley / 4 + 0.02 * (state / 2**31 - 0.5):.5f}")
    return "\n".join(lines) + "\n"


class Calibrate(harness.Scratch):
    def setUp(self):
        super().setUp()
        (self.folder / "joint.toml").write_text(RATIO)
        for i in range(1, 4):
            (self.folder / f"run_{i}.csv").write_text(run_csv(lash=4.0, seed=i))

    def test_it_leaves_every_file_and_the_same_document(self):
        document = self.expect_json("calibrate joint.toml run_1.csv run_2.csv run_3.csv -o out", 0)
        files = self.files("out")
        self.assertEqual(set(files), {"calibration.json", "corrected.toml", "compensation.csv", "report.html", "manifest.json"})
        left = json.loads(files["calibration.json"])
        for key, value in left.items():
            self.assertEqual(document[key], value, key)
        self.assertIn("backlash", [name for effect in left["effects"] for name in effect["group"]])
        self.assertIn(b"# mine", files["corrected.toml"])
        self.assertNotIn(b"http://", files["report.html"].replace(b"http://www.w3.org", b""))
        rows = list(csv.DictReader(files["compensation.csv"].decode().splitlines()))
        self.assertEqual(list(rows[0]), ["theta_deg", "alpha_up_deg", "alpha_down_deg"])
        for row in rows:
            self.assertTrue(all(math.isfinite(float(value)) for value in row.values()))
        middle = rows[len(rows) // 2]
        self.assertAlmostEqual(float(middle["alpha_up_deg"]) - float(middle["alpha_down_deg"]), 4.0, delta=0.3)

    def test_the_folder_has_a_default_and_is_ours_to_write_again(self):
        self.expect("calibrate joint.toml run_1.csv run_2.csv", 0, "joint_calibration")
        self.expect("calibrate joint.toml run_1.csv run_2.csv", 0)
        (self.folder / "out/joint_calibration/report.html").write_text("mine")
        self.expect("calibrate joint.toml run_1.csv run_2.csv", 6, err="report.html")

    def test_the_summary_fits_a_terminal(self):
        text = self.expect("calibrate joint.toml run_1.csv run_2.csv --dry-run", 0, "before +after").stdout.decode()
        self.assertLessEqual(max(len(line) for line in text.splitlines()), 80)
        self.assertFalse((self.folder / "out").exists())

    def test_hold_out_and_columns(self):
        document = self.expect_json("calibrate joint.toml run_1.csv run_2.csv --hold-out run_3.csv --dry-run", 0)
        self.assertEqual(document["held_out"]["runs"], ["run_3.csv"])
        (self.folder / "other.csv").write_text(run_csv().replace("alpha_deg", "motor"))
        self.expect("calibrate joint.toml other.csv", 3, err="other.csv:1:1: error: there is no column alpha_deg")
        self.expect("calibrate joint.toml other.csv --column alpha=motor --dry-run", 0)
        self.expect("calibrate joint.toml other.csv --column alfa=motor", 2, err="did you mean 'alpha'")
        self.expect("calibrate joint.toml other.csv --column motor", 2, err="role=name")

    def test_what_cannot_be_read_or_tested(self):
        self.expect("calibrate joint.toml", 2, err="needs RUN.csv")
        self.expect("calibrate joint.toml nothing.csv", 3, err="no such file")
        (self.folder / "text.csv").write_text("alpha_deg,theta_deg\n1,2\n3,four\n")
        self.expect("calibrate joint.toml text.csv", 3, err='text.csv:3:3: error: theta_deg: "four" is not a number')
        (self.folder / "still.csv").write_text("alpha_deg,theta_deg\n" + "1,2\n" * 50)
        document = self.expect_json("calibrate joint.toml still.csv --dry-run", 0)
        self.assertEqual(document["verdict"], "not_testable")
        self.assertRegex(document["not_testable"][0], "alpha does not change")


if __name__ == "__main__":
    harness.main()

"""`fusee compare` from the user's view: input, refusals, messages and files."""

import json
import unittest

import harness
from calibrate_test import RATIO, run_csv

KEYS = {"schema", "verdict", "summary", "changes", "difference", "noise_floor_deg", "detectable", "runs", "notes"}


class Compare(harness.Scratch):
    def setUp(self):
        super().setUp()
        (self.folder / "joint.toml").write_text(RATIO)
        for folder, lash in (("monday", 2.0), ("tuesday", 2.0), ("friday", 4.0)):  # play, deg of alpha
            (self.folder / folder).mkdir()
            for i in (1, 2):
                (self.folder / folder / f"run_{i}.csv").write_text(run_csv(lash=lash, seed=7 * i + len(folder)))

    def runs(self, folder):
        return f"{folder}/run_1.csv {folder}/run_2.csv"

    def test_reports_grown_play(self):
        line = f"compare joint.toml --before {self.runs('monday')} --after {self.runs('friday')}"
        text = self.expect(line, 0, "play.*grew by.*Cause.*of the difference").stdout.decode()
        self.assertLessEqual(len(text.split("\n\n")[0].split()), 60)
        self.assertNotIn("backlash", text.split("\n\n")[0])
        for row in text.splitlines():
            self.assertLessEqual(len(row), 80, row)
        document = self.expect_json(line, 0)
        self.assertLessEqual(KEYS, set(document))
        self.assertEqual(document["verdict"], "changed")
        (change,) = document["changes"]
        self.assertIn("backlash", change["group"])
        width = change["parameters"]["width_deg"]
        self.assertAlmostEqual(width["change"], 2.0, delta=0.2)
        # Three numbers of six digits, each rounded by half of the fifth decimal at most.
        self.assertAlmostEqual(width["after"] - width["before"], width["change"], delta=1.5e-5)
        self.assertLess(width["ci95"][0], 2.0)
        self.assertGreater(width["ci95"][1], 2.0)
        self.assertLess(document["difference"]["after_rms_deg"], 0.5 * document["difference"]["before_rms_deg"])
        self.assertEqual(document["runs"]["before"], ["monday/run_1.csv", "monday/run_2.csv"])

    def test_reports_no_change(self):
        document = self.expect_json(f"compare joint.toml --before {self.runs('monday')} --after {self.runs('tuesday')}", 0)
        self.assertEqual((document["verdict"], document["changes"]), ("no_change", []))
        self.assertRegex(document["summary"], "^Nothing changed.*would have been seen")
        self.assertTrue(document["detectable"])

    def test_writes_files_to_folder(self):
        line = f"compare joint.toml --before {self.runs('monday')} --after {self.runs('friday')} -o out"
        self.expect(f"{line} --dry-run", 0, "Would be written")
        self.assertFalse((self.folder / "out").exists())
        self.expect(line, 0)
        files = self.files("out")
        self.assertEqual(set(files), {"comparison.json", "report.html", "manifest.json"})
        self.assertEqual(json.loads(files["comparison.json"])["verdict"], "changed")
        self.assertIn(b"What changed", files["report.html"])
        self.assertNotIn(b"http://", files["report.html"].replace(b"http://www.w3.org", b""))
        self.expect(line, 0)  # replaces its own earlier run
        (self.folder / "out/report.html").write_text("mine")
        self.expect(line, 6, err="report.html")

    def test_rejects_runs_of_other_joint(self):
        turned = "\n".join(row if not i else ",".join((row.split(",")[0], str(2 * float(row.split(",")[1])))) for i, row in enumerate(run_csv().split()))
        (self.folder / "other.csv").write_text(turned + "\n")
        line = f"compare joint.toml --before {self.runs('monday')} --after other.csv"
        self.expect(line, 3, err="no two states of one joint")
        self.assertEqual(self.expect_json(line, 3)["verdict"], "not_comparable")

    def test_rejects_wrong_usage_and_files(self):
        self.expect("compare joint.toml", 2, err="compare requires --before")
        self.expect("compare joint.toml --before monday/run_1.csv", 2, err="compare requires --after")
        self.expect("compare --before monday/run_1.csv --after friday/run_1.csv", 2, err="needs SPEC")
        self.expect("compare joint.toml --before none.csv --after friday/run_1.csv", 3, err="none.csv")
        self.expect("compare joint.toml --before monday/run_1.csv --after monday/run_1.csv", 3, err="monday/run_1.csv")
        self.expect("compare joint.toml --before monday/run_1.csv --after friday/run_1.csv --column alfa=a", 2, err="did you mean 'alpha'")


if __name__ == "__main__":
    harness.main()

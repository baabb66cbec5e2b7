"""The module's results equal those of the program: the same figures and bytes."""

import csv
import json
import math
import os
import unittest

import setting
from setting import harness

import numpy as np

import fusee

RUNS = [str(harness.SOURCE / f"profiles/measured/forearm_{i}.csv") for i in (1, 2, 3)]
SEARCHED = """
[optimize]
objective = "max_tension"
variables = ["guides.OE_mm"]
lower = [-45]
upper = [-35]
"""


def in_json(value):
    """A result as JSON has it: with six significant digits."""
    return float(f"{value:.6g}")


class Agreement(harness.Scratch):
    def setUp(self):
        super().setUp()
        # manifest.json contains the path.
        before = os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, before)
        self.arm = fusee.read("arm.toml")

    def same_files(self, mine, folder, without=()):
        theirs = self.files(folder)
        self.assertEqual(list(sorted(mine)), list(theirs))
        for name, data in theirs.items():
            self.assertTrue(name in without or mine[name] == bytes(data), name)

    def test_build_gives_the_same_files(self):
        built = fusee.build(self.arm, "mine")
        self.assertTrue(built.published)
        self.build("theirs")
        self.same_files(built.files, "theirs")
        self.same_files(built.files, "mine")
        answer = self.expect_json("build arm.toml -o theirs", 0)
        self.assertEqual([check["name"] for check in answer["checks"]], [check.name for check in built.checks])
        for theirs, mine in zip(answer["checks"], built.checks):
            self.assertEqual((theirs["value"], theirs["limit"], theirs["ok"]), (mine.value, mine.limit, mine.ok))
        self.assertEqual(answer["as_built"]["max_theta_error_deg"], in_json(math.degrees(built.as_built.max_theta_error_rad)))

    def test_step_file_is_the_same(self):
        answer = self.fusee("build arm.toml -o theirs --step")
        if answer.returncode == 3:
            with self.assertRaisesRegex(fusee.InputError, "STEP"):
                fusee.build(self.arm, step=True)
            self.skipTest("this fusee was built without OpenCASCADE")
        self.same_files(fusee.build(self.arm, step=True).files, "theirs")
        self.assertTrue((self.folder / "theirs/pulley.step").exists())

    def test_settings_give_the_same_files(self):
        arm = self.arm.with_({"pulley.r1_mm": 15, "print.parts": "one", "joint.range_deg": (-25, 25)})
        self.expect('build arm.toml -o theirs --set pulley.r1_mm=15 --set print.parts=one --set "joint.range_deg=[-25, 25]" --dxf r12', 0)
        # The manifest and the head of the report have the settings of the command line.
        self.same_files(fusee.build(arm, dxf="r12").files, "theirs", without={"manifest.json", "report.html"})

    def test_infeasible_joint_has_same_advice(self):
        answer = self.expect_json("build arm.toml --set pulley.r1_mm=25", 4)
        refused = fusee.build(self.arm.with_({"pulley.r1_mm": 25}))
        self.assertEqual([condition["name"] for condition in answer["conditions"]], [condition.name for condition in refused.conditions])
        numbers = [change for change in refused.advice if not isinstance(change.value, str)]
        self.assertEqual([(change["key"], change["to"]) for change in answer["advice"]], [(change.key, change.value) for change in numbers])

    def test_errors_are_the_same(self):
        answer = self.expect_json("build arm.toml --set pulley.r9_mm=25 --set joint.length_mm=-1", 3)["errors"]
        with self.assertRaises(fusee.InputError) as caught:
            self.arm.with_({"pulley.r9_mm": 25, "joint.length_mm": -1})
        mine = [{key: getattr(diagnostic, key) for key in ("file", "line", "column", "message", "hint")} for diagnostic in caught.exception.diagnostics]
        self.assertEqual(mine, answer)

    def test_synthesise_matches_build(self):
        curves = fusee.synthesise(self.arm)
        table = np.genfromtxt(self.build()["transmission.csv"].decode().splitlines(), delimiter=",", names=True)
        for column, mine in (("alpha_deg", np.degrees(curves.stroke.alpha_rad)), ("theta_deg", np.degrees(curves.stroke.theta_rad)),
                             ("r1_mm", curves.stroke.r1_mm), ("r2_mm", curves.stroke.r2_mm)):  # fmt: skip
            self.assertLess(np.max(np.abs(table[column] - mine)), 1e-6, column)

    def test_rewind_gives_the_same_angles(self):
        self.build("out")
        for part in ("pulley.stl", "profile.dxf"):
            answer = self.expect_json(f"rewind arm.toml out/{part}", 0)
            wound = fusee.rewind(self.arm, f"out/{part}")
            self.assertEqual([math.degrees(theta) for theta in wound.theta_rad], [point["theta_deg"] for point in answer["points"]])
            self.assertEqual(list(wound.slack_mm), [point["slack_mm"] for point in answer["points"]])
            self.assertTrue(wound.ok)
        # Curves in memory and in the drawing differ by its arcs, which are within 0.0005 mm.
        curves = fusee.rewind(self.arm, fusee.synthesise(self.arm))
        self.assertLess(abs(curves.max_theta_error_rad - wound.max_theta_error_rad), 5e-5)  # 0.0005 mm over a moment arm above 10 mm
        self.assertEqual([check["value"] for check in self.expect_json("check out/pulley.stl", 0)["checks"]],
                         [check.value for check in fusee.check("out/pulley.stl")])  # fmt: skip

    def test_analyze_gives_the_same_numbers(self):
        answer = self.expect_json("analyze arm.toml --set load.tip_force_N=10 --samples 100 --seed 7", 0)
        mine = fusee.analyze(self.arm.with_({"load.tip_force_N": 10}), samples=100, seed=7)
        self.assertEqual(len(answer["rows"]), len(mine.declared.alpha_rad))
        self.assertEqual([row["alpha_deg"] for row in answer["rows"]], [math.degrees(alpha) for alpha in mine.declared.alpha_rad])
        self.assertEqual([row["r2_mm"] for row in answer["rows"]], list(mine.declared.r2_mm))
        self.assertEqual(len(answer["tolerances"]), len(mine.tolerances))
        self.assertEqual(answer["summary"]["theta_error"]["value_deg"], math.degrees(mine.theta_error_rad.value))
        self.assertEqual(answer["summary"]["safety_factor"], mine.safety_factor)
        self.assertIsNone(mine.motor)

    def test_motor_and_load_are_the_same(self):
        answer = self.expect_json("build arm.toml --dry-run --set load.tip_force_N=10 --set motor.model=MG996R", 0)
        joint = self.arm.with_({"load.tip_force_N": 10, "motor.model": "MG996R"})
        mine = fusee.build(joint).under_load
        self.assertEqual(answer["under_load"]["max_theta_error_deg"], in_json(math.degrees(mine.theta_error_rad.value)))
        self.assertEqual(answer["under_load"]["slack1"], [[in_json(math.degrees(a)) for a in part] for part in mine.slack1_rad])
        self.assertEqual(answer["motor"]["travel"]["needed_deg"], in_json(math.degrees(mine.motor.travel_rad)))
        self.assertEqual(tuple(answer["motor"]["sufficient_models"]), mine.motor.sufficient_models)
        self.assertEqual([change["to"] for change in answer["motor"]["advice"]], [change.value for change in mine.motor.advice if not isinstance(change.value, str)])
        self.assertFalse(mine.motor.ok)
        self.assertIsNone(joint["motor.travel_deg"])
        self.assertEqual(fusee.build(joint.with_({"motor.enforce": True})).status, "infeasible")

    def test_optimize_gives_the_same_file(self):
        with open("arm.toml", "a") as file:
            file.write(SEARCHED)
        answer = self.expect_json("optimize arm.toml -o better.toml", 0)
        best = fusee.optimize(fusee.read("arm.toml"))
        self.assertTrue(best.proven)
        self.assertIn(best.value, set(_numbers(answer)))
        self.assertEqual(best.mechanism.text, (self.folder / "better.toml").read_text())
        self.assertEqual(best.mechanism, fusee.read("better.toml"))

    def test_calibrate_gives_the_same_files(self):
        self.expect(["calibrate", "arm.toml", *RUNS, "--no-audit", "-o", "theirs"], 0)
        found = fusee.calibrate(self.arm, RUNS, "mine", audit=False)
        self.same_files(found.files, "theirs")
        self.same_files(found.files, "mine")
        answer = json.loads((self.folder / "theirs/calibration.json").read_text())
        self.assertEqual(found.verdict, answer["verdict"])
        self.assertEqual([next.kind for next in found.next], [next["kind"] for next in answer["next"]])
        self.assertEqual(found.next[0].keys, (answer["next"][0]["key"],))
        self.assertEqual(found.next[0].separates, tuple(answer["next"][0]["separates"]))
        self.assertEqual(found.corrected, fusee.read("theirs/corrected.toml"))
        self.assertEqual(len(found.residuals), 3)
        for run in found.residuals:
            self.assertEqual(run.before_rad.shape, run.alpha_rad.shape)

    def test_compare_gives_the_same_files(self):
        self.expect(["compare", "arm.toml", "--before", *RUNS[:2], "--after", RUNS[2], "-o", "theirs"], 0)
        compared = fusee.compare(self.arm, RUNS[:2], RUNS[2:], "mine")
        self.same_files(compared.files, "theirs")
        self.same_files(compared.files, "mine")
        answer = json.loads((self.folder / "theirs/comparison.json").read_text())
        self.assertEqual((compared.verdict, compared.summary), (answer["verdict"], answer["summary"]))
        self.assertEqual([change.name for change in compared.changes], [change["name"] for change in answer["changes"]])
        self.assertEqual(compared.difference_rms_deg, answer["difference"]["before_rms_deg"])

    def test_compare_finds_a_moved_zero(self):
        log = {"alpha_deg": np.tile(np.r_[-40:41, 39:-41:-1], 3)}
        theta = fusee.simulate(self.arm, log, noise_deg=0.02).columns["theta_deg"]
        later = fusee.simulate(self.arm, log, noise_deg=0.02, seed=2).columns["theta_deg"] + 0.5
        compared = fusee.compare(self.arm, [{**log, "theta_deg": theta}], [{**log, "theta_deg": later}])
        self.assertEqual(compared.verdict, "changed")
        (change,) = compared.changes
        self.assertIn("zero_offset", change.group)
        for number in change.parameters.values():
            self.assertLess(number.ci95[0], number.change)
            self.assertGreater(number.ci95[1], number.change)

    def test_columns_simulate_like_their_file(self):
        with open(RUNS[0]) as lines:
            rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        columns = {name: [float(row[name]) for row in rows] for name in rows[0]}
        of_file, of_columns = (fusee.simulate(self.arm, log) for log in (RUNS[0], columns))
        self.assertEqual(of_columns.columns, of_file.columns)

    def test_bench_verbs_give_the_same_files(self):
        self.expect("plan arm.toml --minutes 5 -o theirs", 0)
        bench = fusee.plan(self.arm, minutes=5)
        self.same_files(bench.files, "theirs")
        theirs = self.expect("simulate arm.toml theirs/run_1.csv --noise-deg 0.01 --seed 3", 0).stdout.decode()
        moved = fusee.simulate(self.arm, "theirs/run_1.csv", noise_deg=0.01, seed=3)
        self.assertEqual(moved.csv, theirs)
        self.assertEqual(set(moved.status), {"held"})
        self.expect("kit arm.toml -o kit", 0)
        self.same_files(fusee.kit(self.arm).files, "kit")


def _numbers(answer):
    """All fractional numbers of a JSON document."""
    if isinstance(answer, dict):
        for value in answer.values():
            yield from _numbers(value)
    elif isinstance(answer, list):
        for value in answer:
            yield from _numbers(value)
    elif isinstance(answer, float):
        yield answer


if __name__ == "__main__":
    harness.main()

"""Bad input of every kind is an InputError with place and reason; never a crash or another exception."""

import math
import os
import random
import tempfile
import unittest
from pathlib import Path

import setting
from setting import harness

import numpy as np

import fusee

ARM = (harness.SOURCE / "tests/cli/arm.toml").read_text()
LOG = {"alpha_deg": np.linspace(-40, 40, 81), "theta_deg": np.zeros(81)}


class Input(unittest.TestCase):
    def setUp(self):
        self.arm = fusee.read(ARM, name="arm.toml")
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def refused(self, work, *arguments, **options):
        with self.assertRaises(fusee.InputError) as caught:
            work(*arguments, **options)
        self.assertTrue(caught.exception.diagnostics)
        for diagnostic in caught.exception.diagnostics:
            self.assertTrue(diagnostic.message)
        self.assertTrue(str(caught.exception))
        return caught.exception

    def test_reports_all_faults(self):
        error = self.refused(fusee.read, ARM.replace("EB_mm = 50.0", "EB_mm = 'x'").replace("r1_mm", "r9_mm"), name="b.toml")
        places = [(diagnostic.file, diagnostic.line, diagnostic.severity) for diagnostic in error.diagnostics]
        self.assertEqual(len({place for place in places if place[1] > 0}), len(places))
        self.assertGreater(len(places), 1)
        self.assertTrue(all(file == "b.toml" and severity == "error" for file, _, severity in places))
        import pickle

        again = pickle.loads(pickle.dumps(error))
        self.assertEqual((again.diagnostics, str(again)), (error.diagnostics, str(error)))

    def test_rejects_bad_files(self):
        (self.folder / "binary.toml").write_bytes(bytes(range(256)) * 10)
        (self.folder / "large.toml").write_bytes(b"# " + b"x" * 2000000)
        os.mkfifo(self.folder / "pipe.toml")
        for path in ("missing.toml", ".", "binary.toml", "large.toml", "pipe.toml", "\udcff.toml", "x" * 5000):
            with self.subTest(path[:20]):
                self.refused(fusee.read, self.folder / path)
        for wrong in ("", "a\0b", "a = 1\n\0", "\ud800\n", "\n", b"a = 1\n", 3, None, ["x"], 1.5, "[joint\n", "a\n" * 100000):
            with self.subTest(repr(wrong)[:30]):
                self.refused(fusee.read, wrong)
        self.refused(fusee.read, ARM, name="a\0")

    def test_rejects_bad_changes(self):
        wrong = [math.nan, math.inf, -1e300, 10**400, "sixteen", "", [], [1, 2], {}, None, object(), 1j, b"15", True, "\ud800", "\0", np.zeros((2, 2))]
        for value in wrong:
            with self.subTest(repr(value)[:30]):
                self.refused(self.arm.with_, {"pulley.r1_mm": value})
        for key in ("pulley.r2_mm", "r1_mm", "", "pulley", "pulley.r1_mm[0]", "joint.range_deg[2]", "\ud800", "a\0b", "=", "pulley.r1_mm=3\n", 5):
            with self.subTest(repr(key)):
                self.refused(self.arm.with_, {key: 15})
        self.assertIn("did you mean", str(self.refused(self.arm.with_, {"pulley.r1": 15})))
        with self.assertRaises(KeyError):
            self.arm["pulley.r2_mm"]
        with self.assertRaises(KeyError):
            self.arm["\ud800"]
        self.assertNotIn(3, self.arm)

    def test_rejects_bad_arguments(self):
        verbs = {
            fusee.synthesise: {"tolerance_mm": (0, -1, math.nan, 2, "x", None, True, 1j), "steps": (0, 1.5, 10**9, 10**30, "x")},
            fusee.build: {"tolerance_mm": (0, math.inf), "dxf": ("r13", 3, None, []), "max_slack_mm": (-1, "x"), "step": ("no", 1, None), "folder": (3, "a\0", "", b"\0", [])},
            fusee.analyze: {"steps": (1, 3000, 2.0), "samples": (0, 10**9), "seed": (-1, 2**32), "tolerance_mm": (-0.1, 11)},
            fusee.optimize: {"method": ("ga", None, 3), "population": (0, -4, 20000), "generations": (0,), "threads": (-1, 5000)},
            fusee.plan: {"minutes": (-1, math.nan), "loads_N": ((math.inf,), 5, "12", ("x",), range(13)), "range_deg": ((1,), (2, 1), 3, "ab"), "speeds_deg_per_s": ((0,),)},
            fusee.kit: {"tolerance_mm": (0,), "dxf": ("x",)},
        }  # fmt: skip
        for verb, options in verbs.items():
            for name, values in options.items():
                for value in values:
                    with self.subTest(f"{verb.__name__} {name}={value!r}"):
                        self.refused(verb, self.arm, **{name: value})
            for wrong in ("arm.toml", None, 3):
                self.refused(verb, wrong)

    def test_rejects_unsuitable_joints(self):
        jaw = fusee.read("schema = 1\nname = \"jaw\"\n[transmission]\nkind = \"ratio\"\nratio = 2.0\n")
        for verb in (fusee.synthesise, fusee.build, fusee.analyze, fusee.kit):
            self.refused(verb, jaw)
        self.refused(fusee.optimize, self.arm)
        self.refused(fusee.optimize, self.arm, then="nothing")
        searched = fusee.read(ARM + "[optimize]\nobjective = 'max_tension'\nvariables = ['pulley.r1_mm']\nlower = [12]\nupper = [16]\n")
        self.refused(fusee.optimize, searched, method="genetic", then="footprint")
        self.refused(fusee.optimize, searched, method="pareto")
        self.assertTrue(fusee.simulate(jaw, {"alpha_deg": [0.0, 1.0, 2.0]}).exists)

    def test_rejects_bad_parts(self):
        (self.folder / "empty.stl").write_bytes(b"")
        (self.folder / "junk.stl").write_bytes(random.Random(1).randbytes(5000))
        (self.folder / "cube.off").write_text("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n")
        for part in ("empty.stl", "junk.stl", "missing.stl", "."):
            self.refused(fusee.check, self.folder / part)
            self.refused(fusee.rewind, self.arm, self.folder / part)
        self.assertTrue(all(check.ok for check in fusee.check(self.folder / "cube.off")))
        self.refused(fusee.rewind, self.arm, self.folder / "cube.off")
        self.refused(fusee.rewind, self.arm, fusee.synthesise(self.arm.with_({"pulley.r1_mm": 25})))
        self.refused(fusee.rewind, self.arm, fusee.synthesise(self.arm), max_slack_mm=-1)
        for part in (3, None, b"\0"):
            self.refused(fusee.rewind, self.arm, part)

    def test_rejects_bad_logs(self):
        (self.folder / "run.csv").write_text("alpha_deg,theta_deg\n1,x\n")
        logs = [{}, {"alpha_deg": []}, {"alpha_deg": [1, 2], "theta_deg": [1]}, {"alpha_deg": "abc"}, {"alpha_deg": [[1, 2]]},
                {"a,b": [1], "alpha_deg": [1]}, {"theta_deg": [1.0, 2.0]}, {"alpha_deg": [math.nan] * 9}, self.folder / "none.csv", self.folder, 3, None,
                "\0", {"alpha_deg": [None, object()]}, {3: [1]}, {"\ud800": [1.0]}]  # fmt: skip
        for log in logs:
            with self.subTest(repr(log)[:40]):
                self.refused(fusee.simulate, self.arm, log)
                self.refused(fusee.calibrate, self.arm, [log])
        self.refused(fusee.calibrate, self.arm, [self.folder / "run.csv"])
        for runs in ([], LOG, "run.csv", None, 3):
            self.refused(fusee.calibrate, self.arm, runs)
        for runs in ([], LOG, "run.csv", None, 3):
            self.refused(fusee.compare, self.arm, runs, [LOG])
            self.refused(fusee.compare, self.arm, [LOG], runs)
        self.refused(fusee.compare, self.arm, [self.folder / "run.csv"], [LOG])
        self.refused(fusee.calibrate, self.arm, [LOG], columns={"lod": "x"})
        self.refused(fusee.calibrate, self.arm, [LOG], columns={"load": "missing"})
        self.refused(fusee.calibrate, self.arm, [LOG], units={"alpha": "stone"})
        self.refused(fusee.calibrate, self.arm, [LOG], ticks_per_turn={"load": 4096})
        self.refused(fusee.simulate, self.arm, LOG, zero_ticks={"alpha": 4096})
        self.refused(fusee.simulate, self.arm, LOG, home_readings={"load": 1})
        self.refused(fusee.simulate, self.arm, LOG, home_readings={"alpha": float("nan")})

    def test_reports_unwritable_places(self):
        (self.folder / "taken").mkdir()
        (self.folder / "taken/pulley.stl").write_text("mine")
        (self.folder / "file").write_text("")
        for place in ("taken", "file/below"):
            with self.assertRaises(fusee.OutputError) as caught:
                fusee.build(self.arm, self.folder / place)
            self.assertIsInstance(caught.exception, OSError)
        self.assertEqual((self.folder / "taken/pulley.stl").read_text(), "mine")
        self.assertTrue(fusee.build(self.arm, self.folder / "taken", force=True).published)

    def test_survives_any_edit(self):
        chance = random.Random(13)
        words = ["=", "[", "]", "\n", '"', "1e400", "-", "nan", "[joint]", "\0", "é", "\u2028", "'''", "0x", ",", "1979-05-27", "law", "true", "\ud800"]
        outcomes = {True: 0, False: 0}
        for _ in range(1500):
            text = ARM
            for _ in range(chance.randint(1, 4)):
                at = chance.randrange(len(text))
                text = text[:at] + chance.choice([*words, "", ""]) + text[at + chance.choice([0, 1, 1, 2, 8]) :]
            try:
                fusee.read(text + "\n")
                outcomes[True] += 1
            except fusee.InputError as error:
                self.assertTrue(error.diagnostics)
                outcomes[False] += 1
        self.assertTrue(all(count > 100 for count in outcomes.values()), outcomes)

    def test_survives_any_number(self):
        chance = random.Random(13)
        keys = [key for key, value in self.arm.items() if isinstance(value, float) and key.split(".")[0] in ("joint", "guides", "pulley", "tendon")]
        made = 0
        for _ in range(300):
            changes = {chance.choice(keys): chance.choice([0, -1, 1e-9, 1e9, 1, 5, 20, 60, 1000]) for _ in range(chance.randint(1, 3))}
            try:
                curves = fusee.synthesise(self.arm.with_(changes), advice=False)
            except fusee.InputError:
                continue
            made += 1
            self.assertEqual(curves.made, all(condition.ok for condition in curves.conditions), changes)
        self.assertGreater(made, 30)


class Infeasible(unittest.TestCase):
    """An infeasible joint is a value with reasons and advice that builds."""

    def test_advice_builds(self):
        refused = fusee.build(fusee.read(ARM).with_({"pulley.r1_mm": 25}))
        self.assertEqual((refused.status, refused.ok, len(refused.files)), ("infeasible", False, 0))
        self.assertTrue(any(not condition.ok for condition in refused.conditions))
        self.assertGreater(len(refused.advice), 1)
        for change in refused.advice:
            with self.subTest(change.text):
                self.assertTrue(fusee.build(fusee.read(ARM).with_({"pulley.r1_mm": 25}).with_(change.settings)).ok)

    def test_is_reported_by_every_verb(self):
        beyond = fusee.read(ARM).with_({"joint.range_deg": (-170, 170)})
        for verb in (fusee.synthesise, fusee.analyze, fusee.build, fusee.plan, fusee.kit, lambda joint: fusee.simulate(joint, {"alpha_deg": [0.0, 1.0]})):
            answer = verb(beyond)
            self.assertTrue(answer.conditions)
            self.assertFalse(getattr(answer, "exists", getattr(answer, "ok", getattr(answer, "made", True))))


if __name__ == "__main__":
    harness.main()

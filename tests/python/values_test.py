"""Results of the verbs: frozen, views instead of copies, equal by content, unchanged by pickle."""

import dataclasses
import gc
import os
import pickle
import unittest
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import setting
from setting import harness

import numpy as np

import fusee

ARM = (harness.SOURCE / "tests/cli/arm.toml").read_text()


def values_of(arm):
    """One result of each kind."""
    log = {"alpha_deg": np.linspace(-40, 40, 81), "load_N": np.full(81, 5.0)}
    curves = fusee.synthesise(arm)
    return {
        "synthesis": curves,
        "refused": fusee.synthesise(arm.with_({"pulley.r1_mm": 25})),
        "rewound": fusee.rewind(arm, curves),
        "built": fusee.build(arm),
        "not built": fusee.build(arm.with_({"pulley.r1_mm": 25})),
        "analysis": fusee.analyze(arm, samples=50),
        "simulation": fusee.simulate(arm, log),
        "calibration": fusee.calibrate(arm, [{**log, "theta_deg": np.zeros(81)}]),
        "comparison": fusee.compare(arm, [{**log, "theta_deg": np.zeros(81)}], [{**log, "theta_deg": np.ones(81)}]),
        "plan": fusee.plan(arm, minutes=3),
    }


def arrays_in(value):
    """All arrays in a value, however nested."""
    if isinstance(value, np.ndarray):
        yield value
    parts = value.values() if isinstance(value, fusee.Table) else value if isinstance(value, tuple) else ()
    for part in vars(value).values() if dataclasses.is_dataclass(value) else parts:
        yield from arrays_in(part)


def written(arm):
    return dict(fusee.build(arm).files)


INCHES = """schema = 1
units = "inch"
[joint]
length_mm = 3.5
range_deg = [-30, 30]
[guides]
EB_mm = 1.75
ED_mm = 1.75
OE_mm = -1.4
[pulley]
EF_mm = 2.8
r1_mm = 0.56
[tendon]
diameter_mm = "1 mm"
"""


class Inches(unittest.TestCase):
    def test_numbers_are_mm(self):
        arm = fusee.read(INCHES)
        self.assertEqual((arm["units"], arm["joint.length_mm"]), ("inch", 88.9))
        changed = arm.with_({"pulley.r1_mm": 15, "guides.EB_mm": "2 in", "joint.attachment1_mm": (1, np.float64(88))})
        self.assertEqual((changed["pulley.r1_mm"], changed["guides.EB_mm"], changed["joint.attachment1_mm"]), (15.0, 50.8, (1.0, 88.0)))
        self.assertEqual(changed.with_({"joint.attachment1_mm[1]": 80})["joint.attachment1_mm"], (1.0, 80.0))
        bounded = arm.with_({"optimize.variables": ("guides.ED_mm", "joint.range_deg[1]"), "optimize.lower": (40, 20), "optimize.upper": (60, 30)})
        self.assertEqual(bounded["optimize.lower"], (40.0, 20.0))
        self.assertEqual(fusee.read(changed.toml), changed)


class Values(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.arm = fusee.read(ARM, name="arm.toml")
        cls.values = values_of(cls.arm)

    def each(self):
        for name, value in self.values.items():
            with self.subTest(name):
                yield value

    def test_are_immutable(self):
        for value in self.each():
            for name in [part.name for part in dataclasses.fields(value)] + ["novel"]:
                with self.assertRaises((AttributeError, TypeError)):
                    setattr(value, name, 1)
        with self.assertRaises(AttributeError):
            self.arm.path = "other"
        with self.assertRaises(TypeError):
            self.values["built"].files["pulley.stl"] = b""

    def test_angles_are_in_degrees_too(self):
        built, analysis = self.values["built"], self.values["analysis"]
        self.assertEqual(built.as_built.max_theta_error_deg, np.degrees(built.as_built.max_theta_error_rad))
        np.testing.assert_array_equal(built.as_built.theta_deg, np.degrees(built.as_built.theta_rad))
        self.assertFalse(built.as_built.theta_deg.flags.writeable)
        self.assertEqual(analysis.theta_error_deg.value, np.degrees(analysis.theta_error_rad.value))
        self.assertEqual(analysis.theta_error_deg.alpha_deg, np.degrees(analysis.theta_error_rad.alpha_rad))
        self.assertIn("max_theta_error_deg", dir(built.as_built))
        for name in ("max_theta_eror_deg", "_deg", "slack_deg"):
            with self.assertRaisesRegex(AttributeError, f"no attribute '{name}'"):
                getattr(built.as_built, name)

    def test_arrays_are_read_only(self):
        count = 0
        for value in self.each():
            for array in arrays_in(value):
                count += 1
                with self.assertRaises(ValueError):
                    array.flags.writeable = True
                if array.size:
                    with self.assertRaises(ValueError):
                        array[0] = 1
        self.assertGreater(count, 100)

    def test_arrays_are_views(self):
        stroke = self.values["synthesis"].stroke
        self.assertIs(stroke.alpha_rad.base, stroke.r2_mm.base)
        # Rows have many numbers; the strides of a copy would be smaller.
        self.assertGreater(stroke.alpha_rad.strides[0], 8)
        self.assertFalse(stroke.alpha_rad.flags.owndata)
        self.assertFalse(self.values["built"].mesh.triangles.flags.owndata)

    def test_arrays_outlive_their_value(self):
        expected = fusee.synthesise(self.arm).p2.position_mm.copy()
        kept = fusee.synthesise(self.arm).p2.position_mm[5:50, 1]
        gc.collect()
        trash = [fusee.synthesise(self.arm.with_({"pulley.r1_mm": 15})) for _ in range(20)]
        self.assertTrue(np.array_equal(kept, expected[5:50, 1]))
        del trash

    def test_compare_by_content(self):
        again = values_of(self.arm)
        for name, value in self.values.items():
            with self.subTest(name):
                self.assertEqual(value, again[name])
                self.assertEqual(hash(value), hash(again[name]))
                self.assertNotEqual(value, self.arm)
        self.assertNotEqual(self.values["synthesis"], self.values["refused"])
        self.assertNotEqual(fusee.synthesise(self.arm), fusee.synthesise(self.arm.with_({"pulley.r1_mm": 16.0000001})))

    def test_have_short_repr(self):
        for value in self.each():
            self.assertLess(len(repr(value)), 3000)
            self.assertTrue(repr(value).startswith(type(value).__name__ + "("))
            self.assertNotIn("array(", repr(value))

    def test_pickled_values_are_equal(self):
        for value in self.each():
            for protocol in range(2, 6):
                back = pickle.loads(pickle.dumps(value, protocol))
                self.assertEqual(back, value)
                self.assertEqual(repr(back), repr(value))
                self.assertTrue(all(not array.flags.writeable for array in arrays_in(back)))

    def test_arrays_pickle_out_of_band(self):
        buffers = []
        packed = pickle.dumps(self.values["built"], protocol=5, buffer_callback=buffers.append)
        self.assertGreater(len(buffers), 10)
        self.assertEqual(pickle.loads(packed, buffers=buffers), self.values["built"])

    def test_copies_are_frozen(self):
        import copy

        for value in self.each():
            twin = copy.deepcopy(value)
            self.assertEqual(twin, value)
            self.assertTrue(all(not array.flags.writeable for array in arrays_in(twin)))


class Mechanisms(unittest.TestCase):
    def setUp(self):
        self.arm = fusee.read(ARM, name="arm.toml")

    def test_every_key_round_trips(self):
        """Each key of the field table, written back with its value, changes nothing."""
        names = [field["name"] for field in fusee.explain()["fields"]]
        self.assertEqual(names, list(self.arm))
        for key, value in self.arm.items():
            explained = fusee.explain(key)["fields"][0]
            if value is None or (value in ("", 0, ()) and explained["default"] == ""):
                continue  # the file lacks this key's table
            with self.subTest(key):
                self.assertEqual(self.arm.with_({key: value}), self.arm)

    def test_numbers_match_file(self):
        turned = self.arm.with_({"joint.range_deg": (-29.9, 17.3), "load.tip_force_N": 0.1})
        self.assertEqual(turned["joint.range_deg"], (-29.9, 17.3))
        self.assertEqual(turned["load.tip_force_N"], 0.1)
        self.assertEqual(turned.with_({"joint.range_deg[0]": -20, "joint.range_deg[1]": 21})["joint.range_deg"], (-20.0, 21.0))

    def test_accept_python_numbers(self):
        import decimal
        import fractions

        for number in (15, 15.0, np.float64(15), np.float32(15), np.int16(15), fractions.Fraction(15)):
            self.assertEqual(self.arm.with_({"pulley.r1_mm": number})["pulley.r1_mm"], 15.0)
        with self.assertRaises(fusee.InputError):
            self.arm.with_({"pulley.r1_mm": decimal.Decimal(15)})
        self.assertEqual(self.arm.with_({"joint.range_deg": np.array([-20, 20])})["joint.range_deg"], (-20.0, 20.0))

    def test_file_round_trips(self):
        for name in fusee.templates():
            mechanism = fusee.read(harness.SOURCE / f"profiles/{name}.toml")
            self.assertEqual(fusee.read(mechanism.toml, name=mechanism.path), mechanism, name)

    def test_equal_values_have_equal_hashes(self):
        same = fusee.read(ARM + "# another comment\n", name="other.toml")
        self.assertEqual(same, self.arm)
        self.assertEqual(hash(same), hash(self.arm))
        self.assertEqual(self.arm.with_({"load.tip_force_N": -0.0}), self.arm.with_({"load.tip_force_N": 0}))
        self.assertEqual(len({self.arm, same, self.arm.with_({"pulley.r1_mm": 15})}), 2)

    def test_optimized_keep_settings(self):
        text = ARM + "[optimize]\nobjective = 'max_tension'\nvariables = ['guides.OE_mm']\nlower = [-45]\nupper = [-35]\n"
        arm = fusee.read(text).with_({"print.parts": "one", "guides.OE_mm": -38, "load.tip_force_N": 3, "joint.range_deg": (-20, 20)})
        best = fusee.optimize(arm)
        self.assertEqual(best.warnings, ())
        self.assertEqual(best.mechanism, arm.with_(best.numbers))
        self.assertNotEqual(best.mechanism, arm)

    def test_carry_their_files(self):
        import tempfile

        with tempfile.TemporaryDirectory() as folder:
            for name in ("gripper.toml", "gripper_law.csv"):
                with open(os.path.join(folder, name), "wb") as copy:
                    copy.write((harness.SOURCE / "profiles" / name).read_bytes())
            gripper = fusee.read(os.path.join(folder, "gripper.toml"))
            here = fusee.build(gripper)
        back = pickle.loads(pickle.dumps(gripper.with_({"tendon.modulus_MPa": 50000}))).with_({"tendon.modulus_MPa": 40000})
        self.assertEqual(back["pulley.law"], "table")
        self.assertEqual(back, gripper)
        self.assertEqual(fusee.build(back).files["pulley.stl"], here.files["pulley.stl"])


class Anywhere(unittest.TestCase):
    """Results do not depend on thread or process."""

    def setUp(self):
        arm = fusee.read(ARM, name="arm.toml")
        self.arms = [arm, arm.with_({"pulley.r1_mm": 15}), arm.with_({"guides.EB_mm": 55}), arm.with_({"pulley.r1_mm": 25})]
        self.alone = [written(arm) for arm in self.arms]

    def test_threads_build_same_files(self):
        with ThreadPoolExecutor(3) as pool:
            self.assertTrue(list(pool.map(written, self.arms)) == self.alone)

    def test_processes_build_same_files(self):
        with ProcessPoolExecutor(2) as pool:
            self.assertTrue(list(pool.map(written, self.arms)) == self.alone)

    def test_different_verbs_in_parallel_give_same_values(self):
        verbs = [fusee.synthesise, lambda arm: fusee.analyze(arm, samples=50), lambda arm: fusee.plan(arm, minutes=2), fusee.build] * 2
        alone = [verb(self.arms[0]) for verb in verbs]
        with ThreadPoolExecutor(4) as pool:
            self.assertEqual([made.result() for made in [pool.submit(verb, self.arms[0]) for verb in verbs]], alone)


if __name__ == "__main__":
    harness.main()

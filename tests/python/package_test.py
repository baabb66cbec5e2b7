"""The package as a whole: examples, types, and units in names."""

import dataclasses
import doctest
import importlib.util
import inspect
import re
import subprocess
import sys
import unittest

import setting
from setting import harness

import fusee
from fusee import _errors, _mechanism, _run, _values, _verbs

VERBS = ["read", "synthesise", "build", "rewind", "analyze", "optimize", "calibrate", "compare", "simulate", "plan", "kit", "check"]
UNIT = re.compile(r"_(rad|deg|mm|N|Nmm|Nmm_per_rad|rad_per_s|minutes)$|^minutes$")
#: Numbers without a unit, or with it in another member.
PLAIN = {"value", "safety_factor", "was", "limit", "dtheta_dalpha", "normal", "share", "before", "after", "change", "lower_bound", "relative_gap", "ci95", "values"}


def has(module):
    return importlib.util.find_spec(module) is not None


class Package(unittest.TestCase):
    def test_has_version_of_program(self):
        version = harness.fusee("--version", "/").stdout.decode().split()[-1]
        self.assertEqual(fusee.__version__, version)

    def test_verbs_have_examples(self):
        for verb in VERBS:
            with self.subTest(verb):
                words = inspect.getdoc(getattr(fusee, verb))
                self.assertTrue(words)
                if verb not in ("kit", "check"):
                    self.assertIn(">>> import fusee", words)

    def test_examples_run(self):
        attempted = 0
        for module in (fusee, _errors, _mechanism, _run, _values, _verbs):
            result = doctest.testmod(module)
            self.assertEqual(result.failed, 0, module.__name__)
            attempted += result.attempted
        self.assertGreater(attempted, 50)

    def test_all_lists_public_names(self):
        public = {name for name, value in vars(fusee).items() if not name.startswith("_") and not inspect.ismodule(value)}
        self.assertEqual(public | {"__version__"}, set(fusee.__all__))

    def test_names_have_units(self):
        for kind in (value for value in vars(fusee).values() if dataclasses.is_dataclass(value)):
            for part in dataclasses.fields(kind):
                if re.search("Numbers|float", str(part.type)) and not re.search("Table", str(part.type)):
                    self.assertTrue(UNIT.search(part.name) or part.name in PLAIN, f"{kind.__name__}.{part.name}")

    def run_as_program(self, path):
        environment = {**setting.ENVIRONMENT, "PATH": str(path)}
        return subprocess.run([sys.executable, "-m", "fusee", "--version"], env=environment, capture_output=True, text=True, timeout=60)

    def test_package_runs_as_program(self):
        done = self.run_as_program(harness.PROGRAM.parent)
        self.assertEqual((done.returncode, done.stdout), (0, f"fusee {fusee.__version__}\n"), done.stderr)

    def test_missing_program_is_reported(self):
        done = self.run_as_program("/nowhere")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("neither in this package nor on the path", done.stderr)

    def judged(self, arguments):
        return subprocess.run(
            [sys.executable, "-m", *arguments], cwd=setting.PACKAGE, env=setting.ENVIRONMENT, capture_output=True, text=True, timeout=300
        )

    def run_judge(self, arguments):
        done = self.judged(arguments)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    @unittest.skipUnless(has("mypy"), "mypy is not installed")
    def test_types_are_strict(self):
        self.run_judge(["mypy", "--strict", "--cache-dir=/dev/null", "-p", "fusee"])

    @unittest.skipUnless(has("mypy"), "mypy is not installed")
    def test_stubs_match_module(self):
        self.run_judge(["mypy.stubtest", "fusee"])

    @unittest.skipUnless(has("mypy"), "mypy is not installed")
    def test_types_detect_wrong_script(self):
        right = "import fusee\nm = fusee.read('arm.toml')\nx: float = fusee.build(m).as_built.max_slack_mm + m.number('pulley.r1_mm')\n"
        self.run_judge(["mypy", "--strict", "--cache-dir=/dev/null", "-c", right])
        wrong = ["fusee.build('arm.toml')", "fusee.build(m).status = 'done'", "fusee.analyze(m, stepz=3)", "len(fusee.analyze(m).exists)"]
        done = self.judged(["mypy", "--strict", "--cache-dir=/dev/null", "-c", "\n".join(["import fusee", "m = fusee.read('arm.toml')", *wrong])])
        self.assertEqual(re.findall(r"<string>:(\d+): error", done.stdout), [str(line) for line in range(3, 3 + len(wrong))], done.stdout)


if __name__ == "__main__":
    harness.main()

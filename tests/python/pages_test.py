"""Each line of Python in README.md and docs/reference/python.md runs as printed. So does the sweep, in processes and on
Dask."""

import contextlib
import importlib.util
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import setting
from setting import harness

import fusee

PAGES = ["README.md", "docs/reference/python.md"]
SWEEP = harness.SOURCE / "docs/reference/python_sweep.py"


def blocks(page):
    return re.findall(r"^```python\n(.*?)^```", (harness.SOURCE / page).read_text(), re.M | re.S)


class Pages(harness.Scratch):
    def setUp(self):
        super().setUp()
        for folder in ("profiles", "docs"):
            shutil.copytree(harness.SOURCE / folder, self.folder / folder)
        (self.folder / "arm.toml").write_text(fusee.new("forearm"))
        before = os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, before)

    def test_lines_run(self):
        for page in PAGES:
            with self.subTest(page):
                self.assertTrue(blocks(page))
                names = {"__name__": "__main__"}
                for block in blocks(page):
                    printed = io.StringIO()
                    with contextlib.redirect_stdout(printed):
                        exec(compile(block, page, "exec"), names)
                    expected = re.findall(r"print\(.*\)  # (.*)$", block, re.M)
                    for words in expected:
                        self.assertIn(words, printed.getvalue())

    def test_commands_run(self):
        """The commands of docs/reference/python.md, except installations."""
        lines = [line for block in re.findall(r"^```sh\n(.*?)^```", (harness.SOURCE / "docs/reference/python.md").read_text(), re.M | re.S) for line in block.splitlines()]
        ran = 0
        for line in lines:
            if re.search(r"\bpip\b|\.ci/setup|cmake|dask", line):
                continue
            line = line.replace("build/release/python", str(setting.PACKAGE)).replace("python3 ", f"{sys.executable} ", 1)
            done = subprocess.run(["bash", "-c", line], env=setting.ENVIRONMENT, capture_output=True, text=True, timeout=120)
            self.assertEqual(done.returncode, 0, line + done.stderr)
            ran += 1
        self.assertGreater(ran, 0)

    def test_pages_name_existing_members(self):
        for name in re.findall(r"\bfusee\.(\w+)", (harness.SOURCE / "docs/reference/python.md").read_text()):
            self.assertTrue(hasattr(fusee, name) or name in ("toml", "sh"), name)


class Sweep(unittest.TestCase):
    """A small sweep; docs/reference/python.md has the figures of a large one."""

    @classmethod
    def setUpClass(cls):
        spec = importlib.util.spec_from_file_location("python_sweep", SWEEP)
        cls.sweep = importlib.util.module_from_spec(spec)
        sys.modules["python_sweep"] = cls.sweep  # workers import it by name
        spec.loader.exec_module(cls.sweep)
        cls.base = fusee.read(fusee.new("forearm"))
        cls.designs = cls.sweep.designs(300)
        cls.here = cls.sweep.judge_all(cls.base, cls.designs)

    def same(self, figures):
        self.assertEqual(repr(figures), repr(self.here))

    def test_sweep_runs_in_process(self):
        self.assertGreater(sum(figure[0] is None for figure in self.here), 200)
        self.assertGreater(len({figure[0] for figure in self.here}), 1)

    def test_processes_give_same_figures(self):
        self.same(self.sweep.on_futures(self.base, self.designs, 2))

    def test_script_reports_designs(self):
        done = subprocess.run([sys.executable, SWEEP, "50", "2"], env=setting.ENVIRONMENT, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"^50 designs in .* on 2 workers, \d+ can be made\n")

    @unittest.skipUnless(importlib.util.find_spec("distributed"), "Dask is not installed")
    def test_dask_gives_same_figures(self):
        environment = {**setting.ENVIRONMENT, "PYTHONPATH": f"{setting.PACKAGE}:{SWEEP.parent}"}
        text = "import fusee, python_sweep as s\nif __name__ == '__main__':\n    print(repr(s.on_dask(fusee.read(fusee.new('forearm')), s.designs(300), 2)))\n"
        with tempfile.TemporaryDirectory() as folder:
            script = Path(folder, "on_dask.py")  # workers read the script that started them
            script.write_text(text)
            done = subprocess.run([sys.executable, script], cwd=folder, env=environment, capture_output=True, text=True, timeout=180)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.strip(), repr(self.here))


if __name__ == "__main__":
    harness.main()

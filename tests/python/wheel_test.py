"""pip packs an existing build as a wheel for a fresh environment; cmake --install puts the package where Python looks."""

import re
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

import setting
from setting import harness

import fusee

USE = "import fusee; print(fusee.__file__, fusee.__version__, fusee.build(fusee.read(fusee.new('finger'))).status)"
# A wheel includes the module for STEP, if it was built.
HAS_STEP = any(harness.PROGRAM.parent.glob("lib/**/fusee/modules/fusee-step.so"))
USE_FOR_CAD = f"import fusee; print(fusee.build(fusee.read(fusee.new('finger')), step={HAS_STEP}).status)"


def can(*command):
    return subprocess.run([sys.executable, *command], capture_output=True).returncode == 0


class Installed(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        self.environment = {key: value for key, value in setting.ENVIRONMENT.items() if key != "PYTHONPATH"}

    def run_all(self, *commands, **options):
        for command in commands:
            done = subprocess.run([str(word) for word in command], capture_output=True, text=True, env=self.environment, timeout=300, **options)
            self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}\n{done.stderr}")
        return done.stdout.split()

    @unittest.skipUnless(can("-m", "pip", "--version") and can("-c", "import ensurepip"), "pip or venv is not installed")
    def test_pip_installs_wheel(self):
        build = harness.PROGRAM.parent
        pip = [sys.executable, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "--no-index", "-w", self.folder]
        self.run_all([*pip, "--config-settings", f"build-dir={build}", harness.SOURCE], cwd=self.folder)
        (wheel,) = self.folder.glob("*.whl")
        self.assertRegex(wheel.name, rf"^fusee-{re.escape(fusee.__version__)}-cp3\d+-cp3\d+-linux_\w+\.whl$")
        self.assertIn("fusee/py.typed", zipfile.ZipFile(wheel).namelist())
        self.run_all([sys.executable, "-m", "venv", "--system-site-packages", self.folder / "venv"])
        python = self.folder / "venv/bin/python"
        self.run_all([python, "-m", "pip", "install", "--no-index", wheel])
        place, version, status = self.run_all([python, "-c", USE], cwd=self.folder)
        self.assertTrue(place.startswith(str(self.folder)), place)
        self.assertEqual((version, status), (fusee.__version__, "done"))
        self.assertEqual(self.run_all([python, "-c", USE_FOR_CAD], cwd=self.folder), ["done"])
        self.assertEqual(self.run_all([python, "-m", "pip", "show", "fusee"])[:4], ["Name:", "fusee", "Version:", fusee.__version__])
        self.run_all([python, "-m", "pip", "uninstall", "-y", "fusee"])

    def test_cmake_installs(self):
        self.run_all(["cmake", "--install", harness.PROGRAM.parent, "--component", "python", "--prefix", self.folder])
        (package,) = self.folder.glob("lib/python3*/dist-packages")
        self.assertEqual({path.name for path in (package / "fusee").iterdir()}, {path.name for path in setting.PACKAGE.joinpath("fusee").iterdir()} - {"__pycache__"})
        self.environment["PYTHONPATH"] = str(package)
        self.assertEqual(self.run_all([sys.executable, "-c", USE], cwd=self.folder)[1:], [fusee.__version__, "done"])

    def test_package_uses_debian_path(self):
        self.environment["DESTDIR"] = str(self.folder)
        self.run_all(["cmake", "--install", harness.PROGRAM.parent, "--component", "python", "--prefix", "/usr"])
        self.assertTrue((self.folder / "usr/lib/python3/dist-packages/fusee/__init__.py").exists())


if __name__ == "__main__":
    harness.main()

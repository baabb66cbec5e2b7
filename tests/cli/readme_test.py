"""Every command that README.md and profiles/calibration.md show works as it is written, in its order, in a copy of the source tree.

The two that install packages and compile are run by .ci/run in a fresh clone; here their place is taken by the program under test.
"""

import os
import re
import shutil
import subprocess

import harness


PAGES = ["README.md", "profiles/calibration.md", "profiles/model.md", "profiles/physics.md", "profiles/guarantees.md"]


def commands(page="README.md"):
    blocks = re.findall(r"^```sh\n(.*?)^```", (harness.SOURCE / page).read_text(), re.M | re.S)
    return [line for block in blocks for line in block.replace("\\\n", " ").splitlines() if line and not line.startswith("#")]


class Readme(harness.Scratch):
    def test_starts_with_the_two_commands_that_set_everything_up(self):
        first, second = commands()[:2]
        self.assertRegex(first, r"^\.ci/setup && .*build/release/fusee build profiles/paper_optimum\.toml$")
        self.assertRegex(second, r"^\.ci/setup tests && ")

    def setUp(self):
        super().setUp()
        os.makedirs(self.folder / "build/release")
        os.symlink(harness.PROGRAM, self.folder / "build/release/fusee")
        shutil.copytree(harness.SOURCE / "profiles", self.folder / "profiles")

    def run_all(self, lines):
        self.assertTrue(lines)
        for line in lines:
            with self.subTest(line):
                done = subprocess.run(["bash", "-c", line], cwd=self.folder, env=harness.ENVIRONMENT, capture_output=True, timeout=120)
                self.assertEqual(done.returncode, 0, done.stdout.decode() + done.stderr.decode())

    def test_commands(self):
        first = commands()[0].split("&&")[-1]
        self.run_all([first, *commands()[2:]])

    def test_commands_of_calibration(self):
        # A real joint's data are not ours to keep: a variable names their folder.
        self.run_all([line for line in commands("profiles/calibration.md") if "$FUSEE_DAVINCI_JAW" not in line or "FUSEE_DAVINCI_JAW" in os.environ])

    def test_files_they_link_to_exist(self):
        for page in PAGES:
            for target in re.findall(r"\]\(([^)#]+)\)", (harness.SOURCE / page).read_text()):
                if "://" not in target:
                    self.assertTrue((harness.SOURCE / page).parent.joinpath(target).exists(), f"{page}: {target}")


if __name__ == "__main__":
    harness.main()

"""Every command that README.md shows works as it is written, in its order, in a copy of the source tree.

The two that install packages and compile are run by .ci/run in a fresh clone; here their place is taken by the program under test.
"""

import os
import re
import shutil
import subprocess

import harness


def commands():
    blocks = re.findall(r"^```sh\n(.*?)^```", (harness.SOURCE / "README.md").read_text(), re.M | re.S)
    return [line for block in blocks for line in block.replace("\\\n", " ").splitlines() if line and not line.startswith("#")]


class Readme(harness.Scratch):
    def test_starts_with_the_two_commands_that_set_everything_up(self):
        first, second = commands()[:2]
        self.assertRegex(first, r"^\.ci/setup && .*build/release/fusee build profiles/paper_optimum\.toml$")
        self.assertRegex(second, r"^\.ci/setup tests && ")

    def test_commands(self):
        os.makedirs(self.folder / "build/release")
        os.symlink(harness.PROGRAM, self.folder / "build/release/fusee")
        shutil.copytree(harness.SOURCE / "profiles", self.folder / "profiles")
        first = commands()[0].split("&&")[-1]
        for line in [first, *commands()[2:]]:
            with self.subTest(line):
                done = subprocess.run(["bash", "-c", line], cwd=self.folder, env=harness.ENVIRONMENT, capture_output=True, timeout=120)
                self.assertEqual(done.returncode, 0, done.stdout.decode() + done.stderr.decode())

    def test_files_it_links_to_exist(self):
        for target in re.findall(r"\]\(([^)#]+)\)", (harness.SOURCE / "README.md").read_text()):
            if "://" not in target:
                self.assertTrue((harness.SOURCE / target).exists(), target)


if __name__ == "__main__":
    harness.main()

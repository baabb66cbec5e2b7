"""Every example of --help works as printed, in the order of the help."""

import re
import subprocess
import unittest

import harness


class Examples(harness.Scratch):
    def examples(self, command):
        text = self.fusee(f"{command} --help").stdout.decode()
        lines = re.findall(r"^  (fusee .*?)(?:   .*)?$", text.split("examples:\n")[1], re.M)
        self.assertGreaterEqual(len(lines), 2, f"'{command}' needs examples")
        return lines

    def test_examples_succeed(self):
        self.fusee("build arm.toml -o earlier")
        (self.folder / "earlier/pulley.3mf").rename(self.folder / "pulley.3mf")
        (self.folder / "arm.toml").unlink()  # the examples create their own
        for command in ["", "new", "explain", "analyze", "build", "check", "rewind", "optimize", "reproduce", "plan", "kit", "model", "simulate", "replay", "completion", "manual"]:
            for line in self.examples(command):
                with self.subTest(line):
                    # Enter takes each proposal of --ask, which has seven questions.
                    done = subprocess.run(["bash", "-c", line], cwd=self.folder, env=harness.ENVIRONMENT, input=b"\n" * 7, capture_output=True, timeout=120)
                    self.assertEqual(done.returncode, 0, done.stderr.decode())
                    if command == "reproduce":  # its width is tested here only: it takes long
                        self.assertLessEqual(max(map(len, done.stdout.decode().splitlines()), default=0), 80)

    def test_help_fits_terminal(self):
        for command in ["", "new", "explain", "analyze", "build", "check", "rewind", "optimize", "reproduce", "calibrate", "compare", "plan", "kit", "simulate", "replay", "completion", "manual"]:
            for line in self.fusee(f"{command} --help").stdout.decode().splitlines():
                self.assertLessEqual(len(line), 80, line)

    def test_results_fit_terminal(self):
        for command in ["", "new", "explain", "explain pulley.friction", "analyze arm.toml", "build arm.toml", "check out/arm/plates.dxf",
                        "rewind arm.toml out/arm/pulley.stl", "plan arm.toml", "kit arm.toml"]:
            for line in self.fusee(command).stdout.decode().splitlines():
                self.assertLessEqual(len(line), 80, f"{command}: {line}")


if __name__ == "__main__":
    harness.main()

"""`fusee new --ask`: answers become a file with a feasible pulley; invalid answers are asked again, a limited number of
times."""

import os
import pty
import select
import signal
import subprocess
import time
import unittest

import harness


class Questions(harness.Scratch):
    def ask(self, typed, code=0, words="new --ask"):
        done = self.fusee(words, input=typed)
        self.assertEqual(done.returncode, code, done.stderr.decode(errors="replace"))
        return done.stdout.decode(), done.stderr.decode(errors="replace")

    def builds(self, text):
        (self.folder / "asked.toml").write_text(text)
        self.expect("build asked.toml --dry-run", 0)

    def test_proposals_build(self):
        text, asked = self.ask(b"\n" * 6)
        self.assertRegex(text, r"(?m)^length_mm = 60$")
        self.assertRegex(text, r"(?m)^range_deg = \[-30, 30\]")
        self.assertEqual([f"{n}/6 " in asked for n in range(1, 7)], [True] * 6)
        self.assertIn("a pulley is feasible", asked)
        self.assertEqual(text, self.ask(b"")[0])  # the end of the input acts like Enter
        self.builds(text)

    def test_file_has_answers(self):
        text, asked = self.ask(b'a "left" finger\n32\n-15, 45\n0.56\n12.5\nn20-d3\n')
        for line in ('name = "a \\"left\\" finger"', "length_mm = 32", "range_deg = [-15, 45]", "diameter_mm = 0.56",
                     "tip_force_N = 12.5", 'shaft = "n20-d3"'):
            self.assertIn("\n" + line + "\n", text)
        # A number without a question had to change, which is reported.
        self.assertRegex(asked, r"changed to make a pulley feasible: \S+ [≥≤] ")
        self.builds(text)

    def test_invalid_answers_are_repeated(self):
        text, asked = self.ask(b"arm\nsixty\n-3\n60 70\n60\n30 -30\n10 30\n-20 20\n\n\n\n")
        for words in ("'sixty' is not a number", "-3 mm is not within", "give one number", "the lower end comes first", "home, at 0"):
            self.assertIn(words, asked)
        self.assertIn("range_deg = [-20, 20]", text)

    def test_gives_up_after_invalid_answers(self):
        for typed in (b"nonsense\n" * 1000, bytes(100_000), bytes(range(256)) * 40, b"9" * 100_000):
            out, err = self.ask(typed, code=3)
            self.assertEqual(out, "")
            self.assertIn("was not answered in 5 tries", err)

    def test_infeasible_answers_are_reported(self):
        text, asked = self.ask(b"big\n40\n-20 90\n\n\n\n")
        self.assertIn("range_deg = [-20, 90]", text)
        self.assertRegex(asked, r"no pulley yet: .*\n(.*\n)*.*try joint\.range_deg\[1\] = ")

    def test_rejects_other_arguments(self):
        self.assertIn("takes no template", self.ask(b"", 2, "new forearm --ask")[1])
        self.assertIn("which a bundle cannot record", self.ask(b"", 2, "new --ask --bundle b.zip")[1])
        self.assertIn("min_wall_mm = 2.5", self.ask(b"", 0, "new --ask --set body.min_wall_mm=2.5")[0])
        self.assertIn("length_mm = 60\n", self.expect_json("new --ask", 0)["text"])

    def test_signal_ends_question(self):
        ours, theirs = pty.openpty()
        process = subprocess.Popen([harness.PROGRAM, "new", "--ask"], stdin=theirs, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   cwd=self.folder, env=harness.ENVIRONMENT)
        self.assertTrue(select.select([process.stderr], [], [], 20)[0])
        begun = time.monotonic()
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=20)
        os.close(ours)
        os.close(theirs)
        self.assertEqual((process.returncode, out), (130, b""))
        self.assertLess(time.monotonic() - begun, 10)


if __name__ == "__main__":
    harness.main()

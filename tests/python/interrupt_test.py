"""Ctrl-C during a verb takes effect at once and leaves no partial output; other threads run while a verb works."""

import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import setting
from setting import harness

import fusee

ARM = (harness.SOURCE / "tests/cli/arm.toml").read_text()
#: Seconds: 0.2 are promised, and a busy machine may take 0.3 more to wake a thread.
LONGEST = 0.2 + 0.3

#: Works until it is interrupted. Prints the seconds from the signal to KeyboardInterrupt, and to the end of the work.
PROGRAM = """
import os, signal, sys, threading, time
import fusee
arm = fusee.read({arm!r})
runs = [{folder!r} + "/forearm_%d.csv" % i for i in range(1, 6)]
out = {out!r}
sent = []
def send():
    sent.append(time.perf_counter())
    os.kill(os.getpid(), signal.SIGINT)
threading.Timer({after}, send).start()
try:
    while True:
        {work}
except KeyboardInterrupt:
    print("heard", time.perf_counter() - sent[0])
for thread in threading.enumerate():
    if thread is not threading.current_thread():
        thread.join()
print("ended", time.perf_counter() - sent[0])
"""

WORK = {
    "calibrate": "fusee.calibrate(arm, runs)",
    "calibrate into a folder": "fusee.calibrate(arm, runs, out, force=True)",
    "compare": "fusee.compare(arm, runs[:1], runs[1:])",
    "build": "fusee.build(arm, out, force=True)",
    "build with advice": "fusee.build(arm.with_({'pulley.r1_mm': 25}))",
    "analyze": "fusee.analyze(arm, samples=100000)",
    "plan": "fusee.plan(arm, minutes=60)",
    "kit": "fusee.kit(arm, out, force=True)",
    "optimize": "fusee.optimize(arm, method='genetic', generations=100000)",
    "many short ones": "fusee.synthesise(arm)",
}

SEARCHED = """
[optimize]
objective = "max_tension"
variables = ["guides.OE_mm", "guides.EB_mm", "pulley.r1_mm"]
lower = [-60, 40, 12]
upper = [-20, 70, 17]
"""


class Interrupt(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def run_program(self, work, after, out):
        text = PROGRAM.format(arm=ARM + SEARCHED, folder=str(harness.SOURCE / "profiles/measured"), out=str(out), after=after, work=work)
        done = subprocess.run([sys.executable, "-c", text], cwd=self.folder, env=setting.ENVIRONMENT, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        return {name: float(seconds) for name, seconds in (line.split() for line in done.stdout.splitlines())}

    def test_takes_effect_at_once(self):
        for name, work in WORK.items():
            with self.subTest(name):
                output = self.run_program(work, 0.3, self.folder / "out")
                self.assertLess(output["heard"], LONGEST)
                # The work may continue in the background, but not for long: it uses a processor.
                self.assertLess(output["ended"], 5)

    def test_leaves_complete_folder_or_none(self):
        whole = set(fusee.build(fusee.read(ARM)).files)
        for i in range(5):
            out = self.folder / f"out_{i}"
            self.run_program(WORK["build"], 0.15 + 0.09 * i, out)
            if out.exists():
                self.assertEqual({path.name for path in out.iterdir()}, whole)
        left = {path.name for path in self.folder.iterdir() if not path.name.startswith("out_")}
        self.assertEqual(left, set())

    def test_ctrl_c_ends_script(self):
        text = f"import fusee, os, signal, threading\narm = fusee.read({ARM!r})\n" \
               "threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()\nwhile True: fusee.analyze(arm, samples=20000)"
        done = subprocess.run([sys.executable, "-c", text], env=setting.ENVIRONMENT, capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, -signal.SIGINT)
        self.assertIn("KeyboardInterrupt", done.stderr)


class Lock(unittest.TestCase):
    def test_is_released_by_every_verb(self):
        """A thread that counts time runs while each verb works."""
        arm = fusee.read(ARM)
        curves = fusee.synthesise(arm)
        refused = arm.with_({"pulley.r1_mm": 25})
        verbs = {
            "synthesise": lambda: fusee.synthesise(refused),
            "rewind": lambda: [fusee.rewind(arm, curves) for _ in range(50)],
            "build": lambda: fusee.build(arm),
            "analyze": lambda: fusee.analyze(arm, samples=3000),
            "plan": lambda: fusee.plan(arm),
            "kit": lambda: fusee.kit(arm),
            "simulate": lambda: fusee.simulate(arm, {"alpha_deg": [i % 60 for i in range(3000)]}),
            "optimize": lambda: fusee.optimize(fusee.read(ARM + SEARCHED), method="genetic", generations=20),
        }
        for name, verb in verbs.items():
            with self.subTest(name):
                # A busy machine may stop the counter sometimes, but not each time.
                shares = []
                while len(shares) < 6 and min(shares, default=1) > 0.5:
                    shares.append(self.longest_pause(verb))
                self.assertLess(min(shares), 0.5)

    def longest_pause(self, verb):
        """The longest time in which a parallel thread does not run, as a share of the verb's duration."""
        ticks = []
        stop = threading.Event()

        def count():
            while not stop.wait(0.001):
                ticks.append(time.perf_counter())

        counter = threading.Thread(target=count)
        counter.start()
        start = time.perf_counter()
        verb()
        end = time.perf_counter()
        stop.set()
        counter.join()
        within = [tick for tick in ticks if start < tick < end]
        return max(b - a for a, b in zip([start, *within], [*within, end])) / (end - start)

    def test_kept_lock_is_detected(self):
        before = sys.getswitchinterval()
        sys.setswitchinterval(100)  # like a verb that keeps the lock
        try:
            self.assertGreater(self.longest_pause(lambda: [i * i for i in range(2000000)]), 0.5)
        finally:
            sys.setswitchinterval(before)


if __name__ == "__main__":
    harness.main()

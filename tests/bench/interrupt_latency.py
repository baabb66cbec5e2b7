"""How soon each command ends after one SIGINT, at random moments of its run: on the clock, and in seconds of processor
used after the signal, which other programs on the machine do not change.

usage: interrupt_latency.py FUSEE [MOMENTS=50] [COMMAND ...]
(build, giant: of 1 m in fine facets, refused_giant, kit, model, check, rewind, analyze, certified, ga, pareto, replay,
refused, plan, simulate, calibrate, reproduce)

Some runs of a short command are over before the signal: the table counts them. Ends with 1 if a run took more than
0.2 s of processor. It also ends with 1 if a run ended otherwise than interrupted (130), done (0) or refused (4), or by
SIGINT itself before the program handles signals.
"""

import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIMIT = 0.2
TICK = os.sysconf("SC_CLK_TCK")


def processor_of(pid):
    """Processor time of a process with all its threads so far, s."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / TICK


def start(command):
    return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL)


def length_of(command):
    begun = time.monotonic()
    start(command).wait()
    return time.monotonic() - begun


def interrupted_at(command, moment):
    """Wall time and processor time after the signal, s, and the exit status; None if the command ended before it."""
    child = start(command)
    time.sleep(moment)
    if child.poll() is not None:
        return None
    before, sent = processor_of(child.pid), time.monotonic()
    child.send_signal(signal.SIGINT)
    _, status, usage = os.wait4(child.pid, 0)
    clock = time.monotonic() - sent
    child.returncode = os.waitstatus_to_exitcode(status)
    return clock, usage.ru_utime + usage.ru_stime - before, child.returncode


def commands(fusee, folder):
    spec = str(ROOT / "profiles/forearm.toml")
    log = str(min(pathlib.Path(folder).glob("plan/run_*.csv")))
    out = ["-o", f"{folder}/out", "--force"]
    box = [("optimize.variables", '["pulley.r1_mm","guides.EB_mm","guides.ED_mm","guides.OE_mm","pulley.EF_mm","joint.length_mm"]'),
           ("optimize.lower", "[14,45,45,-60,70,90]"), ("optimize.upper", "[18,60,60,-30,90,110]")]
    search = [fusee, "optimize", spec, *(word for key, value in box for word in ("--set", f"{key}={value}"))]
    return {
        "build": [fusee, "build", str(ROOT / "profiles/paper_optimum.toml"), *out],
        "giant": [fusee, "build", f"{folder}/giant.toml", *out, "--tolerance-mm", "0.001"],
        "refused_giant": [fusee, "build", f"{folder}/giant.toml", *out, "--tolerance-mm", "0.001",
                          "--set", "body.bore_diameter_mm=280"],
        "kit": [fusee, "kit", str(ROOT / "profiles/paper_optimum.toml"), *out],
        "model": [fusee, "model", str(ROOT / "profiles/paper_optimum.toml"), *out],
        "check": [fusee, "check", f"{folder}/fine/pulley.stl"],
        "rewind": [fusee, "rewind", str(ROOT / "profiles/paper_optimum.toml"), f"{folder}/fine/pulley.stl"],
        "analyze": [fusee, "analyze", spec, "--steps", "2000", "--samples", "20000"],
        "certified": [*search, "--method", "certified"],
        "ga": [*search, "--method", "ga", "--set", "optimize.feasible=true"],
        "pareto": [*search, "--method", "pareto", "--set", 'optimize.objective=["max_tension","footprint"]'],
        "replay": [fusee, "replay", f"{folder}/bug.zip"],
        "refused": [fusee, "build", str(ROOT / "tests/data/refused.toml"), *out],
        "plan": [fusee, "plan", spec, *out],
        "simulate": [fusee, "simulate", spec, log, "-o", f"{folder}/sim.csv", "--force"],
        "calibrate": [fusee, "calibrate", spec, *sorted(map(str, pathlib.Path(folder).glob("sim_*.csv"))), *out],
        "reproduce": [fusee, "reproduce", *out],
    }


GIANT = """schema = 1
name = "giant"
[joint]
length_mm = 1000.0
range_deg = [-30.0, 30.0]
[guides]
EB_mm = 500.0
ED_mm = 500.0
OE_mm = -400.0
radius_mm = 8.0
[pulley]
EF_mm = 800.0
r1_mm = 160.0
[tendon]
diameter_mm = 4.0
"""


def prepare(fusee, folder):
    """A large design, a part in fine facets with its bundle, a plan, and simulated runs of the forearm for calibration."""
    pathlib.Path(folder, "giant.toml").write_text(GIANT)
    spec = str(ROOT / "profiles/forearm.toml")
    fine = [fusee, "build", str(ROOT / "profiles/paper_optimum.toml"), "-o", f"{folder}/fine", "--tolerance-mm", "0.001"]
    subprocess.run([*fine, "--bundle", f"{folder}/bug.zip", "-q"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run([fusee, "plan", spec, "-o", f"{folder}/plan", "-q"], check=True, stdout=subprocess.DEVNULL)
    for run in sorted(pathlib.Path(folder).glob("plan/run_*.csv"))[:3]:
        command = [fusee, "simulate", spec, str(run), "-o", f"{folder}/sim_{run.name}", "-q"]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def main():
    fusee, moments = shutil.which(sys.argv[1]) or sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 50
    wanted, rng, faults = sys.argv[3:], random.Random(11), 0
    with tempfile.TemporaryDirectory() as folder:
        prepare(fusee, folder)
        print("command      whole run  signals  over before   clock median   largest   processor median   largest  exits")
        for name, command in commands(fusee, folder).items():
            if wanted and name not in wanted:
                continue
            length = length_of(command)
            found = [interrupted_at(command, rng.uniform(0.02, length)) for _ in range(moments)]
            heard = [each for each in found if each]
            clock, processor = sorted(each[0] for each in heard), sorted(each[1] for each in heard)
            exits = sorted({each[2] for each in heard})
            if not heard:
                continue
            print(f"{name:12} {length:7.2f} s {len(heard):8} {len(found) - len(heard):12} {clock[len(clock) // 2]:12.3f} s {clock[-1]:7.3f} s"
                  f" {processor[len(processor) // 2]:16.3f} s {processor[-1]:7.3f} s  {exits}", flush=True)
            faults += processor[-1] > LIMIT or not set(exits) <= {130, 0, 4, -signal.SIGINT}
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""`fusee calibrate` and scipy.optimize.least_squares on the same runs, in the same run of this script.

    calibrate_peers.py FUSEE [BENCH_FIT]

BENCH_FIT is the program of fit_bench.cpp, by default the one in FUSEE's build. Requires numpy and scipy.

The runs are of a joint whose sensor has a gain error and whose motor has play. scipy is given the effects (gain, play and zero) and fits them once
to all rows, over an independent forward model in numpy: exact kinematics over pins with radius, and a play operator. fusee reads the files,
estimates the noise floor, tests all effects and pairs with an elastic model with friction and held-out runs, searches unmodelled
alternatives, and writes the correction and a report. So the first ratio compares a whole calibration with one fit of three known parameters;
divided by the number of candidates it is the cost of one of them. The script fails if fusee's residual is more than 5 % larger than scipy's.

The second comparison is of fits: BENCH_FIT fits the same three parameters with elastic model, friction and discrepancy. scipy then fits them over
the same forward model (predict() through a pipe, the same rows), and over its own kinematic one.
"""

import json
import os
import subprocess
import sys
import tempfile
import time

import numpy as np
from scipy.optimize import least_squares

# Lengths of the joint, mm: pin radius PIN, tendon diameter TENDON, ED = EB.
R, EB, OE, EF, PIN, R1, TENDON = 40.0, 18.0, -14.0, 40.0, 1.0, 6.0, 0.8
SPEC = f"""schema = 1
name = "peer"
[joint]
length_mm = {R}
range_deg = [-30.0, 30.0]
[guides]
EB_mm = {EB}
ED_mm = {EB}
OE_mm = {OE}
radius_mm = {PIN}
friction = 0.1
[pulley]
EF_mm = {EF}
r1_mm = {R1}
[tendon]
diameter_mm = {TENDON}
modulus_MPa = 200000.0
pretension_N = 4
"""
RUNS, ROWS, STROKES, NOISE = 5, 500, 6, 0.02  # rows and strokes of a run; sensor noise, deg
GAIN, PLAY = 0.015, 2.0  # hidden gain error of the sensor; hidden play of the motor, deg
# The first guess and the scale of gain, play (rad) and zero (rad).
START, SCALE = np.array([0.0, np.radians(0.5), 0.0]), np.array([1e-3, 1e-2, 1e-3])


def path_length(theta):
    """Length of the free tendon on side 1 from C over pin B to the point where it leaves the pin for the pulley, mm.
    The other part is constant."""
    rho = PIN + TENDON / 2
    cx, cy = R * np.sin(theta), R * np.cos(theta)
    dx, dy = cx + EB, cy + OE
    distance = np.hypot(dx, dy)
    # The tendon passes the outer side of the pin: a straight part, and an arc up to the lower part.
    return np.sqrt(distance**2 - rho**2) + rho * (np.arcsin(rho / distance) + np.arctan2(dx, dy))


GRID = np.radians(np.linspace(-60, 60, 4001))
LENGTH = path_length(GRID) - path_length(0.0)


def joint_angle(alpha):
    """θ at which a round P1 of radius r1 has paid out as much of tendon 1 as its path has grown. α > 0 pays out tendon
    1."""
    return np.interp(R1 * alpha, LENGTH, GRID)


def behind_play(alpha, width):
    # The motor came down to the beginning of the log, and reverses there.
    half, state = 0.5 * width, alpha[0] + 0.5 * width
    follower = np.empty_like(alpha)
    for i, value in enumerate(alpha):
        state = min(max(state, value - half), value + half)
        follower[i] = state
    return follower


def model(parameters, runs):
    gain, play, zero = parameters
    return np.concatenate([(1 + gain) * joint_angle(behind_play(alpha, play)) + zero for alpha in runs])


def motion(reach):
    phase = np.linspace(0, STROKES, ROWS)
    return reach * (2 * np.abs(phase - 2 * np.floor(phase / 2 + 0.5)) - 1)


def write(folder, runs, measured):
    for i, (alpha, theta) in enumerate(zip(runs, measured), 1):
        seconds = np.arange(ROWS) * (0.15 if i != 3 else 0.03)  # run 3 is five times as fast
        rows = "".join(f"{t:.3f},{np.degrees(a):.5f},{np.degrees(b):.5f},0\n" for t, a, b in zip(seconds, alpha, theta))
        with open(f"{folder}/run_{i}.csv", "w") as file:
            file.write("time_s,alpha_deg,theta_deg,load_N\n" + rows)
    with open(f"{folder}/joint.toml", "w") as file:
        file.write(SPEC)


def inputs(folder):
    return [f"{folder}/joint.toml", *[f"{folder}/run_{i}.csv" for i in range(1, RUNS + 1)]]


def timed(work):
    start = time.perf_counter()
    return work(), time.perf_counter() - start


def fitted(runs, measured):
    theta = np.concatenate(measured)
    return least_squares(lambda p: model(p, runs) - theta, START, x_scale=SCALE)


def fit_against_fit(bench, folder, kinematic):
    """Prints one fit by BENCH_FIT, and one by scipy for the same joint."""
    process = subprocess.Popen([bench, *inputs(folder)], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    ours = json.loads(process.stdout.readline())
    count = 0

    # The simulation is accurate to 1e-9 rad, so difference steps have to be large. scipy takes steps in proportion to a
    # parameter's value. Each parameter is therefore divided by its scale and moved by 1: steps are then 0.1 of the scale.
    def residual(scaled):
        nonlocal count
        parameters = SCALE * (scaled - 1)
        count += 1
        process.stdin.write(("%.17g %.17g %.17g\n" % tuple(parameters)).encode())
        process.stdin.flush()
        return -np.frombuffer(process.stdout.read(8 * ours["rows"]))

    solution, theirs = timed(lambda: least_squares(residual, 1 + START / SCALE, diff_step=0.1))
    gain, play, _ = SCALE * (solution.x - 1)
    process.stdin.close()
    process.wait()
    words = lambda gain, play: f"gain {100 * gain:.3f} %, play {np.degrees(abs(play)):.3f} deg"
    print(f"one fit of the same three numbers of the elastic joint, {ours['rows']} rows: fusee {1e3 * ours['seconds']:.1f} ms, {words(ours['gain'], ours['play'])}; "
          f"scipy over the same physics {1e3 * theirs:.1f} ms, {count} simulations, {words(gain, play)}")
    print(f"fusee is {theirs / ours['seconds']:.1f} times faster than scipy on the same physics, {kinematic / ours['seconds']:.1f} times than scipy on kinematics alone")


def main():
    fusee = os.path.abspath(sys.argv[1])
    bench = os.path.abspath(sys.argv[2]) if len(sys.argv) > 2 else os.path.join(os.path.dirname(fusee), "tests/bench/bench_fit")
    random = np.random.default_rng(1)
    reach = 0.9 * min(-np.interp(np.radians(-30), GRID, LENGTH), np.interp(np.radians(30), GRID, LENGTH)) / R1
    runs = [motion(reach)] * RUNS
    measured = [(1 + GAIN) * joint_angle(behind_play(alpha, np.radians(PLAY))) + np.radians(NOISE) * random.standard_normal(ROWS) for alpha in runs]
    with tempfile.TemporaryDirectory() as folder:
        write(folder, runs, measured)
        command = [fusee, "calibrate", *inputs("."), "--json"]
        process, ours = timed(lambda: subprocess.run(command, cwd=folder, capture_output=True, text=True))
        if process.returncode != 0:
            sys.exit(process.stdout + process.stderr)
        answer = json.loads(process.stdout)
        solution, theirs = timed(lambda: fitted(runs, measured))
        fit_against_fit(bench, folder, theirs)
    residual = np.degrees(np.sqrt(np.mean(solution.fun**2)))
    print(f"scipy least_squares, 3 numbers of a model that is known: {theirs:.3f} s, {solution.nfev} steps, gain {100 * solution.x[0]:.3f} %, "
          f"play {np.degrees(abs(solution.x[1])):.3f} deg, rms {residual:.4f} deg")
    effects = "; ".join(f"{effect['name']} of {{{', '.join(effect['group'])}}} {effect['parameters']}" for effect in answer["effects"])
    print(f"fusee calibrate, without such information, {len(answer['tried'])} candidates tried: {ours:.3f} s, {answer['verdict']}, rms {answer['after']['rms_deg']:.4f} deg: {effects}")
    print(f"fusee calibrate takes {ours / theirs:.1f} times as long as the one fit; for each candidate {ours / theirs / max(1, len(answer['tried'])):.2f} times")
    if answer["after"]["rms_deg"] > 1.05 * residual:
        sys.exit("fusee's residual is larger than scipy's")


if __name__ == "__main__":
    main()

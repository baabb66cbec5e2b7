#!/usr/bin/env python3
"""The paper's problem by other solvers, in the same run as fusee: value found, evaluations, time ratio.

    optimize_peers.py BENCH_OPTIMIZE

BENCH_OPTIMIZE is the program of optimize_bench.cpp. Needs numpy and scipy; cma is used if it is installed. The equations are written
anew here, from [2] to [8] of docs/background/physics.md.
"""

import json
import subprocess
import sys
import time

import numpy as np

THETA = np.radians(np.linspace(-30, 30, 61))
SIN, COS = np.sin(THETA), np.cos(THETA)
R1, EF, MU = 20.0, 60.0, 0.2  # mm, mm, capstan friction
BOUNDS = [(100.0, 300.0), (30.0, 150.0), (-40.0, 50.0)]  # of R, EB = ED and OE, mm
calls = 0  # evaluations of max_tension()


def max_tension(design):
    """Largest T_b/F_c over the stroke, with a penalty for EB > R/2; 1e6 for an impossible design."""
    global calls
    calls += 1
    R, e, oe = design
    m1 = R * (e * COS - oe * SIN) / np.hypot(e - R * -SIN, oe + R * COS)
    m2 = R * (e * COS + oe * SIN) / np.hypot(e - R * SIN, oe + R * COS)
    if min(m1.min(), m2.min()) <= 0:
        return 1e6
    r2 = R1 * m2 / m1
    c = np.hypot(e, EF)
    if r2.max() >= c:
        return 1e6
    phi = np.arctan2(R * COS + oe, R * SIN - e) - np.pi / 2 - np.arctan2(EF, e) + np.arccos(r2 / c)
    penalty = 1e3 * max(0.0, e - 0.5 * R)
    return float((R / m2 * np.exp(MU * phi)).max()) + penalty


def timed(name, solve, ours):
    global calls
    calls = 0
    start = time.perf_counter()
    value = solve()
    seconds = time.perf_counter() - start
    print(f"{name:28} value {value:.9f}  evaluations {calls:7}  {seconds:9.4f} s  {seconds / ours:8.1f} x our certified")
    return value


def main():
    bench = json.loads(subprocess.run([sys.argv[1]], check=True, capture_output=True, text=True).stdout)
    certified, genetic, rate = bench["certified"], bench["genetic"], bench["evaluations_per_s"]
    print(f"max T_b over 61 angles: {rate['scalar']:.0f} designs/s scalar, {rate['batched']:.0f} designs/s batched")
    ours = certified["seconds"]
    print(f"{'fusee certified':28} value {certified['value']:.9f}  evaluations {certified['evaluations']:7}  {ours:9.4f} s  proven >= {certified['lower_bound']:.9f}")
    print(f"{'fusee ga':28} value {genetic['value']:.9f}  evaluations {genetic['evaluations']:7}  {genetic['seconds']:9.4f} s")
    from scipy.optimize import differential_evolution, dual_annealing, shgo
    found = [timed("scipy differential_evolution", lambda: differential_evolution(max_tension, BOUNDS, seed=1, tol=1e-10, maxiter=400).fun, ours),
             timed("scipy dual_annealing", lambda: dual_annealing(max_tension, BOUNDS, seed=1).fun, ours),
             timed("scipy shgo", lambda: shgo(max_tension, BOUNDS).fun, ours)]
    try:
        import cma
        found.append(timed("cma", lambda: cma.fmin2(max_tension, [200, 90, 5], 50, {"bounds": list(zip(*BOUNDS)), "seed": 1, "verbose": -9})[1].result.fbest, ours))
    except ImportError:
        pass
    better = [value for value in found if value < certified["lower_bound"] * (1 - 1e-6)]
    if better:
        sys.exit(f"a solver found {min(better)}, below the proven bound {certified['lower_bound']}")


if __name__ == "__main__":
    main()

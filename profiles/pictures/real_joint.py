#!/usr/bin/env python3
"""Draws the residual of a real joint, from its gain to a cable that stiffens and rubs along its path.

    profiles/pictures/real_joint.py RUNS [picture.svg]

RUNS: a folder with one .csv file for each run (time_s, alpha_deg, theta_deg, tau_out_Nm). Every fourth run is held out,
and all figures and curves are of held-out runs. Prints the table of docs/background/real-joint.md. The equations are
written anew here, and no program of this project runs. Needs numpy. The data of the page are O'Neill, Stephens and
Kowalewski's (Open Database License 1.0).
"""

import pathlib
import sys

import numpy as np

RATIO = -1 / 0.915  # motor angle per joint angle; the fit of the gain starts at 1 / RATIO
SETTLING = 75  # rows, 1.5 s: omitted at the beginning of a run, where the state of its play is unknown


def read(path):
    lines = [line for line in path.read_text().splitlines() if line and not line.startswith("#")]
    return np.genfromtxt(lines, delimiter=",", names=True)


def play(angle, width):
    """The play operator: the output follows when the input is half the width away."""
    follower, at = np.empty(len(angle)), angle[0]
    for i, value in enumerate(angle):
        at = min(max(at, value - width / 2), value + width / 2)
        follower[i] = at
    return follower


# Columns of a regression. Each step adds its columns to those of the steps above it.
STEPS = [
    ("gain", lambda run: [np.ones(len(run)), run["alpha_deg"]]),
    ("and play of 4°", lambda run: [play(run["alpha_deg"], 4)]),
    ("and compliance", lambda run: [run["tau_out_Nm"]]),
]


def least_squares(runs, held, steps):
    """Residuals of the held-out runs."""
    columns = [np.column_stack([c for step in steps for c in step(run)]) for run in runs]
    fitted = [k for k in range(len(runs)) if k not in held]
    numbers = np.linalg.lstsq(
        np.vstack([columns[k][SETTLING:] for k in fitted]),
        np.concatenate([runs[k]["theta_deg"][SETTLING:] for k in fitted]), rcond=None)[0]
    return {k: runs[k]["theta_deg"] - columns[k] @ numbers for k in held}


def cable(runs, numbers):
    """[c1] to [c4] of docs/background/physics.md, all runs at once: gain, compliance, straightened, its rate, friction without
    load and share. deg and N m."""
    gain, compliance, most, rate, unloaded, share = numbers
    length = max(len(run) for run in runs)
    padded = [[np.pad(run[name], (0, length - len(run)), "edge") for run in runs] for name in ("alpha_deg", "tau_out_Nm")]
    driven, load = gain * np.array(padded[0]), np.array(padded[1])

    def deflection(pull):
        return compliance * pull + most * rate * pull / (1 + rate * np.abs(pull))

    spread = (2 * np.arange(8) + 1) / 8
    held = spread * (unloaded + share * np.abs(load))[..., None]
    ends = driven[..., None] - deflection(load[..., None] + np.array([[1], [-1]])[:, None, None] * held[None])
    low, high = ends.min(axis=0), ends.max(axis=0)
    at, angles = 0.5 * (low[:, 0] + high[:, 0]), np.empty_like(driven)
    for i in range(length):
        at = np.minimum(np.maximum(at, low[:, i]), high[:, i])
        angles[:, i] = at.mean(axis=1)
    return [angles[k, :len(run)] for k, run in enumerate(runs)]


def cable_fitted(runs, held):
    """Residuals of the held-out runs, and the numbers fitted to the others by Levenberg and Marquardt's method."""
    fitted = [k for k in range(len(runs)) if k not in held]

    # The last three numbers are positive, and are fitted by their logarithms. The zero is the mean of the residuals.
    def residuals_of(log):
        numbers = np.array([log[0], log[1], log[2], *np.exp(log[3:])])
        angles = cable(runs, numbers)
        zero = np.mean(np.concatenate([(runs[k]["theta_deg"] - angles[k])[SETTLING:] for k in fitted]))
        return [run["theta_deg"] - angle - zero for run, angle in zip(runs, angles)], numbers

    def column(log):
        residuals, _ = residuals_of(log)
        return np.concatenate([residuals[k][SETTLING:] for k in fitted])

    at = np.array([1 / RATIO, -60, -2, np.log(50), np.log(0.006), np.log(0.12)])
    steps, damping, here = np.array([1e-3, 0.1, 0.01, 1e-2, 1e-2, 1e-2]), 1e-2, column(at)
    for _ in range(30):
        slopes = np.column_stack([(column(at + step * unit) - here) / step for step, unit in zip(steps, np.eye(6))])
        normal = slopes.T @ slopes
        move = -np.linalg.solve(normal + damping * np.diag(np.diag(normal)), slopes.T @ here)
        there = column(at + move)
        gained = here @ here - there @ there
        damping = damping / 5 if gained > 0 else damping * 10
        if gained > 0:
            at, here = at + move, there
            if gained < 1e-5 * (here @ here):
                break
    residuals, numbers = residuals_of(at)
    return {k: residuals[k] for k in held}, numbers


def rms(residuals):
    return float(np.sqrt(np.mean(np.concatenate([r[SETTLING:] for r in residuals.values()]) ** 2)))


def picture(panels, runs):
    """One curve a held-out run, darker under a larger load; residual against alpha."""
    wide, tall, edge = 300, 250, 34
    most = max(np.abs(r[SETTLING:]).max() for r in panels[0][1].values())
    angles = np.concatenate([run["alpha_deg"] for run in runs])
    low, high = angles.min(), angles.max()
    loads = {k: np.abs(runs[k]["tau_out_Nm"]).mean() for k in panels[0][1]}
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide * len(panels)} {tall}" '
           'font-family="sans-serif" font-size="11">', f'<rect width="{wide * len(panels)}" height="{tall}" fill="#fff"/>']
    for i, (title, residuals) in enumerate(panels):
        left, right, top, bottom = i * wide + edge, (i + 1) * wide - 8, 22, tall - 26
        out.append(f'<text x="{left}" y="14">{title}: {rms(residuals):.3f}°</text>')
        out.append(f'<rect x="{left}" y="{top}" width="{right - left}" height="{bottom - top}" fill="none" stroke="#999"/>')
        for mark in range(-int(most), int(most) + 1):
            y = top + (most - mark) / (2 * most) * (bottom - top)
            out.append(f'<path d="M{left} {y:.1f}H{right}" stroke="#ddd"/><text x="{left - 4}" y="{y + 4:.1f}" '
                       f'text-anchor="end">{mark}°</text>')
        for mark in range(int(np.ceil(low / 30)) * 30, int(high) + 1, 30):
            x = left + (mark - low) / (high - low) * (right - left)
            out.append(f'<text x="{x:.1f}" y="{bottom + 13}" text-anchor="middle">{mark}°</text>')
        for k, residual in residuals.items():
            x = left + (runs[k]["alpha_deg"][SETTLING::6] - low) / (high - low) * (right - left)
            y = top + (most - residual[SETTLING::6]) / (2 * most) * (bottom - top)
            share = loads[k] / max(loads.values())
            colour = "#%02x%02x%02x" % tuple(int(c * (1 - 0.85 * share)) for c in (150, 190, 255))
            points = "L".join(f"{a:.1f} {b:.1f}" for a, b in zip(x, y))
            out.append(f'<path d="M{points}" fill="none" stroke="{colour}" stroke-width=".7"/>')
    out.append("</svg>\n")
    return "\n".join(out)


def main(folder, target):
    paths = sorted(pathlib.Path(folder).glob("*.csv"))
    runs = [read(path) for path in paths]
    held = [k for k in range(len(runs)) if k % 4 == 2]
    panels = []
    for count in range(1, len(STEPS) + 1):
        panels.append((STEPS[count - 1][0], least_squares(runs, held, [step for _, step in STEPS[:count]])))
    residuals, numbers = cable_fitted(runs, held)
    panels.append(("cable, [c1] to [c4]", residuals))
    for title, residuals in panels:
        print(f"| {title} | {rms(residuals):.3f}° |")
    print("gain, compliance, straightened, rate, friction without load, share:", *np.round(numbers, 4))
    if target:
        pathlib.Path(target).write_text(picture([panels[0], *panels[-2:]], runs))


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else None)

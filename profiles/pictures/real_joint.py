#!/usr/bin/env python3
"""Draws the residual of a real joint, from the declared ratio to what `fusee calibrate` makes of it.

    profiles/pictures/real_joint.py build/release/fusee RUNS [picture.svg]

RUNS: a folder with run_*.csv or tool*.csv files (time_s, alpha_deg, theta_deg, tau_out_Nm). Every fourth run is held
out; all figures and curves are of these. Prints a row of the table of profiles/real_joint.md for every step. Needs
numpy. The data of the page are O'Neill, Stephens and Kowalewski's (Open Database License 1.0).
"""

import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

RATIO = -1 / 0.915
SETTLING = 75  # rows: 1.5 s, in which the play of a run is not known


def read(path):
    lines = [line for line in path.read_text().splitlines() if line and not line.startswith("#")]
    return np.genfromtxt(lines, delimiter=",", names=True)


def play(angle, width):
    lag, at = np.empty(len(angle)), angle[0]
    for i, value in enumerate(angle):
        at = min(max(at, value - width / 2), value + width / 2)
        lag[i] = at
    return lag


# Each step beside those above it: least squares, no program of this project.
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


def calibrated(program, paths, runs, held):
    """What calibrate says, and residuals of the held-out runs by the corrected file."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        spec = folder / "jaw.toml"
        spec.write_text(f'schema = 1\nname = "jaw"\n\n[transmission]\nkind = "ratio"\nratio = {RATIO}\n')
        words = [program, "calibrate", spec, "-o", folder / "out", "--json", "--column", "load=tau_out_Nm"]
        for k, path in enumerate(paths):
            words += ["--hold-out", path] if k in held else [path]
        said = json.loads(subprocess.run(words, capture_output=True, text=True, check=True).stdout)
        residuals = {}
        for k in held:
            shown = folder / "shown.csv"
            subprocess.run([program, "simulate", folder / "out" / "corrected.toml", paths[k], "--column",
                            "load=tau_out_Nm", "-o", shown, "--force", "-q"], check=True)
            residuals[k] = runs[k]["theta_deg"] - read(shown)["theta_deg"]
        return said, residuals


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


def main(program, folder, target):
    paths = sorted(pathlib.Path(folder).glob("*.csv"))
    runs = [read(path) for path in paths]
    held = [k for k in range(len(runs)) if k % 4 == 2]
    panels = []
    for count in range(1, len(STEPS) + 1):
        residuals = least_squares(runs, held, [step for _, step in STEPS[:count]])
        panels.append((STEPS[count - 1][0], residuals))
        print(f"| {STEPS[count - 1][0]} | least squares | {rms(residuals):.3f}° |")
    said, residuals = calibrated(program, paths, runs, held)
    names = ", ".join(f"`{effect['name']}`" for effect in said["effects"])
    print(f"| {names} | `fusee calibrate` | {said['after']['held_out_rms_deg']:.3f}° |")
    for effect in said["effects"]:
        print(effect["name"], {k: v["value"] for k, v in effect["parameters"].items()}, "or", effect["group"])
    panels = [panels[0], panels[-1], ("fusee calibrate", residuals)]
    if target:
        pathlib.Path(target).write_text(picture(panels, runs))


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], sys.argv[3] if len(sys.argv) > 3 else None)

# %% [markdown]
# # Ten thousand pulleys
#
# A sweep over five lengths of a joint. For each design both pitch curves are drawn, tendons are wound on them, and three figures are kept. The
# cells are for an editor that knows `# %%` (or jupytext); as a script: `python3 docs/reference/python_sweep.py [DESIGNS] [WORKERS] [futures|dask]`.

# %% The swept keys of the mechanism file, each with its bounds, mm.
import math
import sys
import time
from concurrent.futures import Executor, ProcessPoolExecutor
from functools import partial
from typing import Dict, List, Optional, Sequence, Tuple

import numpy as np

import fusee

SWEPT: Dict[str, Tuple[float, float]] = {
    "joint.length_mm": (90, 110),
    "guides.EB_mm": (45, 60),
    "guides.ED_mm": (45, 60),
    "pulley.EF_mm": (70, 95),
    "pulley.r1_mm": (12, 18),
}
Design = Dict[str, float]


def designs(count: int, seed: int = 1) -> List[Design]:
    """Designs drawn uniformly within the bounds; the same seed gives the same designs."""
    low, high = np.array(list(SWEPT.values())).T
    rows = np.random.default_rng(seed).uniform(low, high, size=(count, len(SWEPT)))
    return [dict(zip(SWEPT, map(float, row))) for row in rows]


# %% One design. A joint that cannot be made is a value and no exception: main() counts the reasons.
Figures = Tuple[Optional[str], float, float]


def judge(base: fusee.Mechanism, design: Design) -> Figures:
    """Why the design cannot be made (None: it can), the range of r2, mm, and the θ error of tendons wound on its curves, deg."""
    mechanism = base.with_(design)
    curves = fusee.synthesise(mechanism, advice=False)
    if not curves.made:
        return next(condition.name for condition in curves.conditions if not condition.ok), math.nan, math.nan
    wound = fusee.rewind(mechanism, curves)
    return None, float(np.ptp(curves.stroke.r2_mm)), math.degrees(wound.max_theta_error_rad)


def judge_all(base: fusee.Mechanism, chunk: Sequence[Design]) -> List[Figures]:
    return [judge(base, design) for design in chunk]


# %% All designs, on any executor: processes of this machine, or Dask's workers on several. A pickled mechanism contains the files it needs.
def sweep(pool: Executor, base: fusee.Mechanism, all_designs: Sequence[Design], chunk: int = 100) -> List[Figures]:
    chunks = [all_designs[i : i + chunk] for i in range(0, len(all_designs), chunk)]
    return [figures for part in pool.map(partial(judge_all, base), chunks) for figures in part]


def on_futures(base: fusee.Mechanism, all_designs: Sequence[Design], workers: int) -> List[Figures]:
    with ProcessPoolExecutor(max_workers=workers) as pool:
        return sweep(pool, base, all_designs)


def on_dask(base: fusee.Mechanism, all_designs: Sequence[Design], workers: int) -> List[Figures]:
    """The sweep, unchanged, on Dask's pool. `Client("tcp://scheduler:8786")` would use a cluster."""
    from distributed import Client

    with Client(n_workers=workers, threads_per_worker=1, dashboard_address=None) as client, client.get_executor() as pool:
        return sweep(pool, base, all_designs)


# %% Run the sweep and print the reasons and the roundest P2.
def main(count: int = 10000, workers: int = 2, way: str = "futures") -> None:
    base = fusee.read(fusee.new("forearm"))
    start = time.perf_counter()
    figures = {"futures": on_futures, "dask": on_dask}[way](base, designs(count), workers)
    seconds = time.perf_counter() - start
    made = [figure for figure in figures if figure[0] is None]
    print(f"{count} designs in {seconds:.1f} s on {workers} workers, {len(made)} can be made")
    for reason in sorted({str(figure[0]) for figure in figures} - {"None"}):
        print(f"  {reason}: {sum(figure[0] == reason for figure in figures)}")
    if made:
        roundest = min(range(count), key=lambda i: figures[i][1] if figures[i][0] is None else math.inf)
        print(f"roundest P2: {figures[roundest][1]:.3f} mm between its least and largest radius")
        print("  " + ", ".join(f"{key} = {value:.2f}" for key, value in designs(count)[roundest].items()))
        print(f"largest θ error of all: {max(figure[2] for figure in made):.5f} deg")


if __name__ == "__main__":
    given = dict(enumerate(sys.argv))
    main(int(given.get(1, 10000)), int(given.get(2, 2)), given.get(3, "futures"))

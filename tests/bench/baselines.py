#!/usr/bin/env python3
"""Four standard methods and calibrate() on the same joints with known faults, in one table.

    known_truth --joints 400 --first N --jobs 1 --data-to TEST     the joints, with the answers of calibrate()
    known_truth --joints 400 --first M --kinds nothing --kinds one --kinds two --kinds three \\
      --no-calibration --data-to TRAIN                             joints for the random forest
    baselines.py TEST [--train TRAIN] [--only METHOD]...

Requires numpy, scipy and scikit-learn (Debian: python3-numpy python3-scipy python3-sklearn). No test needs scikit-learn, so that .ci/setup does
not install it.

Each method gets slopes.csv of tests/rig/case_data.h: rows of all runs, the error of the declared joint, and the derivative of the joint angle
to each number of each effect. Where a number is searched for (order of a wave, time of a slip), an effect has several starts, and a method
takes any of them. No code of src/calibration is used.

stepwise   forward and backward steps over effects, by the BIC of a linear regression.
lasso      lasso over all columns, its penalty by leaving runs out in turn and the rule of one standard error. An effect is named if a
           coefficient of it is not zero.
forest     a random forest with one output per effect, on the share of the error that each effect explains, alone and beside all others.
           Closed set: it knows no unmodelled class. An effect is named above a probability of 0.5.
gp         Gaussian process of motor angle, direction, load, speed and time, fitted to the error. An effect is named if generalised least
           squares reject its absence beside the process at 1 %, Bonferroni-corrected. Then the process is fitted again.

The score for an unmodelled cause is the correlation of neighbouring residuals (stepwise, lasso), 1 - the largest probability of any output
(forest), the log likelihood ratio of the process to white noise (gp), and the log odds of the answer (calibrate).
"""

import argparse
import json
import sys
import time
import warnings
from pathlib import Path

import numpy as np

MOST_EFFECTS = 8
SIGNIFICANCE = 0.01
GP_ROWS = 200
LASSO_PENALTIES = 40
TREES = 500
FIXED_COLUMNS = ("run", "time_s", "alpha_deg", "theta_deg", "load_N", "direction", "declared_deg")


# ---- statistics ----

def wilson(part, whole, z=1.959963984540054):
    """95 % interval of a share (Wilson 1927).

    >>> [round(bound, 4) for bound in wilson(0, 200)]
    [0.0, 0.0188]
    >>> [round(bound, 4) for bound in wilson(5, 10)]
    [0.2366, 0.7634]
    """
    if whole == 0:
        return 0.0, 1.0
    share = part / whole
    middle = share + z * z / (2 * whole)
    half = z * np.sqrt(share * (1 - share) / whole + z * z / (4 * whole * whole))
    return max(0.0, (middle - half) / (1 + z * z / whole)), min(1.0, (middle + half) / (1 + z * z / whole))


def area_under_roc(positive, negative):
    """Probability that a positive scores higher than a negative; equal scores count half.

    >>> area_under_roc([3, 4], [1, 2])
    1.0
    >>> area_under_roc([1, 3], [1, 2])
    0.625
    >>> area_under_roc([], [1])
    nan
    """
    if not len(positive) or not len(negative):
        return float("nan")
    difference = np.subtract.outer(np.asarray(positive, float), np.asarray(negative, float))
    return float(np.mean((difference > 0) + 0.5 * (difference == 0)))


def area_interval(area, positives, negatives, z=1.959963984540054):
    """95 % interval of an area under the ROC curve (Hanley and McNeil 1982).

    >>> [round(bound, 3) for bound in area_interval(0.9, 50, 50)]
    [0.837, 0.963]
    """
    q1, q2 = area / (2 - area), 2 * area * area / (1 + area)
    variance = area * (1 - area) + (positives - 1) * (q1 - area * area) + (negatives - 1) * (q2 - area * area)
    half = z * np.sqrt(max(0.0, variance) / (positives * negatives))
    return max(0.0, area - half), min(1.0, area + half)


# ---- joints ----

class Joint:
    """Truth and data of one joint. Angles in degrees."""

    def __init__(self, folder):
        self.case = json.loads((folder / "case.json").read_text())
        with open(folder / "slopes.csv") as file:
            titles = file.readline().strip().split(",")
            table = np.loadtxt(file, delimiter=",", ndmin=2)
        at = {title: i for i, title in enumerate(titles)}
        self.rows = {title: table[:, at[title]] for title in FIXED_COLUMNS}
        self.error = self.rows["theta_deg"] - self.rows["declared_deg"]
        self.starts = {}  # effect -> its columns by start, each of unit length
        by_start = {}
        for title in titles[len(FIXED_COLUMNS):]:
            effect, _, start = title.rsplit("/", 2)
            column = table[:, at[title]]
            by_start.setdefault((effect, start), []).append(column / np.linalg.norm(column))
        for (effect, _), columns in by_start.items():
            self.starts.setdefault(effect, []).append(np.column_stack(columns))
        faults = self.case["faults"]
        self.faults = {fault["name"] for fault in faults if fault["is_modelled"]}
        self.has_unmodelled = any(not fault["is_modelled"] for fault in faults)
        self.allowed = self.faults | {kin for fault in faults if not fault["is_modelled"] for kin in fault["kin"]}
        # The rig draws the groove's friction for every joint: to name it is right, but not required.
        if self.case["groove_friction_differs"]:
            self.allowed.add("groove_friction")
        self.optional = self.allowed - self.faults

    def candidates(self):
        return [(effect, columns) for effect, starts in self.starts.items() for columns in starts]


def joints_of(folder):
    folders = sorted(path.parent for path in Path(folder).glob("*/case.json"))
    if not folders:
        sys.exit(f"{folder}: no case.json in its folders. Make them with known_truth --data-to {folder}.")
    return [Joint(path) for path in folders]


def residual_of(error, columns):
    if columns is None or columns.shape[1] == 0:
        return error
    return error - columns @ np.linalg.lstsq(columns, error, rcond=1e-10)[0]


def neighbour_correlation(residual, run):
    """Lag-one correlation within the runs."""
    same = run[1:] == run[:-1]
    return float(np.sum((residual[1:] * residual[:-1])[same]) / max(np.sum(residual**2), 1e-30))


class Answer:
    """Names with a score for an unmodelled cause. `groups`: names that a method does not resolve; else each name is alone."""

    def __init__(self, names, score, groups=None):
        self.groups = [{name} for name in sorted(names)] if groups is None else groups
        self.score = score


# ---- methods ----

def stepwise(joint):
    count = len(joint.error)
    chosen = []  # (effect, columns)

    def bic(members):
        columns = np.column_stack([columns for _, columns in members]) if members else None
        square = np.sum(residual_of(joint.error, columns) ** 2)
        return count * np.log(square / count) + (columns.shape[1] if members else 0) * np.log(count)

    best = bic(chosen)
    while True:
        steps = [chosen[:i] + chosen[i + 1:] for i in range(len(chosen))]
        if len(chosen) < MOST_EFFECTS:
            named = {effect for effect, _ in chosen}
            steps += [chosen + [one] for one in joint.candidates() if one[0] not in named]
        scores = [bic(step) for step in steps]
        if not scores or min(scores) >= best - 1e-9:
            break
        best, chosen = min(scores), steps[int(np.argmin(scores))]
    columns = np.column_stack([columns for _, columns in chosen]) if chosen else None
    return Answer({effect for effect, _ in chosen}, neighbour_correlation(residual_of(joint.error, columns), joint.rows["run"]))


def lasso(joint):
    from sklearn.linear_model import lasso_path

    owners, columns = zip(*[(effect, column) for effect, block in joint.candidates() for column in block.T])
    matrix, run = np.column_stack(columns), joint.rows["run"]
    top = np.max(np.abs(matrix.T @ joint.error)) / len(joint.error)
    penalties = top * np.logspace(0, -3, LASSO_PENALTIES)

    def path(rows):
        return lasso_path(matrix[rows], joint.error[rows], alphas=penalties, precompute=True, tol=1e-3, max_iter=2000)[1]

    folds = np.unique(run)
    losses = []
    for fold in folds:
        kept = run != fold
        missed = joint.error[~kept, None] - matrix[~kept] @ path(kept)
        losses.append(np.mean(missed**2, axis=0))
    mean = np.mean(losses, axis=0)
    least = int(np.argmin(mean))
    bound = mean[least] + np.std(losses, axis=0, ddof=1)[least] / np.sqrt(len(folds))
    chosen = int(np.argmax(mean <= bound))  # the largest penalty of these
    weights = path(np.full(len(run), True))[:, chosen]
    return Answer({owner for owner, weight in zip(owners, weights) if weight != 0},
                  neighbour_correlation(joint.error - matrix @ weights, run))


class Forest:
    NOTHING = "nothing"

    def __init__(self, joints):
        from sklearn.ensemble import RandomForestClassifier

        joints = [joint for joint in joints if not joint.has_unmodelled]
        self.effects = sorted({effect for joint in joints for effect in joint.starts})
        self.labels = sorted({fault for joint in joints for fault in joint.faults}) + [self.NOTHING]
        truth = [[label in joint.faults or (label == self.NOTHING and not joint.faults) for label in self.labels] for joint in joints]
        self.forest = RandomForestClassifier(TREES, random_state=1, n_jobs=1)
        self.forest.fit([self.features(joint) for joint in joints], np.array(truth, int))

    def features(self, joint):
        square = np.sum(joint.error**2)
        whole = np.column_stack([columns for _, columns in joint.candidates()])
        # A ridge of 1e-6: with all columns, the matrix is nearly singular.
        gram = whole.T @ whole + 1e-6 * np.eye(whole.shape[1])
        inverse = np.linalg.inv(gram)
        weights = inverse @ (whole.T @ joint.error)
        owner = np.concatenate([[effect] * columns.shape[1] for effect, columns in joint.candidates()])
        facts = [np.log10(np.sqrt(square / len(joint.error))), neighbour_correlation(joint.error, joint.rows["run"])]
        for effect in self.effects:
            alone, beside = 0.0, 0.0
            if effect in joint.starts:
                alone = max(1 - np.sum(residual_of(joint.error, columns) ** 2) / square for columns in joint.starts[effect])
                own = owner == effect
                # The growth of the sum of squares if the effect is left out of the full regression.
                beside = weights[own] @ np.linalg.solve(inverse[np.ix_(own, own)], weights[own]) / square
            facts += [alone, np.log10(max(beside, 1e-12))]
        return facts

    def __call__(self, joint):
        outputs = self.forest.predict_proba([self.features(joint)])
        probability = {label: (output[0, 1] if output.shape[1] > 1 else 0.0) for label, output in zip(self.labels, outputs)}
        names = {label for label, share in probability.items() if share > 0.5 and label != self.NOTHING}
        return Answer(names, 1 - max(probability.values()))


def process_of(inputs, error):
    """Covariance of a Gaussian process fitted to the error, and its log likelihood ratio to white noise."""
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel

    variance = max(np.mean(error**2), 1e-12)
    scaled = error / np.sqrt(variance)
    kernel = ConstantKernel(0.5, (1e-4, 1e2)) * RBF(np.ones(inputs.shape[1]), (0.05, 50.0)) + WhiteKernel(0.5, (1e-5, 2.0))
    fitted = GaussianProcessRegressor(kernel, n_restarts_optimizer=0, random_state=1).fit(inputs, scaled)
    white = -0.5 * len(error) * (1 + np.log(2 * np.pi))  # of variance 1, the mean square of `scaled`
    return variance * fitted.kernel_(inputs), fitted.log_marginal_likelihood_value_ - white


def gaussian_process(joint):
    from scipy.linalg import solve_triangular
    from scipy.stats import chi2

    rows = np.unique(np.linspace(0, len(joint.error) - 1, GP_ROWS).astype(int))
    data = {title: values[rows] for title, values in joint.rows.items()}
    first, speed = np.zeros(len(rows)), np.zeros(len(rows))
    for run in np.unique(joint.rows["run"]):
        whole = joint.rows["run"] == run
        seconds = np.ptp(joint.rows["time_s"][whole])
        speed[data["run"] == run] = np.sum(np.abs(np.diff(joint.rows["alpha_deg"][whole]))) / max(seconds, 1e-9)
        first[data["run"] == run] = run
    inputs = np.column_stack([data["alpha_deg"], data["direction"], data["load_N"], np.log1p(speed), first])
    inputs = (inputs - inputs.mean(axis=0)) / np.maximum(inputs.std(axis=0), 1e-9)
    error, candidates = joint.error[rows], [(effect, columns[rows]) for effect, columns in joint.candidates()]
    named, base, residual = set(), np.zeros((len(rows), 0)), error
    while True:
        covariance, ratio = process_of(inputs, residual)
        factor = np.linalg.cholesky(covariance + 1e-10 * np.trace(covariance) / len(rows) * np.eye(len(rows)))
        whiten = lambda values: solve_triangular(factor, values, lower=True)
        white_error, white_base = whiten(error), whiten(base)
        before = np.sum(residual_of(white_error, white_base) ** 2)
        best = (SIGNIFICANCE / len(candidates), None, None)
        for effect, columns in candidates:
            if effect in named:
                continue
            after = np.sum(residual_of(white_error, np.column_stack([white_base, whiten(columns)])) ** 2)
            chance = chi2.sf(max(0.0, before - after), columns.shape[1])
            if chance < best[0]:
                best = (chance, effect, columns)
        if best[1] is None or len(named) == MOST_EFFECTS:
            return Answer(named, ratio)
        named.add(best[1])
        base = np.column_stack([base, best[2]])
        weights = np.linalg.lstsq(whiten(base), white_error, rcond=1e-10)[0]
        residual = error - base @ weights


def calibrate_groups(joint):
    answer = joint.case["answer"]
    return Answer((), answer["unmodelled_log_odds"], [set(effect["group"]) for effect in answer["effects"]])


def calibrate_names(joint):
    answer = joint.case["answer"]
    return Answer({effect["name"] for effect in answer["effects"]}, answer["unmodelled_log_odds"])


# ---- table ----

def counts(part, whole):
    if whole == 0:
        return "–"
    low, high = wilson(part, whole)
    return f"{100 * part / whole:.1f} % of {whole} ({100 * low:.1f} … {100 * high:.1f})"


def is_false(joint, groups):
    """A group that holds no fault of the joint and does not contain `unmodelled`."""
    return any(not group & joint.allowed and "unmodelled" not in group for group in groups)


def is_exact(joint, groups):
    if any(len(group) > 1 for group in groups):
        return False
    names = set().union(*groups) if groups else set()
    return joint.faults <= names <= joint.faults | joint.optional


def row_of(title, joints, answers, seconds):
    modelled = [(joint, answer) for joint, answer in zip(joints, answers) if not joint.has_unmodelled]
    beside = [(joint, answer) for joint, answer in zip(joints, answers) if joint.has_unmodelled]
    with_faults = [(joint, answer) for joint, answer in zip(joints, answers) if joint.faults]
    false = lambda pairs: counts(sum(is_false(joint, answer.groups) for joint, answer in pairs), len(pairs))
    held = lambda joint, answer: joint.faults <= set().union(*answer.groups)
    exact = sum(is_exact(joint, answer.groups) for joint, answer in modelled)
    sizes = [len(group) for answer in answers for group in answer.groups]
    positive, negative = [answer.score for _, answer in beside], [answer.score for _, answer in modelled]
    area = area_under_roc(positive, negative)
    if np.isnan(area):
        area_words = "–"
    else:
        low, high = area_interval(area, len(positive), len(negative))
        area_words = f"{area:.2f} ({low:.2f} … {high:.2f})"
    found = counts(sum(held(joint, answer) for joint, answer in with_faults), len(with_faults))
    return (f"| {title} | {false(modelled)} | {false(beside)} | {found} | {counts(exact, len(modelled))} | "
            f"{len(sizes) / len(joints):.1f} × {np.mean(sizes) if sizes else 0:.1f} | {area_words} | {np.mean(seconds):.2f} |")


HEAD = """| method | false positive, faults of the catalogue or none | false positive, with an unmodelled fault | found | exact | groups × members | AUROC | s |
|---|--:|--:|--:|--:|--:|--:|--:|"""
FOOT = """
Shares of joints with their 95 % intervals (Wilson; AUROC: Hanley and McNeil).

false positive: a name is no fault of the joint (calibrate: a group holds none and does not contain `unmodelled`)
found: every fault of the catalogue is named, of joints that have one
exact: every fault is named and nothing else, of joints without an unmodelled fault
groups × members: reported groups a joint, and names in a group; methods other than calibrate name each effect alone
AUROC: joints with an unmodelled fault against all others, by the method's score
s: processor time a joint; of calibrate, if known_truth ran with --jobs 1"""


def methods_of(train):
    methods = {"stepwise": ("stepwise BIC", stepwise), "lasso": ("lasso on the slopes", lasso),
               "gp": ("Gaussian process + threshold", gaussian_process)}
    if train:
        start = time.process_time()
        forest = Forest(joints_of(train))
        print(f"forest: trained in {time.process_time() - start:.1f} s", file=sys.stderr)
        methods["forest"] = ("random forest, closed set", forest)
    return methods


def main():
    warnings.filterwarnings("ignore")  # of convergence: a method is as good as its answer
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("test", help="folder of joints on which all methods are compared")
    parser.add_argument("--train", help="folder of joints on which the random forest is trained")
    parser.add_argument("--only", action="append", choices=("stepwise", "lasso", "gp", "forest"), help="this method alone; repeatable")
    words = parser.parse_args()
    joints = joints_of(words.test)
    print(HEAD)
    if all(joint.case["answer"] for joint in joints):
        seconds = [joint.case["answer"]["seconds"] for joint in joints]
        print(row_of("calibrate, groups", joints, [calibrate_groups(joint) for joint in joints], seconds))
        print(row_of("calibrate, first name of each group", joints, [calibrate_names(joint) for joint in joints], seconds))
    for key, (title, method) in methods_of(words.train).items():
        if words.only and key not in words.only:
            continue
        answers, seconds = [], []
        for joint in joints:
            start = time.process_time()
            answers.append(method(joint))
            seconds.append(time.process_time() - start)
        print(row_of(title, joints, answers, seconds), flush=True)
    print(FOOT)


if __name__ == "__main__":
    main()

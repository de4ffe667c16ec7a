"""How honest the error estimate is, judged from outside: scenes it was not tuned on, truth in extended precision.

Run it from the checkout: `python -m tests.benchmarks.bench_outside [--cases 1800] [--seed tune]`. Families of scenes ×
random values × methods × tolerances and steps, answered by the service in process; truth by Taylor series in 80-bit
numbers from equations written down by hand (`outside_truth`). Constants of the estimate may be set with `--seed tune`;
figures to be told come from `--seed report`. Prints; judges nothing. (`bench_calibration`: the library's own scenes.)

Covered: at every sample before the horizon the true error is at most the estimate (errors below 1e-14 · max(1, |q|)
count as none). Ratio: the median over the samples of estimate over true error, where that is above 1e-13. Only answers
with status `ok` are judged so; the others are counted by status, and their coverage is told apart.
"""

from __future__ import annotations

import argparse
import math
import os
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from random import Random
from time import perf_counter

import numpy as np
from tests.benchmarks.outside_truth import FAMILIES
from tests.simulation.judging import Motion, Trial, Verdict, draw_motions, draw_tolerance, judge

from deltaq.simulation.library import method_ids
from deltaq.simulation.service import warm

CASES, SEEDS = 1800, ("report", "tune")
LOOSEST, TIGHTEST, WITH_STEP = 1e-3, 1e-11, 0.3
NEAR = 100.0  # an estimate at most this many times the true error is tight


def main() -> None:
    options = arguments(__doc__, CASES)
    start, load = perf_counter(), os.getloadavg()
    warm()
    verdicts = [judge(trial) for trial in trials(options.seed, options.cases)]
    print(circumstances(options.seed, len(verdicts), start, load[0]))
    table("family", verdicts, lambda v: v.trial.motion.family)
    table("method", verdicts, lambda v: v.trial.method)
    table("asked for", verdicts, _accuracy)
    print_cost(verdicts)
    _print_others([v for v in verdicts if v.status != "ok"])
    _print_uncovered(verdicts)


def arguments(told: str, cases: int) -> argparse.Namespace:
    """What both benchmarks of the estimate take."""
    parser = argparse.ArgumentParser(description=told, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=int, default=cases, help="how many, over all families (default %(default)s)")
    parser.add_argument("--seed", choices=SEEDS, default=SEEDS[0], help="`tune` to set constants by")
    return parser.parse_args()


def circumstances(seed: str, cases: int, start: float, load: float) -> str:
    """What a figure is told with."""
    machine = f"load of the {os.cpu_count()} cores {load:.1f} before, {os.getloadavg()[0]:.1f} after"
    return f"seed {seed}, {cases} cases, {perf_counter() - start:.0f} s, {machine}"


def trials(seed: str, cases: int) -> Iterator[Trial]:
    """All methods in turn on each family, `auto` too; cases as evenly over the families as they go."""
    methods = (*method_ids(), "auto")
    for place, family in enumerate(FAMILIES):
        count = cases // len(FAMILIES) + (place < cases % len(FAMILIES))
        for number, (motion, random) in enumerate(draw_motions(family, seed, count)):
            yield _trial(motion, methods[(number + place) % len(methods)], random)


def _trial(motion: Motion, method: str, random: Random) -> Trial:
    samples = random.choice((101, 301, 501))
    if random.random() < WITH_STEP:
        steps = round(10.0 ** random.uniform(2.5, 4.0))
        return Trial(motion, method, ("step", motion.t_end / steps), samples)
    return Trial(motion, method, ("tolerance", draw_tolerance(method, random, LOOSEST, TIGHTEST)), samples)


def _accuracy(verdict: Verdict) -> str:
    tolerance = verdict.trial.tolerance
    return "a step" if tolerance is None else f"tolerance {tolerance:.0e}"


def table(title: str, verdicts: Sequence[Verdict], group: Callable[[Verdict], str]) -> None:
    """Coverage and tightness by group, and of all."""
    heads = f"{'cases':>7}{'ok':>6}{'covered':>10}{'ratio ≤ 100':>13}{'median ratio':>14}{'90 % below':>12}"
    print(f"\n{title:26}{heads}")
    for name in (*sorted({group(v) for v in verdicts}), "all"):
        print(f"{name:26}{_row([v for v in verdicts if name in (group(v), 'all')])}")


def _row(verdicts: Sequence[Verdict]) -> str:
    ok = [v for v in verdicts if v.status == "ok"]
    ratios = [v.excess for v in ok if not math.isnan(v.excess)]
    covered = f"{np.mean([v.uncovered <= 1.0 for v in ok]):10.1%}" if ok else f"{'–':>10}"
    if not ratios:
        return f"{len(verdicts):7}{len(ok):6}{covered}"
    near, middle, high = np.mean(np.array(ratios) <= NEAR), np.median(ratios), np.quantile(ratios, 0.9)
    return f"{len(verdicts):7}{len(ok):6}{covered}{near:13.1%}{middle:14.1f}{high:12.0f}"


def print_cost(verdicts: Sequence[Verdict]) -> None:
    """Of answers that stand for their curve: how many runs, and right-hand sides over those of the run returned."""
    print(f"\n{'cost of an answer':26}{'median':>10}{'mean':>10}{'90 % below':>12}")
    for kind in ("tolerance", "step"):
        found = [v for v in verdicts if v.status == "ok" and v.trial.accuracy[0] == kind]
        _print_spread(f"{kind}: runs", [v.runs for v in found])
        _print_spread(f"{kind}: evaluations ratio", [v.effort for v in found])


def _print_spread(title: str, numbers: Sequence[float]) -> None:
    if numbers:
        print(f"{title:26}{np.median(numbers):10.2f}{np.mean(numbers):10.2f}{np.quantile(numbers, 0.9):12.2f}")


def _print_others(others: Sequence[Verdict]) -> None:
    print("\nanswers that do not stand for their curve, and how many of their estimates cover it before the horizon:")
    for status, count in Counter(v.status for v in others).most_common():
        covered = np.mean([v.uncovered <= 1.0 for v in others if v.status == status])
        print(f"  {status:32}{count:6}{covered:10.1%}")


def _print_uncovered(verdicts: Sequence[Verdict], most: int = 30) -> None:
    missed = sorted((v for v in verdicts if v.status == "ok" and v.uncovered > 1.0), key=lambda v: -v.uncovered)
    print(f"\nok, but not covered: {len(missed)}" + (f", the worst {most}:" if len(missed) > most else ":"))
    for v in missed[:most]:
        print(f"  true/estimate {v.uncovered:8.3g}, true {v.worst:8.2g}  {v.trial.motion.family}, {v.trial.label}")


if __name__ == "__main__":
    main()

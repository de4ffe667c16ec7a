"""Whether the simulation can be fooled: motions made for it, by kind and method, beside their truth.

Run it from the checkout: `python -m tests.benchmarks.bench_adversarial [--cases 1250] [--seed tune]`. Fast drives at
frequencies that steps miss, pulses, switches, guides with steps, walls, contacts, masses of unlike size, dry friction
(`tests.simulation.adversaries`, `adversaries_of_state`, `outside_truth.ADVERSARIES`), with all methods and `auto`,
tolerances and steps; answered by the service in process. Prints; judges nothing.

Wrong (silently): the status is `ok` or `stopped`, and at some sample the true error is above the estimate and above the
tolerance asked for (with a step: above the estimate); beside it how many are off by more than 3 and 100 times. Under:
any other answer with a sample before its horizon whose true error is above three times the estimate. False alarm: a
warning beside a curve that is as good as was asked for (with a step: within 1e-4) and within its estimate, or a refusal
of a scene that is sound. Careful: `tolerance_missed`, though met. All else is honest. Errors below
1e-14 · max(1, |q|) count as none.
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from random import Random
from time import perf_counter

from tests.benchmarks.bench_outside import arguments, circumstances, print_cost
from tests.benchmarks.outside_truth import ADVERSARIES
from tests.simulation.adversaries import aimed_drive
from tests.simulation.adversaries_of_state import KINDS
from tests.simulation.judging import Trial, Verdict, draw_motions, draw_trial, judge

from deltaq.simulation.library import method_ids
from deltaq.simulation.service import warm

CASES, WORST = 1250, 20
COUNTED: dict[str, Callable[[Verdict], bool]] = {
    "wrong": lambda v: v.is_silently_wrong(),
    "> 3 ×": lambda v: v.is_silently_wrong(3.0),
    "> 100 ×": lambda v: v.is_silently_wrong(100.0),
    "under": lambda v: not v.is_silently_wrong() and v.uncovered > 3.0,
    "false alarm": lambda v: v.is_false_alarm,
    "careful": lambda v: v.is_too_careful,
}


def main() -> None:
    options = arguments(__doc__, CASES)
    start, load = perf_counter(), os.getloadavg()[0]
    warm()
    verdicts = [judge(trial) for trial in trials(options.seed, options.cases)]
    print(circumstances(options.seed, len(verdicts), start, load))
    _print_counts("kind", verdicts, lambda v: v.trial.motion.family)
    _print_counts("method", verdicts, lambda v: v.trial.method)
    _print_counts("asked for", verdicts, lambda v: v.trial.accuracy[0])
    _print_crossed(verdicts)
    _print_statuses(verdicts)
    print_cost(verdicts)
    _print_worst("silently wrong", [v for v in verdicts if v.is_silently_wrong()])
    _print_worst("false alarms", [v for v in verdicts if v.is_false_alarm])


def trials(seed: str, cases: int) -> Iterator[Trial]:
    """Cases as evenly over the kinds as they go."""
    kinds = (*KINDS, *ADVERSARIES)
    each, rest = divmod(cases, len(kinds) + 1)
    for number in range(each):
        yield aimed_drive(Random(f"{seed} aimed {number}"))
    for place, kind in enumerate(kinds):
        for motion, random in draw_motions(kind, seed, each + (place < rest)):
            yield draw_trial(motion, random)


def _print_counts(title: str, verdicts: Sequence[Verdict], group: Callable[[Verdict], str]) -> None:
    print(f"\n{title:26}{'cases':>7}{'ok':>6}" + "".join(f"{name:>13}" for name in COUNTED) + f"{'longest s':>11}")
    for name in (*sorted({group(v) for v in verdicts}), "all"):
        found = [v for v in verdicts if name in (group(v), "all")]
        counts = "".join(f"{sum(map(is_one, found)):13}" for is_one in COUNTED.values())
        longest = max(v.seconds for v in found)
        print(f"{name:26}{len(found):7}{sum(v.status == 'ok' for v in found):6}{counts}{longest:11.1f}")


def _print_crossed(verdicts: Sequence[Verdict]) -> None:
    """Silently wrong of all cases, by kind and method."""
    methods = (*method_ids(), "auto")
    print("\nsilently wrong of cases; columns: " + ", ".join(f"{n} {m}" for n, m in enumerate(methods, 1)))
    print(" " * 26 + "".join(f"{n:>6}" for n in range(1, len(methods) + 1)))
    for kind in sorted({v.trial.motion.family for v in verdicts}):
        own = [v for v in verdicts if v.trial.motion.family == kind]
        print(f"{kind:26}" + "".join(_share([v for v in own if v.trial.method == m]) for m in methods))


def _share(verdicts: Sequence[Verdict]) -> str:
    wrong = sum(v.is_silently_wrong() for v in verdicts)
    return f"{f'{wrong}/{len(verdicts)}' if verdicts else '':>6}"


def _print_statuses(verdicts: Sequence[Verdict]) -> None:
    print("\nstatus                              cases  false alarm")
    for status, count in Counter(v.status for v in verdicts).most_common():
        print(f"{status:34}{count:7}{sum(v.is_false_alarm for v in verdicts if v.status == status):13}")


def _print_worst(title: str, verdicts: Sequence[Verdict]) -> None:
    """By true error where it is above the estimate."""
    print(f"\n{title}: {len(verdicts)}, the worst {min(WORST, len(verdicts))}:")
    for v in sorted(verdicts, key=lambda v: (-min(v.wrong, 1e6), -v.worst))[:WORST]:
        errors = f"true error {v.worst:8.2g}, over the estimate {max(v.wrong, v.uncovered):8.2g}"
        print(f"  {errors}  {v.status}: {v.trial.motion.family}, {v.trial.label}")


if __name__ == "__main__":
    main()

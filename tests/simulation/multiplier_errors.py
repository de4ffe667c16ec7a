"""How the errors that answers tell of multipliers compare with the true ones, over motions drawn at random.

As a command, `python -m tests.simulation.multiplier_errors 20 seed`, it tries so many motions of each kind.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import dataclass
from random import Random
from typing import Any

import numpy as np
from tests.simulation.bound_kinds import KINDS
from tests.simulation.bound_motions import Equations, Kind, followed
from tests.simulation.judging import draw_tolerance

from deltaq.simulation.library import method_ids
from deltaq.simulation.service import run

METHODS = (*(name for name in method_ids() if name != "taylor"), "auto", "auto", "dop853")
TIGHTEST, STEPS = (1e-4, 1e-8, 1e-12), (100, 300, 1000, 3000)
UNITS = 4 * 2.0**-52  # of λ itself: so much of an error is that of the number that tells it
UNSURE = 1e-6  # of the largest λ: a truth that is itself no better
DOUBTED, FINER = 1e-10, 6  # one that changed by more when its steps were halved is followed again in so many parts


@dataclass(frozen=True)
class Compared:
    """One multiplier of one answer.

    `short` is the largest ratio of the true error to that told, at any sample; `excess` the median of the inverse one.
    """

    label: str
    short: float
    excess: float

    @property
    def is_within(self) -> bool:
        """Neither a hundred times too small anywhere, nor a hundred times too large in the median."""
        return self.short <= 100.0 and self.excess <= 100.0


def compared(kind: Kind, seed: str, count: int, samples: int = 101) -> Iterator[Compared]:
    """So many answers about motions of a kind, each with a method and a tolerance or a step of its own."""
    sources = [Random(f"{seed} {kind.name} {k}") for k in range(count)]
    drawn = [kind.draw(source) for source in sources]
    equations = Equations(kind, list(drawn[0][0]))
    values = np.array([list(one[0].values()) for one in drawn], dtype=np.longdouble).T
    start = np.array([[*q, *v] for _, q, v in drawn], dtype=np.longdouble).T
    times = np.linspace(0.0, kind.t_end, samples).astype(np.longdouble)
    truth, rougher = (followed(equations, start, values, times, parts)[1] for parts in (2, 1))
    changed = np.abs(truth - rougher).max(axis=(0, 1)) / np.abs(truth).max(axis=(0, 1))
    doubted = (changed > DOUBTED) & (changed < UNSURE)
    if doubted.any():
        truth[:, :, doubted] = followed(equations, start[:, doubted], values[:, doubted], times, FINER)[1]
    for k, (one, source) in enumerate(zip(drawn, sources, strict=True)):
        if not changed[k] < UNSURE:
            continue
        request = _request(kind, source) | {"scene": kind.scene(*one), "samples": samples}
        answer: Any = run(request)
        for j, name in enumerate(kind.multipliers):
            label = f"{kind.name} {k} {name} {request['method']} {answer['status']}"
            yield _compared(label, answer, name, truth[:, j, k])


def _request(kind: Kind, source: Random) -> dict[str, object]:
    method = source.choice(METHODS)
    base: dict[str, object] = {"t_end": kind.t_end, "method": method, "include": ["multipliers", "error"]}
    if source.random() < 0.25:
        return base | {"step": kind.t_end / source.choice(STEPS)}
    return base | {"tolerance": draw_tolerance(method, source, 1e-2, source.choice(TIGHTEST))}


def _compared(label: str, answer: Any, name: str, truth: np.ndarray) -> Compared:
    horizon = answer["error"]["horizon"]
    count = len(answer["t"]) if horizon is None else int(np.searchsorted(answer["t"], horizon))
    found = np.array(answer["multipliers"][name], dtype=np.longdouble)[:count]
    told = np.maximum(np.array(answer["error"]["multipliers"][name])[:count], 1e-300)
    true = np.asarray(np.abs(found - truth[:count]), dtype=np.float64)
    own = UNITS * np.abs(truth[:count]).astype(np.float64)
    counts = true > 10.0 * own
    where = counts if counts.sum() > 5 else np.ones(count, dtype=bool)
    excess = float(np.median(told[where] / np.maximum(true, own + 1e-300)[where])) if count else 1.0
    return Compared(label, float(np.max(np.maximum(true - own, 0.0) / told, initial=0.0)), excess)


def main(count: int, seed: str) -> None:
    """Tries, and reports by kind and altogether."""
    every: list[Compared] = []
    for kind in KINDS:
        found = list(compared(kind, seed, count))
        every += found
        _report(kind.name, found)
    _report("all", every)
    for one in sorted(every, key=lambda each: -max(each.short, each.excess))[:12]:
        print(f"{one.label}: {one.short:.2g} times too small, {one.excess:.3g} times too large")


def _report(name: str, found: list[Compared]) -> None:
    covered, within = np.mean([[each.short <= 1.0, each.is_within] for each in found], axis=0)
    print(f"{name}: {len(found)}, covered everywhere {covered:.1%}, within a factor of 100 {within:.1%}", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2])

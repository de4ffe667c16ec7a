"""The experiments there are: whatever stands in `experiments/`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache

from ..errors import Problem, UnknownNameError
from ..packages import modules_of
from .charts.chart import Chart, Say
from .report import Document, Report


@dataclass(frozen=True)
class Experiment:
    """What is measured, and how it is shown.

    `run` reads a request and reports until it is done; it raises InputError for what cannot be read. `charts` draws
    a result, also an unfinished one.
    """

    id: str
    run: Callable[[Mapping[str, object]], Iterator[Report]]
    charts: Callable[[Document, Say], list[Chart]]


@cache
def _experiments() -> dict[str, Experiment]:
    return {module.EXPERIMENT.id: module.EXPERIMENT for module in modules_of("deltaq.lab.experiments")}


def experiment_ids() -> tuple[str, ...]:
    return tuple(_experiments())


def get_experiment(identifier: str) -> Experiment:
    """The experiment of this id. Raises UnknownNameError if there is none."""
    if identifier not in _experiments():
        near = get_close_matches(identifier, experiment_ids(), n=1)
        told = {"name": identifier[:64], "suggestion": near[0] if near else "", "known": ", ".join(experiment_ids())}
        raise UnknownNameError(Problem("unknown-experiment", parameters=told))
    return _experiments()[identifier]

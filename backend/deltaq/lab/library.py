"""The experiments there are: whatever stands in `experiments/`. Light: the web process reads it, too."""

from __future__ import annotations

from difflib import get_close_matches
from importlib import import_module
from typing import TYPE_CHECKING, Any

from ..errors import Problem, UnknownNameError
from ..packages import names_of

if TYPE_CHECKING:
    from .experiment import Experiment

PACKAGE = "deltaq.lab.experiments"


def experiment_ids() -> tuple[str, ...]:
    """Ids of all experiments, in alphabetical order: the names of their files, with hyphens."""
    return tuple(name.replace("_", "-") for name in names_of(PACKAGE))


def get_experiment(identifier: str) -> Experiment[Any]:
    """The experiment of this id, and no other, is imported. Raises UnknownNameError if there is none."""
    if identifier not in experiment_ids():
        near = get_close_matches(identifier, experiment_ids(), n=1)
        told = {"name": identifier[:64], "suggestion": near[0] if near else "", "known": ", ".join(experiment_ids())}
        raise UnknownNameError(Problem("unknown-experiment", parameters=told))
    found: Experiment[Any] = import_module(f"{PACKAGE}.{identifier.replace('-', '_')}").EXPERIMENT
    return found

"""The subject of an experiment that linearizes, or moves states at will: in coordinates that keep constraints by
themselves, where these have a solution in closed form (the ladder's rung `minimal`).

Where a motion begins is told in the scene's own coordinates, so that it can be opened.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..contract.experiment import ExperimentRequest
from ..errors import Problem as Mistake
from ..errors import RequestError, SceneError
from ..simulation.problem import Floats
from ..simulation.service import problem_of
from .ladder.ending import known
from .ladder.measurement import full_run, seen
from .ladder.minimal import Minimal, minimal
from .ladder.simplification import Motion
from .report import Document
from .subject import Subject, subject_of

ACCURACY = 0.01  # of the motion that tells which of several solutions of the constraints is the scene's own


@dataclass(frozen=True)
class FreeSubject:
    """A subject without constraints; `minimal` is what it stands for where the scene has some."""

    subject: Subject
    minimal: Minimal | None = None

    @property
    def coordinates(self) -> tuple[str, ...]:
        """The minimal coordinates; none where the scene's own are."""
        return () if self.minimal is None else tuple(each.name for each in self.subject.scene.free)

    @property
    def described(self) -> Document:
        """The entries about the subject that every result has."""
        return self.subject.described | {"minimal": list(self.coordinates)}

    def begin(self, state: Floats) -> Document:
        """Initial values in the scene's own coordinates; `state` is (q, q̇), shape (≥ 2n,)."""
        n, names = self.subject.problem.degrees, [each.name for each in self.subject.scene.free]
        values, rates = (dict(zip(names, part.tolist(), strict=True)) for part in (state[:n], state[n : 2 * n]))
        if self.minimal is not None:
            columns = ({name: np.array([number]) for name, number in each.items()} for each in (values, rates))
            whole = self.minimal.back(Motion(np.zeros(1), *columns))
            names = [each.name for each in self.minimal.full.free]
            values, rates = ({name: float(part[name][0]) for name in names} for part in (whole.values, whole.rates))
        return {name: {"value": values[name], "rate": rates[name]} for name in names}


def minimal_subject_of(request: ExperimentRequest, samples: int = 501) -> FreeSubject:
    """The subject that a request names, in minimal coordinates where the scene has constraints.

    Raises InputError as `subject_of` does, and RequestError where the constraints have no closed solution.
    """
    subject = subject_of(request, samples)
    if not subject.problem.is_constrained:
        return FreeSubject(subject)
    run = full_run(subject.scene, subject.problem.t_end, np.zeros(1, dtype=np.int64))
    motion = seen(run).until(len(known(run, ACCURACY)[0].times))
    try:
        found = minimal(subject.scene, motion)
    except SceneError:
        count = {"count": len(subject.scene.constraints)}
        raise RequestError(Mistake("lab-constraints", "/scene", parameters=count)) from None
    problem = problem_of(found.scene, subject.problem.t_end, samples)
    return FreeSubject(Subject(found.scene, problem), found)

"""The subject of an experiment that linearizes: scenes with constraints in coordinates that keep them by themselves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..contract.experiment import ExperimentRequest
from ..errors import Problem as Mistake
from ..errors import RequestError, SceneError
from ..simulation.service import problem_of
from .ladder.ending import known
from .ladder.measurement import full_run, seen
from .ladder.minimal import minimal
from .subject import Subject, subject_of

ACCURACY = 0.01  # of the motion that tells which of several solutions of the constraints is the scene's own


@dataclass(frozen=True)
class FreeSubject:
    """A subject without constraints; `coordinates` are the minimal ones where the scene has some, else none."""

    subject: Subject
    coordinates: tuple[str, ...] = ()


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
    return FreeSubject(Subject(found.scene, problem), tuple(each.name for each in found.scene.free))

"""What an experiment is made on: a scene with its values, and the problem that they pose."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from ..contract.experiment import ExperimentRequest
from ..errors import Problem as Mistake
from ..errors import RequestError, UnknownNameError
from ..language.spelling import in_unicode, latex_of
from ..mechanics.jumps import frictions_of, impacts_of, jumps
from ..mechanics.requests import begun_scene, inside
from ..mechanics.scene import Scene
from ..mechanics.user_text import plainly
from ..simulation.driver import is_suitable, require_suitable
from ..simulation.library import get_method, method_ids
from ..simulation.method import Method
from ..simulation.problem import Problem
from ..simulation.service import problem_of
from .report import Document


@dataclass(frozen=True)
class Subject:
    """A scene with the values wanted, on [0, t_end]."""

    scene: Scene
    problem: Problem

    @property
    def described(self) -> Document:
        """The entries about the subject that every result has."""
        values = zip((p.name for p in self.scene.parameters), self.problem.parameters, strict=True)
        starts = zip(self.scene.free, self.problem.values, self.problem.rates, strict=True)
        return {
            "scene": self.scene.id,
            "title": plainly(self.scene.title),
            "names": _names(self.scene),
            "t_end": self.problem.t_end,
            "parameters": dict(values),
            "initial": {c.name: {"value": value, "rate": rate} for c, value, rate in starts},
        }


def _names(scene: Scene) -> Document:
    """How what the scene names is to be written: symbols of quantities, words for its parts in every language."""
    words: Document = {name: plainly(label) for name, label in scene.labels.items()}
    return words | symbols_of(scene)


def symbols_of(scene: Scene) -> Document:
    """The symbols of coordinates, parameters and multipliers."""
    latex = {one.name: one.latex for one in scene.coordinates} | {one.name: one.latex for one in scene.parameters}
    latex |= {one.name: one.latex for one in scene.multipliers}
    return {name: in_unicode(symbol or latex_of(name)) for name, symbol in latex.items()}


def subject_of(request: ExperimentRequest, samples: int = 501) -> Subject:
    """The subject that a request names.

    Raises InputError where there is no such scene, or none with these values, and RequestError for a scene with impacts
    or dry friction: experiments follow one set of equations, and motions that jump or stick follow several.
    """
    begun = begun_scene(request)
    refused = tuple(jumps(begun, Mistake("lab-impacts", "/scene"), Mistake("lab-friction", "/scene")))
    if refused:
        raise RequestError(*refused)
    return _posed(replace(begun, events=()), request, samples)  # about the equations, as if nothing ended the motion


def followed_subject_of(request: ExperimentRequest, samples: int = 501) -> Subject:
    """The subject of an experiment that runs a scene as a simulation does, behind impacts, sticking and slipping.

    What ends motions is left out. Raises InputError where there is no such scene, or none with these values.
    """
    begun = begun_scene(request)
    return _posed(replace(begun, events=tuple(each for each in begun.events if each.bounces)), request, samples)


def hybrid_subject_of(request: ExperimentRequest, samples: int = 501) -> Subject | None:
    """The subject of an experiment that follows motions behind impacts, and while they stick and slip.

    None for a scene without such, or with constraints besides. What ends motions is left out. Raises InputError where
    there is no such scene, or none with these values.
    """
    begun = begun_scene(request)
    if begun.constraints or not (impacts_of(begun) or frictions_of(begun)):
        return None
    return _posed(replace(begun, events=tuple(each for each in begun.events if each.bounces)), request, samples)


def _posed(scene: Scene, request: ExperimentRequest, samples: int) -> Subject:
    with inside("/scene"):
        return Subject(scene, problem_of(scene, request.t_end, samples))


def free_subject_of(request: ExperimentRequest, samples: int = 501) -> Subject:
    """The subject of an experiment that moves states at will: a scene without constraints, which would not let it.

    Raises InputError as `subject_of` does, and RequestError for a scene with constraints.
    """
    subject = subject_of(request, samples)
    if subject.problem.is_constrained:
        count = {"count": len(subject.scene.constraints)}
        raise RequestError(Mistake("lab-starts-with-constraints", "/scene", parameters=count))
    return subject


def bounded(subject: Subject, step_limit: int) -> Problem:
    """The problem, with fewer steps allowed in one run."""
    return replace(subject.problem, step_limit=step_limit)


def methods_of(problem: Problem, names: Sequence[str], default: Sequence[str] = ()) -> tuple[Method, ...]:
    """The methods asked for; if none is named the default ones, or else all that can do the problem.

    Raises UnknownNameError with the place in the list, and RequestError for one that cannot do the problem.
    """
    if not names:
        usual = map(get_method, default or method_ids())
        return tuple(method for method in usual if is_suitable(problem, method))
    found = []
    for index, name in enumerate(names):
        try:
            found.append(get_method(name))
        except UnknownNameError as error:
            problems = (replace(one, pointer=f"/methods/{index}") for one in error.problems)
            raise UnknownNameError(*problems) from None
        require_suitable(problem, found[-1], f"/methods/{index}")
    return tuple(dict.fromkeys(found))


def parameter_of(subject: Subject, name: str, pointer: str) -> int:
    """The place of a parameter among those of the model. Raises UnknownNameError if the scene has none of this name."""
    known = subject.problem.model.layout.parameters
    if name not in known:
        told = {"name": name[:40], "known": ", ".join(known)}
        raise UnknownNameError(Mistake("unknown-parameter", pointer, parameters=told))
    return known.index(name)

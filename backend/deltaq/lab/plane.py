"""The plane of a Poincaré section, and what is plotted of the motions that cross it.

Where nothing drives the scene, the plane is a value of a coordinate, say, and all orbits have one energy; a scene that
something drives periodically is looked at once in each period (stroboscopically).
Sources: H. Poincaré, Les méthodes nouvelles III (1899), ch. 27; Hénon, Heiles, Astron. J. 69 (1964) 73–79.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..contract.experiments.poincare_section import Direction, PoincareSectionRequest
from ..errors import Parameter, RequestError, escaped
from ..errors import Problem as Mistake
from ..language.expression import Expression
from ..language.parser import parse
from ..language.rewriting import written
from ..mechanics.requests import inside
from ..mechanics.scene import Scene
from ..model.compiled import Compiled
from ..model.observables import Observable, Observables
from ..simulation.plane import SIGNS, parsed
from ..simulation.problem import Floats, Problem
from ..simulation.section import Surface
from .period import clocks, period
from .subject import Subject

LOST = 1e-7  # of the energy along the scene's own motion: more than rounding takes
COARSE = 1e-6  # from an angle to the next number: more than can be drawn is lost


@dataclass(frozen=True)
class Section:
    """A plane h(q, q̇, t) = 0, the direction in which it is crossed, and the functions on both axes."""

    problem: Problem
    observables: Observables
    is_driven: bool
    plane: Expression
    direction: Direction
    axes: tuple[Expression, Expression]

    @cached_property
    def function(self) -> Observable:
        """h."""
        return self.observables.observable(self.plane)

    @cached_property
    def surface(self) -> Surface:
        """The plane as motions meet it."""
        turn = math.tau if _turns(self.function, self.problem) else math.inf
        return Surface(self.function.jet.table, SIGNS[self.direction], turn)

    @cached_property
    def turns(self) -> tuple[bool, ...]:
        """Whether what stands on an axis means the same after a turn."""
        return tuple(_turns(self.observables.observable(each), self.problem) for each in self.axes)

    @property
    def places(self) -> tuple[int, ...]:
        """The components of (q, q̇) that stand on an axis by themselves."""
        scene = self.observables.scene
        components = _components([coordinate.name for coordinate in scene.free])
        known = {written(parse(text, scene.names).tree): place for place, text in enumerate(components)}
        found = (known.get(written(each.tree)) for each in self.axes)
        return tuple(place for place in found if place is not None)

    @cached_property
    def _seen(self) -> Compiled:
        return self.observables.seen(self.axes)

    def at(self, rows: Floats) -> Floats:
        """x, y and the energy at rows (q, q̇, t), shape (rows, 3); what turns is between −π and π."""
        if not len(rows):
            return np.zeros((0, 3))
        found = self._seen.table(rows)
        for column, turns in enumerate(self.turns):
            if turns:
                found[:, column] = np.remainder(found[:, column] + math.pi, math.tau) - math.pi
        return found


def observables_of(request: PoincareSectionRequest, subject: Subject) -> Observables:
    """What can be seen of the subject.

    Raises RequestError for one degree of freedom that nothing drives, and for an energy where something drives.
    """
    found = Observables(subject.scene)
    if not found.depends_on_time and subject.problem.degrees < 2:
        raise RequestError(Mistake("section-one-degree", "/scene"))
    if found.depends_on_time and request.energy is not None:
        raise RequestError(Mistake("section-energy-driven", "/energy"))
    return found


def section_of(request: PoincareSectionRequest, problem: Problem, observables: Observables, path: Floats) -> Section:
    """The section that a request means; `path`, shape (steps, 2n + 1), is the scene's own motion as (q, q̇, t).

    Raises InputError that says what to ask instead: for a motion whose energy is lost, for a plane that is no plane.
    """
    scene, is_driven = observables.scene, observables.depends_on_time
    _require_fine(request, problem)
    given = request.plane.strip()
    plane = parsed(given, scene, "/plane") if given else _usual_plane(scene, problem, path, is_driven=is_driven)
    function = observables.observable(plane)
    if function.is_constant:
        raise RequestError(Mistake("section-plane-constant", "/plane", parameters={"plane": plane.text[:80]}))
    first, second = _usual_axes(scene, problem, function)
    axes = [
        parsed(asked.strip() or usual, scene, f"/{name}")
        for name, asked, usual in (("horizontal", request.horizontal, first), ("vertical", request.vertical, second))
    ]
    found = Section(problem, observables, is_driven, plane, request.direction, (axes[0], axes[1]))
    if not is_driven:
        _require_energy(found, path)
    return found


def _require_fine(request: PoincareSectionRequest, problem: Problem) -> None:
    """Raises RequestError where an angle is so large that the numbers beside it are no longer near."""
    for place in np.flatnonzero(problem.angular):
        value, name = problem.state[place], problem.model.layout.free[place]
        gap = float(np.spacing(abs(value)))
        if gap > COARSE:
            told: dict[str, Parameter] = {"name": name, "value": float(value), "gap": float(f"{gap:.2g}")}
            where = f"/initial/{escaped(name)}/value" if name in request.initial else "/scene"
            raise RequestError(Mistake("angle-too-large", where, parameters=told))


def _require_energy(section: Section, path: Floats) -> None:
    """Raises RequestError where the motion does not keep its energy."""
    energies = section.at(path)[:, 2]
    scale = float(np.abs(energies).max() + np.ptp(path[:, section.problem.degrees : -1]))
    lost = float(np.ptp(energies))
    if lost > LOST * scale:
        told = {"lost": float(f"{lost:.3g}"), "t": float(f"{path[-1, -1]:.3g}")}
        raise RequestError(Mistake("section-dissipation", "/scene", parameters=told))


def _usual_plane(scene: Scene, problem: Problem, path: Floats, *, is_driven: bool) -> Expression:
    """The phase of what drives the scene; else the first coordinate that its own motion takes through zero or round."""
    if is_driven:
        with inside("/scene"):
            seconds, phases = period(scene), {written(clock) for clock in clocks(scene)}
        text = f"sin({phases.pop()})" if len(phases) == 1 else f"sin(2*pi*t/{seconds!r})"
        return parse(text, scene.names)
    names = [coordinate.name for coordinate in scene.free]
    crossed = (
        name
        for name, values, is_angle in zip(names, path.T, problem.angular, strict=False)
        if values.min() < 0.0 < values.max() or (is_angle and np.ptp(values) > math.tau)
    )
    return parse(next(crossed, names[0]), scene.names)


def _usual_axes(scene: Scene, problem: Problem, plane: Observable) -> tuple[str, str]:
    """The first coordinate that does not stand in the plane, and its rate."""
    names = [coordinate.name for coordinate in scene.free]
    free = [name for i, name in enumerate(names) if i not in {place % problem.degrees for place in plane.places}]
    chosen = (free or names)[0]
    return chosen, f"dot({chosen})"


def _components(names: list[str]) -> list[str]:
    """The components of (q, q̇) as expressions."""
    return [*names, *(f"dot({name})" for name in names)]


def _turns(function: Observable, problem: Problem) -> bool:
    """Whether a turn of one of the angles changes the value by a turn, and nothing else."""
    return any(problem.angular[place] for place in function.turning)

"""A scene in minimal coordinates s instead of constraints, with the way there and back: q = X(s, t)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ...errors import Problem, SceneError
from ...mechanics.coordinate import Coordinate
from ...mechanics.scene import Scene
from ...mechanics.soundness import expressions
from ...model.compiled import Compiled, compile_expressions
from ...model.elimination import substituted
from ...model.minimal import Solution, kept_positions, numbers, solution
from ...model.symbols import CLOCK
from ...model.symengine_algebra import SymEngineAlgebra
from ...simulation.problem import Floats
from ...simulation.service import problem_of
from .centre import starting
from .names import fresh, tidied
from .simplification import Motion

LONGEST = 240  # characters of an expression: with longer ones deriving and compiling take minutes
LETTERS = {1: ("phi",), 2: ("theta", "psi")}
LATEX = {"phi": r"\varphi", "theta": r"\vartheta", "psi": r"\psi"}


def minimal(scene: Scene, seen: Motion) -> Minimal:
    """The scene in minimal coordinates that give a motion of it. Raises SceneError where there is no closed form."""
    names = {"names": ", ".join(constraint.name for constraint in scene.constraints)}
    columns = {each.name: seen.values[each.name] for each in scene.free} if len(seen.times) else {}
    motion = {**columns, CLOCK: seen.times}
    if columns and kept_positions(scene, motion) is None:
        raise SceneError(Problem("ladder-nonholonomic", parameters=names))
    found = solution(scene, motion) if columns else None
    if found is None:
        raise SceneError(Problem("ladder-minimal", parameters=names))
    added = _coordinates(scene, found)
    guided = (*(guide.coordinate for guide in scene.guides), *(each.name for each in added))
    symbols = replace(found.symbols, guided=guided)
    bare = substituted(replace(scene, constraints=(), labels={}), symbols, found.values, added, found.waves)
    if any(len(each.expression.text) > LONGEST for each in expressions(bare)):
        raise SceneError(Problem("ladder-minimal-long", parameters=names))
    told = Minimal(tidied(bare, scene.labels), scene, found, tuple(each.name for each in added))
    return replace(told, scene=starting(told.scene, told.begins))


def _coordinates(scene: Scene, found: Solution) -> tuple[Coordinate, ...]:
    """φ for a point on a circle, ϑ and ψ on a sphere, numbered where there are several points."""
    unit = "rad" if any(each.unit for each in scene.coordinates) else ""
    several, taken = len(found.widths) > 1, scene
    for number, width in enumerate(found.widths, 1):
        for letter in LETTERS[width]:
            wanted = f"{letter}{number}" if several else letter
            name = fresh(taken, wanted)
            latex = f"{LATEX[letter]}_{{{number}}}" if several else LATEX[letter]
            made = Coordinate(name, latex if name == wanted else "", unit)
            taken = replace(taken, coordinates=(*taken.coordinates, made))
    return taken.coordinates[len(scene.coordinates) :]


@dataclass(frozen=True)
class Minimal:
    """A `scene` in minimal coordinates for the `full` one; `added` are the names of its new coordinates."""

    scene: Scene
    full: Scene
    found: Solution
    added: tuple[str, ...]

    @property
    def _names(self) -> Mapping[str, str]:
        """What the coordinates that are left are called in the solution, by their names in the scene."""
        kept = {each.name: each.name for each in self.scene.free if each.name not in self.added}
        return kept | dict(zip(self.added, self.found.added, strict=True))

    @property
    def begins(self) -> Mapping[str, tuple[float, float]]:
        """Initial values and rates of the minimal coordinates, from consistent ones of the full scene."""
        task = problem_of(self.full, 1.0)
        free = task.model.layout.free
        values = {name: np.array([value]) for name, value in zip(free, task.values, strict=True)}
        known = {**values, **self._constants, CLOCK: np.zeros(1)}
        known |= numbers(self.found, known)
        places = {own: float(known[name][0]) for own, name in self._names.items()}
        rates = self._rates(known, np.array(task.rates), free)
        return {own: (places[own], float(rate)) for own, rate in zip(self._names, rates, strict=True)}

    def _rates(self, known: Mapping[str, Floats], rates: Floats, free: tuple[str, ...]) -> Floats:
        """ṡ = (∂X/∂s)⁺ (q̇ − ∂X/∂t): shape (left,)."""
        symbols, left = self.found.symbols, tuple(self._names.values())
        names = [name for name in symbols.values if name in known]
        given = [self.found.values.get(name, symbols.values[name]) for name in free]
        slopes = [value.diff(symbols.values[name]) for value in given for name in (*left, CLOCK)]
        row = np.array([[float(known[name][0]) for name in names]])
        table = compile_expressions([symbols.values[name] for name in names], slopes).table(row)
        matrix = table.reshape(len(free), len(left) + 1)
        return np.asarray(np.linalg.lstsq(matrix[:, :-1], rates - matrix[:, -1], rcond=None)[0])

    @property
    def _constants(self) -> Mapping[str, Floats]:
        return {each.name: np.array([each.value]) for each in self.full.parameters}

    @cached_property
    def _function(self) -> Compiled:
        """X, Ẋ and Ẍ of what was given up, by s, ṡ, s̈, t and the parameters."""
        symbols, left = self.found.symbols, tuple(self._names.values())
        algebra = SymEngineAlgebra(symbols)
        rates = [algebra.time_derivative(value) for value in self.found.values.values()]
        accelerations = [algebra.time_derivative(rate) for rate in rates]
        moving = [part[name] for part in (symbols.values, symbols.rates, symbols.accelerations) for name in left]
        inputs = [*moving, symbols.time, *(symbols.values[each.name] for each in self.full.parameters)]
        return compile_expressions(inputs, [*self.found.values.values(), *rates, *accelerations])

    def back(self, motion: Motion) -> Motion:
        """The motion in the coordinates of the full scene."""
        still = {name: np.zeros(len(motion.times)) for name in motion.rates}
        values, rates, _ = self.whole(motion, still)
        return Motion(motion.times, values, rates)

    def whole(self, motion: Motion, accelerations: Mapping[str, Floats]) -> tuple[Mapping[str, Floats], ...]:
        """Values, rates and accelerations of the full scene's coordinates, by name, shape (samples,) each.

        `accelerations` are those of the minimal ones.
        """
        given = (motion.values, motion.rates, accelerations)
        columns = [part[name] for part in given for name in self._names]
        count, constants = len(motion.times), [each.value for each in self.full.parameters]
        rows = np.column_stack([*columns, motion.times, np.tile(constants, (count, 1))])
        gone = np.split(self._function.table(rows).T, 3)
        return tuple(
            {**part, **dict(zip(self.found.values, found, strict=True))}
            for part, found in zip(given, gone, strict=True)
        )

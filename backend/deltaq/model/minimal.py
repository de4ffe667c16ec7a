"""Coordinates that keep constraints on positions by themselves: one is given up for each, in closed form.

Constraints on rates count where they can be integrated (`integrated.py`). The constraints g(q, t) = 0 are solved one
after another, for a coordinate that stands in them linearly, for an angle in place of the two or three coordinates of a
point at a given distance, for an angle whose sine and cosine stand in them linearly (atan2, acos), for two such
equations of a loop at once, or by a root. Which of several solutions is the scene's own is told by a motion of it:
coordinates X(s, t) are found only if they give that motion throughout.
Sources: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., §1.3; McCarthy, Geometric Design of Linkages, ch. 2
(closed loops of four bars).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import islice

import numpy as np
import symengine as se

from ..errors import SceneError
from ..mechanics.scene import Scene
from .compiled import Floats, compile_expressions
from .equations import guided_into
from .functions import Expr
from .integrated import exactly, integrated
from .minimal_ways import Unsolved, Way, ways
from .symbols import CLOCK, Symbols
from .symengine_algebra import to_symengine
from .turned import Turned, Waves

MOST = 60  # choices looked at
SAMPLES = 400
SAME = 1e-6  # of a coordinate or of 1: it is what the motion has
CLEAR = 1e-3  # of 1: a square of a sine, and the like
TURN = 2.0 * np.pi
SPARE = "#"


@dataclass(frozen=True)
class Solution:
    """X(s, t): the `values` of the coordinates that are given up, in those that are left and in `added` ones.

    `inverses` are the added ones in coordinates of the scene and in added ones before them. All are written in
    `symbols`, where the added ones have names of their own. `widths` tell how many of them stand for each
    point, `waves` are sine and cosine of angles that are given up.
    """

    symbols: Symbols
    values: Mapping[str, Expr]
    added: tuple[str, ...]
    inverses: Mapping[str, Expr]
    widths: tuple[int, ...] = ()
    waves: Mapping[str, Waves] = field(default_factory=dict)


def solution(scene: Scene, columns: Mapping[str, Floats]) -> Solution | None:
    """Minimal coordinates for a scene with constraints that bind positions; None where no closed form is found.

    `columns` are the free coordinates along a motion of the scene and its times, under `t`: shape (samples,) each.
    """
    kept = kept_positions(scene, columns)
    if kept is None:
        return None
    kept = tuple(kept[place] for place in scene.independence.chosen)  # the others follow
    found = (each.found for each in islice(_search(_begun(scene, columns, kept)), MOST) if not each.unsolved.conditions)
    return next(found, None)


def kept_positions(scene: Scene, columns: Mapping[str, Floats]) -> tuple[Expr, ...] | None:
    """g(q, t) of every constraint, those on rates integrated from where a motion begins; None where one cannot be.

    `columns` are the free coordinates along the motion and its times, under `t`: shape (samples,) each.
    """
    symbols = Symbols.of(scene)
    stated = {each.name: each.value for each in scene.coordinates}
    first = {name: exactly(float(columns[name][0]), stated[name]) for name in symbols.free}
    start = {symbols.values[name]: value for name, value in first.items()}
    start[symbols.time] = exactly(float(columns[CLOCK][0]), 0.0)
    written = [guided_into(scene, to_symengine(each.value, symbols)) for each in scene.conditions]
    pairs = zip(written, scene.conditions, strict=True)
    found = [value if each.is_holonomic else integrated(value, symbols, start) for value, each in pairs]
    return None if any(value is None for value in found) else tuple(found)


def _begun(scene: Scene, columns: Mapping[str, Floats], conditions: tuple[Expr, ...]) -> _Branch:
    own, count = Symbols.of(scene), 2 * len(scene.constraints)
    spare = tuple(f"{SPARE}{k}" for k in range(count))
    symbols = replace(own, guided=(*own.guided, *spare))
    lengths = tuple(symbols.values[each.name] for each in scene.parameters if each.positive)
    free = {name: symbols.values[name] for name in own.free}
    unsolved = Unsolved(conditions, free, lengths, scene.dimension, is_down=scene.drawing.vertical == "down")
    kept = np.linspace(0, len(columns[CLOCK]) - 1, min(SAMPLES, len(columns[CLOCK]))).astype(int)
    thinned = {name: column[kept] for name, column in columns.items()}
    constants = scene.parameter_values
    return _Branch(unsolved, Solution(symbols, {}, (), {}), thinned, constants)


@dataclass(frozen=True)
class _Branch:
    """What is left to solve, what has been found, and the motion in all coordinates met so far."""

    unsolved: Unsolved
    found: Solution
    columns: Mapping[str, Floats]
    constants: Mapping[str, float]

    def after(self, way: Way) -> _Branch | None:
        """The branch behind a choice; None where it does not give the motion."""
        spare = iter(name for name in self.found.symbols.guided if name.startswith(SPARE))
        unused = (name for name in spare if name not in self.found.added)
        names = dict(zip(way.inverses, unused, strict=False))
        renamed = {symbol: self.found.symbols.values[name] for symbol, name in names.items()}
        inverses = {names[symbol]: inverse for symbol, inverse in way.inverses.items()}
        wider = {**self.columns, **{name: self._along(inverse) for name, inverse in inverses.items()}}
        values = {name: se.sympify(value).subs(renamed) for name, value in way.values.items()}
        branch = replace(self, columns=wider)
        if not (branch.gives(values) and self._is_clear(way.guards)):
            return None
        turned = Turned(
            {self.unsolved.free[name]: value for name, value in values.items()},
            {self.unsolved.free[name]: pair for name, pair in way.waves.items()},
        )
        left = tuple(each for i, each in enumerate(self.unsolved.conditions) if i not in way.solved)
        free = {name: symbol for name, symbol in self.unsolved.free.items() if name not in values}
        free |= {name: self.found.symbols.values[name] for name in inverses}
        unsolved = replace(self.unsolved, conditions=tuple(map(turned.into, (*left, *way.instead))), free=free)
        return replace(branch, unsolved=unsolved, found=self._found(turned, values, way.waves, inverses))

    def _found(
        self, turned: Turned, values: Mapping[str, Expr], waves: Mapping[str, Waves], inverses: Mapping[str, Expr]
    ) -> Solution:
        """What was found before, with what is found now put in, and that."""
        known = self.found
        pairs = {name: (turned.into(sine), turned.into(cosine)) for name, (sine, cosine) in known.waves.items()}
        return Solution(
            known.symbols,
            {name: turned.into(value) for name, value in known.values.items()} | dict(values),
            (*known.added, *inverses),
            {**known.inverses, **inverses},
            (*known.widths, len(inverses)) if inverses else known.widths,
            {**pairs, **waves},
        )

    def gives(self, values: Mapping[str, Expr]) -> bool:
        """Whether values are those of the coordinates all along the motion."""
        return all(self._is(name, value) for name, value in values.items())

    def _is(self, name: str, value: Expr) -> bool:
        """Whether a value is the coordinate; of an angle whole turns do not count."""
        apart = self._along(value) - self.columns[name]
        turns = np.round(apart / TURN) * TURN if value.atoms(se.asin, se.acos, se.atan2) else 0.0
        return bool((np.abs(apart - turns) <= SAME * np.maximum(1.0, np.abs(self.columns[name]))).all())

    def _is_clear(self, guards: tuple[Expr, ...]) -> bool:
        """Whether the motion stays away from poles and folds."""
        return all(float(np.min(np.abs(self._along(se.sympify(guard))))) > CLEAR for guard in guards)

    def _along(self, value: Expr) -> Floats:
        """An expression at the samples; not a number where it has no real value."""
        symbols, count = self.found.symbols, len(self.columns[CLOCK])
        known: dict[str, Floats | float] = {**self.constants, **self.columns}
        names = [name for name in symbols.values if name in known]
        rows = np.column_stack([np.broadcast_to(known[name], count) for name in names])
        try:
            return compile_expressions([symbols.values[name] for name in names], [value]).table(rows)[:, 0]
        except SceneError:
            return np.full(count, np.nan)


def _search(branch: _Branch) -> Iterator[_Branch]:
    """The branches met, depth first; one whose last condition is solved is the end of its search."""
    yield branch
    for way in ways(branch.unsolved) if branch.unsolved.conditions else ():
        following = branch.after(way)
        if following is not None:
            yield from _search(following)


def numbers(found: Solution, inputs: Mapping[str, Floats]) -> Mapping[str, Floats]:
    """The added coordinates at given values of the scene's own, of its parameters and of `t`: shape (samples,) each."""
    known = dict(inputs)
    for name, inverse in found.inverses.items():
        names = [each for each in found.symbols.values if each in known]
        rows = np.column_stack(np.broadcast_arrays(*(known[each] for each in names)))
        function = compile_expressions([found.symbols.values[each] for each in names], [inverse])
        known[name] = function.table(rows)[:, 0]
    return {name: known[name] for name in found.added}

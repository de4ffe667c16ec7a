"""Coordinates put in by others: q := X(other coordinates, t), and q̇ by the chain rule."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace
from typing import TypeVar

from ..language.expression import Expression
from ..mechanics.coordinate import Coordinate
from ..mechanics.scene import Scene, names_of
from .functions import Expr
from .symbols import Symbols
from .symengine_algebra import SymEngineAlgebra, to_symengine
from .turned import Turned, Waves
from .writing import Writer

T = TypeVar("T")


def eliminated(scene: Scene, coordinate: str, value: Expression) -> Scene:
    """The scene without a free coordinate; all that depended on it depends on the others instead.

    Labels and drawing stay. Raises ExpressionError where an expression becomes longer than a scene may have.
    """
    symbols = Symbols.of(scene)
    return substituted(scene, symbols, {coordinate: to_symengine(value.tree, symbols)})


def substituted(
    scene: Scene,
    symbols: Symbols,
    values: Mapping[str, Expr],
    added: tuple[Coordinate, ...] = (),
    waves: Mapping[str, Waves] | None = None,
) -> Scene:
    """The scene without several coordinates, by their `values` in what is left and in coordinates that are `added`.

    `symbols` are those that the values are written in, `waves` sines and cosines of angles among them. Constraints,
    labels and drawing stay as they are. Raises ExpressionError where an expression becomes longer than a scene may
    have.
    """
    left = (*(each for each in scene.coordinates if each.name not in values), *added)
    elimination = _Elimination.of(scene, symbols.within(scene.material), values, waves or {}, left)
    return replace(
        scene,
        coordinates=left,
        points=tuple(rewritten(each, elimination.into) for each in scene.points),
        bodies=tuple(rewritten(each, elimination.into) for each in scene.bodies),
        loads=tuple(rewritten(each, elimination.into) for each in scene.loads),
        events=tuple(rewritten(each, elimination.into) for each in scene.events),
    )


def rewritten(thing: T, change: Callable[[Expression], Expression]) -> T:
    """A point, body, load or event with all its expressions changed."""
    found = {item.name: getattr(thing, item.name) for item in fields(thing)}  # type: ignore[arg-type]
    return replace(thing, **{key: _changed(value, change) for key, value in found.items()})  # type: ignore[type-var]


def _changed(value: object, change: Callable[[Expression], Expression]) -> object:
    match value:
        case Expression():
            return change(value)
        case tuple():
            return tuple(_changed(part, change) for part in value)
    return value


@dataclass(frozen=True)
class _Elimination:
    gone: frozenset[str]
    symbols: Symbols
    writer: Writer
    put: Turned

    @classmethod
    def of(
        cls,
        scene: Scene,
        symbols: Symbols,
        values: Mapping[str, Expr],
        waves: Mapping[str, Waves],
        left: tuple[Coordinate, ...],
    ) -> _Elimination:
        algebra, names = SymEngineAlgebra(symbols), names_of(left, scene.parameters, scene.material)
        places = {symbols.values[name]: value for name, value in values.items()}
        rates = {symbols.rates[name]: algebra.time_derivative(value) for name, value in values.items()}
        turned = Turned(places | rates, {symbols.values[name]: pair for name, pair in waves.items()})
        return cls(frozenset(values), symbols, Writer(symbols, names), turned)

    def into(self, expression: Expression) -> Expression:
        """The expression without the coordinates that are gone."""
        if not self.gone & (expression.names | expression.rates):
            return expression
        return self.writer.expression(self.put.into(to_symengine(expression.tree, self.symbols)))

"""A coordinate put in by the others: q := X(other coordinates, t), and q̇ by the chain rule."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from typing import TypeVar

from ..language.expression import Expression
from ..mechanics.scene import Scene, names_of
from .functions import Expr
from .symbols import Symbols
from .symengine_algebra import SymEngineAlgebra, to_symengine
from .writing import Writer

T = TypeVar("T")


def eliminated(scene: Scene, coordinate: str, value: Expression) -> Scene:
    """The scene without a free coordinate; all that depended on it depends on the others instead.

    Labels and drawing stay. Raises ExpressionError where an expression becomes longer than a scene may have.
    """
    left = tuple(each for each in scene.coordinates if each.name != coordinate)
    elimination = _Elimination.of(scene, coordinate, value)
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
    coordinate: str
    symbols: Symbols
    writer: Writer
    value: Expr
    rate: Expr

    @classmethod
    def of(cls, scene: Scene, coordinate: str, value: Expression) -> _Elimination:
        left = tuple(each for each in scene.coordinates if each.name != coordinate)
        symbols = Symbols.of(scene).within(scene.material)
        names = names_of(left, scene.parameters, scene.material)
        found = to_symengine(value.tree, symbols)
        return cls(coordinate, symbols, Writer(symbols, names), found, SymEngineAlgebra(symbols).time_derivative(found))

    def into(self, expression: Expression) -> Expression:
        """The expression without the coordinate."""
        if self.coordinate not in expression.names:
            return expression
        symbols = self.symbols
        put = {symbols.values[self.coordinate]: self.value, symbols.rates[self.coordinate]: self.rate}
        return self.writer.expression(to_symengine(expression.tree, symbols).subs(put))

"""Material coordinates: which particle of a continuum is meant."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from ..errors import InputError, Problem
from ..language.expression import Expression
from ..language.names import Names, Symbol
from .checks import demand, name_problem
from .reader import Reader


@dataclass(frozen=True)
class Material:
    """A material coordinate s between two bounds, which depend on parameters alone."""

    name: str
    lower: Expression
    upper: Expression

    def __post_init__(self) -> None:
        demand(name_problem(self.name))

    def write(self) -> dict[str, str]:
        """The coordinate as it stands in a document."""
        return {"name": self.name, "from": self.lower.text, "to": self.upper.text}


def read_material(table: Reader) -> tuple[Material, ...]:
    """The field `material`: one to three material coordinates."""
    tables = table.tables("material")
    if not 1 <= len(tables) <= 3:
        table.complain("material-count", "material", found=len(tables))
    return tuple(thing for inner in tables[:3] for thing in inner.build(_read))


def _read(table: Reader) -> Material:
    return Material(table.name(), table.expression("from"), table.expression("to"))


def within(table: Reader, material: tuple[Material, ...]) -> Reader:
    """The same table, whose expressions may use the material coordinates."""
    context = table.named
    symbols = tuple(Symbol(coordinate.name, "material") for coordinate in material)
    known = tuple(symbol for symbol in context.names.symbols if symbol.kind not in ("time", "constant"))
    try:
        names = Names(known + symbols)
    except InputError as error:
        table.problems.extend(_at_material(table, error))
        return table
    return replace(table, context=replace(context, names=names))


def _at_material(table: Reader, error: InputError) -> Iterator[Problem]:
    yield from (replace(problem, pointer=f"{table.pointer}/material") for problem in error.problems)

"""Scene documents (format 1): TOML on disk, the same structure as JSON in the API."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from typing import TypeVar, cast

from ..errors import InputError, Problem, SceneError
from ..language.names import Kind, Names, Symbol, is_name
from ..packages import classes_of
from .bodies import Body
from .checks import as_float
from .constraints import Constraint
from .coordinate import Coordinate
from .drawing import Drawing, Element, Vertical
from .event import Event
from .guide import Guide
from .loads import Load
from .parameter import Parameter
from .point import Point
from .reader import Context, Reader
from .scene import Scene
from .soundness import soundness_problems
from .user_text import Translated

T = TypeVar("T")
FORMAT = 1
KINDS: Mapping[str, Kind] = {"coordinates": "coordinate", "parameters": "parameter"}
IDENTIFIER = re.compile(r"[a-z0-9][a-z0-9-]{0,63}")


def read_scene(document: Mapping[str, object]) -> Scene:
    """The scene a document describes. Raises SceneError with every problem found, each with its JSON pointer."""
    scene, problems = examine(document)
    errors = tuple(problem for problem in problems if problem.severity == "error")
    if scene is None or errors:
        raise SceneError(*errors)
    return scene


def examine(document: Mapping[str, object]) -> tuple[Scene | None, tuple[Problem, ...]]:
    """The scene as far as it can be read, with all errors and warnings."""
    problems: list[Problem] = []
    for scene in list(_scene(Reader(document, "", problems, used=set()))):
        return scene, (*problems, *(() if problems else soundness_problems(scene)))
    return None, tuple(problems)


def names_in(document: Mapping[str, object]) -> Names:
    """The names that expressions of a document may use, whatever else is wrong with it."""
    return _names(Reader(document, "", []))


def _scene(root: Reader) -> Iterator[Scene]:
    """The scene, if all its parts are sound; what it says of itself (no body, no freedom) only matters then."""
    if root.get("format", int, FORMAT) != FORMAT:
        root.complain("unknown-format", "format", expected=FORMAT)
    context = Context(_names(root), _place_names(root), _dimension(root), _multipliers(root))
    make = partial(
        Scene,
        _identifier(root),
        root.translated("title"),
        root.translated("summary"),
        context.dimension,
        _each(root.tables("coordinates"), read_coordinate),
        _each(root.tables("parameters"), read_parameter),
        _each(root.tables("points", context), read_point),
        _each(root.tables("bodies", context), read_body),
        _each(root.tables("loads", context), read_load),
        _each(root.tables("guides", context), read_guide),
        _drawing(root, context),
        _labels(root),
        _each(root.tables("events", context), Event.read),
        _each(root.tables("constraints", context), read_constraint),
    )
    yield from root.build(lambda _: make()) if not root.problems else ()


def _each(tables: tuple[Reader, ...], make: Callable[[Reader], T]) -> tuple[T, ...]:
    return tuple(thing for table in tables for thing in table.build(make))


def _dimension(root: Reader) -> int:
    given = root.get("dimension", int, 2)
    dimension = 2 if given is None else given
    if dimension in (2, 3):
        return dimension
    root.complain("wrong-space", "dimension")
    return 2


def _identifier(root: Reader) -> str:
    identifier = root.text("id", "scene")
    if not IDENTIFIER.fullmatch(identifier):
        root.complain("invalid-id", "id", name=identifier[:40])
    return identifier


def _labels(root: Reader) -> Mapping[str, Translated]:
    table = Reader(root.get("labels", Mapping, {}) or {}, "/labels", root.problems)
    return {str(name)[:40]: table.translated(str(name)) for name in table.table}


def _names(root: Reader) -> Names:
    """The names that expressions may use; a coordinate with a wrong value still has its name."""
    named = [
        (f"/{key}/{index}/name", Symbol(name, kind, _text(table, "latex"), _is_positive(kind, table)))
        for key, kind in KINDS.items()
        for index, table in _well_formed(root, key)
        if is_name(name := _text(table, "name"))
    ]
    try:
        return Names(tuple(symbol for _, symbol in named))
    except InputError as error:
        bad = {(p.code, p.parameters.get("name")) for p in error.problems}
    # Go on with the names that are sound, so that what uses them is not called unknown as well.
    sound: dict[str, Symbol] = {}
    for pointer, symbol in named:
        code = "duplicate-name" if symbol.name in sound else "reserved-name"
        if (code, symbol.name) in bad:
            root.problems.append(Problem(code, pointer, parameters={"name": symbol.name}))
        else:
            sound[symbol.name] = symbol
    return Names(tuple(sound.values()))


def _is_positive(kind: Kind, table: Mapping[str, object]) -> bool:
    return kind == "parameter" and table.get("positive", True) is True


def _well_formed(root: Reader, key: str) -> tuple[tuple[int, Mapping[str, object]], ...]:
    """The tables of a list that are tables, with their places in it."""
    value = root.table.get(key)
    members = enumerate(value if isinstance(value, list | tuple) else ())
    return tuple((index, table) for index, table in members if isinstance(table, Mapping))


def _place_names(root: Reader) -> tuple[str, ...]:
    """Points and bodies; a continuum is no place, for it is everywhere."""
    tables = (table for key in ("points", "bodies") for _, table in _well_formed(root, key))
    return tuple(str(table.get("name", "")) for table in tables if "material" not in table)


def _multipliers(root: Reader) -> frozenset[str]:
    """What the multipliers of its constraints may be called: as they say, or λ, λ₁, λ₂ … as for those that do not."""
    tables = [table for _, table in _well_formed(root, "constraints")]
    fresh = {"lambda", *(f"lambda_{k}" for k in range(1, len(tables) + 1))} if tables else set()
    stated = {_text(table, "multiplier") for table in tables} - {""}
    return frozenset(spelt for name in stated | fresh for spelt in (name, name.replace("lambda", "λ")))


def _drawing(root: Reader, context: Context) -> Drawing:
    table = {"vertical": _vertical(root), **(root.get("drawing", Mapping, {}) or {})}
    reader = Reader(table, "/drawing", root.problems, context)
    return next(iter([*reader.build(read_drawing)]), Drawing())


def _vertical(root: Reader) -> str:
    """Where the last component grows if the drawing does not say it: so that weights point down."""
    pulls = [table.get("acceleration") for _, table in _well_formed(root, "loads") if table.get("kind") == "gravity"]
    last = str(pulls[0][-1]).strip() if pulls and isinstance(pulls[0], list | tuple) and pulls[0] else "-"
    return "up" if last.startswith("-") or last == "0" else "down"


def read_drawing(table: Reader) -> Drawing:
    """How the scene is drawn."""
    vertical = cast("Vertical", table.text("vertical", "up"))
    view = table.get("view", list, []) or []
    return Drawing(vertical, tuple(map(as_float, view)) or None, _each(table.tables("elements"), Element.read))


def read_coordinate(table: Reader) -> Coordinate:
    """A coordinate with its initial value and rate."""
    value, rate = table.number("value", 0.0), table.number("rate", 0.0)
    name, latex, unit = table.name(), table.text("latex", ""), table.text("unit", "")
    return Coordinate(name, latex, unit, value, rate, table.bound("min"), table.bound("max"))


def read_parameter(table: Reader) -> Parameter:
    """A parameter; positive unless it says otherwise."""
    value, positive = table.number("value", 1.0), table.flag("positive", default=True)
    name, latex, unit = table.name(), table.text("latex", ""), table.text("unit", "")
    return Parameter(name, latex, unit, value, table.bound("min"), table.bound("max"), positive)


def read_point(table: Reader) -> Point:
    """A named point."""
    return Point(table.name(), table.position("position"))


def read_guide(table: Reader) -> Guide:
    """A guide: the coordinate, and the function of time that it follows."""
    return Guide(table.text("coordinate"), table.expression("value"))


def read_body(table: Reader) -> Body:
    """A body of the kind named. Raises what an unknown kind raises."""
    return cast("type[Body]", _kind("deltaq.mechanics.bodies", table)).read(table)


def read_load(table: Reader) -> Load:
    """A load of the kind named."""
    return cast("type[Load]", _kind("deltaq.mechanics.loads", table)).read(table)


def read_constraint(table: Reader) -> Constraint:
    """A constraint of the kind named."""
    return cast("type[Constraint]", _kind("deltaq.mechanics.constraints", table)).read(table)


def _kind(package: str, table: Reader) -> type:
    """The class of the kind that the table names."""
    kinds = classes_of(package, "kind")
    kind = table.text("kind")
    if kind in kinds:
        return kinds[kind]
    raise SceneError(Problem("unknown-kind", "/kind", parameters={"kind": kind[:40], "known": ", ".join(kinds)}))


def _text(table: Mapping[str, object], key: str) -> str:
    return value if isinstance(value := table.get(key, ""), str) else ""

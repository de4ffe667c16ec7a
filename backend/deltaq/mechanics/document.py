"""Scene documents (format 1): TOML on disk, the same structure as JSON in the API."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from typing import TypeVar, cast

from ..errors import InputError, Problem, SceneError
from ..language.names import Kind, Names, Symbol, is_name
from ..packages import classes_of
from .bodies import Body
from .coordinate import Coordinate
from .drawing import Drawing, Element, Vertical
from .guide import Guide
from .loads import Load
from .parameter import Parameter
from .point import Point
from .reader import Context, Reader
from .scene import Scene
from .soundness import soundness_problems

T = TypeVar("T")
FORMAT = 1
KINDS: Mapping[str, Kind] = {"coordinates": "coordinate", "parameters": "parameter"}
LIMIT = 64  # tables of one kind in a scene
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
    for scene in list(_Tables(Reader(document, "", problems, used=set())).scene()):
        return scene, (*problems, *(() if problems else soundness_problems(scene)))
    return None, tuple(problems)


@dataclass(frozen=True)
class _Tables:
    """The lists of tables of a document, on their way to a scene."""

    root: Reader

    def scene(self) -> Iterator[Scene]:
        root = self.root
        if root.get("format", int, FORMAT) != FORMAT:
            root.complain("unknown-format", "format", expected=FORMAT)
        coordinates = self.each("coordinates", read_coordinate)
        parameters = self.each("parameters", read_parameter)
        names = self._names()
        dimension = root.get("dimension", int, 2)
        if dimension not in (2, 3):
            root.complain("wrong-space", "dimension")
            dimension = 2
        context = Context(names, self._place_names(), dimension)
        make = partial(
            Scene,
            self._identifier(),
            self._translated("title"),
            self._translated("summary"),
            dimension,
            coordinates,
            parameters,
            self.each("points", read_point, context),
            self.each("bodies", read_body, context),
            self.each("loads", read_load, context),
            self.each("guides", read_guide, context),
            next(self._drawing(context), Drawing()),
        )
        # What the scene says of itself (no body, no freedom) only matters once its parts are sound.
        sound = not root.problems
        yield from root.build(lambda _: make()) if sound else ()

    def _identifier(self) -> str:
        identifier = self.root.text("id", "scene")
        if not IDENTIFIER.fullmatch(identifier):
            self.root.complain("invalid-id", "id", name=identifier[:40])
        return identifier

    def _names(self) -> Names:
        """The names that expressions may use; a coordinate with a wrong value still has its name."""
        named = [
            (f"/{key}/{index}/name", Symbol(name, kind, _text(table, "latex"), table.get("positive", True) is True))
            for key, kind in KINDS.items()
            for index, table in enumerate(self._tables(key))
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
                self.root.problems.append(Problem(code, pointer, parameters={"name": symbol.name}))
            else:
                sound[symbol.name] = symbol
        return Names(tuple(sound.values()))

    def _tables(self, key: str) -> tuple[Mapping[str, object], ...]:
        """The well-formed tables of a list."""
        value = self.root.table.get(key)
        return tuple(table for table in value if isinstance(table, Mapping)) if isinstance(value, list | tuple) else ()

    def _place_names(self) -> tuple[str, ...]:
        return tuple(str(table.get("name", "")) for key in ("points", "bodies") for table in self._tables(key))

    def _translated(self, key: str) -> Mapping[str, str]:
        found = self.root.get(key, (Mapping, str), {}) or {}
        texts = {"en": found, "de": found} if isinstance(found, str) else found
        return {str(lang): str(text)[:1000] for lang, text in cast("Mapping[str, object]", texts).items()}

    def each(self, key: str, make: Callable[[Reader], T], context: Context | None = None) -> tuple[T, ...]:
        self.root.used.add(key)
        value = self.root.table.get(key, [])
        if not isinstance(value, list | tuple):
            self.root.complain("not-a-list", key)
            return ()
        if len(value) > LIMIT:
            self.root.complain("too-many", key, field=key, limit=LIMIT)
            return ()
        pointer = f"{self.root.pointer}/{key}"
        return tuple(
            thing for i, table in enumerate(value) for thing in self._one(f"{pointer}/{i}", table, make, context)
        )

    def _one(self, pointer: str, table: object, make: Callable[[Reader], T], context: Context | None) -> Iterator[T]:
        if isinstance(table, Mapping):
            reader = Reader(table, pointer, self.root.problems, context, default_name=self._default_name(table))
            yield from reader.build(make)
        else:
            self.root.problems.append(Problem("not-a-table", pointer))

    def _default_name(self, table: Mapping[str, object]) -> str:
        """A load without a name is called by its kind, with a number where there are several."""
        kind = str(table.get("kind", ""))
        loads = [load for load in self._tables("loads") if load.get("kind") == kind]
        alone = Counter(str(load.get("kind")) for load in loads)[kind] < 2
        places = [index for index, load in enumerate(loads) if load is table]
        return kind if alone or not places else f"{kind}-{places[0] + 1}"

    def _drawing(self, context: Context) -> Iterator[Drawing]:
        self.root.used.add("drawing")
        table = self.root.table.get("drawing", {})

        def make(reader: Reader) -> Drawing:
            vertical = cast("Vertical", reader.text("vertical", "up"))
            view = reader.get("view", list, []) or []
            numbers = tuple(float(number) if isinstance(number, int | float) else float("nan") for number in view)
            reader.used.add("elements")
            return Drawing(vertical, numbers or None, _Tables(reader).each("elements", Element.read, context))

        yield from self._one("/drawing", table, make, context)


def read_coordinate(table: Reader) -> Coordinate:
    value, rate = table.number("value", 0.0), table.number("rate", 0.0)
    name, latex, unit = table.name(), table.text("latex", ""), table.text("unit", "")
    return Coordinate(name, latex, unit, value, rate, table.bound("min"), table.bound("max"))


def read_parameter(table: Reader) -> Parameter:
    value, positive = table.number("value", 1.0), table.flag("positive", default=True)
    name, latex, unit = table.name(), table.text("latex", ""), table.text("unit", "")
    return Parameter(name, latex, unit, value, table.bound("min"), table.bound("max"), positive)


def read_point(table: Reader) -> Point:
    return Point(table.name(), table.position("position"))


def read_guide(table: Reader) -> Guide:
    return Guide(table.text("coordinate"), table.expression("value"))


def read_body(table: Reader) -> Body:
    return cast("type[Body]", _kind("deltaq.mechanics.bodies", table)).read(table)


def read_load(table: Reader) -> Load:
    return cast("type[Load]", _kind("deltaq.mechanics.loads", table)).read(table)


def _kind(package: str, table: Reader) -> type:
    """The class of the kind that the table names."""
    kinds = classes_of(package, "kind")
    kind = table.text("kind")
    if kind in kinds:
        return kinds[kind]
    raise SceneError(Problem("unknown-kind", "/kind", parameters={"kind": kind[:40], "known": ", ".join(kinds)}))


def _text(table: Mapping[str, object], key: str) -> str:
    value = table.get(key, "")
    return value if isinstance(value, str) else ""

"""Reading a request for a simulation: every field is checked, every problem told with its JSON pointer."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace

from ..errors import InputError, Problem, RequestError, UnknownNameError
from ..mechanics.changes import change
from ..mechanics.coordinate import Coordinate
from ..mechanics.document import read_scene
from ..mechanics.library import load_scene
from ..mechanics.scene import Scene
from .choice import AUTO

PARTS = ("coordinates", "rates", "positions", "loads", "energy", "error")
FIELDS = ("scene", "guides", "freeze", "parameters", "initial", "t_end", "samples", "method", "tolerance", "step")
LARGEST_SPAN, SAMPLES, DEFAULT_SAMPLES = 1e5, (2, 20001), 501
TOLERANCES, DEFAULT_TOLERANCE = (1e-13, 1e-1), 1e-6


@dataclass(frozen=True)
class Request:
    """A simulation to run. `scene` has the parameter and initial values wanted; exactly one of step and tolerance."""

    scene: Scene
    t_end: float
    samples: int
    method: str
    step: float | None
    tolerance: float | None
    include: frozenset[str]


def read_request(document: Mapping[str, object]) -> Request:
    """The request in a document. Raises InputError with all problems of the fields, or of the scene."""
    fields = _Fields(document)
    t_end = fields.number("t_end", 0.0, LARGEST_SPAN, required=True)
    step = fields.number("step", 0.0, max(t_end or 0.0, 0.0) or LARGEST_SPAN)
    tolerance = fields.number("tolerance", *TOLERANCES, closed=True)
    if step is not None and tolerance is not None:
        fields.complain("request-step-and-tolerance", "/tolerance")
    samples, method = fields.samples(), fields.text("method", AUTO)
    include, values = fields.include(), fields.numbers("parameters")
    initial, guides, freeze = fields.initial(), fields.guides(), fields.names("freeze")
    if not isinstance(document.get("scene"), str | Mapping):
        fields.complain("request-scene-type", "/scene")
    fields.reject_unknown()
    if fields.problems:
        raise RequestError(*fields.problems)
    changed = change(_with_initial(_scene(document["scene"]), initial, freeze), guides, freeze, values)
    wanted = DEFAULT_TOLERANCE if step is None and tolerance is None else tolerance
    return Request(changed, t_end or 0.0, samples, method, step, wanted, include)


def _scene(given: object) -> Scene:
    with inside("/scene"):
        return load_scene(given) if isinstance(given, str) else read_scene(given)  # type: ignore[arg-type]


@contextmanager
def inside(pointer: str) -> Iterator[None]:
    """Problems raised within are told as seen from the request, in which their document stands at `pointer`."""
    try:
        yield
    except InputError as error:
        raise type(error)(*(problem.below(pointer) for problem in error.problems)) from None


def _with_initial(scene: Scene, initial: Mapping[str, Mapping[str, float]], freeze: tuple[str, ...]) -> Scene:
    """The scene with other initial values; the range of the slider gives way."""
    known = {coordinate.name for coordinate in scene.coordinates}
    free = {coordinate.name for coordinate in scene.free}
    for name in initial:
        pointer = f"/initial/{escaped(name)}"
        if name not in known:
            parameters = {"name": name[:40], "known": ", ".join(sorted(free))}
            raise UnknownNameError(Problem("unknown-coordinate", pointer, parameters=parameters))
        if name not in free:
            raise RequestError(Problem("guided-coordinate", pointer, parameters={"name": name}))
        if name in freeze and initial[name].get("rate"):
            raise RequestError(Problem("frozen-rate", f"{pointer}/rate", parameters={"name": name}))
    coordinates = tuple(_set(coordinate, initial.get(coordinate.name, {})) for coordinate in scene.coordinates)
    return replace(scene, coordinates=coordinates)


def _set(coordinate: Coordinate, given: Mapping[str, float]) -> Coordinate:
    value, rate = given.get("value", coordinate.value), given.get("rate", coordinate.rate)
    low = None if coordinate.min is None else min(coordinate.min, value)
    high = None if coordinate.max is None else max(coordinate.max, value)
    return replace(coordinate, value=value, rate=rate, min=low, max=high)


def escaped(name: str) -> str:
    """A name as part of a JSON pointer (RFC 6901)."""
    return name[:40].replace("~", "~0").replace("/", "~1")


@dataclass
class _Fields:
    """The fields of a document; problems are collected, so that a user sees all of them at once."""

    document: Mapping[str, object]
    problems: list[Problem] = field(default_factory=list)

    def complain(self, code: str, pointer: str, **parameters: str | float) -> None:
        self.problems.append(Problem(code, pointer, parameters=parameters))

    def number(
        self, key: str, low: float, high: float, *, closed: bool = False, required: bool = False
    ) -> float | None:
        """A number in (low, high], or in [low, high] if `closed`."""
        given = self.document.get(key)
        if given is None:
            if required:
                self.complain("missing-field", f"/{key}", field=key)
            return None
        found = self._number(given, f"/{key}")
        if found is not None and not (low < found <= high or (closed and found == low)):
            self.complain("request-outside", f"/{key}", value=found, min=low, max=high)
            return None
        return found

    def _number(self, given: object, pointer: str) -> float | None:
        if isinstance(given, bool) or not isinstance(given, int | float):
            self.complain("request-not-number", pointer)
            return None
        try:
            found = float(given)
        except OverflowError:
            found = math.inf
        if math.isfinite(found):
            return found
        self.complain("request-not-finite", pointer)
        return None

    def samples(self) -> int:
        given = self.document.get("samples")
        if given is None:
            return DEFAULT_SAMPLES
        if isinstance(given, bool) or not isinstance(given, int):
            self.complain("request-not-integer", "/samples")
        elif not SAMPLES[0] <= given <= SAMPLES[1]:
            self.complain("request-outside", "/samples", value=str(given)[:20], min=SAMPLES[0], max=SAMPLES[1])
        else:
            return given
        return DEFAULT_SAMPLES

    def text(self, key: str, default: str) -> str:
        given = self.document.get(key)
        return self._text(default if given is None else given, f"/{key}")

    def _text(self, given: object, pointer: str) -> str:
        if isinstance(given, str):
            return given
        self.complain("request-not-text", pointer)
        return ""

    def names(self, key: str) -> tuple[str, ...]:
        return tuple(self._text(name, f"/{key}/{i}") for i, name in enumerate(self._list(key)))

    def _list(self, key: str) -> tuple[object, ...]:
        given = self.document.get(key)
        if given is None or isinstance(given, list | tuple):
            return tuple(given or ())
        self.complain("request-not-array", f"/{key}")
        return ()

    def _table(self, given: object, pointer: str) -> dict[str, object]:
        if given is None or isinstance(given, Mapping):
            return {str(key): value for key, value in (given or {}).items()}
        self.complain("request-not-object", pointer)
        return {}

    def numbers(self, key: str) -> dict[str, float]:
        given = self._table(self.document.get(key), f"/{key}")
        return dict(self._finite(given, f"/{key}"))

    def _finite(self, given: Mapping[str, object], pointer: str) -> Iterator[tuple[str, float]]:
        for name, value in given.items():
            number = None if value is None else self._number(value, f"{pointer}/{escaped(name)}")
            if number is not None:
                yield name, number

    def initial(self) -> dict[str, dict[str, float]]:
        found = {}
        for name, given in self._table(self.document.get("initial"), "/initial").items():
            pointer = f"/initial/{escaped(name)}"
            table = self._table(given, pointer)
            for key in sorted(table.keys() - {"value", "rate"}):
                self.complain("unknown-field", f"{pointer}/{escaped(key)}", field=key[:40])
            found[name] = dict(self._finite(table, pointer))
        return found

    def guides(self) -> tuple[dict[str, str], ...]:
        tables = [self._table(given, f"/guides/{i}") for i, given in enumerate(self._list("guides"))]
        return tuple(
            {key: self._text(table.get(key), f"/guides/{i}/{key}") for key in ("coordinate", "value")}
            for i, table in enumerate(tables)
        )

    def include(self) -> frozenset[str]:
        """The parts of the answer wanted; all of them if none is named."""
        wanted = self.names("include")
        for index, part in enumerate(wanted):
            if part not in PARTS:
                self.complain("request-not-one-of", f"/include/{index}", expected=", ".join(PARTS))
        return frozenset(wanted or PARTS)

    def reject_unknown(self) -> None:
        for key in sorted(self.document.keys() - {*FIELDS, "include", "lang"}):
            self.complain("unknown-field", f"/{escaped(key)}", field=key[:40])

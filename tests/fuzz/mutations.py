"""Mutations that know what a scene document is: tables, lists, expressions, numbers, in JSON or TOML."""

from __future__ import annotations

import copy
import json
import random
import tomllib
from collections.abc import Callable, Iterator
from typing import Any

from tests.language.hostile import BOMBS, CODE

Document = dict[str, Any]
Place = tuple[Any, Any]  # a table or list, and the key or index of one of its values

KEYS = (
    *("format", "id", "title", "summary", "dimension", "coordinates", "parameters", "points", "bodies", "loads"),
    *("guides", "events", "labels", "drawing", "name", "kind", "latex", "unit", "value", "rate", "min", "max"),
    *("positive", "position", "mass", "inertia", "angle", "angular_velocity", "material", "density", "from", "to"),
    *("at", "force", "moment", "acceleration", "energy", "stiffness", "rest_length", "coefficient", "function"),
    *("coordinate", "vertical", "view", "elements", "radius", "width", "__class__", "", "a/b~c", "ü"),
)
KINDS = (
    *("particle", "rigid", "continuum", "force", "moment", "gravity", "potential", "spring", "damper", "dissipation"),
    *("distributed", "rod", "bob", "disc", "trail", "weight", "constructor"),
)
WORDS = (
    *("phi", "x", "y", "m", "l", "g", "t", "s", "pi", "dot(phi)", "ddot(x)", "delta(x)", "d(t)", "2", "0", "0.5", "-1"),
    *("+", "-", "*", "/", "^", "(", ")", "[", "]", ",", "=", ";", "|", "'", "sin(", "cos(", "sqrt(", "log(", "abs("),
    *("diff(", "^64", "^-1", "/0", "*10^30", "1e-30", " ", "kg", "m/s^2", "°", "φ", "\\ell", "_1", "é", "\u202e", "😀"),
)
VALUES: tuple[Any, ...] = (
    *(None, True, False, 0, 1, -1, 2, 3, 64, 0.5, 1e308, -1e308, 5e-324, 10**30, -(10**30), 1e-30),
    *("", " ", "0", "x", "phi", "m*l", "t", "x" * 70, "\x00", [], {}, [[]], [{}], ["0", "0"], [1, 2, 3], {"a": "b"}),
    *({"name": "x"}, {"kind": "spring"}, ["x", "y", "z"], ["0"] * 65, [{}] * 65),
)


def read(data: bytes) -> Document | None:
    """The table in JSON or TOML, None if it is neither."""
    try:
        text = data.decode()
        found = json.loads(text) if text.startswith("{") else tomllib.loads(text)
    except (ValueError, RecursionError):
        return None
    return found if isinstance(found, dict) else None


def write(document: Document, *, toml: bool) -> bytes:
    """The document as bytes; what TOML cannot say is left out there."""
    if not toml:
        return json.dumps(document, ensure_ascii=False).encode("utf-8", "backslashreplace")
    lines = (f"{_quoted(key)} = {_toml(value)}\n" for key, value in document.items() if value is not None)
    return "".join(lines).encode("utf-8", "backslashreplace")


def _toml(value: Any) -> str:
    match value:
        case dict():
            return "{" + ", ".join(f"{_quoted(k)} = {_toml(v)}" for k, v in value.items() if v is not None) + "}"
        case list():
            return "[" + ", ".join(_toml(one) for one in value if one is not None) + "]"
        case str():
            return _quoted(value)
        case _:
            return json.dumps(value, default=str)


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)


def mutated(document: Document, others: tuple[Document, ...], draw: random.Random) -> Document:
    """The document with one to four changes, some of them taken from another one."""
    changed = copy.deepcopy(document)
    for _ in range(draw.choice((1, 1, 1, 2, 2, 3, 4))):
        places = list(_places(changed))
        if not places:
            return copy.deepcopy(draw.choice(others))
        draw.choice(CHANGES)(places, draw.choice(others), draw)
    return changed


def _places(part: Any) -> Iterator[Place]:
    members = part.items() if isinstance(part, dict) else enumerate(part) if isinstance(part, list) else ()
    for key, value in members:
        yield part, key
        yield from _places(value)


def _remove(places: list[Place], _other: Document, draw: random.Random) -> None:
    whole, key = draw.choice(places)
    del whole[key]


def _replace(places: list[Place], _other: Document, draw: random.Random) -> None:
    whole, key = draw.choice(places)
    whole[key] = copy.deepcopy(draw.choice(VALUES))


def _swap(places: list[Place], _other: Document, draw: random.Random) -> None:
    (one, key), (two, place) = draw.choice(places), draw.choice(places)
    one[key], two[place] = copy.deepcopy(two[place]), copy.deepcopy(one[key])


def _copy_from(places: list[Place], other: Document, draw: random.Random) -> None:
    """Put what stands under the same key elsewhere, here or in the other document, in its place."""
    whole, key = draw.choice(places)
    found = [inner[name] for inner, name in (*_places(other), *places) if name == key]
    if found:
        whole[key] = copy.deepcopy(draw.choice(found))


def _double(places: list[Place], other: Document, draw: random.Random) -> None:
    """One more member of a list, of this document or of the other."""
    lists = [whole[key] for whole, key in places if isinstance(whole[key], list)]
    members = [inner[name] for inner, name in (*places, *_places(other)) if isinstance(inner, list)]
    if lists and members:
        draw.choice(lists).append(copy.deepcopy(draw.choice(members)))


def _add(places: list[Place], other: Document, draw: random.Random) -> None:
    """A further field."""
    tables = [whole for whole, _ in places if isinstance(whole, dict)]
    values = [inner[name] for inner, name in _places(other)]
    draw.choice(tables)[draw.choice(KEYS)] = copy.deepcopy(draw.choice((*VALUES, *values)))


def _rename(places: list[Place], _other: Document, draw: random.Random) -> None:
    whole, key = draw.choice([place for place in places if isinstance(place[0], dict)])
    whole[draw.choice(KEYS)] = whole.pop(key)


def _text(places: list[Place], _other: Document, draw: random.Random) -> None:
    """Another text: cut, spliced, or with a further word."""
    found = [(whole, key) for whole, key in places if isinstance(whole[key], str)]
    if found:
        whole, key = draw.choice(found)
        old = whole[key]
        first, last = sorted(draw.randint(0, len(old)) for _ in range(2))
        word = draw.choice(draw.choice((WORDS, WORDS, KINDS, CODE, BOMBS, [whole[key] for whole, key in found])))
        whole[key] = draw.choice((old[:first] + word + old[first:], old[:first] + word + old[last:], word))[:2100]


def _number(places: list[Place], _other: Document, draw: random.Random) -> None:
    found = [(whole, key) for whole, key in places if isinstance(whole[key], int | float)]
    if found:
        whole, key = draw.choice(found)
        whole[key] = draw.choice((-whole[key], whole[key] * 10.0 ** draw.randint(-20, 20), draw.uniform(-5.0, 5.0)))


CHANGES: tuple[Callable[[list[Place], Document, random.Random], None], ...] = (
    *(_remove, _replace, _swap, _copy_from, _double, _add, _rename, _number),
    *(_text, _text, _text),
)

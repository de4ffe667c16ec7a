"""The worst bodies of a megabyte that can be sent to every call, as the OpenAPI document names them.

Each is large, deep, endless or no JSON at all, and one of them for each member of each request. None asks for a
computation that would be let through: what is measured with them is how a service refuses.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

from tests.api.hostile import Walk, sample

from deltaq.contract.document import EXAMPLE

MEGABYTE = 2**20 - 2**10  # with room for what stands around it
Json = dict[str, Any]
Make = Callable[[int], bytes]

OTHERS = "application/toml"


@dataclass(frozen=True)
class Worst:
    """A body, and the call that it is sent to."""

    path: str
    media_type: str
    name: str
    make: Callable[[], bytes]

    def __str__(self) -> str:
        return f"POST {self.path} {self.name}"


def filled(one: bytes, size: int, between: bytes = b",") -> bytes:
    """As often as it fits."""
    return between.join([one] * max(1, size // (len(one) + len(between))))


def listed(one: bytes) -> Make:
    return lambda size: b"[%b]" % filled(one, size)


def members(value: bytes) -> Make:
    """A table of many different names."""
    return lambda size: b"{%b}" % b",".join(b'"a%x":%b' % (n, value) for n in range(size // (len(value) + 9)))


def quoted(one: bytes) -> Make:
    return lambda size: b'"%b"' % filled(one, size, b"")


def nested(begin: bytes, end: bytes, depth: int) -> Make:
    """Nested to a depth, as often as it fits."""
    return listed(begin * depth + b"0" + end * depth)


# Values that may stand wherever a request has a value.
VALUES: Mapping[str, Make] = {
    "ones": listed(b"1"),
    "nulls": listed(b"null"),
    "texts": listed(b'"a"'),
    "empty texts": listed(b'""'),
    "empty lists": listed(b"[]"),
    "empty tables": listed(b"{}"),
    "infinite numbers": listed(b"1e999"),
    "words for infinity": listed(b"-Infinity"),
    "numbers of 400 digits": listed(b"7" * 400),
    "numbers of 400 places": listed(b"0." + b"7" * 398),
    "tables of one member": listed(b'{"value":1}'),
    "tables of one name": listed(b'{"name":"a"}'),
    "members": members(b"1"),
    "members that are infinite": members(b"1e999"),
    "members that are lists": members(b"[]"),
    "members of one name": lambda size: b"{%b}" % filled(b'"a":1', size),
    "a text": quoted(b"x"),
    "a text of brackets": quoted(b"["),
    "a text of escapes": quoted(rb"\u00e4"),
    "a text of backslashes": quoted(rb"\\"),
    "a text of quotes": quoted(rb"\""),
    "texts of one backslash": listed(rb'"\\"'),
    "a text of lone surrogates": quoted(rb"\ud800"),
    "a text of emoji": quoted("😀".encode()),
    "a text that is no Unicode": quoted(b"\xff"),
    "a text of fractions": quoted(rb"\\frac{1}{"),
    "a number of a million digits": lambda size: b"9" * size,
    "a number of a million places": lambda size: b"0." + b"9" * size,
    "an exponent of a million digits": lambda size: b"1e" + b"9" * size,
    "lists in lists": nested(b"[", b"]", 50),
    "tables in tables": nested(b'{"a":', b"}", 50),
    "deep lists": lambda size: b"[" * (size // 2) + b"]" * (size // 2),
    "deep tables": lambda size: b'{"a":' * (size // 6) + b"1" + b"}" * (size // 6),
    "names of 60 letters": lambda size: b"[%b]" % filled(b'{"%b":{"%b":{}}}' % (b"n" * 60, b"~" * 60), size),
}

# What is no document.
WHOLES: Mapping[str, Make] = {
    "nothing but blanks": lambda size: b" " * size,
    "nothing but line breaks": lambda size: b"\n" * size,
    "nothing but quotes": lambda size: b'"' * size,
    "nothing but backslashes": lambda size: b"\\" * size,
    "nothing but commas": lambda size: b"," * size,
    "nothing but opening brackets": lambda size: b"[" * size,
    "nothing but opening braces": lambda size: b"{" * size,
    "nothing but zeros": lambda size: b"\0" * size,
    "digits that end in a letter": lambda size: b"1" * size + b"x",
    "a text without an end": lambda size: b'"' + b"x" * size,
    "ones without commas": lambda size: b"[" + b"1 " * (size // 2) + b"]",
    "a list without an end": lambda size: b"[" + b"1," * (size // 2),
    "in 16 bits": lambda size: ('{"scene": "%s"}' % ("x" * (size // 2))).encode("utf-16"),
    "after a mark of order": lambda size: b"\xef\xbb\xbf" + b'{"scene":"' + b"x" * size + b'"}',
}

TOML: Mapping[str, Make] = {
    "digits": lambda size: b"a = " + b"9" * size,
    "5000 digits": lambda size: b"a = " + b"9" * 5000,
    "hexadecimal digits": lambda size: b"a = 0x" + b"f" * size,
    "underscores": lambda size: b"a = 1" + b"_1" * (size // 2),
    "places": lambda size: b"a = 0." + b"9" * size,
    "dots": lambda size: b"a" + b".a" * (size // 2) + b" = 1",
    "keys": lambda size: b"".join(b"a%d = 1\n" % n for n in range(size // 12)),
    "dotted keys": lambda size: b"".join(b"a.b.c.d%d = 1\n" % n for n in range(size // 18)),
    "tables": lambda size: b"".join(b"[a%d]\n" % n for n in range(size // 10)),
    "lists of tables": lambda size: b"[[a]]\n" * (size // 6),
    "inner lists of tables": lambda size: b"[[a]]\n[[a.b]]\n[[a.b.c]]\n" * (size // 24),
    "ones": lambda size: b"a = [" + b"1," * (size // 2) + b"]",
    "texts": lambda size: b"a = [" + b"''," * (size // 3) + b"]",
    "dates": lambda size: b"a = [" + b"1979-05-27," * (size // 11) + b"]",
    "infinite numbers": lambda size: b"a = [" + b"inf," * (size // 4) + b"]",
    "deep lists": lambda size: b"a = " + b"[" * (size // 2) + b"]" * (size // 2),
    "deep tables": lambda size: b"a = " + b"{a=" * (size // 4) + b"1" + b"}" * (size // 4),
    "a text": lambda size: b'a = "' + b"x" * size + b'"',
    "a text without an end": lambda size: b"a = '''" + b"x" * size,
    "escapes": lambda size: b'a = "' + rb"\u00e4" * (size // 6) + b'"',
    "comments": lambda size: b"# x\n" * (size // 4),
    "one comment": lambda size: b"#" + b"x" * size,
    "line breaks": lambda size: b"\r\n" * (size // 2),
    "no Unicode": lambda size: b"\xff" * size,
    "the same key": lambda size: b"a = 1\n" * (size // 6),
    "words": lambda size: b"x" * size,
    "coordinates": lambda size: b'[[coordinates]]\nname = "x"\n' * (size // 27),
}

# Lists of a scene that a body may fill.
PARTS = ("coordinates", "parameters", "points", "bodies", "loads", "guides", "events", "labels", "drawing", "title")


def worst_bodies(document: Json, size: int = MEGABYTE) -> Iterator[Worst]:
    """All of them for a description of the API; those with a scene in the members called so, too."""
    for path, methods in document["paths"].items():
        operation = methods.get("post", {})
        for media_type, content in operation.get("requestBody", {}).get("content", {}).items():
            address = addressed(path, operation)
            if media_type == OTHERS:
                yield from (Worst(address, media_type, name, _made(make, size)) for name, make in TOML.items())
            else:
                model = _model(document, content["schema"])
                yield from (Worst(address, media_type, *one) for one in _of_model(model, size))


def addressed(path: str, operation: Json) -> str:
    """An address of the call."""
    for parameter in operation.get("parameters", []):
        if parameter["in"] == "path":
            path = path.replace(f"{{{parameter['name']}}}", str(sample(parameter["schema"])))
    return path


def _model(document: Json, schema: Json) -> Json:
    return Walk(document)._resolved(schema)


def _of_model(model: Json, size: int) -> Iterator[tuple[str, Callable[[], bytes]]]:
    for name, make in (VALUES | WHOLES).items():
        yield name, _made(make, size)
    example = next((one for one in model.get("examples", ()) if isinstance(one, dict)), EXAMPLE)
    for member in model.get("properties", PARTS):
        for name, make in VALUES.items():
            yield f"{member}: {name}", _member(example, member, make, size)
    if "scene" in model.get("properties", ()):
        for part in PARTS:
            for name, make in VALUES.items():
                yield f"scene/{part}: {name}", _in_scene(example, part, make, size)


def _made(make: Make, size: int) -> Callable[[], bytes]:
    return lambda: make(size)


def _member(example: Json, member: str, make: Make, size: int) -> Callable[[], bytes]:
    return lambda: _with(example, member, make(size))


def _in_scene(example: Json, part: str, make: Make, size: int) -> Callable[[], bytes]:
    return lambda: _with(example, "scene", _with(EXAMPLE, part, make(size)))


def _with(example: Json, member: str, value: bytes) -> bytes:
    """The example with a member that is no value of Python's."""
    rest = {name: one for name, one in example.items() if name != member}
    return b'{"%b":%b%b%b' % (member.encode(), value, b"," if rest else b"", _written(json.dumps(rest)))


@cache
def _written(rest: str) -> bytes:
    return rest[1:].encode()

"""Hostile texts at every string of every call, as the OpenAPI document names them.

Run it for long from the checkout: `python -m tests.api.hostile [share]` sends all texts to all places, or so great a
share of them. Loopback only; it ends by itself, with 1 if anything was found.
"""

from __future__ import annotations

import asyncio
import json
import random
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Awaitable, Callable, Iterator
from contextlib import chdir
from dataclasses import dataclass, field
from itertools import chain
from pathlib import Path
from typing import Any

import httpx
from tests.hostile import CANARY, KINDS
from tests.serving import PATIENT, served

from deltaq.contract.document import EXAMPLE

LINES = tuple(chain(*KINDS.values()))
LONGEST = 30.0  # seconds, of which most are spent in a queue
CLIENTS = 6
FREE = {"type": "object"}  # a table of which the document says no more, such as a scene
Schema = dict[str, Any]
Make = Callable[[str], Any]
Place = tuple[str, Make]  # where a text stands, and what holds it there
Send = Callable[..., Awaitable[httpx.Response]]


@dataclass(frozen=True)
class Slot:
    """A string of one call: where it stands, and the request that has a text there."""

    method: str
    path: str
    where: str
    request: Callable[[str], dict[str, Any]]

    def __str__(self) -> str:
        return f"{self.method} {self.path} {self.where}"


class Walk:
    """Goes through an OpenAPI document."""

    def __init__(self, document: Schema) -> None:
        self._document = document

    def slots(self) -> Iterator[Slot]:
        """Every string that a client may send."""
        for path, methods in self._document["paths"].items():
            for method, operation in methods.items():
                yield from self._of_address(method.upper(), path, operation)
                for media_type, content in operation.get("requestBody", {}).get("content", {}).items():
                    yield from self._of_body(method.upper(), path, operation, media_type, content["schema"])
        for name in ("Accept", "Accept-Language", "If-None-Match", "X-Request-ID", "Origin", "Cookie"):
            yield Slot(
                "GET", "/api/v1/scenes", f"header {name}", lambda text, name=name: {"headers": header(name, text)}
            )

    def _of_address(self, method: str, path: str, operation: Schema) -> Iterator[Slot]:
        found = operation.get("parameters", [])
        given = {one["name"]: sample(one["schema"]) for one in found if one["in"] == "path"}
        for one in found:
            name, place = one["name"], one["in"]
            if place == "path":
                yield Slot(
                    method, path, f"path {name}", lambda text, name=name: {"path": given | {name: text}, "json": {}}
                )
            else:
                yield Slot(
                    method, path, f"query {name}", lambda text, name=name: {"path": given, "query": {name: text}}
                )

    def _of_body(self, method: str, path: str, operation: Schema, media_type: str, schema: Schema) -> Iterator[Slot]:
        given = {one["name"]: sample(one["schema"]) for one in operation.get("parameters", []) if one["in"] == "path"}
        if media_type != "application/json":
            headers = {"Content-Type": media_type}
            yield Slot(method, path, "body", lambda text: {"content": encoded(text), "headers": headers})
            return
        whole = self._resolved(schema)
        examples = whole.get("examples") or [EXAMPLE]
        for where, make in self.strings(whole, examples[0], "/experiments/" not in path):
            yield Slot(method, path, f"body {where}", lambda text, make=make: {"path": given, "json": make(text)})

    def strings(self, schema: Schema, example: Any, deep: bool) -> Iterator[Place]:
        """Where strings may stand in what a schema describes: values, and names of members."""
        schema = self._resolved(schema)
        for choice in schema.get("anyOf", []) + schema.get("oneOf", []):
            yield from self.strings(choice, example, deep)
        match schema.get("type"):
            case "string":
                yield "", str
            case "array":
                yield from _within("0", self.strings(schema.get("items", {}), None, deep), lambda made: [made])
            case "object" if "properties" in schema:
                yield from self._members(schema, example, deep)
            case "object" if isinstance(schema.get("additionalProperties"), dict):
                inner = schema["additionalProperties"]
                yield "/{name}", lambda text: {text: sample(self._resolved(inner))}
                yield from _within("*", self.strings(inner, None, deep), lambda made: {"phi": made})
            case "object" if deep:
                yield from leaves(example if isinstance(example, dict) else EXAMPLE)

    def _members(self, schema: Schema, example: Any, deep: bool) -> Iterator[Place]:
        needed = {name: sample(self._resolved(schema["properties"][name])) for name in schema.get("required", ())}
        base = example if isinstance(example, dict) else needed
        for name, inner in schema["properties"].items():
            inside = self.strings(inner, base.get(name), deep)
            yield from _within(name, inside, lambda made, name=name: base | {name: made})

    def _resolved(self, schema: Schema) -> Schema:
        name = schema.get("$ref", "").rpartition("/")[2]
        return self._document["components"]["schemas"][name] if name else schema


def _within(name: str, places: Iterator[Place], put: Callable[[Any], Any]) -> Iterator[Place]:
    """The same places seen from the table or list around them."""
    for where, make in places:
        yield f"/{name}{where}", lambda text, make=make: put(make(text))


def leaves(part: Any) -> Iterator[Place]:
    """Every string in a document, and every name of a member."""
    match part:
        case str():
            yield "", str
        case dict():
            for name, value in part.items():
                yield from _within(name, leaves(value), lambda made, name=name: part | {name: made})
            yield "/{name}", lambda text: part | {text: "x"}
        case list():
            for n, value in enumerate(part):
                yield from _within(str(n), leaves(value), lambda made, n=n: [*part[:n], made, *part[n + 1 :]])


def sample(schema: Schema) -> Any:
    """Something that a schema allows, most of the time."""
    found = [*schema.get("examples", []), *schema.get("enum", []), *([schema["const"]] if "const" in schema else [])]
    usual = {"string": "x", "number": 1.0, "integer": 1, "boolean": True, "array": [], "object": {}}
    return found[0] if found else usual.get(schema.get("type", ""), 1.0)


def encoded(text: str) -> bytes:
    """A text as bytes, lone surrogates too."""
    return text.encode("utf-8", "surrogatepass")


def quoted(text: str) -> str:
    """A text as part of an address."""
    return "".join(f"%{byte:02X}" for byte in encoded(text))


def header(name: str, text: str) -> dict[str, bytes]:
    """A header without what no client can send in one."""
    return {name: encoded("".join(one for one in text if one >= " " and one != "\x7f")).strip()}


def written(value: Any) -> dict[str, Any]:
    """A body of JSON; lone surrogates stand in it as escapes."""
    return {"content": json.dumps(value).encode(), "headers": {"Content-Type": "application/json"}}


async def ask(send: Send, slot: Slot, text: str) -> httpx.Response:
    """Send a text to its place."""
    request = slot.request(text)
    path = slot.path
    for name, value in request.pop("path", {}).items():
        path = path.replace(f"{{{name}}}", quoted(value))
    path += "".join(f"?{name}={quoted(value)}" for name, value in request.pop("query", {}).items())
    if "json" in request:
        request |= written(request.pop("json"))
    return await send(slot.method, path, **request)


def judged(answer: httpx.Response, text: str) -> str:
    """What is wrong with an answer, "" if nothing is."""
    kind = answer.headers.get("content-type", "")
    wrong = {
        f"status {answer.status_code}": answer.status_code >= 500,
        "may be sniffed": answer.headers.get("x-content-type-options") != "nosniff",
        "is echoed in a page": "html" in kind and "<" in text and text in answer.text,
        "was executed": Path(CANARY).exists(),
    }
    return ", ".join(what for what, true in wrong.items() if true)


@dataclass
class Tally:
    """What came of all requests."""

    statuses: Counter[int] = field(default_factory=Counter)
    found: Counter[str] = field(default_factory=Counter)
    slowest: tuple[float, str] = (0.0, "")

    def __str__(self) -> str:
        statuses = ", ".join(f"{count} × {status}" for status, count in sorted(self.statuses.items()))
        return f"{self.statuses.total()} requests: {statuses}; the slowest {self.slowest[0]:.2f} s ({self.slowest[1]})"


async def one_client(send: Send, pairs: Iterator[tuple[Slot, str]], tally: Tally) -> None:
    """Sends what is left, one after the other."""
    for slot, text in pairs:
        begin = time.perf_counter()
        answer = await ask(send, slot, text)
        took = time.perf_counter() - begin
        tally.statuses[answer.status_code] += 1
        tally.slowest = max(tally.slowest, (took, f"{slot}: {text[:60]!r}"))
        late = f"took {took:.1f} s" if took > LONGEST else ""
        if wrong := ", ".join(filter(None, (judged(answer, text), late))):
            tally.found[f"{slot}: {text[:200]!r} {wrong}"] += 1


async def drive(address: str, share: float) -> Tally:
    """All texts at all places, or a share of them, from a few clients at once."""
    async with httpx.AsyncClient(base_url=address, timeout=300) as client:
        slots = list(Walk((await client.get("/api/v1/openapi.json")).json()).slots())
        draw, tally = random.Random(1), Tally()
        pairs = ((slot, text) for text in LINES for slot in slots if draw.random() < share)
        print(f"{len(slots)} places, {len(LINES)} texts", flush=True)
        await asyncio.gather(*(one_client(client.request, pairs, tally) for _ in range(CLIENTS)))
    return tally


def run(share: float) -> bool:
    """A service of its own in a folder of its own; whether nothing was found."""
    with tempfile.TemporaryDirectory() as folder, chdir(folder), served(**PATIENT) as service:
        tally = asyncio.run(drive(service.address.rstrip("/"), share))
        alive = service.process.poll() is None
    print(tally, *tally.found, sep="\n")
    return alive and not tally.found


if __name__ == "__main__":
    sys.exit(not run(float(sys.argv[1]) if len(sys.argv) > 1 else 1.0))

"""How the API describes itself: the OpenAPI document, made for clients that are generated and for people."""

from __future__ import annotations

import re
from collections.abc import Iterator
from threading import Lock
from typing import Any

from fastapi import FastAPI
from fastapi.routing import APIRoute

from ..contract.problem import ProblemDocument
from .samples import samples

SUMMARY = "Analytical mechanics, derived and simulated"
DESCRIPTION = """Derives Lagrange's equations of the second kind step by step, simulates the motion, checks answers, and
says how accurate each number is. Formulas come as LaTeX and as plain text that any program reads. Texts are in the
language of `lang`, else of Accept-Language. Every failure is a problem document (RFC 9457) whose `problems` say where
the mistake is and what to write instead; 429 and 503 come with Retry-After. The same question has the same answer, and
its ETag."""
# By subject, in the order in which one comes to need them.
SUBJECTS = {
    "scenes": "Mechanical systems as data: the built-in ones, and checking one's own.",
    "derivations": "From a scene to its equations of motion, one verified step at a time.",
    "ensembles": "Many motions of one scene together; Accept: text/event-stream tells blocks of them as they are done.",
    "simulations": "Motions, with an error estimate and an energy balance.",
    "variations": "The first variation of what one writes, by its definition and by the chain rule.",
    "proofs": "Derivations that hold for any scene.",
    "homework": "Tasks, answers checked in any equivalent form, and what went wrong.",
    "experiments": "Speed against accuracy, convergence, stability, chaos, and the least model that will do. "
    "Accept: text/event-stream lets one watch: events `preparing` with how many `kernels` are compiled `of` all, where "
    "they still are, `waiting` with `place` in the queue (1: the next, 0: begun) and "
    "`seconds` until it should begin, `part` with the charts so far, then `result` or `problem`; "
    "text/html and text/csv give the charts as files.",
    "exports": "A derivation as a document, a motion as a program.",
    "methods": "The time integrators.",
    "expressions": "What a text means in the names of a scene.",
    "catalogs": "The sentences of the page.",
    "service": "How the service is doing.",
}

_SCHEMAS = "#/components/schemas/"
_FIRST_CLAUSE = re.compile(r"[^.:;]+")


class DescribedAPI(FastAPI):
    """An application whose document has summaries from the docstrings, and samples that run."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        self._making = Lock()

    def openapi(self) -> dict[str, Any]:
        """The OpenAPI document, made once, whatever threads ask for it."""
        with self._making:
            if self.openapi_schema is None:
                self.openapi_schema = _completed(super().openapi())
            return self.openapi_schema


def operation_id(route: APIRoute) -> str:
    """The name of the function, which generated clients take over."""
    return route.name


def subjects() -> list[dict[str, Any]]:
    """The tags of the document."""
    return [{"name": name, "description": text} for name, text in SUBJECTS.items()]


def _completed(document: dict[str, Any]) -> dict[str, Any]:
    components = document["components"]["schemas"]
    components[ProblemDocument.__name__] = ProblemDocument.model_json_schema(ref_template=f"{_SCHEMAS}{{model}}")
    components[ProblemDocument.__name__].pop("$defs")  # ProblemEntry, which answers hold, too
    for name in _asked(document):
        _free_to_leave_out(name, components)
    for path, methods in document["paths"].items():
        for method, operation in methods.items():
            operation["responses"]["200"]["description"] = "the answer"
            operation["summary"] = _first_clause(operation["description"])
            if "x-codeSamples" not in operation:
                operation["x-codeSamples"] = samples(method, path, operation, components)
    return document


def _first_clause(text: str) -> str:
    found = _FIRST_CLAUSE.match(text)
    return found[0] if found else text


def _asked(document: dict[str, Any]) -> list[str]:
    """The schemas of what is sent: those of request bodies, and all that these refer to."""
    operations = (operation for methods in document["paths"].values() for operation in methods.values())
    found = dict.fromkeys(name for one in operations for name in _references(one.get("requestBody")))
    waiting = list(found)
    while waiting:
        further = [name for name in _references(document["components"]["schemas"][waiting.pop()]) if name not in found]
        found.update(dict.fromkeys(further))
        waiting += further
    return list(found)


def _references(node: object) -> Iterator[str]:
    """The names of all schemas to which a part of the document refers."""
    if isinstance(node, dict):
        if isinstance(target := node.get("$ref"), str):
            yield target.removeprefix(_SCHEMAS)
        node = list(node.values())
    if isinstance(node, list):
        for part in node:
            yield from _references(part)


def _free_to_leave_out(name: str, components: dict[str, Any]) -> None:
    """Have generators see that what has a default may be left out of a request.

    A `default` beside a type makes openapi-typescript take the member for one that is always there, as it is in an
    answer. So it stands one level deeper, with the type as the only branch of a union. Types that generators give a
    name of their own get the name that they had.
    """
    for member, schema in components[name].get("properties", {}).items():
        if "default" not in schema:
            continue
        about = {key: schema[key] for key in ("title", "description", "examples") if key in schema}
        branch = {key: part for key, part in schema.items() if key not in about}
        if branch.keys() & {"enum", "additionalProperties"}:
            own = f"{name}{member.title().replace('_', '')}"
            components[own] = {"title": own} | branch
            branch = {"$ref": f"{_SCHEMAS}{own}"}
        components[name]["properties"][member] = about | {"anyOf": [branch]}

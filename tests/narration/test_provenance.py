"""Where the terms of a result come from."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
import sympy as sp
from tests.derived import derived, told

from deltaq.derivation.system import System
from deltaq.language.parser import parse
from deltaq.mechanics.library import scene_ids
from deltaq.narration.derive import derive_request


def sums(part: object, path: str = "") -> Iterator[tuple[str, dict]]:
    """Every expression of a result that has terms, by its place in the answer."""
    if isinstance(part, dict):
        if "terms" in part:
            yield from entries(part["plain"], part["terms"], path)
        for key, value in part.items():
            yield from sums(value, f"{path}/{key}")
    elif isinstance(part, list):
        for index, value in enumerate(part):
            yield from sums(value, f"{path}/{index}")


def entries(plain: object, terms: list, path: str) -> Iterator[tuple[str, dict]]:
    """An expression, or those of a vector or matrix."""
    if isinstance(plain, str):
        yield path, {"plain": plain, "terms": terms}
        return
    for index, (one, its) in enumerate(zip(plain, terms, strict=True)):
        yield from entries(one, its, f"{path}/{index}")


def value(system: System, text: str) -> sp.Expr:
    return system.expression(parse(text.removesuffix(" = 0"), system.scene.names).tree)


@pytest.mark.one_in(12)
@pytest.mark.parametrize("scene", scene_ids())
def test_terms_sum_to_the_expression(scene: str) -> None:
    system = derived(scene)[0]
    known = {f"body:{body.name}" for body in system.scene.bodies} | {f"load:{load}" for load in system.load_names}
    known |= set(system.constraint_sources)
    found = dict(sums(told(scene, "de")["result"]))
    assert {
        "/virtual_work",
        "/kinetic_energy",
        "/lagrangian",
        "/equations/0",
        "/forcing/0",
        "/mass_matrix/0/0",
        "/jacobi_energy",
    } <= found.keys()
    for place, expression in found.items():
        whole = sum((value(system, term["plain"]) for term in expression["terms"]), sp.Integer(0))
        assert system.is_zero(whole - value(system, expression["plain"])), place
        for term in expression["terms"]:
            assert term["sources"], (place, term)
            assert set(term["sources"]) <= known, (place, term)


def sources(scene: str, key: str) -> dict[str, list[str]]:
    return {term["plain"]: term["sources"] for term in told(scene, "de")["result"][key]["terms"]}


def test_what_bodies_share_is_told_apart() -> None:
    energy = sources("cart-pendulum", "kinetic_energy")
    assert energy["M*dot(x)^2/2"] == ["body:cart"]
    assert energy["m*dot(x)^2/2"] == ["body:bob"]


def test_kinetic_and_potential_parts_of_the_lagrangian() -> None:
    assert sources("pendulum", "lagrangian") == {
        "m*l^2*dot(phi)^2/2": ["body:bob"],
        "m*g*l*cos(phi)": ["load:weight"],
    }


def test_terms_of_steps_name_loads_and_bodies() -> None:
    chapters = derive_request({"scene": "elastic-pendulum"})["chapters"]
    marked = {step["rule"]: step["marked"] for chapter in chapters for step in chapter["steps"]}
    assert r"\htmlClass{load-weight load-drive " in marked["generalized-forces"]
    assert r"\htmlClass{load-drive " in marked["decomposition"]
    assert r"\htmlClass{body-bob energy-kinetic " in marked["lagrangian"]


def springs() -> dict[str, object]:
    """Two masses between like springs, dampers and a force: many of their shares are alike."""
    return {
        "id": "springs",
        "coordinates": [{"name": "x", "value": 0.1}, {"name": "y", "value": 0.3}],
        "parameters": [{"name": name} for name in ("m", "k", "c", "F0", "l")],
        "bodies": [
            {"name": "first", "kind": "particle", "mass": "m", "position": ["x", "0"]},
            {"name": "second", "kind": "particle", "mass": "m", "position": ["y", "0"]},
        ],
        "loads": [
            {"kind": "potential", "name": "left", "energy": "k*x^2/2"},
            {"kind": "potential", "name": "right", "energy": "k*(x - l)^2/2"},
            {"kind": "potential", "name": "middle", "energy": "k*(y - x)^2/2"},
            {"kind": "force", "name": "damper", "at": "first", "force": ["-c*dot(x)", "0"]},
            {"kind": "force", "name": "drive", "at": "first", "force": ["-c*(dot(x) - dot(y)) + F0", "0"]},
        ],
    }


def steps_of(document: object) -> dict[str, dict]:
    found: dict[str, dict] = {}

    def walk(several: list[dict]) -> None:
        for step in several:
            found[step["id"]] = step
            walk(step["substeps"])

    for chapter in derive_request({"scene": document})["chapters"]:
        walk(chapter["steps"])
    return found


def test_terms_of_loads_that_are_alike_are_told_apart() -> None:
    """What several loads add to a term names them all, what one of them adds names it alone."""
    steps = steps_of(springs())
    told = {
        term["latex"]: {name.removeprefix("load:") for name in term["sources"]}
        for term in steps["generalized-forces"]["terms"]
    }
    assert told["F_{0}"] == told[r"c \dot{y}"] == {"drive"}
    assert told[r"- 2 c \dot{x}"] == {"damper", "drive"}
    assert told["k (y - 3 x + l)"] == {"left", "right", "middle"}
    origins = {term["latex"]: [one["term"] for one in term["from"]] for term in steps["generalized-force:x"]["terms"]}
    assert origins["- k x"] == ["generalized-force:x/0.1.0", "work-of-potential:left/0.1.0"]
    assert origins[r"- c \dot{x}"][0] == "generalized-force:x/0.1.3"
    works = {term["latex"]: [one["term"] for one in term["from"]] for term in steps["virtual-work"]["terms"]}
    assert works[r"\delta W_{\text{left}}"] == ["virtual-work/0.0.0", "work-of-potential:left/1.2.0"]


def test_a_sum_in_a_bracket_keeps_the_sources_of_its_terms() -> None:
    marked = steps_of(springs())["generalized-forces"]["marked"]
    for load, term in (
        ("load-middle", r"\htmlClass{q-1}{y}"),
        ("load-left load-right load-middle", r"3 \htmlClass{q-0}{x}"),
        ("load-right", "l"),
    ):
        assert rf"\htmlClass{{{load}}}{{{term}}}" in marked


def test_shares_that_cancel_are_no_origins() -> None:
    """c·ẋ of one load stands against that of another; what is left comes from the third."""
    document = springs()
    document["loads"] = [
        {"kind": "force", "name": name, "at": "first", "force": [force, "0"]}
        for name, force in (("push", "F0 + c*dot(x)"), ("pull", "-c*dot(x)"), ("drag", "-2*c*dot(x)"))
    ]
    terms = {
        term["latex"]: term
        for term in steps_of(document)["generalized-force:x"]["terms"]
        if "/0.2." in term["id"] or "/0.3." in term["id"]
    }
    assert [one["term"] for one in terms[r"- 2 c \dot{x}"]["from"] if one["term"].startswith("generalized-force:x")]
    last = [term for term in terms.values() if "/0.3." in term["id"]]
    drag = next(term for term in last if "c" in term["latex"])
    assert drag["sources"] == ["load:drag"]
    assert [one["term"] for one in drag["from"]] == ["generalized-force:x/0.2.2"]

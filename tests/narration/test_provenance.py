"""Where the terms of a result come from."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
import sympy as sp

from deltaq.derivation.system import System
from deltaq.language.parser import parse
from deltaq.mechanics.library import load_scene, scene_ids
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


@pytest.mark.parametrize("scene", scene_ids())
def test_terms_sum_to_the_expression(scene: str) -> None:
    system = System(load_scene(scene))
    known = {f"body:{body.name}" for body in system.scene.bodies} | {f"load:{load}" for load in system.load_names}
    found = dict(sums(derive_request({"scene": scene})["result"]))
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
    return {term["plain"]: term["sources"] for term in derive_request({"scene": scene})["result"][key]["terms"]}


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

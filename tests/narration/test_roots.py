"""Roots that recur have a letter, which each step that uses it explains; nothing else of the step changes."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import pytest
import sympy as sp

from deltaq.language.canonical import is_zero
from deltaq.language.names import Names, Symbol
from deltaq.language.parser import parse
from deltaq.language.symbols import Symbols
from deltaq.language.sympy_algebra import to_sympy
from deltaq.mechanics.document import read_scene
from deltaq.narration.derive import derive_request

EXPLAINED = re.compile(r" \\\\\[[\d.]+em\] \\text\{(?:with|mit) }")


def pair(rest: str = "s0", **values: float) -> dict[str, object]:
    """Two masses on a spring in the plane."""
    numbers = {"m": 1.0, "M": 2.0, "k": 5.0, rest: 1.0} | values
    return {
        "id": "pair",
        "coordinates": [{"name": name, "value": value} for name, value in (("x1", 0), ("y1", 0), ("x2", 1), ("y2", 1))],
        "parameters": [{"name": name, "value": value} for name, value in numbers.items()],
        "bodies": [
            {"name": "one", "kind": "particle", "mass": "m", "position": ["x1", "y1"]},
            {"name": "two", "kind": "particle", "mass": "M", "position": ["x2", "y2"]},
        ],
        "loads": [
            {"kind": "spring", "name": "spring", "from": "one", "to": "two", "stiffness": "k", "rest_length": rest}
        ],
    }


def single(energy: str, *coordinates: str) -> dict[str, object]:
    """A particle in a potential."""
    places = [{"name": name, "value": 0.4 + number} for number, name in enumerate(coordinates)]
    return {
        "id": "one",
        "coordinates": places,
        "parameters": [{"name": "m"}, {"name": "mu"}, {"name": "k"}, {"name": "a"}, {"name": "h", "value": 0.5}],
        "bodies": [
            {"name": "one", "kind": "particle", "mass": "m", "position": [*coordinates, "0"][: max(2, len(places))]}
        ],
        "loads": [{"kind": "potential", "name": "field", "energy": energy}],
    }


KEPLER = single("-m*mu/sqrt(x^2 + y^2)", "x", "y")
TRUSS = single("k*(sqrt(a^2 + x^2) - sqrt(a^2 + h^2))^2", "x")


def steps(document: object, lang: str = "en") -> dict[str, Any]:
    """All steps and substeps by their ids."""
    found: dict[str, Any] = {}

    def walk(several: list[Any]) -> None:
        for one in several:
            found[one["id"]] = one
            walk(one["substeps"])

    answer: Any = derive_request({"scene": document, "lang": lang})
    for chapter in answer["chapters"]:
        walk(chapter["steps"])
    return found


@pytest.mark.one_in(2)
@pytest.mark.parametrize("scene", [pair(), KEPLER, TRUSS, pair(s=3.0)], ids=["pair", "kepler", "truss", "taken"])
def test_with_its_letters_put_in_an_equation_is_that_of_the_result(scene: dict[str, object]) -> None:
    answer: Any = derive_request({"scene": scene})
    names, found, used = read_scene(scene).names, steps(scene), 0
    for equation in answer["result"]["equations"]:
        step = found[f"equation:{equation['coordinate']}"]
        own = [Symbol(one["symbol"], "parameter") for one in step["where"]]
        known = Names((*names.symbols[:-2], *own))
        roots = {Symbols(known).name(one["symbol"]): value(one["plain"], known) for one in step["where"]}
        text = (
            EXPLAINED.split(step["latex"])[0].rpartition(r"\Longleftrightarrow\; & ")[2].removesuffix(r"\end{aligned}")
        )
        left = value(text.partition(" = 0")[0], known, "latex").xreplace(roots)
        assert is_zero(left - value(equation["plain"].removesuffix(" = 0"), known), Symbols(known)) is True, text
        used += bool(own)
    assert used or scene is KEPLER  # its equations hold one root each, and a short one


def value(text: str, names: Names, syntax: str = "plain") -> sp.Expr:
    return to_sympy(parse(text, names, syntax).tree, Symbols(names))  # type: ignore[arg-type]


def test_a_distance_has_a_letter_that_is_said() -> None:
    step = steps(pair())["lagrangian"]
    assert step["latex"].count(r"\sqrt") == 1
    assert r"\frac{1}{2} k (s - s_{0})^{2}" in step["latex"]
    assert r"\text{with }s &= \sqrt{(x_{2} - x_{1})^{2} + (y_{2} - y_{1})^{2}}" in step["latex"]
    assert ". with s equals the square root of open bracket x two minus x one" in step["spoken"]
    assert [one["symbol"] for one in step["where"]] == ["s"]
    german = steps(pair(), "de")["lagrangian"]
    assert r"\text{mit }s &=" in german["latex"]
    assert ". mit s gleich der Wurzel aus Klammer auf x zwei minus x eins" in german["spoken"]


def test_powers_of_a_root_are_powers_of_its_letter() -> None:
    forces = steps(KEPLER)["generalized-forces"]["latex"]
    assert r"Q_{x} &= -\frac{m \mu x}{s^{3}}" in forces
    assert r"\text{with }s &= \sqrt{x^{2} + y^{2}}" in forces


def test_several_roots_are_numbered_as_they_come() -> None:
    energy = steps(TRUSS, "de")["potential:field"]["latex"]
    assert r"k (s_{1} - s_{2})^{2}" in energy
    assert r"\text{mit }s_{1} &= \sqrt{x^{2} + a^{2}}" in energy
    assert r"\text{und }s_{2} &= \sqrt{a^{2} + h^{2}}" in energy


def test_a_letter_that_is_taken_is_left_alone() -> None:
    where = {one["symbol"] for step in steps(pair(s=3.0)).values() for one in step["where"]}
    assert where == {"rho"}


def long_roots(latex: str) -> Iterator[str]:
    """What stands under roots of sums, if it is no short sum."""
    for found in re.finditer(r"\\sqrt\{|\)\^\{\d*[13579]/2\}", latex):
        depth, start = 1, found.end()
        end = start
        while found[0].startswith(r"\sqrt") and depth and end < len(latex):
            depth += {"{": 1, "}": -1}.get(latex[end], 0)
            end += 1
        yield latex[start : end - 1]


@pytest.mark.one_in(2)
@pytest.mark.parametrize("scene", ["elastic-pendulum", "wind-on-rod", "coupled-pendulums", "pair", "kepler"])
def test_no_step_writes_a_long_root_twice(scene: str) -> None:
    document: object = {"pair": pair(), "kepler": KEPLER}.get(scene, scene)
    for step in steps(document).values():
        roots = [root for root in long_roots(step["latex"]) if root.count("^{2}") >= 2 and " + " in root]
        assert len(roots) == len(set(roots)), step["id"]
        for one in step["where"]:
            assert f"{one['symbol_latex']} &= {one['latex']}" in step["latex"]
            assert one["symbol_latex"] in step["latex"].rpartition(r"\text{with }")[0], step["id"]


def test_results_do_without_letters() -> None:
    answer: Any = derive_request({"scene": pair()})
    texts = [one[form] for one in answer["result"]["equations"] for form in ("plain", "latex")]
    assert not any(re.search(r"(?<!\w)s(?![\w_])", text) for text in texts)
    assert all(r"sqrt" in text for text in texts)


@pytest.mark.parametrize("scene", ["double-pendulum-by-rods", "magnetic-pendulum"])
def test_one_root_has_one_letter_however_it_is_written(scene: str) -> None:
    """√((x₂ − x₁)² + …) and √((x₁ − x₂)² + …) are one length: no two letters of a step have the same value."""
    told = [one for step in steps(scene).values() for one in [step["where"]] if one]
    assert told
    for where in told:
        values = {one["symbol"]: sp.expand(sp.sympify(one["plain"].replace("^", "**")) ** 2) for one in where}
        assert len(set(values.values())) == len(values), values

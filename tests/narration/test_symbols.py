"""One symbol means one thing."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from typing import Any

import pytest
from tests.derived import derived

from deltaq.derivation.formula import Named, Quantity
from deltaq.mechanics.library import scene_ids
from deltaq.narration.derive import derive_request, notation_of


def named(part: object) -> Iterator[Quantity]:
    """All quantities that a formula names."""
    if isinstance(part, Named):
        yield part.quantity
    if dataclasses.is_dataclass(part):
        for field in dataclasses.fields(part):
            yield from named(getattr(part, field.name))
    elif isinstance(part, tuple):
        for member in part:
            yield from named(member)


def meanings(identifier: str) -> dict[str, set[object]]:
    """What each symbol stands for: quantities, and names of the scene."""
    system, derivation = derived(identifier)
    scene = system.scene
    symbols = dataclasses.replace(notation_of(system, "en").symbols, wrap=lambda _, latex: latex)  # type: ignore[type-var]
    found: dict[str, set[object]] = {symbol.typeset: {symbol.name} for symbol in scene.names.symbols}
    for quantity in (each for step in derivation.steps() for each in named(step.relations)):
        meaning = quantity.of if quantity.kind == "coordinate" else quantity
        found.setdefault(symbols.latex(quantity), set()).add(meaning)
    return found


@pytest.mark.parametrize("name", scene_ids())
def test_a_symbol_means_one_thing(name: str) -> None:
    assert {symbol: of for symbol, of in meanings(name).items() if len(of) > 1} == {}


PENDULUM = {
    "format": 1,
    "id": "letters",
    "title": {"en": "A pendulum of length L"},
    "dimension": 2,
    "coordinates": [{"name": "x", "unit": "rad", "value": 0.3}],
    "parameters": [
        {"name": "m", "unit": "kg", "value": 1.0, "positive": True},
        {"name": "L", "unit": "m", "value": 1.0, "positive": True},
        *({"name": name, "value": 1.0} for name in ("E", "V", "M", "R", "h", "omega", "g")),
    ],
    "bodies": [
        {"name": "bob", "kind": "particle", "mass": "m", "position": ["L*sin(x)", "L*cos(x) + E*V*M*R*h*omega"]}
    ],
    "loads": [{"kind": "gravity", "acceleration": ["0", "g"]}],
}


def test_quantities_give_way_to_the_letters_of_a_scene() -> None:
    chapters = derive_request({"scene": PENDULUM, "lang": "en"})["chapters"]
    steps = {step["rule"]: step for chapter in chapters for step in chapter["steps"]}  # type: ignore[attr-defined]
    assert r"\mathcal{L} = \mathcal{E} - \mathcal{V}" in steps["lagrangian"]["latex"].replace("&", "")
    assert steps["jacobi-energy"]["text"].startswith(r"Here it equals $\mathcal{E} + \mathcal{V}$")
    assert steps["linearization"]["text"].startswith(r"With $q = q_0 + \xi$ and small $\xi$")
    assert steps["eigenfrequencies"]["text"].startswith(r"Trying $\xi = a \cos\nu t$")


def test_bold_letters_stay_bold_beside_a_parameter_f() -> None:
    r"""The letter that gives way is that of the symbol, not the last one of \mathbf."""
    document = {
        "format": 1, "id": "f", "title": "f", "dimension": 2,
        "coordinates": [{"name": "x"}, {"name": "y"}],
        "parameters": [{"name": "m", "value": 1.0}, {"name": "f", "value": 1.0}],
        "bodies": [{"name": "b", "kind": "particle", "mass": "m", "position": ["x", "y"]}],
        "loads": [{"kind": "force", "at": "b", "force": ["f", "0"]}],
    }  # fmt: skip
    chapters: Any = derive_request({"scene": document, "lang": "en"})["chapters"]
    (step,) = (step for chapter in chapters for step in chapter["steps"] if step["id"] == "matrix-form")
    assert "mathb\\mathcal" not in step["latex"]


def test_a_sentence_calls_a_matrix_as_its_formula_does() -> None:
    """The slider has a mass M; the mass matrix is a bold one."""
    chapters: Any = derive_request({"scene": "slider-crank", "lang": "en"})["chapters"]
    (step,) = (step for chapter in chapters for step in chapter["steps"] if step["id"] == "augmented-system")
    assert r"\mathbf{M} &=" in step["latex"]
    assert r"its blocks are $\mathbf{M}$" in step["text"]

"""What a reader sees of a derivation: brackets keep their sources, numbers their kind, integrals are found."""

from __future__ import annotations

import random
from collections.abc import Iterator

import pytest
import sympy as sp
from tests.derived import told

from deltaq.derivation.engine import derive
from deltaq.derivation.result import result_of
from deltaq.language.canonical import display, is_zero
from deltaq.language.names import Names, Symbol
from deltaq.language.parser import parse
from deltaq.language.plain_printer import plain
from deltaq.language.symbols import Symbols
from deltaq.language.sympy_algebra import to_sympy
from deltaq.mechanics.document import read_scene
from deltaq.narration.derive import derive_request

NAMES = Names(
    tuple(Symbol(name, "coordinate") for name in ("x", "y", "phi"))
    + tuple(Symbol(name, "parameter", positive=True) for name in ("m", "M", "l", "a", "k", "Omega"))
)
SYMBOLS = Symbols(NAMES)


def marked(scene: str, step: str) -> str:
    chapters = told(scene, "de")["chapters"]
    return next(s["marked"] for chapter in chapters for s in chapter["steps"] if s["id"] == step)


def test_each_mass_in_a_bracket_belongs_to_its_own_body() -> None:
    equation = marked("double-pendulum", "equation:phi1")
    assert r"(\htmlClass{body-upper}{m_1} + \htmlClass{body-lower}{m_2}) \ell_1^{2}" in equation
    assert r"\htmlClass{load-weight t-0-1-3}{(m_1 + m_2) g" in equation


def test_a_turning_plane_has_its_integral_and_no_time() -> None:
    result = told("foucault", "de")["result"]
    shown = [result["kinetic_energy"]["plain"], *result["forcing"]["plain"], str(result["mass_matrix"]["plain"])]
    assert not any("Omega*t" in text or "cos(" in text for text in shown)
    assert [each["kind"] for each in result["conserved"]] == ["energy", "symmetry"]


def ball(inertia: str) -> dict[str, object]:
    """A ball that rolls in a bowl."""
    return {
        "id": "ball",
        "coordinates": [{"name": "theta"}],
        "parameters": [{"name": "m"}, {"name": "R", "value": 3.0}, {"name": "r"}, {"name": "g"}, {"name": "c"}],
        "bodies": [
            {
                "name": "ball", "kind": "rigid", "mass": "m", "inertia": inertia, "angle": "(R - r)*theta/r",
                "position": ["(R - r)*sin(theta)", "(R - r)*cos(theta)"],
            },
        ],
        "loads": [{"kind": "gravity", "acceleration": ["0", "g"]}],
    }  # fmt: skip


@pytest.mark.parametrize(
    ("inertia", "energy", "slope"),
    [
        ("2/5*m*r^2", r"\frac{7}{10}", r"\frac{7}{5}"),
        ("0.4*m*r^2", "0.7", "1.4"),
    ],
)
def test_numbers_are_written_as_the_scene_writes_them(inertia: str, energy: str, slope: str) -> None:
    result = derive_request({"scene": ball(inertia)})["result"]
    assert result["kinetic_energy"]["latex"] == rf"{energy} m (R - r)^{{2}} \dot{{\theta}}^{{2}}"
    assert result["equations"][0]["latex"].startswith(rf"{slope} m (R - r)^{{2}} \ddot{{\theta}}")


def expressions(seed: int) -> Iterator[sp.Expr]:
    """Sums of products of brackets, waves, roots and sizes, as energies and forces are made of."""
    source = random.Random(seed)
    atoms = [
        "x",
        "y",
        "dot(x)",
        "dot(phi)",
        "sin(phi)",
        "cos(phi)",
        "cos(Omega*t)",
        "m",
        "M",
        "l",
        "a",
        "k",
        "2",
        "1/3",
    ]
    brackets = [
        "(x - l)", "(l + a*cos(phi))", "(dot(x) - k*y)", "(m + M)", "(x^2 + y^2)", "sqrt(x^2 + y^2 + l^2)",
        "abs(x - y)", "sign(x - y)", "1/sqrt(x^2 + a^2)", "(dot(x) + l*cos(phi)*dot(phi))", "1/(l + x^2)",
        "(k*x - m*y)", "exp(-x)", "sin(t*sin(Omega))",
    ]  # fmt: skip
    while True:
        terms = (
            "*".join(
                [*source.choices(atoms, k=source.randint(0, 3)), f"{source.choice(brackets)}^{source.randint(1, 2)}"]
            )
            for _ in range(source.randint(1, 4))
        )
        yield read(" + ".join(terms))


def read(text: str) -> sp.Expr:
    return to_sympy(parse(text, NAMES).tree, SYMBOLS)


@pytest.mark.parametrize("seed", range(8))
def test_what_is_shown_is_equal_and_can_be_read_back(seed: int) -> None:
    for _, expr in zip(range(12), expressions(seed), strict=False):
        shown = display(expr, SYMBOLS)
        assert is_zero(shown - expr, SYMBOLS) is True, expr
        assert is_zero(read(plain(shown)) - expr, SYMBOLS) is True, plain(shown)
        assert plain(display(shown, SYMBOLS)).count("*") <= plain(expr.expand()).count("*") + 2


def test_every_step_of_hard_forms_is_verified() -> None:
    """A spring with a rest length between points on rails, and a load with a size in it."""
    document = {
        "id": "rails",
        "coordinates": [{"name": "x1"}, {"name": "x2", "value": 0.7}],
        "parameters": [{"name": name} for name in ("m", "k", "s", "h", "c")],
        "bodies": [
            {"name": "left", "kind": "particle", "mass": "m", "position": ["x1", "0"]},
            {"name": "right", "kind": "particle", "mass": "2*m", "position": ["x2", "h"]},
        ],
        "loads": [
            {"kind": "spring", "name": "spring", "from": "left", "to": "right", "stiffness": "k", "rest_length": "s"},
            {"kind": "potential", "name": "bumper", "energy": "c*abs(x2 - x1)^3"},
        ],
    }
    system, derivation = derive(read_scene(document))
    assert [step.id for step in derivation.steps() if not step.verified] == []
    assert result_of(system).equations


@pytest.mark.parametrize("scene", ["elastic-pendulum", "base-pendulum", "double-pendulum"])
def test_what_cancels_in_an_equation_is_a_term_by_itself_in_both_parts(scene: str) -> None:
    """d/dt ∂L/∂q̇ and ∂L/∂q: the last of each pair of terms that the equation no longer has, as it is written."""
    steps = {step["id"]: step for chapter in told(scene, "de")["chapters"] for step in chapter["steps"]}
    last = "phi2" if scene == "double-pendulum" else "phi"
    _, change, slope = (part["latex"] for part in steps[f"equation:{last}"]["substeps"])
    rates = {"double-pendulum": r"\dot{\varphi}_1 \dot{\varphi}_2"}.get(scene, r"\dot{q}_1 \dot{q}_2")
    assert rates in change
    assert rates in slope
    assert "(" not in slope.replace(r"(\varphi_1 - \varphi_2)", "").split("&=")[-1]

"""What is wrong with a scene does not depend on the unit of its lengths: the same from 10⁻¹² to 10¹² of it."""

from __future__ import annotations

import pytest

from deltaq.mechanics.document import examine

SIZES = [10.0**exponent for exponent in (-12, -9, -5, -3, 0, 3, 6, 9, 12)]
NO_FRICTION, IDLE = "friction-without-coordinates", "constraint-without-coordinates"
SIZED = pytest.mark.parametrize("size", SIZES, ids=lambda size: f"{size:g}")


def rubs(slipping: str) -> dict[str, object]:
    return {"loads": [{"kind": "friction", "name": "R", "coordinate": slipping, "force": "0.1"}]}


def bounces(gap: str) -> dict[str, object]:
    return {"events": [{"name": "wall", "value": gap, "then": "bounce", "restitution": "0.5"}]}


def keeps(*equations: str) -> dict[str, object]:
    return {"constraints": [{"kind": "equation", "name": f"c{i}", "equation": e} for i, e in enumerate(equations)]}


# In lengths l: what stands in the scene, where its particle is, of coordinates x, y, z that begin at 3 l, 4 l, 0 and an
# angle, and what is wrong with it.
SCENES = [
    pytest.param(rubs("x"), ("x", "y", "0"), "", id="friction on a coordinate"),
    pytest.param(rubs("x - y"), ("x", "y", "0"), "", id="friction between two"),
    pytest.param(rubs("l*sin(x/l) + y"), ("x", "y", "0"), "", id="friction on what follows from them"),
    pytest.param(rubs("x - x"), ("x", "y", "0"), NO_FRICTION, id="friction on nothing"),
    pytest.param(rubs("l*sin(x/l)^2 + l*cos(x/l)^2"), ("x", "y", "0"), NO_FRICTION, id="friction on l"),
    pytest.param(bounces("x"), ("x", "y", "0"), "", id="wall"),
    pytest.param(bounces("x + 5*l"), ("x", "y", "0"), "", id="wall beside"),
    pytest.param(bounces("l + x - x"), ("x", "y", "0"), "bounce-without-coordinates", id="no wall"),
    pytest.param(keeps("4*x = 3*y"), ("x", "y", "0"), "", id="line"),
    pytest.param(keeps("x^2 + y^2 = 25*l^2"), ("x", "y", "0"), "", id="circle"),
    pytest.param(keeps("sqrt(x^2 + y^2) = 5*l"), ("x", "y", "0"), "", id="rod"),
    pytest.param(keeps("(x + y)^2 - x^2 - 2*x*y - y^2 = 0"), ("x", "y", "0"), IDLE, id="idle"),
    pytest.param(keeps("4*x = 3*y", "8*x = 6*y"), ("x", "y", "z"), "dependent-constraints", id="the same twice"),
    pytest.param(
        keeps("4*x = 3*y", "x^2 = 9*l^2 + z*l"), ("x", "y", "z"), "", id="two that are independent"
    ),
    pytest.param(keeps("dot(x) = l*dot(phi)"), ("x", "y", "l*phi"), "", id="rolling"),
    pytest.param(
        keeps("dot(x) = l*dot(phi)", "dot(y) = 2*l*dot(phi)"), ("x", "y", "l*phi"), "", id="lengths and angles"
    ),
    pytest.param(
        keeps("dot(x) = l*dot(phi)", "2*dot(x) = 2*l*dot(phi)"), ("x", "y", "l*phi"), "dependent-constraints",
        id="rolling twice",
    ),
    pytest.param({}, ("l*sin(phi)", "y - l*cos(phi)", "0"), "", id="hanging below what moves"),
    pytest.param({}, ("x", "0", "0"), "coordinate-without-inertia", id="one that moves nothing"),
    pytest.param({}, ("x + y", "0", "0"), "dependent-coordinates", id="two that move together"),
]  # fmt: skip


@SIZED
@pytest.mark.parametrize(("parts", "position", "code"), SCENES)
def test_verdicts_are_those_of_any_unit(
    parts: dict[str, object], position: tuple[str, ...], code: str, size: float
) -> None:
    known = " ".join(position) + str(parts)
    starts = {"x": 3 * size, "y": 4 * size, "z": 0.0, "phi": 0.4}
    used = [name for name in starts if name in known.replace("phi", "") or (name == "phi" and "phi" in known)]
    used += ["y"] if code == "coordinate-without-inertia" else []
    document = {
        "format": 1,
        "id": "sized",
        "dimension": 3,
        "coordinates": [{"name": name, "value": starts[name]} for name in used],
        "parameters": [{"name": "l", "value": size}],
        "bodies": [{"name": "mass", "kind": "particle", "mass": "1", "position": list(position)}],
        **parts,
    }
    _, problems = examine(document)
    told = {problem.code for problem in problems if problem.severity == "error"}
    assert told == ({code} if code else set())

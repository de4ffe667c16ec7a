"""What is at rest together, and which of its forces equations leave open: against closed forms and linear programs."""

from __future__ import annotations

from base64 import b64decode
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from random import Random

import numpy as np
import pytest
import sympy as sp
from scipy.optimize import linprog
from tests.simulation.constrained import platform
from tests.simulation.scenes import document

from deltaq.errors import InputError
from deltaq.mechanics.writing import write_scene
from deltaq.simulation import service

UNBOUNDED = 3  # as SciPy has it
WIDE = 1e-7  # what a force may be varied by, so that it is not determined


def ask(scene: dict, t_end: float = 1.0, **wanted: object) -> dict:
    found = service.run({"scene": scene, "t_end": t_end, "samples": 11, "tolerance": 1e-9, **wanted})
    assert found["status"] == "ok", found["reason"]
    return found


def open_forces(
    matrix: np.ndarray, needed: list[float], bounds: dict[str, tuple[float | None, float | None]]
) -> set | None:
    """The forces λ that can be varied within their bounds and `matrix` λ = `needed`; None if there are none."""
    balance = {"A_eq": matrix, "b_eq": needed, "bounds": list(bounds.values())}
    if not linprog(np.zeros(len(bounds)), **balance).success:
        return None

    def is_open(k: int) -> bool:
        own = np.eye(len(bounds))[k]
        least, most = linprog(own, **balance), linprog(-own, **balance)
        return UNBOUNDED in (least.status, most.status) or -most.fun - least.fun > WIDE

    return {name for k, name in enumerate(bounds) if is_open(k)}


@dataclass
class Row:
    """Carts at x = 0, 1, 2 … with friction and pushes; what links neighbours, rods or contacts, and walls, which touch.

    In coordinates q with x = T q.
    """

    frictions: list[float]
    pushes: list[float]
    rods: list[tuple[int, int]] = field(default_factory=list)
    contacts: list[int] = field(default_factory=list)  # of a cart with the next
    walls: list[int] = field(default_factory=list)  # −1 on the left of the first, 1 on the right of the last
    size: float = 1.0  # of all places and forces
    transform: list[list[float]] | None = None  # T

    def place(self, i: int) -> str:
        if self.transform is None:
            return f"q{i}"
        return " + ".join(f"{factor!r}*q{j}" for j, factor in enumerate(self.transform[i]))

    @property
    def document(self) -> dict:
        count, size, x = len(self.frictions), self.size, [self.place(i) for i in range(len(self.frictions))]
        places = size * np.arange(count)
        q = places if self.transform is None else np.linalg.solve(self.transform, places)
        loads = [
            {"kind": "friction", "name": f"R{i}", "coordinate": x[i], "force": repr(size * force)}
            for i, force in enumerate(self.frictions)
            if force
        ]
        loads += [
            {"kind": "force", "name": f"F{i}", "at": f"b{i}", "force": [repr(size * push), "0"]}
            for i, push in enumerate(self.pushes)
        ]
        made = document(
            {f"q{i}": (float(q[i]), 0.0) for i in range(count)},
            {},
            {f"b{i}": (str(1 + i), [x[i], "0"]) for i in range(count)},
            loads,
        )
        made["constraints"] = [
            {"kind": "equation", "name": f"S{i}{j}", "equation": f"{x[j]} - ({x[i]}) = {size * (j - i)!r}"}
            | {"multiplier": f"S{i}{j}"}
            for i, j in self.rods
        ]
        gaps = {f"N{i}": f"{x[i + 1]} - ({x[i]}) - {size!r}" for i in self.contacts}
        gaps |= {self.wall(side): x[0] if side < 0 else f"{size * (count - 1)!r} - ({x[-1]})" for side in self.walls}
        made["events"] = [
            {"name": name, "value": gap, "then": "bounce", "restitution": "0"} for name, gap in gaps.items()
        ]
        return made

    @staticmethod
    def wall(side: int) -> str:
        return "left" if side < 0 else "right"

    def _forces(self) -> Iterator[tuple[str, dict[int, float], tuple[float | None, float | None]]]:
        """Each force by name: what it does to which carts, and its bounds."""
        for i, force in enumerate(self.frictions):
            if force:
                yield f"R{i}", {i: 1.0}, (-force, force)
        for i, j in self.rods:
            yield f"S{i}{j}", {j: 1.0, i: -1.0}, (None, None)
        for i in self.contacts:
            yield f"N{i}", {i + 1: 1.0, i: -1.0}, (0.0, None)
        for side in self.walls:
            yield self.wall(side), {0 if side < 0 else len(self.frictions) - 1: -float(side)}, (0.0, None)

    def open_forces(self) -> set[str] | None:
        """The forces that can be varied while all rests; None if it cannot rest."""
        forces, carts = list(self._forces()), range(len(self.frictions))
        if not forces:
            return None if any(self.pushes) else set()
        matrix = np.array([[does.get(i, 0.0) for _, does, _ in forces] for i in carts])
        bounds = {name: each for name, _, each in forces}
        return open_forces(matrix, [-push for push in self.pushes], bounds)


def drawn(random: Random) -> Row:
    count = random.randint(1, 4)
    links = [random.choice(["", "rod", "contact"]) for _ in range(count - 1)]
    skew = [[float(i == j) + random.uniform(-0.4, 0.4) for j in range(count)] for i in range(count)]
    return Row(
        [random.choice([0.0, random.uniform(0.2, 2.0)]) for _ in range(count)],
        [random.choice([0.0, random.uniform(-1.0, 1.0)]) for _ in range(count)],
        [(i, i + 1) for i, link in enumerate(links) if link == "rod"],
        [i for i, link in enumerate(links) if link == "contact"],
        random.choice([[], [], [-1], [1], [-1, 1]]),
        random.choice([1.0, 1.0, 1e-6, 1e4]),
        random.choice([None, skew]),
    )


@dataclass
class Kept:
    """Quadratic functions of q, and products of them, at rest: with friction along them, kept, or not below zero.

    Where they are zero, the products' gradients depend on those of their factors.
    """

    functions: list[sp.Expr]
    kinds: list[str]
    energy: sp.Expr
    start: dict[sp.Symbol, float]
    frictions: list[float]

    @property
    def document(self) -> dict:
        made = document(
            {str(q): (value, 0.0) for q, value in self.start.items()},
            {},
            {f"b{q}": ("1", [f"{q} + sin({q})/5", "0"]) for q in self.start},
            [{"kind": "potential", "name": "V", "energy": spelt(self.energy)}] if self.energy != 0 else [],
        )
        made["constraints"], made["events"] = [], []
        for k, (function, kind) in enumerate(zip(self.functions, self.kinds, strict=True)):
            name, text = f"r{k}", spelt(function)
            if kind == "friction":
                made["loads"].append({"kind": kind, "name": name, "coordinate": text, "force": repr(self.frictions[k])})
            elif kind == "kept":
                equation = {"kind": "equation", "name": name, "equation": f"{text} = 0", "multiplier": name}
                made["constraints"].append(equation)
            else:
                made["events"].append({"name": name, "value": text, "then": "bounce", "restitution": "0"})
        return made

    def open_forces(self) -> set[str] | None:
        slopes = [[float(f.diff(q).subs(self.start)) for q in self.start] for f in self.functions]
        needed = [float(self.energy.diff(q).subs(self.start)) for q in self.start]
        most = {"kept": (None, None), "contact": (0.0, None)}
        bounds = {f"r{k}": most.get(kind, (-self.frictions[k], self.frictions[k])) for k, kind in enumerate(self.kinds)}
        return open_forces(np.array(slopes).T, needed, bounds)


def spelt(expression: sp.Expr) -> str:
    return str(expression).replace("**", "^")


def quadratic(random: Random, start: dict[sp.Symbol, float]) -> sp.Expr:
    terms = [*start, *(x * y for x in start for y in start if random.random() < 0.4)]
    return sp.nsimplify(sum(round(random.uniform(-1.0, 1.0), 2) * term for term in terms), rational=True)


def zero_at(start: dict[sp.Symbol, float], function: sp.Expr) -> sp.Expr:
    return function - sp.nsimplify(function.subs(start), rational=True)


def dependent(f: sp.Expr, g: sp.Expr) -> sp.Expr:
    return sp.expand(f + 2 * g + f * g)


def kept(random: Random) -> Kept:
    start = {q: round(random.uniform(-1.0, 1.0), 2) for q in sp.symbols(f"q:{random.randint(1, 3)}")}
    functions = [zero_at(start, quadratic(random, start)) for _ in range(random.randint(1, 3))]
    if len(functions) > 1:
        functions.append(dependent(*random.sample(functions, 2)))
    energy = quadratic(random, start) * random.choice([0, 1, 3])
    kinds = random.choices(["friction", "contact", "kept"], [3, 1, 1], k=len(functions))
    return Kept(functions, kinds, energy, start, [round(random.uniform(0.3, 4.0), 2) for _ in functions])


@pytest.mark.parametrize("seed", range(20))
def test_friction_along_what_constraints_hold_does_not_end_a_motion(seed: int) -> None:
    """It is a combination of two constraints where they are kept, but for rounding; a third coordinate is free."""
    random = Random(seed)
    start = {q: round(random.uniform(-1.0, 1.0), 2) for q in sp.symbols("q:3")}
    f, g = (zero_at(start, quadratic(random, start)) for _ in range(2))
    scene = Kept([f, g, dependent(f, g)], ["kept", "kept", "friction"], sp.Integer(0), start, [0.0, 0.0, 2.0])
    found = ask(scene.document)
    assert (found["events"], found["indeterminate"]) == (
        [],
        [{"names": ["r2", "r0", "r1"], "start": 0.0, "end": 1.0}],
    )


@pytest.mark.parametrize("seed", range(60))
def test_forces_along_functions_are_open_that_a_linear_program_can_vary(seed: int) -> None:
    """Those of contacts without a load are not, though their gradients depend on each other; what rests stays."""
    random = Random(seed)
    while True:
        drawn_one = kept(random)
        if (expected := drawn_one.open_forces()) is None:
            continue
        with suppress(InputError):  # no motion is left
            found = ask(drawn_one.document)
            break
    told = {name for span in found["indeterminate"] for name in span["names"]}
    assert told | set(found.get("undetermined", ())) == expected
    assert all(np.ptp(column) <= 1e-9 for column in found["coordinates"].values())
    assert found["events"] == []


@pytest.mark.parametrize("seed", range(40))
def test_forces_are_open_that_a_linear_program_can_vary(seed: int) -> None:
    random = Random(seed)
    row = next(row for row in iter(lambda: drawn(random), None) if row.open_forces() is not None)
    found = ask(row.document)
    spans = [(span["start"], span["end"]) for span in found["indeterminate"]]
    told = {name for span in found["indeterminate"] for name in span["names"]}
    assert told | set(found.get("undetermined", ())) == row.open_forces()
    assert spans in ([], [(0.0, 1.0)])
    for column in found["coordinates"].values():
        assert np.ptp(column) <= 1e-9 * row.size


def linked(**changes: object) -> dict:
    """Masses 2 and 1, one metre apart on a rod, with friction .9 and .6, of which 3 sin(t/2) pushes the first."""
    made = Row([0.9, 0.6], [0.0, 0.0], [(0, 1)]).document | changes
    made["bodies"][0]["mass"], made["bodies"][1]["mass"] = "2", "1"
    made["loads"][2]["force"] = ["3*sin(t/2)", "0"]
    return made


SLIPS = 2.0 * np.arcsin(1.5 / 3.0)  # when the push is as large as both frictions


@pytest.mark.parametrize("method", ["dop853", "dormand-prince-54", "rk4", "radau-5", "gauss-4"])
def test_blocks_on_a_rod_share_a_push_in_no_certain_way_until_they_slip(method: str) -> None:
    """While they slip: (m₀ + m₁) a = P − F₀ − F₁, λ = P − F₀ − m₀ a."""
    found = ask(linked(), 3.0, method=method, columns="numbers")
    (span,) = found["indeterminate"]
    assert span == {"names": ["R0", "R1", "S01"], "start": 0.0, "end": pytest.approx(SLIPS, abs=1e-8)}
    t = np.array(found["t"])
    slipping = np.flatnonzero(t == span["end"])[-1]
    push = 3.0 * np.sin(t / 2.0)
    rod = push - 0.9 - 2.0 * (push - 1.5) / 3.0
    parts = (
        (found["friction"]["R0"]["force"], np.full_like(t, -0.9)),
        (found["friction"]["R1"]["force"], np.full_like(t, -0.6)),
    )
    for told, true in (*parts, (found["multipliers"]["S01"], rod)):
        assert told[:slipping] == [None] * slipping
        np.testing.assert_allclose(told[slipping:], true[slipping:], atol=1e-8)
    assert found["error"]["multipliers"]["S01"][:slipping] == [None] * slipping
    assert found["friction"]["R0"]["largest"] == [0.9] * len(t)
    packed = ask(linked(), 3.0, method=method, columns="base64")
    assert np.isnan(numbers(packed["friction"]["R0"]["force"])[:slipping]).all()
    np.testing.assert_allclose(numbers(packed["multipliers"]["S01"])[slipping:], rod[slipping:], atol=1e-8)


def numbers(packed: str) -> np.ndarray:
    return np.frombuffer(b64decode(packed), "<f8")


def test_what_is_not_together_at_rest_is_determined() -> None:
    """A friction alone takes the push; with a rod that another block without friction hangs on, and without one."""
    t = np.linspace(0.0, 0.5, 11)
    for row in (Row([0.9], [0.0]), Row([0.9, 0.0], [0.0, 0.0], [(0, 1)])):
        made = row.document
        made["loads"][1]["force"] = ["3*sin(t/2)", "0"]
        found = ask(made, 0.5)
        assert found["indeterminate"] == []
        np.testing.assert_allclose(found["friction"]["R0"]["force"], -3.0 * np.sin(t / 2.0), atol=1e-12)


def test_a_ladder_that_sticks_on_floor_and_wall_does_not_tell_where() -> None:
    """x² + y² = 5² with friction at both ends; on the floor alone it takes what the rod does: R = −mg x/y."""
    made = document(
        {"x": (3.0, 0.0), "y": (4.0, 0.0)},
        {},
        {"foot": ("1", ["x", "0"]), "top": ("2", ["0", "y"])},
        [
            {"kind": "gravity", "acceleration": ["0", "-9.81"]},
            {"kind": "friction", "name": "floor", "coordinate": "x", "force": "40"},
            {"kind": "friction", "name": "wall", "coordinate": "y", "force": "10"},
        ],
    )
    made["constraints"] = [{"kind": "distance", "name": "rod", "from": "foot", "to": "top", "length": "5"}]
    found = ask(made)
    assert found["indeterminate"] == [{"names": ["floor", "wall", "lambda"], "start": 0.0, "end": 1.0}]
    made["loads"] = made["loads"][:2]
    found = ask(made)
    assert found["indeterminate"] == []
    np.testing.assert_allclose(found["friction"]["floor"]["force"], -2.0 * 9.81 * 3.0 / 4.0, atol=1e-9)
    np.testing.assert_allclose(found["multipliers"]["lambda"], -2.0 * 9.81 * 5.0 / 4.0, atol=1e-9)


def test_belts_of_one_speed_carry_linked_blocks_in_no_certain_way() -> None:
    """On belts of 1 m/s blocks of no push come to move with them; on unequal ones each friction is known for ever."""
    for other, is_open in (("1", True), ("2", False)):
        made = Row([0.9, 0.6], [0.0, 0.0], [(0, 1)]).document
        for load, speed in zip(made["loads"], ("1", other), strict=False):
            load["surface_rate"] = speed
        found = ask(made, 5.0)
        spans = found["indeterminate"]
        assert [span["names"] for span in spans] == ([["R0", "R1", "S01"]] if is_open else [])
        if is_open:  # 3 kg by 1.5 N
            assert (spans[0]["start"], spans[0]["end"]) == (pytest.approx(2.0, abs=1e-9), 5.0)


def test_multipliers_that_constraints_leave_open_are_told_once() -> None:
    """Of three parallel rods none is determined, whether or not something sticks beside them."""
    made = write_scene(platform(3))
    made["coordinates"].append({"name": "z", "value": 0.0, "rate": 0.0})
    made["bodies"].append({"name": "block", "kind": "particle", "mass": "1", "position": ["z", "0"]})
    made["loads"].append({"kind": "force", "name": "push", "at": "block", "force": ["sin(t)/10", "0"]})
    made["loads"].append({"kind": "friction", "name": "R", "coordinate": "z", "force": "1"})
    found = ask(made)
    assert (found["undetermined"], found["indeterminate"]) == (["S0", "S1", "S2"], [])
    np.testing.assert_allclose(found["friction"]["R"]["force"], -np.sin(found["t"]) / 10.0, atol=1e-12)

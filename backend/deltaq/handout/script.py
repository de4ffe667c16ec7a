"""A motion as a program of its own: Python with NumPy and SciPy, from the derived equations M(q, t) q̈ = f(q, q̇, t)."""

from __future__ import annotations

import builtins
import keyword
import unicodedata
from collections.abc import Iterator, Mapping

import sympy as sp
from sympy.printing.numpy import NumPyPrinter

from ..derivation.matrix_form import forcing, mass_matrix
from ..derivation.system import System
from ..language.functions import FUNCTIONS
from ..mechanics.event import Event
from ..mechanics.scene import Scene

TEMPLATE = """\
# {title}
# The motion of this scene, from the equations of motion M(q, t) q'' = f(q, q', t) that δq derived.
# Needs NumPy and SciPy; draws the motion if Matplotlib is there. Units are those beside the values.

import numpy as np
from numpy import {functions}
from scipy.integrate import solve_ivp

{parameters}

COORDINATES = {coordinates}
VALUES = {values}  # at t = 0
RATES = {rates}
T_END = {t_end}
SAMPLES = {samples}


def mass_matrix(t, q):
    {unpack_values}
    return np.array({mass_matrix}, dtype=float)


def forcing(t, q, v):
    {unpack_values}
    {unpack_rates}
    return np.array({forcing}, dtype=float)


def positions(t, q):
    {unpack_values}
    return {positions}


{events}def right_hand_side(t, state):
    q, v = np.split(state, 2)
    return np.concatenate([v, np.linalg.solve(mass_matrix(t, q), forcing(t, q, v))])


def solve(t_end=T_END, samples=SAMPLES):
    times = np.linspace(0.0, t_end, samples)
    start = np.array([*VALUES, *RATES])
    found = solve_ivp(
        right_hand_side, (0.0, t_end), start, method="DOP853", t_eval=times, rtol=1e-11, atol=1e-12{watched}
    )
    if not found.success:
        raise SystemExit(found.message)
    return found.t, found.y[: len(VALUES)], found.y[len(VALUES) :]


def draw(times, q):
    try:
        from matplotlib import pyplot
    except ImportError:
        return
    for name, curve in zip(COORDINATES, q):
        pyplot.plot(times, curve, label=name)
    pyplot.xlabel("t in s")
    pyplot.legend()
    pyplot.show()


if __name__ == "__main__":
    times, q, v = solve()
    print("t," + ",".join(COORDINATES))
    for t, *row in zip(times, *q):
        print(",".join(f"{{value:.10g}}" for value in (t, *row)))
    draw(times, q)
"""
EVENT = """\
def {name}(t, state):  # {title}
    q, v = np.split(state, 2)
    {unpack_values}
    {unpack_rates}
    return {value}


{name}.terminal, {name}.direction = True, -1  # the motion is right as long as this is positive


"""
OWN = {"np", "solve_ivp", "mass_matrix", "forcing", "positions", "right_hand_side", "solve", "draw", "pyplot"}
LOCAL = {"t", "q", "v", "state", "times", "found", "start", "name", "curve", "row", "value", "t_end", "samples"}
CONSTANTS = {"COORDINATES", "VALUES", "RATES", "T_END", "SAMPLES"}
OF_NUMPY = {"arcsin", "arccos", "arctan", "arctan2", "arcsinh", "arccosh", "arctanh", "pi"}
TAKEN = frozenset({*OWN, *LOCAL, *CONSTANTS, *OF_NUMPY, *FUNCTIONS, *dir(builtins)})
SAMPLES_PER_SECOND = 30


def script(scene: Scene, language: str, t_end: float) -> str:
    """The program: it prints the motion from the scene's own initial values as a table."""
    system = System(scene)
    words = _Words(system)
    free = scene.free
    unpacked = {
        "unpack_values": f"[{', '.join(words.called(system.q(c.name).name) for c in free)}] = q",
        "unpack_rates": f"[{', '.join(words.called(system.rate(c.name).name) for c in free)}] = v",
    }
    events = [_event(event, system, words, language, unpacked) for event in scene.events]
    content = unpacked | {
        "title": comment(scene.title.get(language) or scene.id),
        "parameters": "\n".join(_parameters(scene, words)) or "# This scene has no parameters.",
        "coordinates": repr([c.name for c in free]),
        "values": repr([float(c.value) for c in free]),
        "rates": repr([float(c.rate) for c in free]),
        "t_end": repr(float(t_end)),
        "samples": str(int(t_end * SAMPLES_PER_SECOND) + 1),
        "events": "".join(events),
        "watched": f", events=[{', '.join(words.called(_event_of(event.name)) for event in scene.events)}]"
        if events
        else "",
        "mass_matrix": words.matrix(mass_matrix(system)),
        "forcing": words.vector(forcing(system)),
        "positions": "{" + ", ".join(_positions(system, words)) + "}",
    }
    return TEMPLATE.format(functions=", ".join(words.functions), **content)


def _event(event: Event, system: System, words: _Words, language: str, unpacked: Mapping[str, str]) -> str:
    """A function that is positive until the event happens, and ends the integration there."""
    value = words.text(system.guided(system.expression(event.value.tree)))
    title = comment(event.title.get(language) or event.name)
    return EVENT.format(name=words.called(_event_of(event.name)), title=title, value=value, **unpacked)


def _event_of(name: str) -> str:
    """An event among the names of symbols, none of which has a blank."""
    return f"event {name}"


def comment(text: str) -> str:
    """Text that stays within one comment whatever it holds."""
    return "".join(sign if unicodedata.category(sign)[0] not in "CZ" else " " for sign in text).strip()


def _parameters(scene: Scene, words: _Words) -> Iterator[str]:
    for parameter in scene.parameters:
        yield f"{words.called(parameter.name)} = {float(parameter.value)!r}" + (
            f"  # {comment(parameter.unit)}" if parameter.unit else ""
        )


def _positions(system: System, words: _Words) -> Iterator[str]:
    """Positions that hang on nothing but coordinates and time; a continuum has one for each of its points."""
    for body in system.scene.bodies:
        position = system.position(body.name)
        if words.knows(position):
            yield f"{body.name!r}: np.array({words.vector(position)}, dtype=float)"


class _Words:
    """How the quantities of a system are called in the program, and the functions it needs of NumPy."""

    def __init__(self, system: System) -> None:
        scene = system.scene
        plain = [*(p.name for p in scene.parameters), *(c.name for c in scene.coordinates)]
        wanted = {_event_of(event.name): f"event_{event.name}" for event in scene.events}
        wanted |= {name: name for name in plain} | {system.rate(c.name).name: f"{c.name}_dot" for c in scene.free}
        self._known = {**_distinct(wanted), system.t.name: "t"}
        self._printer = NumPyPrinter({"fully_qualified_modules": False})

    @property
    def functions(self) -> list[str]:
        """What the program imports from NumPy for what has been printed so far."""
        return sorted(self._printer.module_imports.get("numpy", ())) or ["pi"]

    def knows(self, expression: sp.ImmutableMatrix) -> bool:
        """Whether the program has all that the expression hangs on."""
        return {symbol.name for symbol in expression.free_symbols} <= self._known.keys()

    def called(self, name: str) -> str:
        """What the symbol of this name is called in the program."""
        return self._known[name]

    def text(self, expression: sp.Expr) -> str:
        """The expression in Python, by functions that NumPy has."""
        called = {symbol: sp.Symbol(self._known[symbol.name]) for symbol in expression.free_symbols}
        plain = expression.xreplace(called).replace(_is_reciprocal, _by_its_inverse)
        return str(self._printer.doprint(plain))

    def vector(self, column: sp.ImmutableMatrix) -> str:
        return f"[{', '.join(map(self.text, column))}]"

    def matrix(self, square: sp.ImmutableMatrix) -> str:
        rows = (", ".join(map(self.text, row)) for row in square.tolist())
        return f"[{', '.join(f'[{row}]' for row in rows)}]"


RECIPROCALS = {sp.cot: sp.tan, sp.sec: sp.cos, sp.csc: sp.sin}


def _is_reciprocal(expression: sp.Basic) -> bool:
    return expression.func in RECIPROCALS


def _by_its_inverse(expression: sp.Basic) -> sp.Expr:
    return 1 / RECIPROCALS[expression.func](*expression.args)


def _distinct(wanted: Mapping[str, str]) -> dict[str, str]:
    """Each its name, or one like it where the name means something else already."""
    taken, given = set(TAKEN), {}
    for symbol, proposed in wanted.items():
        name = proposed if proposed.isascii() and proposed.isidentifier() else "x"
        while keyword.iskeyword(name) or name in taken:
            name += "_"
        taken.add(name)
        given[symbol] = name
    return given

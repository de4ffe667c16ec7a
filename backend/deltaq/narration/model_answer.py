"""Equilibria, small motions and Routh's function as data: expressions as data, numbers rounded."""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp
from flint import arb

from ..derivation.conditions import Comparison, Conditions
from ..derivation.conservation import Reduction
from ..derivation.contact_equilibria import ContactEquilibrium
from ..derivation.linearization import Linearization
from ..derivation.program import number
from ..derivation.rest_sets import KinkRest, RestRange
from ..derivation.result import LoadPotential, Result, Told
from ..derivation.spectrum import ComplexMode, Mode
from ..derivation.steady import SteadyMotion
from ..mechanics.scene import Scene
from .expression_writer import ExpressionWriter

Document = dict[str, object]

DIGITS = 12


def equilibrium(told: Told, scene: Scene, write: ExpressionWriter) -> Document:
    """One equilibrium: where, how stable, and with which frequencies (rad/s) it oscillates in which shapes.

    Coordinates in `free` may have any value; shapes are in all coordinates, also with constraints. `exact` says that
    plain and latex are closed forms in the parameters; `number` is their value in this scene. No numbers of small
    motions where one is beyond doubles.
    """
    linear = told.linear
    free = [coordinate.name for coordinate in scene.free]
    point = _start(scene)
    held = linear.equilibrium.reactions
    spectrum = linear.spectrum if linear.spectrum and linear.spectrum.is_representable else None
    return {
        "values": {q.name: _value(q, linear, point, write) for q in linear.equilibrium.values},
        **({"multipliers": {e.name: _reaction(v, linear, point, write) for e, v in held.items()}} if held else {}),
        "exact": linear.equilibrium.exact,
        "free": list(linear.equilibrium.free),
        "stability": linear.stability,
        "kind": linear.verdict.kind or None,
        "conditions": _conditions(told.conditions, write),
        "band": _band(linear, point, write),
        "eigenvalues": [[_float(v.real), _float(v.imaginary)] for v in spectrum.eigenvalues] if spectrum else [],
        "eigenfrequencies": [_float(frequency) for frequency in spectrum.frequencies] if spectrum else [],
        "modes": [_mode(mode, linear, free) for mode in spectrum.modes] if spectrum else [],
        "complex_modes": [_complex_mode(mode, linear, free) for mode in spectrum.complex_modes] if spectrum else [],
    }


def contact_equilibrium(found: ContactEquilibrium, scene: Scene, write: ExpressionWriter) -> Document:
    """A state of rest on closed contacts: where, with which reactions, and how stable."""
    place, point = found.equilibrium, _start(scene)

    def told(value: sp.Expr) -> Document:
        return _written(value, point, write, exact=place.exact)

    pairs = zip(found.contacts, found.reactions, strict=True)
    held = {each.name: told(value) for each, value in place.reactions.items()}
    return {
        "values": {q.name: told(value) for q, value in place.values.items()},
        "contacts": [{"contact": event.name, "reaction": told(value)} for event, value in pairs],
        **({"multipliers": held} if held else {}),
        "exact": place.exact,
        "free": list(place.free),
        "stability": found.stability,
    }


def _start(scene: Scene) -> dict[str, arb]:
    """Parameters, and free coordinates where the scene starts."""
    point = {parameter.name: arb(parameter.value) for parameter in scene.parameters}
    return point | {coordinate.name: arb(coordinate.value) for coordinate in scene.free}


def _conditions(found: Conditions | None, write: ExpressionWriter) -> Document | None:
    """The inequalities for its existence and its stability or instability; none where the verdict holds here only."""
    if found is None:
        return None
    return {
        "existence": [_comparison(each, write) for each in found.existence],
        "stability": [_comparison(each, write) for each in found.stability],
    }


def _comparison(each: Comparison, write: ExpressionWriter) -> Document:
    sides = {"smaller": each.smaller, "larger": each.larger}
    return {name: write.written(side) for name, side in sides.items()}


def _band(linear: Linearization, point: Mapping[str, arb], write: ExpressionWriter) -> Document | None:
    """Between which values dry friction holds the coordinate."""
    if linear.band is None:
        return None
    ends = {"low": linear.band.low, "high": linear.band.high}
    return {name: _written(value, point, write, exact=linear.band.exact) for name, value in ends.items()}


def kink_equilibrium(found: KinkRest, scene: Scene, write: ExpressionWriter) -> Document:
    """A state of rest where forces jump: where, what switches there, and what acts beside it or balances the forces."""
    place, point = found.equilibrium, _start(scene)

    def told(value: sp.Expr) -> Document:
        return _written(value, point, write, exact=place.exact)

    return {
        "values": {q.name: told(value) for q, value in place.values.items()},
        "switches": [write.written(s) for s in found.switches],
        "forces": dict(zip(("below", "above"), map(told, found.sides), strict=True)) if found.sides else None,
        "shares": [told(share) for share in found.shares],
        "contacts": [event.name for event in found.contacts],
        "exact": place.exact,
        "free": list(place.free),
        "stability": found.stability,
    }


def rest_range(found: RestRange, scene: Scene, write: ExpressionWriter) -> Document:
    """Between which values the coordinate rests; null where there is no end."""
    point = _start(scene)
    ends = {"low": found.low, "high": found.high}
    told = {
        name: None if end is None else {**_written(end.value, point, write, exact=end.exact), "at": end.kind}
        for name, end in ends.items()
    }
    return {"coordinate": found.coordinate, **told, "friction": found.by_friction}


def search(result: Result) -> Document | None:
    """How many equilibria there are, where they were sought, and whether that is all; none where time is in the laws.

    `range` holds the coordinates that were searched between two values, not everywhere.
    """
    found = result.search
    if found is None:
        return None
    several = (each.ranges for each in (result.kinked, result.resting, found) if each is not None)
    return {
        "complete": result.left_out is None,
        "count": found.count,
        "range": {name: list(map(_float, ends)) for each in several for name, ends in each.items()},
        "left_out": result.left_out,
    }


def _value(q: sp.Symbol, linear: Linearization, point: Mapping[str, arb], write: ExpressionWriter) -> Document:
    return _written(linear.equilibrium.values[q], point, write, exact=linear.equilibrium.exact)


def _reaction(value: sp.Expr, linear: Linearization, point: Mapping[str, arb], write: ExpressionWriter) -> Document:
    return _written(value, point, write, exact=linear.equilibrium.exact)


def _written(value: sp.Expr, point: Mapping[str, arb], write: ExpressionWriter, *, exact: bool) -> Document:
    if exact:
        return {**write.written(value), "number": _float(number(value, point))}
    return write.number(value, _float(value))


def _mode(mode: Mode, linear: Linearization, free: list[str]) -> Document:
    """ω² in 1/s², negative where the motion grows, and the ratio of the amplitudes."""
    (parts,) = linear.in_all_coordinates(mode.shape)
    shape = {name: _float(part) for name, part in zip(free, parts, strict=True)}
    return {"eigenfrequency_squared": _float(mode.square), "shape": shape}


def _complex_mode(mode: ComplexMode, linear: Linearization, free: list[str]) -> Document:
    """x = Re(a e^λt): circular frequency in rad/s, decay in 1/s (negative: growth), a as [real, imaginary] parts."""
    parts = zip(free, *linear.in_all_coordinates(mode.real, mode.imaginary), strict=True)
    return {
        "eigenfrequency": _float(mode.eigenvalue.imaginary),
        "decay": _float(-mode.eigenvalue.real),
        "shape": {name: [_float(real), _float(imaginary)] for name, real, imaginary in parts},
    }


def _float(value: sp.Expr | arb | float) -> float:
    found = float(f"{float(value):.{DIGITS}g}")
    return found if abs(found) > 10.0**-DIGITS else 0.0


def own_symbols(result: Result, write: ExpressionWriter) -> list[Document]:
    """Names in plain texts of the result that the scene does not have: the constant momenta of Routh's function."""
    momenta = result.routh.momenta if result.routh else {}
    return [{**write.name(p.name), "kind": "momentum", "coordinate": q} for q, p in momenta.items()]


def load(found: LoadPotential, write: ExpressionWriter) -> Document:
    """Whether a load has a potential, and the curl test: ∂Qᵢ/∂qₖ − ∂Qₖ/∂qᵢ for every pair of coordinates."""
    energy, zero = found.potential, write.written(sp.S.Zero)
    curl = ((pair, zero if value == 0 else write.written(value)) for pair, value in found.curl.items())
    return {
        "load": found.load,
        "outcome": found.outcome,
        "has_potential": found.has_potential,
        "potential": None if energy is None else write.written(energy),
        "curl": [{"coordinates": list(pair), **value} for pair, value in curl],
    }


def routh(reduction: Reduction | None, write: ExpressionWriter) -> Document | None:
    """Routh's function; its `momenta` are the constant momenta of the cyclic coordinates, by their symbols."""
    if reduction is None:
        return None
    momenta = {coordinate: symbol.name for coordinate, symbol in reduction.momenta.items()}
    return {**write.written(reduction.function), "momenta": momenta}


def steady(motion: SteadyMotion, number: int, write: ExpressionWriter) -> Document:
    """A relative equilibrium; `initial` starts it, with the scene's own values of the parameters."""
    rate = {**write.written(motion.rate), "number": _float(motion.number)}
    return {
        "step": f"relative-equilibrium:{number}",
        "resting": motion.coordinate,
        "turning": motion.turning,
        "rate": rate,
        "stability": motion.stability,
        "eigenfrequency": None if motion.frequency is None else _float(motion.frequency),
        "initial": {q: {"value": value, "rate": _float(speed)} for q, (value, speed) in motion.initial.items()},
    }

"""Small motions of every scene over the ranges of all its sliders, held to mpmath's eigenvalue solvers at 40 digits.

Run it from the checkout: `python -m tests.derivation.modes_over_sliders [values] [scene …]`, a thousand values unless
told otherwise. Of M, D and K of each equilibrium, undamped ones are solved as a symmetric problem by Cholesky's
factors of M, the others as the companion matrix. Every eigenvalue must be there as often as mpmath finds it, and every
shape must fulfil its equation; there must be as many shapes as coordinates where M, K are symmetric.
"""

from __future__ import annotations

import random
import sys
from collections.abc import Iterator
from dataclasses import replace

import mpmath as mp
import sympy as sp

from deltaq.derivation.conservation import is_cyclic, is_passive
from deltaq.derivation.dissipation import dissipative_loads, remaining_loads
from deltaq.derivation.linearization import Linearization, damping_at_rest, linearizations, stiffness_at_rest
from deltaq.derivation.matrix_form import forces_at_rest, is_autonomous, mass_matrix
from deltaq.derivation.system import System
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.parameter import Parameter
from deltaq.mechanics.scene import Scene

DIGITS = 40
NEAR = mp.mpf(10) ** -12  # the refined numbers of equilibria without closed form are doubles
WIDE = 5.0  # times and parts of the value, where a slider has no ends of its own
OF_VALUES = ("scene", "effort", "parameter_values")  # all else that is kept holds for any values


def scenes() -> list[str]:
    """Those whose laws do not hold time."""
    return [name for name in scene_ids() if is_autonomous(System(load_scene(name)))]


def at_random(scene: Scene, source: random.Random) -> Scene:
    """The scene with every slider somewhere in its range."""
    return replace(scene, parameters=tuple(replace(p, value=_within(p, source)) for p in scene.parameters))


def _within(parameter: Parameter, source: random.Random) -> float:
    low = parameter.value / WIDE if parameter.min is None else parameter.min
    high = parameter.value * WIDE if parameter.max is None else parameter.max
    found = float(f"{source.uniform(min(low, high), max(low, high)):.3g}")
    return parameter.value if parameter.positive and found <= 0 else found


def systems(name: str, count: int) -> Iterator[System]:
    """The scene at so many values; what holds for all of them is derived once."""
    scene, source = load_scene(name), random.Random(name)
    first = System(scene)
    for known in (mass_matrix, forces_at_rest, damping_at_rest, stiffness_at_rest, is_passive, is_autonomous):
        known(first)
    dissipative_loads(first), remaining_loads(first), [is_cyclic(first, q) for q in first.free]
    shared = {key: value for key, value in vars(first).items() if key not in OF_VALUES}
    for _ in range(count):
        system = System(at_random(scene, source))
        vars(system).update({k: dict(v) if k.startswith("answers") else v for k, v in shared.items()})
        vars(system).pop("answers of deltaq.derivation.equilibria.domain", None)
        yield system


def matrix(value: sp.Matrix, system: System) -> mp.matrix:
    starts = {system.q(c.name): sp.Rational(repr(float(c.value))) for c in system.scene.free}
    numbers = value.xreplace({**starts, **system.parameter_values})
    return mp.matrix([[mp.mpf(str(sp.N(entry, DIGITS + 5))) for entry in row] for row in numbers.tolist()])


def number(value: sp.Rational) -> mp.mpf:
    return mp.mpf(int(value.p)) / int(value.q)


def findings(system: System) -> Iterator[str]:
    """What is wrong with the small motions about any equilibrium."""
    with mp.workdps(DIGITS):
        for each in linearizations(system):
            if each.spectrum is not None:
                M, D, K = (matrix(part, system) for part in (each.mass, each.damping, each.stiffness))
                yield from _undamped(each, M, K) if not any(D) and _is_symmetric(K) else _damped(each, M, D, K)


def _is_symmetric(K: mp.matrix) -> bool:
    return mp.mnorm(K - K.T) <= NEAR * mp.mnorm(K)


def _undamped(each: Linearization, M: mp.matrix, K: mp.matrix) -> Iterator[str]:
    assert each.spectrum is not None
    inverse = mp.inverse(mp.cholesky(M))
    squares = sorted(mp.eigsy(inverse * K * inverse.T, eigvals_only=True))
    size, modes = max(map(abs, squares), default=mp.mpf(0)) or mp.mpf(1), each.spectrum.modes
    if len(modes) != len(squares):
        yield f"{len(modes)} modes of {len(squares)}"
        return
    for found, expected in zip(sorted(number(mode.square) for mode in modes), squares, strict=True):
        if abs(found - expected) > NEAR * size:
            yield f"ω² = {mp.nstr(found)}, not {mp.nstr(expected)}"
    for mode in modes:
        shape, square = mp.matrix([number(part) for part in mode.shape]), number(mode.square)
        if mp.norm((K - square * M) * shape) > NEAR * (mp.mnorm(K) + abs(square) * mp.mnorm(M)):
            yield f"the shape {list(map(float, mode.shape))} is none of ω² = {mp.nstr(square)}"
        if abs(max(map(abs, shape)) - 1) > NEAR:
            yield "the largest part of a shape is not 1"


def _damped(each: Linearization, M: mp.matrix, D: mp.matrix, K: mp.matrix) -> Iterator[str]:
    assert each.spectrum is not None
    n, inverse = M.rows, mp.inverse(M)
    companion = mp.zeros(2 * n)
    companion[:n, n:], companion[n:, :n], companion[n:, n:] = mp.eye(n), -inverse * K, -inverse * D
    expected = list(mp.eig(companion, left=False, right=False))
    found = [mp.mpc(number(value.real), number(value.imaginary)) for value in each.spectrum.eigenvalues]
    size = max(map(abs, expected), default=mp.mpf(0)) or mp.mpf(1)
    for value in found:
        nearest = min(expected, key=lambda other, value=value: abs(other - value))  # type: ignore[misc]
        expected.remove(nearest)
        if abs(nearest - value) > NEAR ** mp.mpf("0.5") * size:
            yield f"λ = {mp.nstr(value)}, not {mp.nstr(nearest)}"
    for mode in each.spectrum.complex_modes:
        root = mp.mpc(number(mode.eigenvalue.real), number(mode.eigenvalue.imaginary))
        pairs = zip(mode.real, mode.imaginary, strict=True)
        shape = mp.matrix([mp.mpc(number(real), number(imaginary)) for real, imaginary in pairs])
        scale = abs(root) ** 2 * mp.mnorm(M) + abs(root) * mp.mnorm(D) + mp.mnorm(K)
        if mp.norm((root**2 * M + root * D + K) * shape) > NEAR * scale:
            yield f"a complex shape does not belong to λ = {mp.nstr(root)}"


def main(count: int, names: list[str]) -> int:
    """Prints what was checked and what is wrong; the number of these."""
    total = wrong = motions = 0
    for name in names:
        before = motions
        for system in systems(name, count):
            told = list(findings(system))
            motions += sum(each.spectrum is not None for each in linearizations(system))
            total, wrong = total + 1, wrong + len(told)
            for text in told[:1]:
                print(f"{name} {dict(system.parameter_values)}: {text}")
        print(f"{name}: {count} values, {motions - before} spectra", flush=True)
    print(f"{len(names)} scenes, {total} sets of values, {motions} spectra, {wrong} findings")
    return wrong


if __name__ == "__main__":
    sys.exit(bool(main(int(sys.argv[1]) if len(sys.argv) > 1 else 1000, sys.argv[2:] or scenes())))

"""Motions with constraints drawn at random, and the truth of them: series of batches in extended precision.

Equations come from SymPy's derivatives of energies that are written down here once more, and q̈ and λ from
[M −Aᵀ; A 0] solved by elimination in numbers of 64 bits of mantissa; nothing of it is computed by δq. A motion goes on
by extrapolation of the midpoint rule, all motions of a kind side by side.
Source: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, II.9 (Gragg, Bulirsch, Stoer).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from random import Random

import numpy as np
import sympy as sp
from numpy.typing import NDArray
from tests.simulation.constrained import Document

Longs = NDArray[np.longdouble]
Values = Mapping[str, float]
T = sp.Symbol("t")
COLUMNS, PARTS = 8, 2  # of the extrapolation; steps between two samples


@dataclass(frozen=True)
class Kind:
    """A family of motions: its scene, and the same in symbols.

    `masses` are a mass and a position each, `rows` the constraints as g(q, t), or, with rates in them, as w = 0; a row
    that pulls has the sign of the tension. `draw` gives parameters, and values and rates that keep all constraints.
    """

    name: str
    coordinates: tuple[str, ...]
    bodies: tuple[Document, ...]
    constraints: tuple[Document, ...]
    masses: tuple[tuple[str, tuple[str, ...]], ...]
    rows: tuple[str, ...]
    draw: Callable[[Random], tuple[dict[str, float], list[float], list[float]]] = field(repr=False)
    multipliers: tuple[str, ...] = ()
    potential: str = "0"
    forces: tuple[str, ...] = ()
    points: Mapping[str, list[str]] = field(default_factory=dict)
    loads: tuple[Document, ...] = ()
    t_end: float = 4.0

    def scene(self, values: Values, q: Sequence[float], v: Sequence[float]) -> Document:
        table = zip(self.coordinates, q, v, strict=True)
        return {
            "id": "own",
            "dimension": len(self.masses[0][1]),
            "coordinates": [{"name": name, "value": float(a), "rate": float(b)} for name, a, b in table],
            "parameters": [{"name": name, "value": value, "positive": False} for name, value in values.items()],
            "points": [{"name": name, "position": at} for name, at in self.points.items()],
            "bodies": list(self.bodies),
            "loads": list(self.loads),
            "constraints": list(self.constraints),
        }


class Equations:
    """[M −Aᵀ; A 0] and its right side of a kind, as functions of (q, v, t, parameters) in extended precision."""

    def __init__(self, kind: Kind, names: Sequence[str]) -> None:
        q, v = (sp.symbols([letter + name for name in kind.coordinates]) for letter in ("", "rate_"))
        self.n, self.m = len(q), len(kind.rows)
        functions = {"sqrt": sp.sqrt, "sin": sp.sin, "cos": sp.cos}
        known = functions | {each.name: each for each in (*q, *v, T, *sp.symbols(list(names)))}

        def read(text: str) -> sp.Expr:
            return sp.sympify(text, locals=known)

        def rate(of: sp.Expr) -> sp.Expr:
            return sp.Add(sp.diff(of, T), *(sp.diff(of, a) * b for a, b in zip(q, v, strict=True)))

        parts = [(read(m), [rate(read(x)) for x in place]) for m, place in kind.masses]
        kinetic = sum(m * sum(u**2 for u in speed) for m, speed in parts) / 2
        mass = sp.Matrix([[sp.diff(kinetic, a, b) for a in v] for b in v])
        forces = [read(each) for each in kind.forces or ("0",) * self.n]
        right = [
            Q + sp.diff(kinetic - read(kind.potential), a) - rate(sp.diff(kinetic, b))
            for Q, a, b in zip(forces, q, v, strict=True)
        ]
        slips = [w if w.has(*v) else rate(w) for w in map(read, kind.rows)]
        rows = sp.Matrix([[sp.diff(w, b) for b in v] for w in slips])
        bias = [-rate(w) for w in slips]
        zero = sp.zeros(self.m, self.m)
        matrix = sp.Matrix(sp.BlockMatrix([[mass, -rows.T], [rows, zero]]))
        given = [*q, *v, T, *sp.symbols(list(names))]
        self._entries = sp.lambdify(given, [*matrix, *right, *bias], modules="numpy", cse=True)

    def solved(self, state: Longs, time: Longs, values: Longs) -> Longs:
        """q̈ and λ: shape (n + m, batch); `state` has shape (2n, batch), `values` (parameters, batch)."""
        size, batch = self.n + self.m, state.shape[1]
        table = np.empty((size * size + size, batch), dtype=np.longdouble)
        for k, entry in enumerate(self._entries(*state, time, *values)):
            table[k] = entry
        return eliminated(table[: size * size].reshape(size, size, batch), table[size * size :])

    def rates(self, state: Longs, time: Longs, values: Longs) -> Longs:
        return np.concatenate([state[self.n :], self.solved(state, time, values)[: self.n]])


def eliminated(matrix: Longs, right: Longs) -> Longs:
    """The solutions of a batch of linear systems, shape (size, size, batch) and (size, batch)."""
    size, batch = right.shape
    table = np.concatenate([matrix, right[:, None, :]], axis=1)
    every = np.arange(batch)
    for k in range(size):
        pivot = k + np.argmax(np.abs(table[k:, k, :]), axis=0)
        row = table[pivot, :, every].T.copy()
        table[pivot, :, every] = table[k].T
        table[k] = row / row[k]
        others = np.arange(size) != k
        table[others] -= table[others, k][:, None, :] * table[k][None, :, :]
    return table[:, size, :]


def followed(
    equations: Equations, start: Longs, values: Longs, times: Longs, parts: int = PARTS
) -> tuple[Longs, Longs]:
    """States and λ at `times`, shape (samples, 2n, batch) and (samples, m, batch)."""
    state, states, found = start, [], []
    for before, now in zip(times, [*times[1:], None], strict=True):
        states.append(state)
        found.append(equations.solved(state, before, values)[equations.n :])
        if now is None:
            break
        h = (now - before) / parts
        for k in range(parts):
            state = _leap(equations, state, before + k * h, h, values)
    return np.array(states), np.array(found)


def _leap(equations: Equations, state: Longs, time: Longs, h: Longs, values: Longs) -> Longs:
    """One step by extrapolation of midpoint rules with 2, 4, 6 … parts."""
    columns: list[Longs] = []
    slope = equations.rates(state, time, values)
    for j in range(1, COLUMNS + 1):
        part, new = h / (2 * j), []
        old, now = state, state + part * slope
        for k in range(1, 2 * j):
            old, now = now, old + 2 * part * equations.rates(now, time + k * part, values)
        new = [0.5 * (now + old + part * equations.rates(now, time + h, values))]
        for k, above in enumerate(columns):
            ratio = (np.longdouble(j) / (j - 1 - k)) ** 2 - 1
            new.append(new[k] + (new[k] - above) / ratio)
        columns = new
    return columns[-1]

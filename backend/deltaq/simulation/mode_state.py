"""A state in a mode: which signs are fixed and which rows are held, and what follows at that state."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..model.linear_system import LinearSystem
from ..model.modes import Modes
from .kernels.motion import SMALLEST_SCHUR_PIVOT
from .once import once
from .problem import Floats, Problem

TOUCHING = 1e-11  # a gap, relative to the coordinates
Least = tuple[float | Floats, float | Floats]  # of places, and of rates


class Mode(NamedTuple):
    """Signs of kinks, of slipping and of switches (−1 or 1), flags of rows (1: held), offsets of watched values."""

    kinks: tuple[float, ...]
    slips: tuple[float, ...]
    flags: tuple[float, ...]
    offsets: tuple[float, ...]

    @property
    def parameters(self) -> tuple[float, ...]:
        """As the model reads them, behind the scene's own."""
        return (*self.kinks, *self.slips, *self.flags, *self.offsets)


class Facts(NamedTuple):
    """What is known at a state: vectors as arrays, single numbers as those of Python, which are quicker one by one.

    Of the rows `a` and the directions of their reactions `along`, shape (rows, n) each, the rates `w`, γ in `bias`, and
    λ in `reactions`; F₀ of frictions and switches in `limits`; of contacts `gaps`, and e in `restitutions`; values of
    `kinks` and of `pins`.
    """

    a: Floats
    along: Floats
    w: list[float]
    bias: list[float]
    limits: list[float]
    gaps: list[float]
    restitutions: list[float]
    kinks: list[float]
    pins: list[float]
    reactions: list[float]


@dataclass(frozen=True)
class ModeState:
    """A state (q, q̇) at a time, in a mode, of a problem in modes; `q` and `v` have shape (n,).

    What is small is so beside the largest place or rate, which count as `least` at least: a number each, or shape (n,).
    Gaps of `closed` times what the largest places move them by are closed.
    """

    problem: Problem
    modes: Modes
    time: float
    q: Floats
    v: Floats
    mode: Mode
    least: Least = (1.0, 1.0)
    closed: float = TOUCHING

    @once
    def row(self) -> Floats:
        """Inputs of the model's functions: shape (inputs,)."""
        return np.array([*self.q.tolist(), *self.v.tolist(), self.time, *self.parameters])

    @property
    def parameters(self) -> tuple[float, ...]:
        """The scene's own, and those of the mode."""
        of_mode = self.mode.parameters
        return (*self.problem.parameters[: -len(of_mode)], *of_mode)

    @property
    def is_finite(self) -> bool:
        """Whether places, rates, time and kinetic energy are numbers."""
        return all(map(math.isfinite, (*self.q.tolist(), *self.v.tolist(), self.time, self.kinetic)))

    @once
    def facts(self) -> Facts:
        """The rows with the flags of the mode."""
        n, modes, found = len(self.q), self.modes, self.modes.facts.at(self.row)
        vectors = found[: modes.rows * modes.facts_of_row].reshape(modes.rows, modes.facts_of_row)
        return Facts(vectors[:, :n], vectors[:, n + 2 :], *map(found.tolist().__getitem__, modes.single_facts))

    @once
    def _system(self) -> LinearSystem:
        """What the model says of the motion, of this state alone."""
        return self.problem.model.system_at(self.row)

    @once
    def mass(self) -> Floats:
        """M, shape (n, n)."""
        return self._system.mass

    @property
    def kept(self) -> tuple[Floats, Floats]:
        """A, shape (m, n), and γ, shape (m,), of the scene's constraints."""
        return self._system.rows, self._system.gamma

    def moved_by(self, forces: Floats, gamma: Floats | None = None) -> Floats:
        """x of M x = forces + Aᵀλ, A x = gamma (0 if not given): what forces, or impulses, do to q̈, or to q̇.

        `forces` and what is returned have shape (n,), `gamma` shape (m,). Rows that follow from others do so but for
        rounding, of which nothing is to be made.
        """
        count = len(self.problem.model.layout.multipliers)
        if not count:
            return _solved(self.mass, forces)
        rows = self.kept[0]
        scale = np.abs(self.mass).max() / (np.abs(rows).max() or 1.0)
        matrix = np.block([[self.mass, scale * rows.T], [scale * rows, np.zeros((count, count))]])
        right = np.concatenate([forces, np.zeros(count) if gamma is None else scale * gamma])
        nothing = None if self.problem.rank == count else SMALLEST_SCHUR_PIVOT
        return np.asarray(np.linalg.lstsq(matrix, right, rcond=nothing)[0][: len(self.q)])

    @once
    def accelerations(self) -> Floats:
        """q̈ in this mode, shape (n,)."""
        return self.moved_by(self._system.forces, self._system.gamma)

    def moved_freely_by(self, forces: Floats) -> Floats:
        """M⁻¹ forces, without the scene's constraints; both have shape (n,)."""
        return _solved(self.mass, forces)

    @once
    def free_accelerations(self) -> Floats:
        """q̈ in this mode without the scene's constraints, shape (n,)."""
        return self.moved_freely_by(self._system.forces)

    def in_one_unit(self, rows: Floats) -> Floats:
        """Rows of rates, or forces along them, of the coordinates √Mᵢᵢ qᵢ: shape (…, n) as `rows`.

        Entries for lengths and for angles then have one unit, so that their sizes say how far rows are apart.
        """
        with np.errstate(over="ignore", invalid="ignore"):  # that a motion exceeds all numbers is told elsewhere
            return np.asarray(rows / self._roots_of_mass)

    @once
    def _roots_of_mass(self) -> Floats:
        """√Mᵢᵢ, shape (n,); 1 for a coordinate without inertia."""
        diagonal = np.diagonal(self.mass)
        has_inertia = (diagonal > 0.0) & np.isfinite(diagonal)
        return np.sqrt(np.where(has_inertia, diagonal, 1.0))

    @property
    def touching(self) -> list[int]:
        """The contacts that are closed, but for rounding."""
        if not self.modes.contacts:
            return []
        first = self.modes.bounded
        return [j for j, gap in enumerate(self.facts.gaps) if gap <= self.closed * self.place_along(first + j)]

    @once
    def sizes_of_places(self) -> Floats:
        """By coordinate, what the largest place comes to in its unit: shape (n,)."""
        return np.maximum(self.shared(self.q), self.least[0])

    @once
    def sizes_of_rates(self) -> Floats:
        """By coordinate, what the largest rate comes to in its unit: shape (n,)."""
        return np.maximum(self.shared(self.v), self.least[1])

    def shared(self, values: Floats) -> Floats:
        """By coordinate, the value that has as much of inertia, Mᵢᵢ xᵢ², as the largest has: shape (n,) as `values`.

        Lengths and angles are compared so, in whatever units; equal inertias have the largest |x|.
        """
        with np.errstate(over="ignore", invalid="ignore"):
            largest = np.abs(values * self._roots_of_mass).max(initial=0.0)
        return self.in_one_unit(np.full(len(values), largest))

    def place_along(self, row: int) -> float:
        """What the largest places move the value of a row by, max |aᵢ qᵢ|."""
        return _largest(self.facts.a[row], self.sizes_of_places)

    def rate_along(self, row: int) -> float:
        """What the largest rates add to the rate w of a row, max |aᵢ q̇ᵢ|."""
        return _largest(self.facts.a[row], self.sizes_of_rates)

    @once
    def size_of_forces(self) -> float:
        """The largest |λ| or F₀."""
        return max(map(abs, filter(math.isfinite, (*self.facts.reactions, *self.facts.limits))), default=0.0)

    @once
    def watched(self) -> Floats:
        """The values that are positive as long as the mode lasts, with its offsets: shape (watched,)."""
        return self.problem.model.events.at(self.row)  # type: ignore[union-attr]

    @once
    def kinetic(self) -> float:
        """½ q̇ᵀ M q̇, up to what does not change at an impact."""
        rates, rows = self.v.tolist(), self.mass.tolist()  # numbers of Python, which overflow without a warning
        parts = (a * m * b for a, row in zip(rates, rows, strict=True) for m, b in zip(row, rates, strict=True))
        return 0.5 * float(sum(parts))

    def at(self, time: float, q: Floats, v: Floats) -> ModeState:
        """Another state in the same mode; `q` and `v` have shape (n,)."""
        return ModeState(self.problem, self.modes, time, q, v, self.mode, self.least, self.closed)

    def with_rates(self, v: Floats) -> ModeState:
        """The same place at the same time with other rates, shape (n,)."""
        return self._here(v, self.mode)

    def within(self, mode: Mode) -> ModeState:
        """The same state in another mode."""
        return self._here(self.v, mode)

    def _here(self, v: Floats, mode: Mode) -> ModeState:
        """A state at the same place and time; M depends on nothing else."""
        found = ModeState(self.problem, self.modes, self.time, self.q, v, mode, self.least, self.closed)
        if "mass" in self.__dict__:
            found.__dict__["mass"] = self.mass
        return found

    def with_flags(self, flags: tuple[float, ...]) -> ModeState:
        """The same state with other rows held."""
        return self.within(self.mode._replace(flags=flags))

    def with_rows(self, slips: Sequence[float], held: Sequence[bool]) -> ModeState:
        """The same state with these signs of what slips, and these rows held."""
        kinks, _, _, offsets = self.mode
        return self.within(Mode(kinks, tuple(slips), tuple(map(float, held)), offsets))

    def offset_by(self, offsets: tuple[float, ...]) -> ModeState:
        """The same state with other offsets of watched values."""
        kinks, slips, flags, _ = self.mode
        return self.within(Mode(kinks, slips, flags, offsets))

    def pushed(self, row: int, change: float) -> ModeState:
        """The state behind an impulse along a row that changes its rate w by so much."""
        along = self.moved_by(self.facts.a[row])
        return self.with_rates(self.v + along * (change / (self.facts.a[row] @ along)))


def in_mode_of(problem: Problem, modes: Modes, time: float, least: Least = (1.0, 1.0)) -> ModeState:
    """The state that a stretch of a motion begins with, in seconds, in the mode that its parameters tell."""
    counts = (len(modes.kinks), modes.bounded, modes.rows, modes.watched)
    left, parts = problem.parameters[len(problem.parameters) - sum(counts) :], []
    for count in counts:
        parts.append(left[:count])
        left = left[count:]
    n, state = problem.degrees, problem.state
    return ModeState(problem, modes, time, state[:n], state[n : 2 * n], Mode(*parts), least)


def _solved(mass: Floats, forces: Floats) -> Floats:
    """x of M x = forces, shape (n,); of a single coordinate by a division, as LAPACK has it with more ado."""
    if len(mass) == 1 and mass[0, 0] != 0.0:
        return np.asarray(forces / mass[0])
    return np.asarray(np.linalg.solve(mass, forces))


def _largest(row: Floats, sizes: Floats) -> float:
    """max |aᵢ| sᵢ, of shape (n,) both; of a row of zeros the largest sᵢ."""
    with np.errstate(over="ignore", invalid="ignore"):
        return float((np.abs(row) * sizes).max(initial=0.0)) or float(sizes.max(initial=0.0))

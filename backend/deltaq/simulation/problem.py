"""What is to be computed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..model.linear_system import LinearSystem
from ..model.model import Model
from ..model.reactions import HeldBy

Floats = NDArray[np.float64]

# Steps in one run; about three seconds of the most expensive method on a small scene.
STEP_LIMIT = 2_000_000


@dataclass(frozen=True)
class Moved:
    """What was added to the values and rates wanted, of each free coordinate, so that all constraints are kept.

    `undetermined` are the multipliers, and the reactions of what is released, that are not unique.
    """

    values: tuple[float, ...]
    rates: tuple[float, ...]
    undetermined: tuple[str, ...] = ()


@dataclass(frozen=True)
class Released:
    """What holds the quantities of these names: functions of what the model reads, of q̈ and λ."""

    names: tuple[str, ...]
    held_by: HeldBy


@dataclass(frozen=True)
class Problem:
    """An initial value problem: q(0), q̇(0) of the free coordinates (in their order), on [0, t_end].

    `angular` says which coordinates are angles: an angle that is wrong by a radian is wrong, however often it has
    wound around. `samples` are spread evenly over [0, t_end]. Where there are constraints, the initial values keep
    them: `rank` says how many are independent, `moved`, by how much those wanted were moved for that. Of what is
    `released` it is asked what holds it.
    """

    model: Model
    parameters: tuple[float, ...]
    values: tuple[float, ...]
    rates: tuple[float, ...]
    t_end: float
    samples: int = 501
    angular: tuple[bool, ...] = ()
    step_limit: int = STEP_LIMIT
    rank: int = 0
    moved: Moved | None = None
    released: Released | None = None

    def going_on(
        self, parameters: tuple[float, ...], values: tuple[float, ...], rates: tuple[float, ...], step_limit: int
    ) -> Problem:
        """The same problem from another state on, in another mode; `replace` would look at all the rest, too."""
        found = object.__new__(Problem)
        changed = {"parameters": parameters, "values": values, "rates": rates, "step_limit": step_limit}
        found.__dict__.update(self.__dict__, **changed)
        return found

    @property
    def is_constrained(self) -> bool:
        return bool(self.model.layout.multipliers)

    @property
    def reactions(self) -> tuple[str, ...]:
        """The names of the multipliers, then those of what is released."""
        return (*self.model.layout.multipliers, *(self.released.names if self.released else ()))

    @property
    def degrees(self) -> int:
        return self.model.layout.degrees

    @property
    def width(self) -> int:
        """The components of a state: 2n or, where power is fed in, 2n + 1."""
        return 2 * self.degrees + self.model.layout.is_powered

    @property
    def state(self) -> Floats:
        """The initial state (q, q̇ and, where power is fed in, ∫P dt): shape (width,)."""
        work = (0.0,) if self.model.layout.is_powered else ()
        return np.array([*self.values, *self.rates, *work], dtype=np.float64)

    def inputs(self, times: Floats, states: Floats) -> Floats:
        """What the model's functions read at these times and states: (q, q̇, t, parameters).

        `times` has shape (states,), `states` shape (states, ≥ 2n); returns shape (states, inputs).
        """
        parameters = np.broadcast_to(np.array(self.parameters, dtype=np.float64), (len(times), len(self.parameters)))
        return np.hstack([states[:, : 2 * self.degrees], times[:, None], parameters])

    def system(self, times: Floats, states: Floats) -> LinearSystem:
        """M q̈ = f + Aᵀλ, A q̈ = γ at these times, shape (states,), and states, shape (states, ≥ 2n)."""
        return self.model.system(self.inputs(times, states))


@dataclass(frozen=True)
class Stretch:
    """A part of a motion that goes on behind events: from `start` in seconds it is that of a problem, in its mode."""

    start: float
    problem: Problem


def numbers_of_stretches(times: Floats, stretches: tuple[Stretch, ...]) -> NDArray[np.int64]:
    """In which stretch each sample lies; of a time that stands twice, the last belongs to the one that begins then.

    `times` and what is returned have shape (samples,).
    """
    starts = np.array([each.start for each in stretches])
    before, behind = (np.searchsorted(starts, times, side=side) - 1 for side in ("left", "right"))
    follows = np.append(times[1:] == times[:-1], False)
    return np.asarray(np.maximum(np.where(follows, before, behind), 0))


def inputs_of_stretches(times: Floats, states: Floats, stretches: tuple[Stretch, ...]) -> Floats:
    """What a model's functions read at samples, each in the mode of its stretch: shape (samples, inputs).

    `times` has shape (samples,), `states` shape (samples, ≥ 2n).
    """
    parameters = np.array([each.problem.parameters for each in stretches])[numbers_of_stretches(times, stretches)]
    return np.hstack([states[:, : 2 * stretches[0].problem.degrees], times[:, None], parameters])

"""Carts on a line with springs, dry friction and buffers that keep what they catch, by SciPy from event to event.

What holds behind an event is found by trial: of all ways to hold or let go what is at rest, the one in which no
friction is larger than its limit, no buffer pulls, and what is let go leaves.
Source: Pfeiffer, Glocker, Multibody Dynamics with Unilateral Contacts, ch. 5 (uniqueness of the accelerations).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import product
from random import Random

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from tests.simulation.scenes import document

from deltaq.mechanics.document import read_scene
from deltaq.mechanics.scene import Scene

Floats = NDArray[np.float64]
AT_REST, CLOSED = 1e-9, 1e-8
MOST = 60  # events: more are rounding where several rows are at their bounds at once
MOMENT = 1e-5  # s behind an event, in which its value may still be zero
HELD, OPEN = 0, 1


class UndecidedError(Exception):
    """Events follow each other at one time: this truth cannot tell what holds."""


@dataclass(frozen=True)
class Cart:
    """A cart with a spring to `rest`, a force c + A sin ωt, and friction F on the floor (0: none)."""

    mass: float
    x: float
    v: float = 0.0
    spring: float = 0.0
    rest: float = 0.0
    force: float = 0.0
    amplitude: float = 0.0
    omega: float = 1.0
    friction: float = 0.0


@dataclass
class Train:
    """Carts in a line, and between which of them there are buffers: pairs of neighbours, −1 the wall at x = 0."""

    carts: Sequence[Cart]
    buffers: Sequence[tuple[int, int]] = ()
    modes: list[tuple[int, ...]] = field(default_factory=list)

    @property
    def scene(self) -> Scene:
        names = [f"x{i}" for i in range(len(self.carts))]
        springs = [f"{c.spring!r}*({x} - ({c.rest!r}))^2/2" for x, c in zip(names, self.carts, strict=True) if c.spring]
        loads: list[dict[str, object]] = [
            {"kind": "potential", "name": "springs", "energy": " + ".join(springs) or "0"}
        ]
        for x, cart in zip(names, self.carts, strict=True):
            pull = f"{cart.force!r} + {cart.amplitude!r}*sin({cart.omega!r}*t)"
            loads.append({"kind": "force", "name": f"F{x}", "at": f"b{x}", "force": [pull, "0"]})
            if cart.friction:
                loads.append({"kind": "friction", "name": f"R{x}", "coordinate": x, "force": repr(cart.friction)})
        found = document(
            {x: (cart.x, cart.v) for x, cart in zip(names, self.carts, strict=True)},
            {},
            {f"b{x}": (repr(cart.mass), [x, "0"]) for x, cart in zip(names, self.carts, strict=True)},
            loads,
        )
        gaps = [names[j] if i < 0 else f"{names[j]} - {names[i]}" for i, j in self.buffers]
        events = [{"name": f"c{k}", "value": gap, "then": "bounce", "restitution": "0"} for k, gap in enumerate(gaps)]
        return read_scene(found | {"events": events})

    @property
    def mass(self) -> Floats:
        return np.array([cart.mass for cart in self.carts])

    @property
    def rows(self) -> Floats:
        """What is at rest, or is not, of frictions and then of buffers."""
        each = np.eye(len(self.carts))
        frictions = [each[i] for i, cart in enumerate(self.carts) if cart.friction]
        return np.array([*frictions, *(each[j] - (each[i] if i >= 0 else 0.0) for i, j in self.buffers)])

    @property
    def limits(self) -> list[float]:
        return [cart.friction for cart in self.carts if cart.friction]

    def _pulls(self, t: float, x: Floats) -> Floats:
        """Forces without frictions and buffers."""
        return np.array([
            c.force + c.amplitude * np.sin(c.omega * t) - c.spring * (place - c.rest)
            for c, place in zip(self.carts, x, strict=True)
        ])  # fmt: skip

    def solved(self, t: float, x: Floats, mode: Sequence[int]) -> tuple[Floats, Floats]:
        """ẍ, and λ of all rows: of those held what holds them."""
        rows, mass = self.rows, self.mass
        forces = self._pulls(t, x)
        for k, limit in enumerate(self.limits):
            forces = forces - mode[k] * limit * rows[k]
        held = [k for k, each in enumerate(mode) if each == HELD]
        reactions = np.zeros(len(rows))
        if held:
            a = rows[held]
            reactions[held] = np.linalg.solve(a @ (a / mass).T, -a @ (forces / mass))
            forces = forces + a.T @ reactions[held]
        return forces / mass, reactions

    def _mode(self, t: float, x: Floats, v: Floats, forced: tuple[int, int] | None) -> tuple[int, ...]:
        rows, limits = self.rows, self.limits
        w, gaps = rows @ v, rows @ x
        ways: list[tuple[int, ...]] = []
        for k in range(len(rows)):
            is_buffer = k >= len(limits)
            if forced is not None and forced[0] == k:
                ways.append((forced[1],))
            elif abs(w[k]) < AT_REST and (not is_buffer or gaps[k] < CLOSED):
                ways.append((HELD, OPEN) if is_buffer else (HELD, 1, -1))
            else:
                ways.append((OPEN,) if is_buffer else (int(np.sign(w[k])),))
        found = []
        for mode in product(*ways):
            held = [k for k, each in enumerate(mode) if each == HELD]
            if held and np.linalg.matrix_rank(rows[held]) < len(held):
                continue
            accelerations, reactions = self.solved(t, x, mode)
            margins = [0.0]
            for k, each in enumerate(mode):
                if len(ways[k]) > 1:
                    is_held = reactions[k] if k >= len(limits) else limits[min(k, len(limits) - 1)] - abs(reactions[k])
                    margins.append(is_held if each == HELD else each * float(rows[k] @ accelerations))
            found.append((min(margins), mode))
        return max(found)[1]

    def along(self, times: Floats) -> Floats:
        """x at these times, shape (samples, carts); `modes` tells what held, one after the other."""
        n, t = len(self.carts), 0.0
        x, v = np.array([c.x for c in self.carts]), np.array([c.v for c in self.carts])
        just: list[int] = []
        mode, found = self._mode(t, x, v, None), [x]
        left = list(times[1:])
        self.modes[:] = [mode]
        while left:
            if len(self.modes) > MOST:
                raise UndecidedError
            values = list(self._watched(mode, t, just))
            span = (t, float(times[-1]))
            run = solve_ivp(
                lambda s, y, mode=mode: np.concatenate([y[n:], self.solved(s, y[:n], mode)[0]]), span, [*x, *v],
                method="DOP853", rtol=1e-13, atol=1e-14, max_step=0.02, dense_output=True,
                events=[each for _, each in values] or None,
            )  # fmt: skip
            while left and left[0] <= run.t[-1]:
                found.append(run.sol(left.pop(0))[:n])
            if run.status != 1:
                break
            row = next(k for (k, _), happened in zip(values, run.t_events, strict=True) if len(happened))
            t, x, v = float(run.t[-1]), run.y[:n, -1], run.y[n:, -1]
            was_held, forced = mode[row] == HELD, None
            if was_held:
                is_buffer = row >= len(self.limits)
                forced = (row, OPEN if is_buffer else -int(np.sign(self.solved(t, x, mode)[1][row])))
            v = self._caught(x, v)
            mode = self._mode(t, x, v, forced)
            just = [row, *(k for k, gap in enumerate(self.rows @ x) if k >= len(self.limits) and gap < CLOSED)]
            self.modes.append(mode)
        return np.array(found)

    def stepped(self, times: Floats, steps: int) -> Floats:
        """The same to first order, where more rows hold than are needed: impulses of each step by Gauss–Seidel.

        Source: Moreau, Unilateral contact and dry friction in finite freedom dynamics (1988).
        """
        rows, limits, mass = self.rows, self.limits, self.mass
        h, found = float(times[-1]) / steps, []
        x, v = np.array([c.x for c in self.carts]), np.array([c.v for c in self.carts])
        flexibility, impulses = (rows / mass) @ rows.T, np.zeros(len(rows))
        most = h * np.array([*limits, *[np.inf] * len(self.buffers)])
        least = np.array([*(-h * f for f in limits), *[0.0] * len(self.buffers)])
        for k in range(steps):
            found.append(x)
            middle = x + 0.5 * h * v
            v = v + h * self._pulls((k + 0.5) * h, middle) / mass
            acts = [j for j in range(len(rows)) if j < len(limits) or rows[j] @ middle <= 0.0]
            impulses[[j for j in range(len(rows)) if j not in acts]] = 0.0
            rates = rows @ v + flexibility @ impulses
            for _ in range(500):
                before = impulses.copy()
                for j in acts:
                    wanted = impulses[j] - rates[j] / flexibility[j, j]
                    change = min(max(wanted, least[j]), most[j]) - impulses[j]
                    impulses[j] += change
                    rates = rates + flexibility[:, j] * change
                if np.abs(impulses - before).max() < 1e-12:
                    break
            v = v + (rows / mass).T @ impulses
            x = middle + 0.5 * h * v
        found.append(x)
        grid = np.linspace(0.0, float(times[-1]), steps + 1)
        return np.array([np.interp(times, grid, each) for each in np.array(found).T]).T

    def _watched(
        self, mode: Sequence[int], t: float, just: Sequence[int]
    ) -> Iterator[tuple[int, Callable[..., float]]]:
        """By row, the values that are positive as long as the mode lasts."""
        rows, limits, n = self.rows, self.limits, len(self.carts)

        def ends(value: Callable[[float, Floats], float], row: int, until: float) -> tuple[int, Callable[..., float]]:
            def watched(s: float, y: Floats) -> float:
                return 1e-3 if s < until else float(value(s, y))

            watched.terminal, watched.direction = True, -1  # type: ignore[attr-defined]
            return row, watched

        for k, each in enumerate(mode):
            until = t + MOMENT if k in just and each != HELD else -1.0
            if each == HELD:
                for side in (1, -1) if k < len(limits) else (-1,):
                    limit = limits[k] if k < len(limits) else 0.0
                    yield ends(lambda s, y, k=k, f=limit, i=side: f - i * self.solved(s, y[:n], mode)[1][k], k, until)
            elif k >= len(limits):
                yield ends(lambda s, y, k=k: rows[k] @ y[:n], k, until)
            else:
                yield ends(lambda s, y, k=k, i=each: i * (rows[k] @ y[n:]), k, until)

    def _caught(self, x: Floats, v: Floats) -> Floats:
        """v behind impacts without rebound, and without what rounding left of a rate."""
        rows, mass = self.rows, self.mass
        closed = [k for k in range(len(self.limits), len(rows)) if rows[k] @ x < CLOSED]
        best = (-np.inf, v)
        for kept in product((False, True), repeat=len(closed)):
            a = rows[[k for k, each in zip(closed, kept, strict=True) if each]]
            impulses = np.linalg.solve(a @ (a / mass).T, -a @ v) if len(a) else np.zeros(0)
            after = v + (a / mass).T @ impulses if len(a) else v
            best = max(best, (min([0.0, *impulses, *(rows[closed] @ after)]), after), key=lambda pair: pair[0])
        v = best[1]
        for row in (each for each in rows for _ in range(3)):
            if abs(row @ v) < AT_REST:
                v = v - row / mass * (row @ v) / (row @ (row / mass))
        return v


def drawn(random: Random) -> Train:
    """Two to four carts, some of them touching at first."""
    count, touches = random.choice([2, 2, 3, 3, 4]), random.random() < 0.3
    places = [0.5] * count if touches else sorted(random.uniform(0.1, 2.0) for _ in range(count))
    carts = [
        Cart(
            mass=random.uniform(0.3, 3.0),
            x=x,
            v=0.0 if touches or random.random() < 0.3 else random.uniform(-2.0, 2.0),
            spring=random.choice([0.0, random.uniform(1.0, 30.0)]),
            rest=random.uniform(-0.5, 2.2),
            force=random.choice([0.0, random.uniform(-4.0, 4.0)]),
            amplitude=random.choice([0.0, random.uniform(0.0, 6.0)]),
            omega=random.uniform(0.5, 5.0),
            friction=random.choice([0.0, random.uniform(0.1, 2.0)]),
        )
        for x in places
    ]
    pairs = [(i - 1, i) for i in range(count) if random.random() < 0.8]
    return Train(carts, pairs or [(0, 1)])

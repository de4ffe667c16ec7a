"""Random scenes with constraints and contacts: particles on rods, tracks and turning lines, before walls.

As a command, `python -m tests.derivation.bound_scenes 100 1`, it tries so many of them from a seed on: each is derived
with every step verified, its equilibria are at rest by SymPy's LagrangesMethod, its impacts are those of a linear
system solved in numbers, and the right answers to its tasks are judged right.
"""

from __future__ import annotations

import random
import sys
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import sympy as sp
from tests.derivation.peer import Peer, T
from tests.derivation.random_scenes import Maker, not_right

from deltaq.derivation.bound_equilibria import searched
from deltaq.derivation.engine import derive
from deltaq.derivation.impacts import Impact, bouncing, impact
from deltaq.derivation.system import System
from deltaq.homework.service import tasks_request
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene

Document = dict[str, Any]
Numbers = dict[str, float]
ASKED = ("equilibria", "stability", "rest-reaction", "impulse", "momentum-behind", "impact-loss", "constraint-force")
CLOSE = 1e-9


def bound_scene(seed: int) -> Scene:
    """One particle or two, each on a constraint of its own, with loads and contacts."""
    maker = Maker(random.Random(f"bound {seed}"))
    draw, constraints = maker.draw, []
    for k in range(draw.choice((1, 1, 2))):
        place = [maker.coordinate("x"), maker.coordinate("y")]
        body = {"name": f"body{k}", "kind": "particle", "mass": maker.constant("m"), "position": place}
        maker.bodies.append(body)
        constraints.append(_constraint(maker, k))
    maker.loads.append({"kind": "gravity", "acceleration": ["0", f"-{maker.constant('g', 5, 10)}"]})
    for _ in range(draw.choice((0, 1))):
        q = draw.choice(maker.coordinates)["name"]
        maker.loads.append({"kind": "potential", "energy": f"{maker.constant('k')}*{q}^2/2"})
    maker.parameters.append({"name": "e", "value": round(draw.uniform(0.2, 0.9), 2), "positive": False})
    events = [_contact(maker, k) for k in range(draw.choice((1, 2)))]
    return read_scene(
        {
            "id": "bound",
            "coordinates": maker.coordinates,
            "parameters": maker.parameters,
            "points": [{"name": "origin", "position": ["0", "0"]}],
            "bodies": maker.bodies,
            "loads": [{**load, "name": f"load{i}"} for i, load in enumerate(maker.loads)],
            "constraints": constraints,
            "events": events,
        }
    )


def _constraint(maker: Maker, k: int) -> Document:
    """A rod from the origin or the body before, or an equation."""
    (x, y), name = maker.bodies[k]["position"], f"bound{k}"
    before = maker.bodies[k - 1]["name"] if k else "origin"
    if maker.draw.random() < 0.4:
        return {"kind": "distance", "name": name, "from": before, "to": f"body{k}", "length": maker.constant("l", 0.8)}
    a = maker.constant("a")
    texts = (f"{x}^2 + {y}^2 = {a}^2", f"{y} = {a}*{x}^2", f"{y} = {a}*{x}", f"{y}*cos({a}*t) = {x}*sin({a}*t)")
    return {"kind": "equation", "name": name, "equation": maker.draw.choice(texts)}


def _contact(maker: Maker, k: int) -> Document:
    """A wall at rest or one that moves, or a slope."""
    x, y = maker.draw.choice(maker.bodies)["position"]
    far = maker.constant("w", 3.0, 6.0)
    walls = (f"{x} + {far}", f"{far} - {y}", f"{y} + {far} - {maker.constant('b')}*sin({far}*t)", f"{x} - {y} + {far}")
    return {"name": f"wall{k}", "value": maker.draw.choice(walls), "then": "bounce", "restitution": "e"}


def faults(scene: Scene) -> list[str]:
    """What is wrong with the derivation and the tasks of a scene; nothing, if all is well."""
    system, derivation = derive(scene)
    peer = Laws(scene)
    found = [f"unverified {step.id}" for step in derivation.steps() if not step.verified]
    found += [f"not at rest: {place}" for place in _moving(system, peer)]
    for event in bouncing(system):
        known = impact(system, event)
        found += [] if known is None else [f"{event.name}: {gap}" for gap in _wrong_impact(peer, event, known)]
    asked = {"scene": write_scene(scene)}
    tasks: Any = tasks_request(asked)["tasks"]
    for task in tasks:
        if task["kind"] in ASKED:
            found += [f"task {task['id']}: {told}" for told in not_right(asked | {"task": task["id"]}, task["form"])]
    return found


class Laws:
    """The equations and constraints of a scene by SymPy, and M, A and b as functions of numbers."""

    def __init__(self, scene: Scene) -> None:
        peer = Peer(scene)
        self.scene, self.free = scene, [c.name for c in scene.free]
        self.equations = peer.equations()
        self.q, self.v, self.a = (
            [sp.Symbol(form.format(q)) for q in self.free] for form in ("{}", "dot({})", "ddot({})")
        )
        self.values = {p.name: p.value for p in scene.parameters}
        self.gaps = [self._plain(peer, peer.read(condition.value)) for condition in scene.conditions]
        self.contacts = {
            event.name: self._plain(peer, peer.read(event.value.tree)) for event in scene.events if event.bounces
        }

    def _plain(self, peer: Peer, value: Any) -> Any:
        return value.subs({f: sp.Symbol(name) for name, f in peer.q.items()}).subs(T, sp.Symbol("t"))

    def row(self, gap: Any) -> tuple[list[Any], Any]:
        """∂g/∂q and ∂g/∂t"""
        return [gap.diff(q) for q in self.q], gap.diff(sp.Symbol("t"))

    def at(self, state: Numbers) -> Callable[[Any], Any]:
        """The values of expressions, or arrays of them, at a state."""

        def number(value: Any) -> Any:
            if isinstance(value, list):
                return np.array([number(each) for each in value], dtype=float)
            known = {s: state[s.name] for s in sp.sympify(value).free_symbols}
            return float(sp.sympify(value).subs(known).evalf())

        return number


def _moving(system: System, laws: Laws) -> Iterator[str]:
    """Equilibria that do not keep the constraints, or at which something is left of the equations of motion."""
    known = searched(system)
    for each in known.found if known else ():
        there = {symbol.name: value for symbol, value in {**each.values, **each.reactions}.items()}
        values = {s.name: value for s, value in system.parameter_values.items()}
        rest = dict.fromkeys((s.name for s in (*laws.v, *laws.a)), 0)
        start = {c.name: sp.Float(c.value) for c in laws.scene.free}
        for law in (*laws.equations, *laws.gaps):
            point = {s: (rest | start | there | {"t": 0}).get(s.name, values.get(s.name)) for s in law.free_symbols}
            left = sp.N(law.subs(point).subs({s: values.get(s.name) for s in law.subs(point).free_symbols}), 20)
            if abs(left) > CLOSE:
                yield f"{each.values} leaves {left}"


def _wrong_impact(laws: Laws, event: Any, found: Impact) -> Iterator[str]:
    """What of Δq̇, Λ and the loss is not that of [M −Aᵀ −wᵀ; A 0 0; w 0 0] solved in numbers."""
    state = _state(laws)
    if state is None:
        return
    number, n, m = laws.at(state), len(laws.free), len(laws.gaps)
    mass = np.array([[number(law.diff(a)) for a in laws.a] for law in laws.equations])
    rows, drifts = zip(*(laws.row(gap) for gap in (*laws.gaps, laws.contacts[event.name])), strict=True)
    table, drift = number([list(row) for row in rows]), number(list(drifts))
    before = np.array([state[v.name] for v in laws.v])
    matrix = np.block([[mass, -table.T], [table, np.zeros((m + 1, m + 1))]])
    right = np.zeros(n + m + 1)
    right[-1] = -(1.0 + state["e"]) * (table[-1] @ before + drift[-1])
    if abs(np.linalg.det(matrix)) < 1e-6:
        return
    jumps = np.linalg.solve(matrix, right)
    after = before + jumps[:n]
    told = {**{f"rate {q}": found.rates.get(q, 0) for q in laws.free}, "impulse": found.impulse, "loss": found.loss}
    true = [*jumps[:n], jumps[-1], 0.5 * (before @ mass @ before - after @ mass @ after)]
    for (name, value), wanted in zip(told.items(), true, strict=True):
        own = number(value)
        if abs(own - wanted) > CLOSE * max(1.0, abs(wanted)):
            yield f"{name}: {own} for {wanted}"


def _state(laws: Laws) -> Numbers | None:
    """A state that keeps the constraints; None where Newton's method finds none."""
    source = random.Random(3)
    state = {**laws.values, "t": 0.37, **{q: c.value for q, c in zip(laws.free, laws.scene.free, strict=True)}}
    for _ in range(40):
        number = laws.at(state)
        gaps, rows = number(laws.gaps), number([list(laws.row(gap)[0]) for gap in laws.gaps])
        if np.abs(gaps).max() < 1e-13:
            break
        change = np.linalg.lstsq(rows, gaps, rcond=None)[0]
        state |= {q: state[q] - step for q, step in zip(laws.free, change, strict=True)}
    else:
        return None
    drift = number([laws.row(gap)[1] for gap in laws.gaps])
    wanted = np.array([source.uniform(-1.0, 1.0) for _ in laws.free])
    kept = wanted - np.linalg.lstsq(rows, rows @ wanted + drift, rcond=None)[0]
    return state | {v.name: float(rate) for v, rate in zip(laws.v, kept, strict=True)}


def main(count: int, seed: int) -> None:
    """Tries scenes and reports."""
    sound = 0
    for k in range(seed, seed + count):
        try:
            wrong = faults(bound_scene(k))
        except Exception as error:  # noqa: BLE001 - whatever it is, it is told
            wrong = [f"{type(error).__name__} {error}"]
        sound += not wrong
        for each in wrong[:3]:
            print(k, each[:300], flush=True)
    print(f"{sound} of {count} sound, seeds {seed}…{seed + count - 1}")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:3]))

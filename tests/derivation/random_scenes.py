"""Random scenes that are valid: bodies, guides and loads with roots, poles, kinks and drags, in many coordinates.

As a command, `python -m tests.derivation.random_scenes 2000 1`, it tries so many of them from a seed on: each is
derived with every step verified, its equations are those of SymPy's LagrangesMethod, its equilibria are at rest, it
moves, and the right answers to its tasks are judged right.
"""

from __future__ import annotations

import random
import sys
import time
import traceback
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, cast

import sympy as sp
from flint import ctx
from tests.derivation.peer import Peer

from deltaq.derivation.engine import derive
from deltaq.derivation.equilibria import search
from deltaq.derivation.linearization import numeric_point
from deltaq.derivation.matrix_form import forces_at_rest
from deltaq.derivation.program import number
from deltaq.derivation.result import result_of
from deltaq.derivation.system import System
from deltaq.homework.service import check_request, solution_request, tasks_request
from deltaq.language.bounds import MAX_CHARACTERS
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene
from deltaq.narration.catalog import LANGUAGES
from deltaq.narration.derive import narrator_of
from deltaq.simulation.service import run

Document = dict[str, Any]
DIGITS = 25
FOR_TASKS = 2.0  # seconds
ASKED_FIRST = ("equilibria", "stability", "symmetry", "steady-motion")


@dataclass
class Maker:
    """Draws a scene; every constant has a name of its own, so that its unit fits wherever it stands."""

    draw: random.Random
    space: bool = False
    coordinates: list[Document] = field(default_factory=list)
    parameters: list[Document] = field(default_factory=list)
    bodies: list[Document] = field(default_factory=list)
    loads: list[Document] = field(default_factory=list)
    guides: list[Document] = field(default_factory=list)

    def constant(self, letter: str, low: float = 0.3, high: float = 2.5) -> str:
        name = f"{letter}{len(self.parameters)}"
        self.parameters.append({"name": name, "value": round(self.draw.uniform(low, high), 2)})
        return name

    def coordinate(self, letter: str) -> str:
        name = f"{letter}{len(self.coordinates)}"
        value, rate = round(self.draw.uniform(0.2, 1.2), 2), round(self.draw.uniform(-0.5, 0.5), 2)
        self.coordinates.append({"name": name, "value": value, "rate": rate})
        return name

    def document(self) -> Document:
        for index in range(self.draw.choice((1, 1, 1, 2, 2))):
            self.body(index)
        for _ in range(self.draw.randint(1, 3)):
            self.load()
        return {
            "id": "random",
            "dimension": 3 if self.space else 2,
            "coordinates": self.coordinates,
            "parameters": self.parameters,
            "points": [{"name": "origin", "position": ["0"] * (3 if self.space else 2)}],
            "bodies": self.bodies,
            "loads": [{**load, "name": f"load{i}"} for i, load in enumerate(self.loads)],
            "guides": self.guides,
        }

    def body(self, index: int) -> None:
        place = self.in_space() if self.space else self.in_the_plane()
        if index and self.draw.random() < 0.4:  # it hangs on the one before
            place = [f"{a} + {b}" for a, b in zip(self.bodies[-1]["position"], place, strict=True)]
        body: Document = {"name": f"body{index}", "kind": "particle", "mass": self.constant("m"), "position": place}
        if not self.space and self.draw.random() < 0.25:
            angle = self.turning()
            body |= {"kind": "rigid", "inertia": self.constant("J"), "angle": angle}
        self.bodies.append(body)

    def turning(self) -> str:
        """An angle of its own, or one that a coordinate makes."""
        known = [each["name"] for each in self.coordinates if each["name"].startswith("phi")]
        return known[0] if known else self.coordinate("phi")

    def in_the_plane(self) -> list[str]:
        kinds = (self.line, self.plane, self.pendulum, self.polar, self.sliding, self.curve, self.guided, self.turned)
        return self.draw.choice(kinds)()

    def line(self) -> list[str]:
        return [self.coordinate("x"), "0"]

    def plane(self) -> list[str]:
        return [self.coordinate("x"), self.coordinate("y")]

    def pendulum(self) -> list[str]:
        return self.arm(self.coordinate("phi"))

    def polar(self) -> list[str]:
        r, phi = self.coordinate("r"), self.coordinate("phi")
        return [f"{r}*sin({phi})", f"-{r}*cos({phi})"]

    def sliding(self) -> list[str]:
        x = self.coordinate("x")
        across, down = self.pendulum()
        return [f"{x} + {across}", down]

    def curve(self) -> list[str]:
        x, a = self.coordinate("x"), self.constant("a")
        return [x, self.draw.choice((f"{a}*{x}^2", f"{a}*cosh({x}/{a})", f"{a}*sin({x}/{a})"))]

    def turned(self) -> list[str]:
        r, w = self.coordinate("r"), self.constant("w")
        return [f"{r}*cos({w}*t)", f"{r}*sin({w}*t)"]

    def arm(self, angle: str) -> list[str]:
        l = self.constant("l")
        return [f"{l}*sin({angle})", f"-{l}*cos({angle})"]

    def guided(self) -> list[str]:
        y, b, w = self.coordinate("y"), self.constant("b"), self.constant("w")
        self.guides.append({"coordinate": y, "value": f"{b}*sin({w}*t)"})
        across, down = self.arm(self.coordinate("phi"))
        return [across, f"{y} {down}"]

    def in_space(self) -> list[str]:
        if self.draw.random() < 0.5:
            return [self.coordinate(letter) for letter in "xyz"]
        theta, psi, l = self.coordinate("theta"), self.coordinate("psi"), self.constant("l")
        return [f"{l}*sin({theta})*cos({psi})", f"{l}*sin({theta})*sin({psi})", f"-{l}*cos({theta})"]

    def load(self) -> None:
        free = [c["name"] for c in self.coordinates if c["name"] not in {g["coordinate"] for g in self.guides}]
        q = self.draw.choice(free)
        body = self.draw.choice(self.bodies)["name"]
        zeros = ["0"] * (1 if not self.space else 2)
        k, s = self.constant("k"), self.constant("s")
        lengths = [name for name in free if name[0] in "xyzr"]
        made: list[Document] = [
            {"kind": "gravity", "acceleration": [*zeros, f"-{self.constant('g', 5, 10)}"]},
            {"kind": "potential", "energy": f"{k}*{q}^2/2"},
            {"kind": "potential", "energy": f"-{k}*{q}^2/2 + {self.constant('b')}*{q}^4/4"},
            {"kind": "dissipation", "function": f"{k}*dot({q})^2/2"},
            {"kind": "moment", "angle": q, "moment": f"-{k}*sign(dot({q}))"},
            {"kind": "moment", "angle": q, "moment": f"-{k}*abs(dot({q}))*dot({q})"},
            {"kind": "moment", "angle": q, "moment": f"-{k}*abs({q})*{q}"},
            {"kind": "moment", "angle": q, "moment": f"{k}*sin({self.constant('w')}*t)"},
            {"kind": "spring", "from": "origin", "to": body, "stiffness": k, "rest_length": s},
            {"kind": "damper", "from": "origin", "to": body, "coefficient": k},
            {"kind": "force", "at": body, "force": self.drag(body, k)},
        ]
        if lengths:
            x = self.draw.choice(lengths)
            made += [
                {"kind": "potential", "energy": f"-{k}/sqrt({x}^2 + {s}^2)"},
                {"kind": "potential", "energy": f"{k}/{x} - {self.constant('c')}/{x}^2"},
                {"kind": "potential", "energy": f"{k}*(1 - exp(-{x}/{s}))^2"},
                {"kind": "potential", "energy": f"-{k}*cos({x}/{s})"},
                {"kind": "potential", "energy": f"{k}*(sqrt({x}^2 + {s}^2) - {self.constant('b')})^2"},
            ]
        if len(lengths) > 1:
            x, y = self.draw.sample(lengths, 2)
            made += [
                {"kind": "potential", "energy": f"{k}*({x} - {y})^2/2"},
                {"kind": "potential", "energy": f"-{k}/sqrt({x}^2 + {y}^2)"},
                {"kind": "potential", "energy": f"{k}*{x}^2*{y}^2"},
            ]
        self.loads.append(self.draw.choice(made))

    def drag(self, body: str, k: str) -> list[str]:
        """−k |v| v of a body's own velocity where its position is one of coordinates, else of a coordinate's rate."""
        place = next(each["position"] for each in self.bodies if each["name"] == body)
        own = [each for each in place if any(each == c["name"] for c in self.coordinates)]
        guided = {guide["coordinate"] for guide in self.guides}
        if not own or guided & set(own):
            return [f"-{k}", *["0"] * (len(place) - 1)]
        size = "sqrt(" + " + ".join(f"dot({q})^2" for q in own) + ")"
        return [f"-{k}*{size}*dot({each})" if each in own else "0" for each in place]


def random_scene(seed: int) -> Scene:
    """The scene of a seed. Only constants that it uses are in it."""
    draw = random.Random(seed)
    document = Maker(draw, draw.random() < 0.25).document()
    used = repr([document["bodies"], document["loads"], document["guides"]])
    names = set(_names(used))
    document["parameters"] = [each for each in document["parameters"] if each["name"] in names]
    return read_scene(document)


def _names(text: str) -> list[str]:
    return "".join(c if c.isalnum() else " " for c in text).split()


def faults(scene: Scene) -> list[str]:
    """What is wrong with a derivation and a motion of the scene; nothing, if all is well."""
    system, derivation = derive(scene)
    found = [f"unverified {step.id}" for step in derivation.steps() if not step.verified]
    for language in LANGUAGES:
        narrator_of(system, language).chapters(derivation)
    result = result_of(system)
    found += [f"equation {gap}" for gap in wrong_equations(scene, list(result.equations.values()))]
    found += [f"not at rest: {place}" for place in moving(system)]
    answer = run({"scene": write_scene(scene), "t_end": 0.5, "samples": 5})
    if answer["status"] not in STATUSES:
        found.append(f"status {answer['status']}")
    return found + wrong_tasks(scene)


def wrong_tasks(scene: Scene, seconds: float = FOR_TASKS) -> list[str]:
    """The tasks whose own right answer is not judged right, as text and as LaTeX, as far as time allows."""
    asked = {"scene": write_scene(scene)}
    tasks = tasks_request(asked)["tasks"]
    end = time.process_time() + seconds
    found = []
    for task in sorted(cast("list[Document]", tasks), key=lambda task: task["kind"] not in ASKED_FIRST):
        if time.process_time() > end:
            break
        found += [f"task {task['id']}: {told}" for told in not_right(asked | {"task": task["id"]}, task["form"])]
    return found


def not_right(asked: Document, form: str) -> list[str]:
    """What is said of the right answer handed back, where it is not that it is right."""
    found = []
    for syntax, parts in solution_request(asked).items():
        value = written(cast("Sequence[str]", parts), form, syntax)
        if len(value) <= MAX_CHARACTERS:
            verdict = check_request(asked | {"answer": {"syntax": syntax, "value": value}})
            codes = {problem["code"] for problem in cast("list[Document]", verdict["problems"])}
            fine = verdict["outcome"] == "correct" or "too-many-nodes" in codes  # so long is no answer of a student
            found += [] if fine else [f"{syntax} {verdict['outcome']} {value}"]
    return found


def written(parts: Sequence[str], form: str, syntax: str) -> str:
    """The parts of an answer as one writes them."""
    if form == "vector" and syntax == "latex":
        return r"\begin{bmatrix}" + r"\\".join(parts) + r"\end{bmatrix}"
    return f"[{', '.join(parts)}]" if form == "vector" else "; ".join(parts)


STATUSES = (
    "ok",
    "stopped",
    "diverged",
    "singular_mass_matrix",
    "singular",
    "unresolved",
    "step_limit",
    "horizon_reached",
    "stiff",
    "tolerance_missed",
)


def wrong_equations(scene: Scene, ours: list[sp.Expr]) -> list[str]:
    """The equations that differ from SymPy's at random points."""
    theirs = Peer(scene).equations()
    names = sorted({symbol.name for equation in (*ours, *theirs) for symbol in equation.free_symbols})
    source = random.Random(7)
    wrong = []
    for _ in range(2):
        point = {name: sp.Float(source.uniform(0.3, 1.2), 30) for name in names}
        values = [[_value(each, point) for each in side] for side in (ours, theirs)]
        wrong += [f"{a} for {b}" for a, b in zip(*values, strict=True) if abs(a - b) > 1e-15 * (1 + abs(b))]
    return wrong


def _value(expression: sp.Expr, point: dict[str, sp.Float]) -> complex:
    known = expression.xreplace({symbol: point[symbol.name] for symbol in expression.free_symbols})
    return complex(sp.N(known.doit(), DIGITS))


def moving(system: System) -> list[str]:
    """Equilibria at which a force acts."""
    known = search(system)
    gone = []
    with ctx.workprec(256):
        for each in known.found if known else ():
            point = numeric_point(system, each)
            forces = [number(force, point) for force in forces_at_rest(system)]
            if not all(bool(abs(force) < 1e-30) for force in forces):
                gone.append(str(dict(each.values)))
    return gone


def main(count: int, seed: int) -> None:
    """Tries scenes and reports."""
    outcomes: Counter[str] = Counter()
    times: list[float] = []
    for k in range(seed, seed + count):
        start = time.process_time()
        try:
            wrong = faults(random_scene(k))
        except Exception as error:  # noqa: BLE001 - whatever it is, it is told
            wrong = [f"{type(error).__name__} {error} at {traceback.extract_tb(error.__traceback__)[-1]}"]
        times.append(time.process_time() - start)
        outcomes["faulty" if wrong else "sound"] += 1
        for each in wrong[:2]:
            print(k, each[:300], flush=True)
        if len(times) % 50 == 0:
            print(f"{len(times)} scenes", dict(outcomes), flush=True)
        if times[-1] > SLOW:
            print(k, f"slow: {times[-1]:.1f} s", flush=True)
    print(
        dict(outcomes),
        f"seeds {seed}…{seed + count - 1}",
        f"median {sorted(times)[len(times) // 2]:.2f} s, most {max(times):.1f} s",
    )


SLOW = 6.0


if __name__ == "__main__":
    main(*map(int, sys.argv[1:3]))

"""Requests to every call with numbers that are as large, as small or as odd as numbers may be.

Run it for long from the checkout: `python -m tests.api.extreme_numbers [count]`. Loopback only; it ends with 1 if the
service made a mistake: any status from 500 on that does not say that it is busy, or that the question is too large.
"""

from __future__ import annotations

import asyncio
import random
import sys
from collections import Counter
from collections.abc import Iterator
from copy import deepcopy
from typing import Any

import httpx
from tests.serving import served

from deltaq.contract.document import EXAMPLE
from deltaq.lab.library import experiment_ids
from deltaq.mechanics.library import load_scene
from deltaq.mechanics.writing import write_scene

Json = dict[str, Any]
Request = tuple[str, Json]

SCENES = ("pendulum", "elastic-pendulum", "double-pendulum", "base-pendulum", "quarter-car", "two-mass-oscillator")
CONSTRAINED = ("cartesian-pendulum", "four-bar", "slider-crank", "chaplygin-sleigh", "catching-pendulum")
JUMPING = ("bouncing-ball", "stick-slip", "string-pendulum")
MAGNITUDES = (5e-324, 2.3e-308, 1e-200, 1e-155, 1e-16, 1e16, 1e77, 1e153, 1e154, 1e155, 1e200, 1e300, 1.7e308)
WHOLE = (0, -1, 2**31, 2**53 + 1, 2**63, 2**64, -(2**63) - 1, 10**300, 10**308, 10**309, 10**399)
METHODS = ("auto", "rk4", "explicit-euler", "dop853", "radau-5", "stormer-verlet", "gauss-4", "newmark")
FORMS = ("latex", "markdown", "python")
EXPERIMENTS = experiment_ids()
BUSY = {503, 504}
QUICK = {"simulation_deadline": 2, "derivation_deadline": 2, "experiment_deadline": 2, "queue_patience": 60}


class Draw(random.Random):
    """Draws numbers, and requests that hold them."""

    def number(self) -> float:
        """Any finite number, most of them at an end of their range; whole ones may be larger than the others can be."""
        kind = self.random()
        if kind < 0.5:
            return self.sign() * self.choice(MAGNITUDES)
        if kind < 0.54:
            return self.choice(WHOLE)
        return self.sign() * self.uniform(1.0, 9.99) * 10.0 ** self.randint(-320, 307)

    def sign(self) -> int:
        """Mostly +: a negative mass is soon refused."""
        return -1 if self.random() < 0.1 else 1

    def often(self, usual: float) -> float:
        """Mostly an ordinary number: where all are odd, the first that is refused hides the others."""
        return usual if self.random() < 0.8 else self.number()

    def constant(self) -> str:
        """A number as expressions may have it."""
        mantissa, exponent = (
            self.choice(("1", "9.99", "0.000001", "123456789012345678901234567890")),
            self.choice((0, 9, 30)),
        )
        power = self.choice(("", "^64", "^(-64)", "^64*10^64", "^(-64)/10^64"))
        return f"({mantissa}*10^{exponent}){power}"

    def changes(self, scene: str) -> Json:
        """A scene with values of its own."""
        document = write_scene(load_scene(scene))
        names = [one["name"] for one in document["parameters"]]
        chosen = self.sample(names, min(len(names), self.choice((0, 1, 1, 1, 2, 3))))
        asked: Json = {"scene": scene, "parameters": {name: self.number() for name in chosen}}
        if self.random() < 0.3:
            asked["scene"] = self.document(document)
        if self.random() < 0.2 and len(document["coordinates"]) > 1:
            asked["guides"] = [{"coordinate": document["coordinates"][0]["name"], "value": self.guide()}]
        return asked

    def guide(self) -> str:
        return f"{self.constant()}*sin({self.constant()}*t)"

    def document(self, document: Json) -> Json:
        """The document with other numbers, and a load with a constant."""
        changed = deepcopy(document)
        for table in [*changed["coordinates"], *changed["parameters"]]:
            for key in ("value", "rate", "min", "max"):
                if key in table:
                    table[key] = self.often(table[key])
        zero = ["0"] * (changed["dimension"] - 1)
        changed["loads"] = [
            *changed.get("loads", []),
            {"kind": "gravity", "name": "more", "acceleration": [self.constant(), *zero]},
        ]
        return changed

    def initial(self, scene: str) -> Json:
        names = [one.name for one in load_scene(scene).coordinates]
        return {name: {"value": self.often(0.1), "rate": self.often(0.0)} for name in names if self.random() < 0.6}

    def request(self) -> Request:
        """One of all."""
        scene = self.choice((*SCENES, *CONSTRAINED, *JUMPING))
        kinds = (self.simulation, self.simulation, self.ensemble, self.derivation, self.derivation, self.export)
        return self.choice((*kinds, self.homework, self.variation, self.experiment, self.scene_or_expression))(scene)

    def simulation(self, scene: str) -> Request:
        return "/simulations", self.changes(scene) | self.run(scene)

    def derivation(self, scene: str) -> Request:
        return "/derivations", self.changes(scene)

    def export(self, scene: str) -> Request:
        own = {"initial": self.initial(scene), "t_end": self.often(1.0)}
        return f"/exports/{self.choice(FORMS)}", self.changes(scene) | own

    def run(self, scene: str) -> Json:
        given = {"initial": self.initial(scene), "t_end": self.often(1.0), "method": self.choice(METHODS)}
        if self.random() < 0.5:
            given["tolerance"] = self.often(1e-6)
        elif self.random() < 0.5:
            given["step"] = self.often(0.01)
        if self.random() < 0.2:
            given["samples"] = self.often(11)
        return given

    def ensemble(self, scene: str) -> Request:
        """Some initial values and parameters vary, in each of the ways in which that is asked for."""
        document = write_scene(load_scene(scene))
        quantities = [f"parameters.{one['name']}" for one in document["parameters"]]
        quantities += [f"initial.{one['name']}.{part}" for one in document["coordinates"] for part in ("value", "rate")]
        vary = {name: self.varied() for name in self.sample(quantities, self.choice((1, 1, 2)))}
        own = {"vary": vary, "initial": self.initial(scene), "t_end": self.often(0.5), "samples": 5}
        if self.random() < 0.5:
            own["statistics"] = ["mean", "quantiles"]
        return "/ensembles", self.changes(scene) | own

    def varied(self) -> object:
        """Values, an interval of them, or a distribution."""
        kind = self.randrange(3)
        if kind == 0:
            return [self.often(0.5), self.number()]
        if kind == 1:
            return {"from": self.often(0.1), "to": self.number(), "count": 3}
        return {"normal": [self.often(0.5), self.number()], "count": 3}

    def homework(self, scene: str) -> Request:
        asked = self.changes(scene)
        coordinate = load_scene(scene).coordinates[0].name
        task = self.choice(("kinetic-energy", f"equation:{coordinate}", "lagrange-function"))
        answer = {"value": f"{self.constant()}*dot({coordinate})^2"}
        path = self.choice(("/tasks", "/tasks/solution", "/tasks/stack", "/checks", "/checks/lines", "/checks/motion"))
        if path == "/checks/lines":
            scheme = {"points": {task: self.often(3.0)}, "follow_through": self.often(0.5)}
            return path, asked | {"lines": [{"task": task, "answer": answer}], "scheme": scheme}
        if path == "/tasks/stack":
            return path, asked | {"tasks": [task]}
        own: Json = {"task": task} if path != "/tasks" else {}
        return path, asked | own | ({"answer": answer} if path.startswith("/checks") else {})

    def variation(self, scene: str) -> Request:
        numeric = {
            "functions": {"x": f"{self.constant()}*sin(t)"},
            "direction": {"x": f"t*{self.constant()}"},
            "t": self.often(0.5),
            "parameters": {"k": self.number()},
        }
        asked: Json = {"functions": ["x"], "parameters": ["k"], "include": ["quotient"], "numeric": numeric}
        if self.random() < 0.5:
            asked["functional"] = {"kind": "integral", "from": "0", "to": self.constant()}
        return "/variations", asked | {"expression": f"k*x^2*dot(x)*{self.constant()}"}

    def experiment(self, scene: str) -> Request:
        asked = self.changes(scene) | {"initial": self.initial(scene)}
        name = self.choice(EXPERIMENTS)
        own: dict[str, Json] = {
            "energy-drift": {"steps": 1000, "step": self.often(0.01)},
            "chaos": {"apart": self.often(1e-6)},
            "fidelity": {"tolerance": self.often(0.01)},
            "poincare-section": {"energy": self.number(), "count": 2} if self.random() < 0.5 else {"count": 2},
            "basins": {"x_from": -self.often(1.0), "x_to": self.often(1.0), "count": 8, "pairs": 0},
            "uncertainty": {"tolerance": self.often(0.01), "runs": 30, "share": self.often(0.1)},
            "bifurcation": {
                "sweep": {"parameter": "omega", "from": self.number(), "to": self.number(), "count": 8},
                "crossings": 4,
                "skip": 4,
            },
            "stability-map": {
                axis: {"parameter": "omega", "from": self.number(), "to": self.number(), "count": 4} for axis in "xy"
            },
        }
        return f"/experiments/{name}", asked | {"t_end": self.often(0.5)} | own.get(name, {})

    def scene_or_expression(self, scene: str) -> Request:
        if self.random() < 0.5:
            return "/scenes/validate", self.document(self.choice((EXAMPLE, write_scene(load_scene(scene)))))
        return "/expressions", {"scene": scene, "expression": f"{self.constant()}*t + {self.constant()}"}


def requests(count: int, seed: int = 1) -> Iterator[Request]:
    """So many, always the same."""
    draw = Draw(seed)
    for _ in range(count):
        path, body = draw.request()
        yield f"/api/v1{path}", body


def is_wrong(status: int) -> bool:
    """Whether a status is a mistake of the service."""
    return status >= 500 and status not in BUSY


async def drive(address: str, count: int) -> tuple[Counter[int], list[str]]:
    """The statuses, and what went wrong."""
    statuses: Counter[int] = Counter()
    wrong: list[str] = []
    left = requests(count)

    async def one_client(client: httpx.AsyncClient) -> None:
        for path, body in left:
            answer = await client.post(path, json=body)
            statuses[answer.status_code] += 1
            if is_wrong(answer.status_code):
                wrong.append(f"{answer.status_code} {path} {body}")
            if statuses.total() % 250 == 0:
                print(dict(sorted(statuses.items())), flush=True)

    async with httpx.AsyncClient(base_url=address, timeout=300) as client:
        await asyncio.gather(*(one_client(client) for _ in range(4)))
    return statuses, wrong


def main() -> int:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 5000
    with served(**QUICK) as service:
        statuses, wrong = asyncio.run(drive(service.address, count))
    print(dict(sorted(statuses.items())), *wrong, sep="\n")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

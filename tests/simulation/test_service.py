"""Requests answered: the fields of the answer, and every way to ask wrongly."""

from __future__ import annotations

import base64
import gzip
import json
import math
import subprocess
import sys
from time import sleep
from typing import Any

import numpy as np
import pytest
from tests.simulation.constrained import pendulum
from tests.simulation.scenes import document, double_pendulum, oscillator

from deltaq.contract.simulation import COLUMNS
from deltaq.errors import InputError, Problem, RequestError, SceneError, UnknownNameError
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.mechanics.scene import Scene
from deltaq.mechanics.writing import write_scene
from deltaq.model.model import Model, compile_model
from deltaq.narration.catalog import LANGUAGES, message, text
from deltaq.simulation import service
from deltaq.simulation.choice import AUTO
from deltaq.simulation.columns import WRITERS
from deltaq.simulation.driver import simulate
from deltaq.simulation.kernels.compiler import MachineCodeNeededError
from deltaq.simulation.library import ENSEMBLES, families, get_method, kernel_groups, method_ids
from deltaq.simulation.method import Method
from deltaq.simulation.outcome import codes
from deltaq.simulation.problem import Problem as Started
from deltaq.simulation.service import problem_of, run, run_at_once, run_meanwhile, warm

FIELDS = {
    *("status", "reason", "remedy", "event", "events", "indeterminate", "method", "choice", "columns", "t"),
    *("t_reached", "trusted_until", "condition", "cost"),
    *("coordinates", "rates", "positions", "loads", "energy", "error"),
}
OF_CONSTRAINTS = {"multipliers", "reactions", "drift", "moved", "undetermined"}


def ask(**fields: object) -> dict[str, object]:
    answer = run({"scene": "pendulum", "t_end": 2.0, "samples": 21, **fields})
    json.dumps(answer, allow_nan=False)
    return answer


@pytest.mark.parametrize("scene", [name for name in scene_ids() if all(e.bounces for e in load_scene(name).events)])
@pytest.mark.parametrize("accuracy", [{}, {"tolerance": 1e-9}, {"step": 0.01}], ids=["default", "tolerance", "step"])
def test_every_scene_answers_in_full(scene: str, accuracy: dict[str, float]) -> None:
    answer = ask(scene=scene, **accuracy)
    loaded = load_scene(scene)
    forces = {
        "friction": any(load.kind == "friction" for load in loaded.loads),
        "contacts": any(event.bounces for event in loaded.events),
    }
    of_scene = (OF_CONSTRAINTS if loaded.constraints else set()) | {name for name, acts in forces.items() if acts}
    assert set(answer) == FIELDS | of_scene
    assert (answer["status"], answer["event"]) == ("ok", None)
    assert answer["reason"] == {"code": "ok", "parameters": answer["reason"]["parameters"]}
    count = len(answer["t"])
    regular = [t for t in answer["t"] if answer["t"].count(t) == 1]  # times of events stand twice
    assert len(regular) == 21 - (answer["t"].count(0.0) > 1)
    assert answer["t"][-1] == 2.0
    for part in ("coordinates", "rates", "positions", "loads"):
        assert all(len(values) == count for values in answer[part].values())
    assert all(len(answer["energy"][key]) == count for key in ("kinetic", "potential", "power", "work", "balance"))
    assert len(answer["error"]["estimate"]) == count
    assert set(answer["cost"]) >= {"steps", "rejected", "rhs_evaluations", "wall_time", "compile_time"}


@pytest.mark.parametrize("t_end", [2.0, 51.40243757, 1e-3 / 3.0, 1000.0 / 7.0])
@pytest.mark.parametrize("samples", [4, 21, 301])
def test_the_times_told_are_those_computed_at(t_end: float, samples: int) -> None:
    """Times rounded after the fact would put every state beside its time: at speed, an error of its own."""
    answer = ask(t_end=t_end, samples=samples)
    problem = problem_of(load_scene("pendulum"), t_end, samples)
    found = simulate(problem, get_method("rk4"), step=t_end / 200)
    assert answer["t"] == found.times.tolist()
    assert answer["t"][-1] == t_end
    assert all(time == float(f"{time:.15g}") for time in answer["t"][:-1])


def unpacked(column: object) -> np.ndarray:
    return np.frombuffer(base64.b64decode(str(column)), "<f8")


def test_packed_columns_hold_the_same_numbers() -> None:
    assert tuple(WRITERS) == COLUMNS
    wanted = {"scene": "elastic-pendulum", "tolerance": 1e-6}
    plain, packed = ask(**wanted), ask(**wanted, columns="base64")
    np.testing.assert_array_equal(unpacked(packed["t"]), plain["t"])
    for part in ("coordinates", "rates"):
        for name, column in packed[part].items():
            np.testing.assert_array_equal(unpacked(column), plain[part][name])
    for part in ("positions", "loads"):
        for name, column in packed[part].items():
            np.testing.assert_array_equal(unpacked(column).reshape(21, 2), plain[part][name])
    for name in ("kinetic", "potential", "power", "work", "balance"):
        np.testing.assert_array_equal(unpacked(packed["energy"][name]), plain["energy"][name])


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-12])
def test_columns_in_planes_are_right_and_small(tolerance: float) -> None:
    """Far within the error estimate of the same numbers in full; their last bytes are zero as far as that allows."""
    wanted = {"scene": "elastic-pendulum", "samples": 201, "tolerance": tolerance}
    plain, packed = ask(**wanted), ask(**wanted, columns="planes")
    errors = np.array(plain["error"]["estimate"])

    def in_order(column: object) -> np.ndarray:
        planes = np.frombuffer(base64.b64decode(str(column)), "u1").reshape(8, -1)
        return np.ascontiguousarray(planes.T).view("<f8").reshape(201, -1).squeeze()

    np.testing.assert_array_equal(in_order(packed["t"]), plain["t"])
    for part in ("coordinates", "rates", "positions", "loads"):
        for name, column in packed[part].items():
            apart = np.abs(in_order(column) - np.array(plain[part][name]))
            assert (apart.reshape(201, -1).max(axis=1) <= 5e-3 * errors + 1e-15).all(), name
    for name in ("kinetic", "potential", "work", "balance"):
        np.testing.assert_allclose(in_order(packed["energy"][name]), plain["energy"][name], atol=1e-3 * errors.max())
    sent = [len(gzip.compress(json.dumps(answer, separators=(",", ":")).encode(), 5)) for answer in (packed, plain)]
    assert sent[0] < 0.95 * sent[1]


def test_power_is_the_rate_of_the_work() -> None:
    """Driven by a guide: ∫P dt by the trapezoidal rule over fine samples is the work."""
    energy = ask(scene="guided-pendulum", samples=4001, tolerance=1e-9)["energy"]
    power, work = np.array(energy["power"]), np.array(energy["work"])
    steps = (power[1:] + power[:-1]) / 2 * (2.0 / 4000)
    np.testing.assert_allclose(np.cumsum(steps), work[1:], atol=1e-5)
    assert np.ptp(work) > 0.1
    assert set(ask(scene="pendulum")["energy"]["power"]) == {0.0}


def test_power_is_told_to_those_who_ask_for_it() -> None:
    """It comes with the energies that it balances; who wants these alone gets these alone."""
    alone, whole = (ask(scene="guided-pendulum", include=[part])["energy"] for part in ("energy", "power"))
    assert whole.keys() - alone.keys() == {"power", "work"}
    assert {name: whole[name] for name in alone} == alone


def test_guided_coordinate_is_shown_like_the_others() -> None:
    answer = ask(scene="guided-pendulum")
    assert list(answer["coordinates"]) == ["y", "phi"]
    assert answer["coordinates"]["y"][1] == pytest.approx(0.15 * math.sin(0.5))
    assert answer["rates"]["y"][0] == pytest.approx(0.75)
    assert answer["positions"]["pivot"][1] == pytest.approx([0.0, 0.15 * math.sin(0.5)])


def test_loads_are_arrows() -> None:
    answer = ask(scene="elastic-pendulum", initial={"phi": {"value": 0.0}})
    assert answer["loads"]["drive"][0] == [2.0, 0.0]
    assert answer["loads"]["weight"][0] == [0.0, 9.81]
    assert "suspension" not in answer["loads"]


def test_parameters_and_initial_values_are_taken() -> None:
    answer = ask(parameters={"l": 0.25}, initial={"phi": {"value": 0.01}}, t_end=math.pi * math.sqrt(0.25 / 9.81))
    assert answer["coordinates"]["phi"][-1] == pytest.approx(-0.01, rel=1e-4)
    assert answer["positions"]["bob"][0] == pytest.approx([0.25 * math.sin(0.01), 0.25 * math.cos(0.01)])


def test_the_time_of_compiling_is_told_by_itself(monkeypatch: pytest.MonkeyPatch) -> None:
    def slowly(scene: Scene) -> Model:
        sleep(0.05)
        return compile_model(scene)

    monkeypatch.setattr(service, "compile_model", slowly)
    cost = ask()["cost"]
    assert cost["compile_time"] >= 0.05
    assert cost["run_time"] <= cost["wall_time"]


def test_what_is_asked_at_once_is_the_same_answer_or_none(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = {"scene": "pendulum", "t_end": 0.1, "samples": 3, "method": "rk4", "step": 0.05}
    soon = run(asked)
    for now in (run_at_once(asked), run_meanwhile(asked)):
        assert now is not None
        assert {**now, "cost": None} == {**soon, "cost": None}

    def takes_too_long(_work: object, _seconds: float) -> None:
        raise MachineCodeNeededError

    monkeypatch.setattr(service, "interpreted", takes_too_long)
    assert run_at_once(asked) is None


def test_initial_value_beyond_the_slider_is_allowed() -> None:
    assert ask(initial={"phi": {"value": 10.0, "rate": -3.0}})["rates"]["phi"][0] == -3.0


def test_initial_value_of_a_frozen_coordinate_is_where_it_is_held() -> None:
    answer = ask(scene="base-pendulum", freeze=["y"], initial={"y": {"value": 0.3}})
    assert set(answer["coordinates"]["y"]) == {0.3}


def test_guides_of_the_request() -> None:
    guide = {"coordinate": "y", "value": "y0*sin(omega*t)"}
    parameters = {"y0": 0.15, "omega": 5.0}
    changed = ask(scene="base-pendulum", guides=[guide], parameters=parameters, initial={"phi": {"value": 0.4}})
    expected = ask(scene="guided-pendulum")["coordinates"]["phi"]
    np.testing.assert_allclose(changed["coordinates"]["phi"], expected, atol=1e-6)


def test_scene_documents_are_taken() -> None:
    assert ask(scene=write_scene(double_pendulum()))["status"] == "ok"


def test_include_limits_the_answer_and_saves_the_second_run() -> None:
    answer = ask(include=["coordinates"])
    assert set(answer) & {"coordinates", "rates", "positions", "loads", "energy", "error"} == {"coordinates"}
    assert answer["cost"]["runs"] == 1
    assert ask(include=["error"])["cost"]["runs"] > 1


def test_numbers_are_as_long_as_their_error_allows() -> None:
    asked = {"t_end": 60.0, "method": "bogacki-shampine-32"}
    answer = ask(tolerance=1e-3, **asked)
    values, estimates = answer["coordinates"]["phi"], answer["error"]["estimate"]
    for value, estimate in zip(values[1:], estimates[1:], strict=True):
        assert value == round(value, math.ceil(-math.log10(estimate)) + 3)
    exact = ask(tolerance=1e-12, **asked | {"method": "dop853"})["coordinates"]["phi"]
    assert np.all(np.abs(np.array(values) - exact) <= np.array(estimates) * 1.01)


def test_a_diverging_run_gives_its_good_part() -> None:
    answer = ask(scene=write_scene(oscillator("m*x^3")), t_end=10.0, samples=1001)
    assert answer["status"] == "diverged"
    assert 0 < len(answer["t"]) == len(answer["coordinates"]["x"]) < 1001
    assert answer["t_reached"] < 10.0


def test_angles_are_known_by_their_unit() -> None:
    """Of an angle no more than a radian counts as its size, however often it has wound around."""
    known = {
        name: problem_of(load_scene(name), 1.0).angular for name in ("elastic-pendulum", "double-pendulum", "atwood")
    }
    assert known == {"elastic-pendulum": (False, True), "double-pendulum": (True, True), "atwood": (False,)}


@pytest.mark.parametrize(("x", "times", "reached"), [(-1.1, [0.0, 0.5, 1.0], 1.0), (0.1, [], 0.0)])
def test_a_position_without_value_ends_the_answer(x: float, times: list[float], reached: float) -> None:
    """The motion is harmless, but a point of the drawing leaves the real numbers."""
    document = write_scene(oscillator("0", x=x, u=1.0))
    document["points"] = [{"name": "image", "position": ["sqrt(-x)", "0"]}]
    answer = ask(scene=document, t_end=2.0, samples=5)
    assert (answer["status"], answer["reason"]) == ("singular", {"code": "not_finite", "parameters": {"t": reached}})
    assert (answer["t"], answer["t_reached"]) == (times, reached)


def test_an_answer_that_ends_has_all_its_columns_up_to_there() -> None:
    """A pendulum in x and y, let go at x = −1: √(−x) is real until it passes below the pivot, after 0.59 s."""
    document = write_scene(pendulum(x=-1.0))
    document["points"] = [*document["points"], {"name": "image", "position": ["sqrt(-x)", "0"]}]
    whole, answer = (ask(scene=scene, t_end=1.0, samples=11) for scene in (write_scene(pendulum(x=-1.0)), document))
    assert answer["t"] == whole["t"][:6]
    parts = [
        *(answer[part] for part in ("coordinates", "rates", "positions", "loads", "multipliers")),
        {name: each for name, each in answer["energy"].items() if isinstance(each, list)},
        {"estimate": answer["error"]["estimate"], **answer["error"]["multipliers"]},
    ]
    assert [name for part in parts for name, column in part.items() if len(column) != 6] == []
    assert answer["error"]["multipliers"] == {"S": whole["error"]["multipliers"]["S"][:6]}
    assert answer["multipliers"] == {"S": whole["multipliers"]["S"][:6]}


def rubbed(scene: Scene) -> dict[str, Any]:
    """The scene with dry friction, from rest: beside it the force jumps by twice as much."""
    document: dict[str, Any] = write_scene(scene)
    friction = {"kind": "friction", "name": "rub", "coordinate": "x", "force": "0.2"}
    return document | {"loads": [*document["loads"], friction]}


@pytest.mark.parametrize(
    ("fields", "method", "reason"),
    [
        pytest.param({}, "dormand-prince-54", "auto_short", id="short"),
        pytest.param({"t_end": 100.0, "tolerance": 1e-9}, "dop853", "auto_smooth", id="long and accurate"),
        pytest.param({"t_end": 1.0, "tolerance": 1e-12}, "taylor", "auto_series", id="beyond order 8"),
        pytest.param({"scene": "quarter-car", "t_end": 100.0, "tolerance": 1e-9}, "dop853", "auto_smooth", id="driven"),
        pytest.param({"step": 0.01}, "rk4", "auto_fixed_step", id="fixed step"),
        pytest.param({"scene": write_scene(oscillator("-k*abs(x)*x"))}, "dormand-prince-54", "auto_kinks", id="kinks"),
        pytest.param(
            {"scene": write_scene(oscillator("-1e6*x - 1e4*dot(x)")), "t_end": 100.0},
            "radau-5",
            "auto_stiff",
            id="stiff and damped",
        ),
        pytest.param({"scene": write_scene(oscillator("-1e6*x")), "t_end": 10.0}, "dop853", "auto_smooth", id="fast"),
        pytest.param(
            {"scene": rubbed(oscillator("-20*x")), "t_end": 20.0, "tolerance": 1e-9},
            "dop853",
            "auto_smooth",
            id="rubbed",
        ),
        pytest.param(
            {"scene": rubbed(oscillator("-1e6*x - 1e4*dot(x)")), "t_end": 100.0}, "radau-5", "auto_stiff", id="both"
        ),
        pytest.param({"method": "heun"}, "heun", None, id="chosen by the user"),
    ],
)
def test_auto_says_why(fields: dict[str, object], method: str, reason: str | None) -> None:
    answer = ask(**fields)
    assert answer["method"] == method
    assert answer["choice"] == ({"code": reason, "parameters": {}} if reason else None)


@pytest.mark.parametrize("x", [-1e15, 1e15])
def test_what_begins_at_the_largest_number_is_followed(x: float) -> None:
    free = write_scene(oscillator("0"))
    answer = ask(scene=free, initial={"x": {"value": x, "rate": 0.0}}, t_end=1.0)
    assert answer["status"] == "ok"
    assert answer["coordinates"]["x"][-1] == x


def error(code: str, pointer: str, **parameters: object) -> Problem:
    return Problem(code, pointer, parameters=parameters)


KNOWN_METHODS = ", ".join(method_ids())
PARTS = "coordinates, rates, positions, loads, multipliers, energy, power, error"
HOSTILE = [
    pytest.param({"t_end": None}, RequestError, error("missing-field", "/t_end", field="t_end"), id="no end"),
    *(
        pytest.param(
            {"initial": {"phi": {key: number}}},
            RequestError,
            error("initial-too-large", f"/initial/phi/{key}", value=number, most=1e15),
            id=f"a {key} of {number}, from where no motion is followed",
        )
        for key, number in (("value", 1e17), ("rate", -2e15))
    ),
    pytest.param({"t_end": math.nan}, RequestError, error("request-not-finite", "/t_end"), id="NaN"),
    pytest.param({"t_end": math.inf}, RequestError, error("request-not-finite", "/t_end"), id="infinity"),
    pytest.param({"t_end": 10**400}, RequestError, error("request-not-finite", "/t_end"), id="huge integer"),
    pytest.param({"t_end": "10"}, RequestError, error("request-not-number", "/t_end"), id="text for a number"),
    pytest.param({"t_end": True}, RequestError, error("request-not-number", "/t_end"), id="flag for a number"),
    pytest.param({"t_end": -1}, RequestError, error("request-outside", "/t_end", value=-1.0, min=0.0, max=1e5), id="p"),
    pytest.param({"t_end": 0}, RequestError, error("request-outside", "/t_end", value=0.0, min=0.0, max=1e5), id="now"),
    pytest.param(
        {"t_end": 1e6}, RequestError, error("request-outside", "/t_end", value=1e6, min=0.0, max=1e5), id="too long"
    ),
    pytest.param(
        {"samples": 1}, RequestError, error("request-outside", "/samples", value="1", min=2, max=20001), id="one sample"
    ),
    pytest.param(
        {"samples": 10**9}, RequestError, error("request-outside", "/samples", value="1000000000", min=2, max=20001),
        id="too many samples",
    ),
    pytest.param({"samples": 10.5}, RequestError, error("request-not-integer", "/samples"), id="half a sample"),
    pytest.param(
        {"step": 0.1, "tolerance": 1e-3}, RequestError, error("request-step-and-tolerance", "/tolerance"), id="both"
    ),
    pytest.param(
        {"step": 3.0}, RequestError, error("request-outside", "/step", value=3.0, min=0.0, max=2.0), id="giant step"
    ),
    pytest.param(
        {"step": 0.0}, RequestError, error("request-outside", "/step", value=0.0, min=0.0, max=2.0), id="no step"
    ),
    pytest.param(
        {"tolerance": 1e-15}, RequestError,
        error("request-outside", "/tolerance", value=1e-15, min=1e-13, max=0.1), id="beyond doubles",
    ),
    pytest.param(
        {"method": "rk5"}, UnknownNameError,
        error("unknown-method", "/method", name="rk5", suggestion="rk4", known=KNOWN_METHODS), id="unknown method",
    ),
    pytest.param({"method": 4}, RequestError, error("request-not-text", "/method"), id="number for a method"),
    pytest.param(
        {"scene": "pendulun"}, UnknownNameError,
        error("unknown-scene", "/scene", name="pendulun", suggestion="pendulum", known=", ".join(scene_ids())),
        id="unknown scene",
    ),
    pytest.param({"scene": 5}, RequestError, error("request-scene-type", "/scene"), id="number for a scene"),
    pytest.param({"scene": None}, RequestError, error("request-scene-type", "/scene"), id="no scene"),
    pytest.param(
        {"initial": {"x/~y": {"value": 1}}}, UnknownNameError,
        error("unknown-coordinate", "/initial/x~1~0y", name="x/~y", known="phi"), id="unknown coordinate",
    ),
    pytest.param(
        {"initial": {"phi": {"value": "1"}}}, RequestError, error("request-not-number", "/initial/phi/value"),
        id="text for an initial value",
    ),
    pytest.param(
        {"initial": {"phi": {"rate": math.nan}}}, RequestError, error("request-not-finite", "/initial/phi/rate"),
        id="NaN for a rate",
    ),
    pytest.param({"initial": {"phi": 1.0}}, RequestError, error("request-not-object", "/initial/phi"), id="bare"),
    pytest.param(
        {"initial": {"phi": {"velocity": 1}}}, RequestError,
        error("unknown-field", "/initial/phi/velocity", field="velocity"), id="unknown field of an initial value",
    ),
    pytest.param(
        {"scene": "guided-pendulum", "initial": {"y": {"value": 1}}}, RequestError,
        error("guided-coordinate", "/initial/y", name="y"), id="initial value of a guided coordinate",
    ),
    pytest.param(
        {"scene": "base-pendulum", "freeze": ["y"], "initial": {"y": {"rate": 1}}}, RequestError,
        error("frozen-rate", "/initial/y/rate", name="y"), id="rate of a frozen coordinate",
    ),
    pytest.param(
        {"parameters": {"q": 1}}, UnknownNameError,
        error("unknown-parameter", "/parameters/q", name="q", known="m, l, g"),
        id="unknown parameter",
    ),
    pytest.param(
        {"parameters": {"m": -1}}, SceneError, error("not-positive", "/parameters/m", name="m", value=-1.0),
        id="negative mass",
    ),
    pytest.param({"parameters": {"m": math.inf}}, RequestError, error("request-not-finite", "/parameters/m"), id="inf"),
    pytest.param({"parameters": [1]}, RequestError, error("request-not-object", "/parameters"), id="list"),
    pytest.param({"freeze": "phi"}, RequestError, error("request-not-array", "/freeze"), id="text to freeze"),
    pytest.param({"guides": [5]}, RequestError, error("request-not-object", "/guides/0"), id="number for a guide"),
    pytest.param(
        {"include": ["all"]}, RequestError, error("request-not-one-of", "/include/0", expected=PARTS), id="unknown part"
    ),
    pytest.param({"tend": 3}, RequestError, error("unknown-field", "/tend", field="tend"), id="misspelt field"),
    pytest.param(
        {"scene": "base-pendulum", "guides": [{"coordinate": "y", "value": "t/(t - t)"}]}, SceneError,
        error("not-computable", "/scene", detail="LLVMDouble can only represent real valued infinity"),
        id="guide without value",
    ),
    pytest.param(
        {"scene": {**write_scene(oscillator()), "loads": [{"kind": "potential", "energy": "k*x^2/(x - x)"}]}},
        SceneError, error("never-defined", "/scene/loads/0/energy", expression="k*x^2/(x - x)"),
        id="potential without value",
    ),
]  # fmt: skip


@pytest.mark.parametrize(("fields", "kind", "problem"), HOSTILE)
def test_wrong_requests_are_told_where_and_why(
    fields: dict[str, object], kind: type[InputError], problem: Problem
) -> None:
    with pytest.raises(InputError) as caught:
        ask(**fields)
    assert type(caught.value) is kind
    assert problem in caught.value.problems
    assert all(message(language, told) for told in caught.value.problems for language in LANGUAGES)


def test_a_motion_that_cannot_start_has_no_samples() -> None:
    """The force is infinite where the particle stands at first."""
    answer = ask(scene=write_scene(oscillator("-k/x", x=0.0)))
    assert (answer["status"], answer["t"], answer["energy"]["balance"]) == ("singular", [], [])
    assert answer["error"]["estimate"] == []


def test_all_problems_are_told_at_once() -> None:
    with pytest.raises(RequestError) as caught:
        ask(t_end="x", samples=0, initial={"phi": {"value": math.nan}})
    assert [problem.pointer for problem in caught.value.problems] == ["/t_end", "/samples", "/initial/phi/value"]


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_status_and_method_has_its_sentences(language: str) -> None:
    for code in (*codes(), "auto_smooth", "auto_series", "auto_short", "auto_kinks", "auto_stiff", "auto_fixed_step"):
        assert text(language, f"statuses.{code}.reason")
        assert text(language, f"statuses.{code}.remedy") or code == "ok" or code.startswith("auto")
    for identifier in (*method_ids(), AUTO):
        assert text(language, f"methods.{identifier}.title")
        assert text(language, f"methods.{identifier}.summary")


def test_running_needs_no_sympy() -> None:
    program = "import sys; from deltaq.simulation.service import run; run({'scene': 'pendulum', 't_end': 1.0}); "
    program += "sys.exit('sympy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0


def test_one_compiled_kernel_serves_all_methods_scenes_and_experiments() -> None:
    """In a process of its own: whoever calls a kernel by hand compiles it for his own arrays."""
    program = """
import sys
from deltaq.lab.experiments.bifurcation import EXPERIMENT as SWEEP
from deltaq.lab.experiments.convergence import EXPERIMENT
from deltaq.simulation.ensemble_answer import run as many
from deltaq.simulation.integration import integrate, integrate_implicit, integrate_newmark, integrate_split
from deltaq.simulation.library import kernel_groups
from deltaq.simulation.service import run, warm
from deltaq.simulation.ensemble import integrate_members
kernels = (integrate, integrate_implicit, integrate_newmark, integrate_split, integrate_members)
count = lambda: [len(kernel.compiled.signatures) for kernel in kernels]
seen = []
for family in kernel_groups():
    warm(family)
    seen.append(count())
run({"scene": "elastic-pendulum", "t_end": 1.0})
many({"scene": "double-pendulum", "t_end": 1.0, "vary": {"parameters.l1": [0.5, 1.0]}})
gamma = {"parameter": "gamma", "from": 1.0, "to": 1.06, "count": 8}
assert [*SWEEP.run({"scene": "driven-pendulum", "sweep": gamma, "skip": 8})]
assert [*EXPERIMENT.run({"scene": "pendulum", "t_end": 0.5})]
print(seen[0], count())
"""
    told = subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True).stdout
    assert told.splitlines()[-1] == "[1, 0, 0, 0, 0] [1, 1, 1, 1, 1]"


@pytest.mark.parametrize("chosen", [(), *((group,) for group in kernel_groups()), families()[:2]], ids=" ".join)
def test_methods_of_the_families_that_are_named_are_warmed(
    monkeypatch: pytest.MonkeyPatch, chosen: tuple[str, ...]
) -> None:
    ran: list[str] = []
    held: list[str] = []  # by constraints, to which a series has no way back
    lanes: list[int] = []

    def simulated(problem: Started, method: Method, **_options: object) -> None:
        (held if problem.is_constrained else ran).append(method.id)

    monkeypatch.setattr(service, "simulate", simulated)
    monkeypatch.setattr(service.ensemble, "warm", lambda _problem: lanes.append(1))
    warm(*chosen)
    assert {get_method(name).family for name in ran} == {*(chosen or families())} - {ENSEMBLES}
    assert set(held) == set(ran) - {"taylor"}
    assert lanes == ([1] if not chosen or ENSEMBLES in chosen else [])
    assert set(method_ids()) - set(ran) == {
        name for name in method_ids() if chosen and get_method(name).family not in chosen
    }


def test_what_ended_a_motion_at_its_start_is_told_though_its_forces_are_no_numbers() -> None:
    """At r = 0 polar coordinates have no inverse of M: that is why it ends, and not that friction is not finite."""
    polar = document(
        {"r": (0.0, 1.0), "phi": (0.0, 1.0)},
        {},
        {"bob": ("1", ["r*cos(phi)", "r*sin(phi)"])},
        [{"kind": "friction", "name": "R", "coordinate": "phi", "force": "1"}],
    )
    found = ask(scene=polar)
    assert (found["status"], found["reason"]["code"], found["t"]) == (
        "singular_mass_matrix",
        "singular_mass_matrix",
        [],
    )

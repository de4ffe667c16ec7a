"""Compiling: what is shared, what is passed on, what cannot be compiled."""

from __future__ import annotations

import pickle
from dataclasses import replace

import numpy as np
import pytest
from tests.simulation.scenes import all_scenes, get_scene, scene

from deltaq.errors import Problem, SceneError
from deltaq.mechanics.changes import change
from deltaq.mechanics.library import load_scene
from deltaq.model.model import compile_model


def test_new_numbers_need_no_new_model() -> None:
    pendulum = load_scene("pendulum")
    other = change(pendulum, parameters={"l": 0.5})
    assert compile_model(other) is compile_model(pendulum)
    assert compile_model(replace(pendulum, id="other", title={"en": "Other"})) is compile_model(pendulum)


def test_another_guide_needs_another_model() -> None:
    base = load_scene("base-pendulum")
    guided = change(base, guides=[{"coordinate": "y", "value": "0.1*sin(t)"}])
    assert compile_model(guided) is not compile_model(base)
    assert compile_model(guided).layout.free == ("phi",)


def test_frozen_coordinate_becomes_an_input() -> None:
    frozen = change(load_scene("base-pendulum"), freeze=["y"])
    layout = compile_model(frozen).layout
    assert (layout.free, layout.guided, layout.parameters[-1]) == (("phi",), ("y",), "y_0")
    assert not layout.is_powered


def test_model_survives_pickling() -> None:
    model = compile_model(load_scene("elastic-pendulum"))
    assert model.motion.addresses[0] > 0
    copy = pickle.loads(pickle.dumps(model))
    rows = np.random.default_rng(1).uniform(0.1, 1.0, (3, model.motion.inputs))
    np.testing.assert_array_equal(copy.motion.table(rows), model.motion.table(rows))
    assert copy.motion.addresses != model.motion.addresses, "those of another process"


@pytest.mark.parametrize("name", all_scenes())
def test_one_state_gives_the_same_numbers_as_many(name: str) -> None:
    """To the last bit: a state behind an event is looked at alone, samples together."""
    model = compile_model(get_scene(name))
    rows = np.random.default_rng(2).uniform(0.1, 1.0, (4, model.motion.inputs))
    several = model.system(rows)
    for k, row in enumerate(rows):
        one = model.system_at(row)
        for part in ("mass", "forces", "rows", "gamma"):
            np.testing.assert_array_equal(getattr(one, part), getattr(several, part)[k])


@pytest.mark.parametrize("name", all_scenes())
def test_thorough_code_gives_the_same_numbers(name: str) -> None:
    """To the last bit: how long a run is must not be seen in its answer."""
    model = compile_model(get_scene(name))
    rows = np.random.default_rng(1).uniform(0.1, 1.4, (50, model.motion.inputs))
    np.testing.assert_array_equal(model.thorough.table(rows), model.motion.table(rows))


@pytest.mark.parametrize(
    ("motion", "detail"),
    [
        pytest.param("t/(t - t)", "LLVMDouble can only represent real valued infinity", id="division by zero"),
        pytest.param("t*sqrt(m - m - 1)", "-I", id="complex"),
        pytest.param("t*log(m - m)", "LLVMDouble can only represent real valued infinity", id="log of zero"),
    ],
)
def test_guide_without_real_value_is_the_users_problem(motion: str, detail: str) -> None:
    guided = change(load_scene("base-pendulum"), guides=[{"coordinate": "y", "value": motion}])
    with pytest.raises(SceneError) as caught:
        compile_model(guided)
    assert caught.value.problems == (Problem("not-computable", parameters={"detail": detail}),)


def test_user_names_never_reach_the_machine_code() -> None:
    """Names that mean something to a code generator are numbered symbols by then."""
    odd = scene({"q1": (0.3, 0.0)}, {"u0": 2.0, "p0": 3.0, "q0": 0.5}, {"b": ("u0", ["p0*sin(q1) + q0", "p0*cos(q1)"])})
    model = compile_model(odd)
    assert model.motion.table(np.array([[0.3, 1.0, 0.0, 2.0, 3.0, 0.5]]))[0, 0] == pytest.approx(2.0 * 9.0)

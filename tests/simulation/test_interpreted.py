"""Kernels that are interpreted, where there is no machine code yet, do what machine code does."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from deltaq.simulation.kernels import compiler
from deltaq.simulation.kernels.compiler import Kernel, MachineCodeNeededError, interpreted, soonest
from deltaq.simulation.service import _run

QUESTIONS: list[dict[str, Any]] = [
    {"scene": "pendulum", "t_end": 2.0},
    {"scene": "double-pendulum", "t_end": 2.0, "method": "taylor", "tolerance": 1e-9},
    {"scene": "double-pendulum", "t_end": 1.0, "method": "radau-5"},
    {"scene": "elastic-pendulum", "t_end": 1.0, "method": "gauss-4"},
    {"scene": "elastic-pendulum", "t_end": 1.0, "method": "newmark", "step": 0.01},
    {"scene": "pendulum", "t_end": 1.0, "method": "stormer-verlet", "step": 0.01},
    {"scene": "pendulum", "t_end": 1.0, "method": "explicit-euler", "step": 0.01},
    {"scene": "four-bar", "t_end": 0.3},
    {"scene": "four-bar", "t_end": 0.3, "method": "implicit-midpoint", "step": 0.01},
    {"scene": "bouncing-ball", "t_end": 1.0},
    {"scene": "stick-slip", "t_end": 1.0},
]
PROGRAM = """
import json, sys
from deltaq.simulation.kernels.compiler import interpreted
from deltaq.simulation.service import _run
questions = json.loads(sys.stdin.read())
answers = [interpreted(lambda: _run(question), 300.0) for question in questions]
told = [{name: answer[name] for name in ("status", "t", "coordinates", "rates", "error")} for answer in answers]
print(json.dumps({"answers": told, "machine code": "numba" in sys.modules}))
"""


def test_what_is_interpreted_is_what_machine_code_finds(tmp_path: Path) -> None:
    """On a machine that has never compiled anything, and does not now: that would load the compiler."""
    told = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        input=json.dumps(QUESTIONS),
        env=os.environ | {"NUMBA_CACHE_DIR": str(tmp_path), "XDG_CACHE_HOME": str(tmp_path)},
        capture_output=True,
        text=True,
        check=True,
    )
    found = json.loads(told.stdout)
    assert not found["machine code"]
    for question, answer in zip(QUESTIONS, found["answers"], strict=True):
        expected = json.loads(json.dumps(_run(question)))  # in machine code, loaded or not
        assert answer["status"] == expected["status"], question
        for name, values in expected["coordinates"].items():
            np.testing.assert_allclose(answer["coordinates"][name], values, rtol=1e-8, atol=1e-8, err_msg=str(question))
        np.testing.assert_allclose(answer["error"]["estimate"], expected["error"]["estimate"], rtol=0.1, atol=1e-10)


@pytest.fixture
def new_machine(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compiler, "is_marked", lambda _name: False)


def looped(count: int) -> int:
    for _ in range(count):
        compiler.checkpoint()
    return count


def test_what_takes_too_long_is_given_to_machine_code(new_machine: None, caplog: pytest.LogCaptureFixture) -> None:
    """And who waits hears it."""
    loop = Kernel(looped)
    made: list[int] = []

    def compute() -> int:
        made.append(loop(10_000_000 if not made else 3) if len(made) == 0 else 7)
        return made[-1]

    with caplog.at_level("INFO", "deltaq.simulation"):
        assert interpreted(lambda: loop(3), 10.0) == 3
        with pytest.raises(MachineCodeNeededError):
            interpreted(lambda: loop(10_000_000), 0.01)
        loop.__dict__["compiled"] = lambda count: -count
        assert soonest(lambda: loop(3), 10.0) == -3  # once there is machine code, it is run
    assert [record.getMessage() for record in caplog.records] == [
        "kernels are not compiled on this machine yet: this motion is interpreted"
    ] * 2


def test_short_motions_do_not_wait_until_machine_code_is_loaded(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    """It is there, on disk: who has not loaded it yet tries for a second without."""
    monkeypatch.setattr(compiler, "is_marked", lambda _name: True)
    monkeypatch.setattr(compiler, "LOADING", 0.01)
    loop = Kernel(looped)
    with caplog.at_level("INFO", "deltaq.simulation"):
        monkeypatch.setattr(compiler, "is_loaded", lambda: False)
        assert interpreted(lambda: loop(3), 10.0) == 3
        with pytest.raises(MachineCodeNeededError):
            interpreted(lambda: loop(10_000_000), 60.0)
    assert not caplog.messages  # nothing is missing that one would have to be told of
    monkeypatch.setattr(compiler, "is_loaded", lambda: True)
    monkeypatch.setattr(compiler, "_machine", lambda: SimpleNamespace(compiled_kernel=lambda _f: lambda count: -count))
    assert interpreted(lambda: loop(3), 10.0) == -3


def test_an_interpreter_without_a_value_asks_machine_code(new_machine: None, caplog: pytest.LogCaptureFixture) -> None:
    """1/0 is infinite for kernels, and an error in Python."""

    def inverse(x: float) -> float:
        return 1.0 / x

    kernel = Kernel(inverse)
    tries: list[object] = []

    def compute() -> float:
        tries.append(None)
        if len(tries) == 2:
            kernel.__dict__["compiled"] = lambda _x: np.inf
        return float(kernel(0.0))

    with caplog.at_level("INFO", "deltaq.simulation"):
        assert soonest(compute, 10.0) == np.inf
    assert caplog.messages[-1] == "this motion takes longer: its kernels are compiled, or loaded"

"""Functions in LLVM's language: they run as long as they are held, whatever has been compiled since."""

from __future__ import annotations

import ctypes
import gc
from collections.abc import Callable
from math import sin

import pytest

from deltaq.simulation.series.code import QUICK, THOROUGH, TOGETHER, Code, MachineCode, compiled


def sine_and(number: float, effort: int) -> MachineCode:
    """The function sin x + number."""
    code = Code(1)
    code.label("entry")
    code.do(f"ret double {code.add(code.function('sin', '%x'), code.number(number))}")
    return compiled({"f": code}, effort, "double", "double %x")


def called(code: MachineCode) -> Callable[[float], float]:
    return ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_double)(code.address)


@pytest.mark.parametrize("effort", [QUICK, THOROUGH])
def test_functions_stay_while_others_come_and_go(effort: int) -> None:
    held = {number: sine_and(float(number), effort) for number in range(0, 3 * TOGETHER, TOGETHER - 1)}
    for number in range(2 * TOGETHER):
        assert called(sine_and(float(number), effort))(0.0) == number
    gc.collect()
    assert [called(code)(0.5) for code in held.values()] == [sin(0.5) + number for number in held]

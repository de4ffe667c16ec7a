"""Functions in LLVM's language: they run as long as they are held, and what all share is made once."""

from __future__ import annotations

import ctypes
import gc
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from math import sin
from threading import Barrier

from deltaq.simulation.series.code import TOGETHER, Code, MachineCode, compiled, shared


def sine_and(number: float) -> MachineCode:
    """The function sin x + number."""
    code = Code(1)
    code.label("entry")
    code.do(f"ret double {code.add(code.function('sin', '%x'), code.number(number))}")
    return compiled({"f": code}, "double", "double %x")


def called(code: MachineCode) -> Callable[[float], float]:
    return ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_double)(code.address)


def test_functions_stay_while_others_come_and_go() -> None:
    held = {number: sine_and(float(number)) for number in range(0, 3 * TOGETHER, TOGETHER - 1)}
    for number in range(2 * TOGETHER):
        assert called(sine_and(float(number)))(0.0) == number
    gc.collect()
    assert [called(code)(0.5) for code in held.values()] == [sin(0.5) + number for number in held]


def test_what_is_shared_is_made_once_by_whoever_asks_first() -> None:
    """Both runs of a pair ask at the same time, and know no more of it than its address."""
    made, threads = list[float](), 8
    start = Barrier(threads)

    def make() -> MachineCode:
        made.append(1.0)
        return sine_and(3.0)

    def ask(_number: int) -> int:
        start.wait()
        return shared("shared in a test", make).address

    with ThreadPoolExecutor(threads) as pool:
        addresses = set(pool.map(ask, range(threads)))
    assert (len(addresses), len(made)) == (1, 1)

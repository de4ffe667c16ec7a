"""Kernels that are called again and again with arguments of the same types, at which nobody looks any more."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from deltaq.simulation.kernels.compiler import Kernel, KernelCalls, interpreted

FLOATS, INTEGERS = np.array([0.5, 1.0, 2.25]), np.array([1, 2, 4])


def total(numbers: NDArray[Any], factor: float) -> Any:
    found = numbers[0] * 0
    for each in numbers:
        found += each
    return found * factor


def in_machine_code() -> Kernel:
    """The function as a kernel whose machine code is there, kept on no disk."""
    found = Kernel(total)
    found.__dict__["compiled"] = njit(total)
    return found


def test_every_call_returns_what_the_kernel_does() -> None:
    kernel, calls = in_machine_code(), KernelCalls()
    assert [calls(kernel, factor * FLOATS, factor) for factor in (1.0, 2.0, 3.0)] == [3.75, 15.0, 33.75]


def test_callers_with_arguments_of_other_types_do_not_disturb_each_other() -> None:
    """Numbers are read as what they are also by those who begin when there is machine code for several types."""
    kernel = in_machine_code()
    given = ((KernelCalls(), FLOATS, 3.75), (KernelCalls(), INTEGERS, 7.0), (KernelCalls(), FLOATS, 3.75))
    for _ in range(3):
        assert [calls(kernel, numbers, 1.0) for calls, numbers, _ in given] == [found for *_, found in given]


def test_who_began_without_machine_code_goes_on_with_it() -> None:
    kernel, calls = Kernel(total), KernelCalls()
    assert interpreted(lambda: calls(kernel, FLOATS, 1.0), 60.0) == 3.75
    kernel.__dict__["compiled"] = lambda *_: "machine code"
    assert calls(kernel, FLOATS, 1.0) == "machine code"

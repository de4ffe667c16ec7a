"""Which functions are kernels, and how they run: as machine code, or interpreted where there is none yet.

A kernel is a Python function that Numba can compile. That takes seconds for a large one, once on a machine; a first
motion is there sooner when its kernels are interpreted. Both do the same operations in the same order; machine code may
round a product and a sum once where the interpreter rounds twice.
"""

from __future__ import annotations

import ctypes
import logging
import sys
from collections.abc import Callable
from contextvars import ContextVar
from dataclasses import dataclass
from functools import cached_property, update_wrapper
from importlib import import_module
from time import process_time
from typing import Any, TypeVar, cast

import numpy as np

from .marks import is_marked, name_of

LOGGER = logging.getLogger("deltaq.simulation")
F = TypeVar("F", bound=Callable[..., object])
A = TypeVar("A")
KINDS: dict[str, Any] = {"void": None, "int64": ctypes.c_int64, "float64": ctypes.c_double}


class MachineCodeNeededError(Exception):
    """Interpreted kernels have had their time, or cannot say what machine code would: the value of 1/0, say."""


MACHINE = "deltaq.simulation.kernels.machine"
LOADING = 1.0  # seconds: half of what it takes to load what runs machine code


@dataclass(eq=False)
class Interpretation:
    """Kernels are interpreted up to a time, `end`, of the processor's clock; begun at `start`.

    Those without machine code are, and those with it in a process that has run none yet: the shell's, say. Most
    motions are there before the machine code would be loaded, so that only so much is spent on trying.
    """

    start: float
    end: float
    is_told: bool = False
    failure: Exception | None = None  # where none could be raised

    def takes(self, name: str) -> bool:
        """Whether a kernel is interpreted whose machine code this process has not run."""
        if not is_marked(name):
            self.tell()
            return True
        if is_loaded():
            return False
        self.end = min(self.end, self.start + LOADING)
        return True

    def tell(self) -> None:
        """Says that there is no machine code, once."""
        if not self.is_told:
            self.is_told = True
            LOGGER.info("kernels are not compiled on this machine yet: this motion is interpreted")


_INTERPRETATION: ContextVar[Interpretation | None] = ContextVar("interpretation", default=None)


def soonest(compute: Callable[[], A], seconds: float) -> A:
    """What `compute` finds: by interpreted kernels where machine code is not at hand; by this if that takes longer.

    `compute` may be called twice.
    """
    try:
        return interpreted(compute, seconds)
    except MachineCodeNeededError:
        LOGGER.info("this motion takes longer: its kernels are compiled, or loaded")
        return compute()


def is_loaded() -> bool:
    """Whether this process has what runs machine code."""
    return MACHINE in sys.modules


def interpreted(compute: Callable[[], A], seconds: float) -> A:
    """What `compute` finds, with kernels interpreted as `Interpretation` says.

    Raises MachineCodeNeededError if that takes longer, or cannot be done.
    """
    start = process_time()
    token = _INTERPRETATION.set(Interpretation(start, start + seconds))
    try:
        return compute()
    finally:
        _INTERPRETATION.reset(token)


def checkpoint() -> None:
    """Stands in loops: where interpreted, it raises MachineCodeNeededError when the time is up."""
    found = _INTERPRETATION.get()
    if found is not None and found.failure is not None:
        raise found.failure
    if found is not None and process_time() > found.end:
        raise MachineCodeNeededError


def _machine() -> Any:
    """What makes machine code; loaded where that is needed, for it takes a second."""
    return import_module(MACHINE)


class Kernel:
    """A function that is run as machine code, or interpreted where that is wanted and there is no such code yet."""

    def __init__(self, function: Callable[..., Any]) -> None:
        self.function, self.name = function, name_of(function)
        update_wrapper(self, function)

    def __call__(self, *arguments: Any) -> Any:
        """What the function returns. Raises MachineCodeNeededError where it is interpreted, and that takes too long."""
        interpretation = _INTERPRETATION.get()
        if interpretation is None or "compiled" in self.__dict__ or not interpretation.takes(self.name):
            return self.compiled(*arguments)
        try:
            with np.errstate(all="ignore"):
                return self.function(*arguments)
        except ArithmeticError:  # of Python's own numbers, which NumPy's would have a value for
            raise MachineCodeNeededError from None

    @cached_property
    def compiled(self) -> Any:
        """Its machine code, made when it is first called."""
        return _machine().compiled_kernel(self.function)

    def in_machine_code(self) -> Any:
        """What other kernels call."""
        return self.compiled

    def for_the_same_types(self) -> Callable[..., Any]:
        """What runs it, as just now, with arguments of exactly the same types, without looking at those again.

        To find out the types of many arrays takes longer than a short run.
        """
        if "compiled" not in self.__dict__:
            return self
        known: Callable[..., Any] = self._first_code if len(self.compiled.overloads) == 1 else self.compiled
        return known

    @cached_property
    def _first_code(self) -> Any:
        """The machine code for the types that came first. It does not look at them, so that others must not come."""
        return next(iter(self.compiled.overloads.values())).entry_point


class KernelCalls:
    """Runs kernels for one who gives each of them arguments of the same types every time."""

    def __init__(self) -> None:
        self._known: dict[object, Callable[..., Any]] = {}

    def __call__(self, kernel: Any, *arguments: Any) -> Any:
        """What the kernel returns. Raises MachineCodeNeededError as it does."""
        known = self._known.get(kernel)
        if known is not None:
            return known(*arguments)
        found = kernel(*arguments)
        self._known[kernel] = kernel.for_the_same_types()
        return found


def kernel(function: F) -> F:
    """A function that is compiled for itself and kept on disk; sums are not reordered (see `machine`)."""
    return cast("F", Kernel(function))


def subroutine(function: F) -> F:
    """A part of kernels that is always called: too large to be there more than once."""
    return _part(function, is_inlined=False)


def inline(function: F) -> F:
    """A part of kernels that is always inlined, since a call would pass seven words for each array."""
    return _part(function, is_inlined=True)


def _part(function: F, *, is_inlined: bool) -> F:
    def in_machine_code() -> Any:
        return _machine().compiled_part(function, is_inlined=is_inlined)

    function.in_machine_code = in_machine_code  # type: ignore[attr-defined]
    return function


def instruction(function: F) -> F:
    """A part whose machine code stands in `instructions` under the same name; this is what the interpreter does."""

    def in_machine_code() -> Any:
        return getattr(import_module("deltaq.simulation.kernels.instructions"), function.__name__)

    function.in_machine_code = in_machine_code  # type: ignore[attr-defined]
    return function


class Callback:
    """A function with a fixed signature that machine code calls by its address; made when first asked for."""

    def __init__(self, function: Callable[..., Any], signature: str) -> None:
        self.function, self.signature, self.name = function, signature, name_of(function)
        self.__doc__ = function.__doc__

    @property
    def address(self) -> int:
        """Where it is, as long as the process lives."""
        interpretation = _INTERPRETATION.get()
        if interpretation is None or "compiled" in self.__dict__ or not interpretation.takes(self.name):
            return int(self.compiled.address)
        return int(ctypes.cast(self._called, ctypes.c_void_p).value or 0)

    @cached_property
    def compiled(self) -> Any:
        """Its machine code."""
        return _machine().compiled_callback(self.function, self.signature)

    @cached_property
    def _called(self) -> Any:
        """A function of C that calls the interpreter; what is raised there is raised behind it (`checkpoint`)."""
        returned, _, given = self.signature.removesuffix(")").partition("(")

        def guarded(*arguments: Any) -> Any:
            try:
                with np.errstate(all="ignore"):
                    return self.function(*arguments)
            except Exception as error:  # noqa: BLE001  nothing can be raised through C
                found = _INTERPRETATION.get()
                if found is not None:
                    found.failure = MachineCodeNeededError() if isinstance(error, ArithmeticError) else error
                return None if returned == "void" else 0

        return ctypes.PYFUNCTYPE(KINDS[returned], *(KINDS[each] for each in given.split(", ")))(guarded)


def callback(signature: str) -> Callable[[Callable[..., object]], Callback]:
    """A function that machine code calls by its address: a compiled model made around another, say.

    The signature names what is returned and given, `void(int64, float64)`.
    """

    def wrapped(function: Callable[..., object]) -> Callback:
        return Callback(function, signature)

    return wrapped


@inline
def runtime_int(number: int) -> int:
    """The number, no longer a literal: Numba compiles a function once more for each literal it is called with."""
    return int(number)

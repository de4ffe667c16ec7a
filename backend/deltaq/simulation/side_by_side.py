"""Two computations at once, where a processor is free."""

from __future__ import annotations

import _thread
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import suppress
from contextvars import copy_context
from typing import TypeVar

A = TypeVar("A")
B = TypeVar("B")


def side_by_side(first: Callable[[], A], second: Callable[[], B]) -> tuple[A, B]:
    """Both results. What either of them raises is raised here.

    The second is computed by another thread if that gets a processor before the first is done, else afterwards by this
    one: nothing waits for a thread to be started, as `Thread.start` would, for long on a busy machine.
    """
    promise: Future[B] = Future()

    def fulfil() -> None:
        if promise.set_running_or_notify_cancel():
            try:
                promise.set_result(second())
            except Exception as error:  # noqa: BLE001  it is raised where the result is wanted
                promise.set_exception(error)

    with suppress(RuntimeError):  # where there may be no more threads
        _thread.start_new_thread(copy_context().run, (fulfil,))
    try:
        result = first()
    except BaseException:
        promise.cancel()
        raise
    return result, second() if promise.cancel() else promise.result()

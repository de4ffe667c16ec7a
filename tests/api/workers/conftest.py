from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack

import pytest

from deltaq.api.workers.pool import Pool
from deltaq.api.workers.worker_thread import Limits

MakePool = Callable[..., Pool]


@pytest.fixture
def make_pool() -> Iterator[MakePool]:
    """Pools whose workers are all up, and which are stopped at the end of the test."""
    with ExitStack() as stack:

        def make(size: int = 1, queue_length: int = 100, reserve: int = 0, **limits: float) -> Pool:
            chosen = {"memory": 2**31, "jobs": 10_000, "start_timeout": 30.0, "queue_timeout": 30.0} | limits
            # A fork server that is started again loads what the last pool wanted.
            pool = Pool(size, queue_length, Limits(**chosen), reserve=reserve)
            pool.start()
            stack.callback(pool.stop, 0.1)
            while pool.state.ready < size + reserve:
                time.sleep(0.005)
            return pool

        yield make

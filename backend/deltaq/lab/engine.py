"""Where the parts of a map are worked out: on the processors of this machine, or on a cluster that Dask keeps."""

from __future__ import annotations

import logging
import os
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import contextmanager
from importlib import import_module
from threading import Event, Thread
from typing import Any

import numpy as np

from ..simulation.integration import Flag

LOGGER = logging.getLogger("deltaq.lab")
SCHEDULER = "DELTAQ_SCHEDULER"  # environment variable with the address of Dask's scheduler
RETRIES = 3  # of a part whose worker was lost
CLUSTER_TIMEOUT = 5.0  # seconds for the cluster to answer; then this machine does it
LOOK_UP = 0.2  # seconds between two looks at whether a part is still wanted


@contextmanager
def engine() -> Iterator[Executor]:
    """An executor for the parts of one map.

    What it is given must be pickled and give the same wherever it is worked out; then parts that are lost with a worker
    of the cluster are worked out by another, and the map is the same. When the map is given up, or its process killed,
    the cluster drops the parts that wait, and those under way end if they work `while_wanted`.
    """
    with cluster() as found:
        if found is not None:
            yield found
            return
    with ThreadPoolExecutor(os.cpu_count()) as threads:
        yield threads


@contextmanager
def cluster() -> Iterator[Executor | None]:
    """The cluster that the environment names, as an executor (see `engine`); None without one that works."""
    client = _cluster()
    if client is None:
        yield None
        return
    with client:  # all that it asked for is dropped at its end
        yield client.get_executor(retries=RETRIES, pure=False)


def _cluster() -> Any:
    """A client of the cluster that the environment names; None if there is none, or none that works."""
    address = os.environ.get(SCHEDULER)
    if not address:
        return None
    client = None
    try:
        client = import_module("distributed").Client(address, set_as_default=False, timeout=CLUSTER_TIMEOUT)
        client.wait_for_workers(1, timeout=CLUSTER_TIMEOUT)
    except (ImportError, OSError) as error:  # a TimeoutError is an OSError
        LOGGER.warning("a map is worked out here, for the cluster does not answer: %s", type(error).__name__)
        if client is not None:
            client.close()
        return None
    return client


@contextmanager
def while_wanted(cancelled: Flag) -> Iterator[Flag]:
    """A flag that is set when nobody wants any more what this thread works out.

    On a cluster the part has only a copy of the flag it was given, so a watcher asks the worker and sets another.
    """
    wanted = _wanted_by_the_cluster()
    if wanted is None:
        yield cancelled
        return
    flag, done = np.zeros_like(cancelled), Event()

    def watch() -> None:
        while not done.wait(LOOK_UP):
            if not wanted():
                flag[0] = 1
                return

    Thread(target=watch, name="deltaq-wanted", daemon=True).start()
    try:
        yield flag
    finally:
        done.set()


def _wanted_by_the_cluster() -> Callable[[], bool] | None:
    """Asks whether the task of this thread is still wanted; None if it is no task of a cluster."""
    distributed = sys.modules.get("distributed")  # where it is not loaded, nothing is its task
    try:
        worker = distributed.get_worker() if distributed else None
    except ValueError:
        return None
    if worker is None:
        return None
    key = worker.get_current_task()

    def wanted() -> bool:
        task = worker.state.tasks.get(key)
        return task is not None and task.state != "cancelled"

    return wanted

"""Where the parts of a map are worked out: on the processors of this machine, or on a cluster that Dask keeps."""

from __future__ import annotations

import os
from collections.abc import Iterator
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import contextmanager
from importlib import import_module

SCHEDULER = "DELTAQ_SCHEDULER"  # environment variable with the address of Dask's scheduler
RETRIES = 3  # of a part whose worker was lost


@contextmanager
def engine() -> Iterator[Executor]:
    """An executor for the parts of one map.

    What it is given must be pickled and give the same wherever it is worked out; then parts that are lost with a worker
    of the cluster are worked out by another, and the map is the same.
    """
    address = os.environ.get(SCHEDULER)
    if not address:
        with ThreadPoolExecutor(os.cpu_count()) as threads:
            yield threads
        return
    with import_module("distributed").Client(address, set_as_default=False) as client:
        yield client.get_executor(retries=RETRIES, pure=False)

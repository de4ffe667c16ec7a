"""Workers are born warm, from a process of one thread."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

PROBE = """
import asyncio, json
from deltaq.api.workers.job import Job
from deltaq.api.workers.lane import Limits
from deltaq.api.workers.pool import Pool

async def main():
    pool = Pool(1, 4, Limits(2**31, 10, 60.0, 60.0), ["deltaq.api.workers.preload"])
    pool.start()
    print((await pool.run(Job("tests.api.workers.jobs:birth", 60.0), None)).decode())
    pool.stop()

asyncio.run(main())
"""


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_workers_are_born_with_the_libraries_from_a_process_of_one_thread(root: Path) -> None:
    probe = subprocess.run([sys.executable, "-c", PROBE], cwd=root, capture_output=True, text=True, check=True)
    assert json.loads(probe.stdout) == {
        "threads_of_parent": 1,
        "threads": 1,
        "loaded": ["numba", "numpy", "symengine", "sympy"],
    }

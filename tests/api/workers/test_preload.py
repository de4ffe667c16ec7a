"""Workers are born warm, from a process of one thread."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from deltaq.api.workers.kernels import are_compiled

PROBE = """
import asyncio, json
from deltaq.api.workers.job import Job
from deltaq.api.workers.worker_thread import Limits
from deltaq.api.workers.pool import Pool

async def main():
    pool = Pool(1, 4, Limits(2**31, 10, 60.0, 60.0))
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


LOADED = """
import json, sys
import deltaq.api.workers.preload
print(json.dumps(["deltaq.narration.derive" in sys.modules, "deltaq.simulation.kernels.compiler" in sys.modules]))
"""


@pytest.mark.parametrize(
    "compiled",
    [
        pytest.param(False, id="nobody waits for the compiler"),
        pytest.param(
            True,
            id="kernels are loaded",
            marks=pytest.mark.skipif(not are_compiled(), reason="the kernels of this machine are not compiled yet"),
        ),
    ],
)
def test_what_is_loaded(tmp_path: Path, *, compiled: bool) -> None:
    environment = os.environ | ({} if compiled else {"NUMBA_CACHE_DIR": str(tmp_path)})
    probe = subprocess.run([sys.executable, "-c", LOADED], env=environment, capture_output=True, text=True, check=True)
    assert json.loads(probe.stdout) == [True, True]
    assert compiled or list(tmp_path.rglob("*.nbc")) == []

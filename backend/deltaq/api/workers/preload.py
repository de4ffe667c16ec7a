"""Imported once by the fork server, so that each worker is born with the libraries in place.

The one module whose import has an effect, which is its purpose: the fork server knows no other way.
"""

from __future__ import annotations

import gc
import os
from contextlib import suppress
from importlib import import_module

# A worker is one thread; and the thread pools of these libraries do not survive a fork.
for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ[variable] = "1"

for module in ("deltaq.api.jobs", "deltaq.narration.derive", "deltaq.simulation.service"):
    with suppress(Exception):  # whoever needs it will report it
        import_module(module)

gc.collect()
gc.freeze()  # what is there now is shared by all workers; the collector must not touch its pages

"""Imported once by the fork server, so that each worker is born with the libraries loaded and warm.

The one module whose import has an effect, which is its purpose: the fork server knows no other way.
"""

from __future__ import annotations

import gc
import os
from contextlib import suppress
from importlib import import_module

from .kernels import are_compiled
from .limits import die_with_parent

SCENE = "pendulum"


def load() -> None:
    """Import what the jobs need and run it once; what fails here is reported by the job that needs it."""
    die_with_parent()  # else it would go on loading when the web process has ended meanwhile
    # A worker is one thread; and thread pools do not survive a fork.
    for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"):
        os.environ[variable] = "1"
    gc.disable()  # nearly all that is made here stays
    with suppress(Exception):
        import_module("deltaq.api.jobs")
    with suppress(Exception):
        import_module("deltaq.narration.derive").derive_request({"scene": SCENE})
    with suppress(Exception):
        catalogs = import_module("deltaq.narration.catalog")
        for language in catalogs.LANGUAGES:
            catalogs.catalog(language)  # texts to be read from files
    with suppress(Exception):  # which has the tightest bound of a processor of all jobs
        import_module("deltaq.narration.expressions").typeset_request({"scene": SCENE, "expression": "sin(t)"})
    with suppress(Exception):
        service = import_module("deltaq.simulation.service")
        if are_compiled():  # compiling them here would keep all workers waiting
            service.warm()
    gc.freeze()  # what is there now is shared by all workers; the collector must not touch its pages
    gc.enable()


load()

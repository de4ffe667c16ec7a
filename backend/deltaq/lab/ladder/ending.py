"""How far the full motion is known, and why no further: verdicts are given for that part alone.

The words are told to programs; `labs.fidelity.ending` in the catalogs has the sentences.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from ...contract.experiments.fidelity import Ending
from .distance import Yardstick
from .measurement import RungRun, yardstick
from .passages import determined_until
from .verdict import lasts

WHOLE: Final = ""
START: Final = "start"  # it cannot begin: the coordinates fail in the initial state, or a law has no value there
PASSAGE: Final = "passage"  # it comes to a state behind which it is not determined
DIGITS: Final = "digits"  # the error of the computation is no longer far below the one that is allowed
EVENT: Final = "event"
ENDED: Final = "ended"  # in another way, as its outcome says: it grows beyond bounds, or comes to rest


def known(run: RungRun, tolerance: float) -> tuple[Yardstick, Ending]:
    """The full motion as long as it is determined and far more accurate than `tolerance`, and why no longer."""
    full = yardstick(run, tolerance)
    passage = determined_until(full)
    if passage < np.inf:
        return yardstick(run, tolerance, passage), PASSAGE
    return full, _ending(run, full)


def _ending(run: RungRun, full: Yardstick) -> Ending:
    if not full.end > 0.0:
        return DIGITS if run.trajectory.reached > 0.0 else START
    if lasts(full.end, run.problem.t_end):
        return WHOLE
    if run.gives_out or not lasts(full.end, run.trajectory.reached):
        return DIGITS
    return EVENT if run.trajectory.event is not None else ENDED

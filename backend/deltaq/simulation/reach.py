"""When a motion is given up because no number of steps that is allowed would bring it to its end.

It is looked at once it has taken a part of the steps. It is far from its end if even all of them would bring it nowhere
at that pace; and lost if its steps do not become longer, as half of that part tell: a motion that slows down may yet
come to the end.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .problem import Floats

PART = 16  # of the steps that are allowed: after so large a part it is looked
REACH = 0.1  # of the span: motions that would not come so far are given up
LONGER = 2.1  # times the time of half of the steps: more than twice, by more than chance, and steps become longer


def is_far(gone: float | Floats, span: float) -> NDArray[np.bool_]:
    """Whether motions that came so many seconds, shape (…,), with a part of the steps, would come nowhere with all."""
    return np.asarray((np.asarray(gone) > 0.0) & (PART * np.asarray(gone) < REACH * span))


def is_steady(gone: float | Floats, half: float | Floats) -> NDArray[np.bool_]:
    """Whether steps do not become longer: `half` of them came so many seconds, shape (…,)."""
    return np.asarray(np.asarray(gone) <= LONGER * np.asarray(half))

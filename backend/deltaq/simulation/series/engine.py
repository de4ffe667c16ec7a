"""Which code a model's series run in: code that is compiled quickly at first, faster code in the long run."""

from __future__ import annotations

from ...model.model import Model
from .code import QUICK, THOROUGH, host
from .generated import Jet, jet_of

LANES = 8  # motions side by side where few are marched in rounds: the fewer rounds, the better


def lanes_of_host() -> int:
    """Those of a whole ensemble, of which each lane has many: one vector of this processor, but four at least.

    With two vectors a processor that has registers for one spends more time on memory than it saves by waiting less.
    """
    return max(4, host().width)


def jet_of_model(model: Model, *, is_long: bool, lanes: int = 1) -> Jet:
    """The code for a model's series; made once for each effort, and the thorough one serves all once it is there."""
    effort = THOROUGH if is_long or model.has(("jet", lanes, THOROUGH)) else QUICK
    return model.kept(("jet", lanes, effort), lambda: jet_of(model.recurrences, lanes, effort))

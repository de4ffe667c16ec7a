"""What may be asked of an experiment. Light: the web process reads it, too."""

from __future__ import annotations

LONGEST, SPAN = 1000.0, 10.0  # seconds of motion: at most, and usually
SHORTEST = 1e-6  # below it differences of times are lost in rounding
TOLERANCES_OF_MODEL = (1e-9, 10.0)  # relative error of a simpler model
LOCAL_TOLERANCES = (1e-13, 1e-1)
DRIFT_STEPS, USUAL_DRIFT = (1_000, 1_000_000), 100_000
MAP_POINTS, USUAL_MAP = (8, 400), 200  # on a side of the stability map
APART = (1e-15, 1.0)  # of twins at first
FLIP_POINTS, USUAL_FLIPS = (16, 160), 96  # on a side of the map of flips
CHAOS_LONGEST, CHAOS_SPAN = 200.0, 30.0
AT = ("state", "rest")  # where the stability lab linearizes

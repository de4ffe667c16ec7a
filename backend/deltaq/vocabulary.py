"""The words of answers that programs decide by, declared once for who says them and who describes them."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Literal

# The languages of the texts.
Language = Literal["de", "en"]
# The method that chooses one.
AUTO = "auto"
# How a computation of a motion ended.
Status = Literal[
    "ok",
    "event",
    "stopped",
    "cancelled",
    "step_limit",
    "singular_mass_matrix",
    "diverged",
    "newton_failed",
    "stiff",
    "unresolved",
    "step_blind",
    "horizon_reached",
    "tolerance_missed",
    "guide_jumps",
    "singular_constraints",
    "singular",
]
# The same of a run among many, which was not tried where the one before took too long.
TriedStatus = Literal[Status, "too_slow"]
# The same of a simpler model in the ladder, whose derivation may be refused.
RungStatus = Literal[Status, "refused"]
# How the search for points of a section along a motion ended: it never met it, lay in it, or met it as often as wanted.
SectionStatus = Literal[RungStatus, "never_met", "contained", "full"]
# What the linearization says of a state of rest.
Stability = Literal["stable", "undecided", "unstable"]
# What it leaves open: neighbours at rest, too; forces across the velocity that hold it; zero eigenvalues; friction.
StabilityKind = Literal["family", "gyroscopic", "degenerate", "band"]
# What a range of rest ends at: where forces overcome friction, where one of them jumps or bends, or a wall.
RangeEnd = Literal["force", "kink", "bend", "contact"]
# Why a search for equilibria is not complete: its operations were spent, equilibria are not isolated, or constraints
# depend on one another in some of them; or those at kinks, on contacts, or held by friction were not all sought.
SearchEnd = Literal["budget", "continuum", "singular", "kinks", "contacts", "friction"]
# Parts that a derivation is complete without, and why one is missing: it has not been asked for, its operations were
# spent, its time was over, it failed, or it is not made for scenes with constraints, or on rates, or such as
# follow from others; and of multipliers written out: they are too long or too many. `steps` are those
# of chapters before the last.
OptionalPart = Literal[
    "steps",
    "multipliers",
    "model",
    "equilibria",
    "contact-equilibria",
    "kink-equilibria",
    "small-motions",
    "integrals",
    "relative-equilibria",
    "canonical",
]
Missing = Literal["later", "budget", "time", "failed", "constraints", "rates", "long", "many", "dependent", "ended"]
# What is added to the name of a part that is missing for a reason of the scene's own, to name the sentence about it.
OWN_REASONS: Mapping[Missing, str] = MappingProxyType(
    {
        "constraints": "-constrained",
        "rates": "-rates",
        "long": "-long",
        "many": "-many",
        "dependent": "-dependent",
        "ended": "-ended",
        "time": "-time",
    }
)
# Among which generators symmetries are sought: those affine in coordinates and time; motions of space and rigid bodies.
GeneratorFamily = Literal["affine", "motions-of-space"]
# What a scene holds fixed: a length, one of several rods, a rod with mass, places, an angle, a guided coordinate.
HoldKind = Literal["length", "scaled", "lengths", "rod", "place", "angle", "guide"]
# What happens where a motion goes on.
TransitionKind = Literal["impact", "rest", "release", "stick", "slip", "turn", "slide", "leave"]
# Whether a load has a potential, by the curl of its generalized forces.
CurlOutcome = Literal[
    "conservative",
    "conservative-in-time",
    "single",
    "single-in-time",
    "no-closed-form",
    "rates",
    "generalized",
    "nonconservative",
]
# What one term of an answer has wrong.
SlipKind = Literal[
    "sign",
    "missing",
    "half",
    "double",
    "factor",
    "superfluous",
    "factor-missing",
    "factor-superfluous",
    "function",
    "argument",
    "power",
    "name",
    "rate",
    "exchanged",
    "components",
]
# What the checker says of an answer, and of one of its parts.
PartOutcome = Literal["correct", "wrong", "undecided"]
Outcome = Literal["correct", "wrong", "undecided", "invalid", "follow_through"]
Severity = Literal["error", "warning"]
# What holds the functions of a functional at its ends, at both or at the lower and the upper one.
Ends = Literal[
    "fixed", "hinged", "free", "fixed-hinged", "fixed-free", "hinged-fixed", "hinged-free", "free-fixed", "free-hinged"
]

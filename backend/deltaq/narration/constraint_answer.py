"""Constraints, contacts and reactions as data: expressions as plain text, as LaTeX and in words."""

from __future__ import annotations

from ..derivation.held_reactions import held_reactions, reaction_impulses, rivals
from ..derivation.impacts import Contact, Impact, Sticking
from ..derivation.released import Release
from ..derivation.result import Bound
from ..language.plain_printer import plain
from ..mechanics.release import held
from ..mechanics.scene import Scene
from .expression_writer import ExpressionWriter

Document = dict[str, object]


def constraint(bound: Bound, write: ExpressionWriter) -> Document:
    """A constraint, its multiplier, and the reactions that keep it."""
    return {
        "name": bound.name,
        "kind": bound.kind,
        "holonomic": bound.is_holonomic,
        "equation": write.equated(bound.equation),
        "multiplier": write.written(bound.multiplier),
        "reaction": None if bound.reaction is None else write.written(bound.reaction),
        "forces": [{"coordinate": q, **write.written(force)} for q, force in bound.forces.items()],
    }


def reaction(release: Release, write: ExpressionWriter) -> Document:
    """What holds what was released; of a rod or string also its force, which is the negative."""
    shift = release.held.shift
    force = release.system.display(-release.value) if release.is_of_rod else None
    return {
        "name": release.name,
        "kind": release.kind,
        "reaction": write.written(release.value),
        "closed": release.closed is not None,
        "force": None if force is None else write.written(force),
        "at": shift.rod.start if shift and shift.rod else None,
        "displacements": {place: [plain(x) for x in along] for place, along in release.displacements.items()},
        **({"held": held_ones} if (held_ones := _held(release, write)) else {}),
        **({"impulses": impulses} if (impulses := _impulses(release, write)) else {}),
        **({"shared_with": list(shared)} if (shared := rivals(release)) else {}),
    }


def _held(release: Release, write: ExpressionWriter) -> list[Document]:
    """Z while something sticks or rests."""
    return [
        {"kind": each.kind, "name": each.name, "reaction": None if each.value is None else write.written(each.value)}
        for each in held_reactions(release)
    ]


def _impulses(release: Release, write: ExpressionWriter) -> list[Document]:
    """Ẑ at impacts."""
    found = reaction_impulses(release)
    return [{"event": each.event.name, "impulse": write.written(each.value)} for each in found]


def releasable(scene: Scene, write: ExpressionWriter) -> list[Document]:
    """What the scene holds fixed."""
    symbols = {symbol.name: symbol.typeset for symbol in scene.names.symbols}
    return [
        {"name": each.name, "kind": each.kind, "latex": symbols[each.name], "spoken": write.speech.name(each.name)}
        for each in held(scene)
    ]


def contact(found: Contact, write: ExpressionWriter) -> Document:
    """A contact, and what an impact does: null where that would be too long to be read."""
    impact = found.impact
    return {
        "name": found.name,
        "gap": write.written(found.gap),
        "restitution": write.written(found.restitution),
        "impact": None
        if impact is None
        else {
            "impulse": write.written(impact.impulse),
            "momentum_jumps": [{"coordinate": q, **write.written(jump)} for q, jump in impact.momenta.items()],
            "rate_jumps": [{"coordinate": q, **write.written(jump)} for q, jump in impact.rates.items()],
            "energy_loss": write.written(impact.loss),
            **({"constraint_impulses": _answers(impact, write)} if impact.answers else {}),
        },
    }


def _answers(impact: Impact, write: ExpressionWriter) -> list[Document]:
    """The impulses by which constraints answer."""
    return [{"constraint": name, **write.written(value)} for name, value in impact.answers.items()]


def sticking(found: Sticking, write: ExpressionWriter) -> Document:
    """What friction holds with, and at most."""
    return {"load": found.load, "holding": write.written(found.holding), "largest": write.written(found.largest)}

"""How a computation ended, in sentences."""

from __future__ import annotations

from typing import Any

from ..vocabulary import OWN_REASONS, Missing, OptionalPart
from .catalog import text
from .prose import plain

Document = dict[str, Any]


def explained(answer: Document, language: str) -> Document:
    """`reason`, `remedy`, the event and why the method was chosen in words, from what the simulation gave."""
    code, parameters, event = answer["reason"]["code"], answer["reason"]["parameters"], answer["event"]
    if event:
        event = {**event, "title": event["title"].get(language) or event["name"]}
        parameters = {**parameters, "title": event["title"]}
    told = {part: plain(text(language, f"statuses.{code}.{part}", **parameters)) for part in ("reason", "remedy")}
    choice = answer["choice"]
    why = choice and plain(text(language, f"statuses.{choice['code']}.reason", **choice["parameters"]))
    return {**told, "choice": why, "event": event}


def outcomes_explained(outcomes: Document, language: str) -> Document:
    """`reasons`: for each status the sentences about it, of the first run that has it."""
    reasons = {}
    for status, (code, parameters) in outcomes.items():
        told = (plain(text(language, f"statuses.{code}.{part}", **parameters)) for part in ("reason", "remedy"))
        reasons[status] = " ".join(part for part in told if part)
    return {"reasons": reasons}


def missing(part: OptionalPart, reason: Missing, language: str) -> Document:
    """A part of a derivation that is not there, why, and what to do about it."""
    outcome = f"{part}{OWN_REASONS.get(reason, '')}"
    key = f"rules.left-out.{reason}" if part == "model" else f"rules.steps.left-out.{outcome}"
    return {"part": part, "reason": reason, "text": plain(text(language, key))}

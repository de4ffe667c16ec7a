"""Events: what ends a simulation, or where bodies meet and part again."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from ..errors import Problem
from ..language.expression import Expression
from ..language.functions import KINKED
from ..language.tree import Call, Rate, walk
from .checks import demand, name_problem
from .reader import Reader
from .user_text import Translated, UserText


@dataclass(frozen=True)
class Event:
    """Something that happens when value(q, q̇, t) falls through zero from above.

    A string goes slack, a contact opens: as long as the value (the tension, the normal force) is positive, the scene
    holds. `then` says what happens: nothing said, the motion ends; "bounce": the value g(q, t) is a gap that closes,
    and the bodies part with `restitution` (0 … 1) times the rate at which they met. `title` says in each language what
    happens, as a sentence without its full stop; `at` is the place that the drawing marks, if any.
    """

    name: str
    value: Expression
    title: Translated = field(default_factory=dict)
    at: str | None = None
    then: str | None = None
    restitution: Expression | None = None

    def __post_init__(self) -> None:
        faster = (node for node in walk(self.value.tree) if isinstance(node, Rate) and node.order > 1)
        problems = (Problem("event-with-acceleration", "/value", parameters={"coordinate": n.name}) for n in faster)
        demand(name_problem(self.name), next(problems, None), *self._of_impact())

    def _of_impact(self) -> Iterator[Problem]:
        if self.then not in (None, "end", "bounce"):
            yield Problem("unknown-ending", "/then", parameters={"name": str(self.then)[:40]})
        if not self.bounces:
            if self.restitution is not None and self.then in (None, "end"):
                yield Problem("restitution-without-bounce", "/restitution")
            return
        if self.restitution is None:
            yield Problem("missing-field", "/restitution", parameters={"field": "restitution"})
        for rate in sorted(self.value.rates)[:1]:
            yield Problem("bounce-with-rate", "/value", parameters={"coordinate": rate})
        kinks = (node for node in walk(self.value.tree) if isinstance(node, Call) and node.function in KINKED)
        for kink in kinks:
            place = kink.span
            yield Problem("bounce-not-smooth", "/value", place.offset, place.length, {"function": kink.function})

    @property
    def bounces(self) -> bool:
        """Whether the motion goes on behind it, by an impact."""
        return self.then == "bounce"

    @classmethod
    def read(cls, table: Reader) -> Event:
        """The event in a table of a scene document."""
        at = table.place("at") if "at" in table.table else None
        then = table.text("then", "") or None
        restitution = table.expression("restitution") if "restitution" in table.table else None
        return cls(table.name(), table.expression("value"), table.translated("title"), at, then, restitution)

    def __hash__(self) -> int:
        return hash((self.name, self.value, self.then, self.restitution))

    def called(self, language: str) -> UserText:
        """What happens, in a language; the name where there is no title."""
        return self.title.get(language) or UserText(self.name)

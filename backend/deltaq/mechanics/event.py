"""Events: what ends a simulation."""

from __future__ import annotations

from dataclasses import dataclass, field

from ..errors import Problem
from ..language.expression import Expression
from ..language.tree import Rate, walk
from .checks import demand, name_problem
from .reader import Reader
from .user_text import Translated, UserText


@dataclass(frozen=True)
class Event:
    """Something that ends the scene's validity: it happens when value(q, q̇, t) falls through zero from above.

    A string goes slack, a contact opens: as long as the value (the tension, the normal force) is positive, the scene
    holds. `title` says in each language what happens, as a sentence without its full stop; `at` is the place that the
    drawing marks, if any.
    """

    name: str
    value: Expression
    title: Translated = field(default_factory=dict)
    at: str | None = None

    def __post_init__(self) -> None:
        faster = (node for node in walk(self.value.tree) if isinstance(node, Rate) and node.order > 1)
        problems = (Problem("event-with-acceleration", "/value", parameters={"coordinate": n.name}) for n in faster)
        demand(name_problem(self.name), next(problems, None))

    @classmethod
    def read(cls, table: Reader) -> Event:
        """The event in a table of a scene document."""
        at = table.place("at") if "at" in table.table else None
        return cls(table.name(), table.expression("value"), table.translated("title"), at)

    def __hash__(self) -> int:
        return hash((self.name, self.value))

    def called(self, language: str) -> UserText:
        """What happens, in a language; the name where there is no title."""
        return self.title.get(language) or UserText(self.name)

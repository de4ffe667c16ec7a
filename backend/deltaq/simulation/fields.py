"""The fields of a request, read one by one: every problem is collected with its JSON pointer."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from ..errors import Problem, escaped


@dataclass
class Fields:
    """The fields of a document; problems are collected, so that a user sees all of them at once."""

    document: Mapping[str, object]
    problems: list[Problem] = field(default_factory=list)

    def complain(self, code: str, pointer: str, **parameters: str | float) -> None:
        """Notes a problem by its code in the catalog and its JSON pointer."""
        self.problems.append(Problem(code, pointer, parameters=parameters))

    def number(
        self, key: str, low: float, high: float, *, closed: bool = False, required: bool = False
    ) -> float | None:
        """A number in (low, high], or in [low, high] if `closed`."""
        given = self.document.get(key)
        if given is None:
            if required:
                self.complain("missing-field", f"/{key}", field=key)
            return None
        found = self._number(given, f"/{key}")
        if found is not None and not (low < found <= high or (closed and found == low)):
            self.complain("request-outside", f"/{key}", value=found, min=low, max=high)
            return None
        return found

    def _number(self, given: object, pointer: str) -> float | None:
        if isinstance(given, bool) or not isinstance(given, int | float):
            self.complain("request-not-number", pointer)
            return None
        try:
            found = float(given)
        except OverflowError:
            found = math.inf
        if math.isfinite(found):
            return found
        self.complain("request-not-finite", pointer)
        return None

    def whole(self, key: str, low: int, high: int, default: int) -> int:
        """A whole number between two bounds, both allowed."""
        given = self.document.get(key)
        if given is None:
            return default
        if isinstance(given, bool) or not isinstance(given, int):
            self.complain("request-not-integer", f"/{key}")
        elif not low <= given <= high:
            self.complain("request-outside", f"/{key}", value=str(given)[:20], min=low, max=high)
        else:
            return given
        return default

    def text(self, key: str, default: str) -> str:
        """A text, or the default if nothing is said."""
        given = self.document.get(key)
        return self._text(default if given is None else given, f"/{key}")

    def _text(self, given: object, pointer: str) -> str:
        if isinstance(given, str):
            return given
        self.complain("request-not-text", pointer)
        return ""

    def flag(self, key: str) -> bool:
        """Whether something is wanted; not, if nothing is said."""
        given = self.document.get(key)
        if given is None or isinstance(given, bool):
            return bool(given)
        self.complain("request-not-flag", f"/{key}")
        return False

    def names(self, key: str) -> tuple[str, ...]:
        """A list of texts, empty if nothing is said."""
        return tuple(self._text(name, f"/{key}/{i}") for i, name in enumerate(self._list(key)))

    def _list(self, key: str) -> tuple[object, ...]:
        given = self.document.get(key)
        if given is None or isinstance(given, list | tuple):
            return tuple(given or ())
        self.complain("request-not-array", f"/{key}")
        return ()

    def _table(self, given: object, pointer: str) -> dict[str, object]:
        if given is None or isinstance(given, Mapping):
            return {str(key): value for key, value in (given or {}).items()}
        self.complain("request-not-object", pointer)
        return {}

    def numbers(self, key: str) -> dict[str, float]:
        """Finite numbers by name; what is null is left out."""
        given = self._table(self.document.get(key), f"/{key}")
        return dict(self._finite(given, f"/{key}"))

    def _finite(self, given: Mapping[str, object], pointer: str) -> Iterator[tuple[str, float]]:
        for name, value in given.items():
            number = None if value is None else self._number(value, f"{pointer}/{escaped(name)}")
            if number is not None:
                yield name, number

    def initial(self) -> dict[str, dict[str, float]]:
        """Initial values by coordinate, each with `value`, `rate`, or both."""
        found = {}
        for name, given in self._table(self.document.get("initial"), "/initial").items():
            pointer = f"/initial/{escaped(name)}"
            table = self._table(given, pointer)
            for key in sorted(table.keys() - {"value", "rate"}):
                self.complain("unknown-field", f"{pointer}/{escaped(key)}", field=key[:40])
            found[name] = dict(self._finite(table, pointer))
        return found

    def guides(self) -> tuple[dict[str, str], ...]:
        """Pairs of `coordinate` and `value`, as texts."""
        tables = [self._table(given, f"/guides/{i}") for i, given in enumerate(self._list("guides"))]
        return tuple(
            {key: self._text(table.get(key), f"/guides/{i}/{key}") for key in ("coordinate", "value")}
            for i, table in enumerate(tables)
        )

    def some_of(self, key: str, parts: tuple[str, ...]) -> frozenset[str]:
        """The parts wanted; all of them if none is named."""
        wanted = self.names(key)
        for index, part in enumerate(wanted):
            if part not in parts:
                self.complain("request-not-one-of", f"/{key}/{index}", expected=", ".join(parts))
        return frozenset(wanted or parts)

    def one_of(self, key: str, choices: tuple[str, ...]) -> str:
        """One of the choices; the first if none is named."""
        wanted = self.text(key, choices[0])
        if wanted not in choices:
            self.complain("request-not-one-of", f"/{key}", expected=", ".join(choices))
        return wanted

    def reject_all_but(self, known: tuple[str, ...]) -> None:
        """Complains of every field that is not known."""
        for key in sorted(self.document.keys() - set(known)):
            self.complain("unknown-field", f"/{escaped(key)}", field=key[:40])

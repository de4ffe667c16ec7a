"""Results kept with the object that computed them, so that they go when it goes."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any, Concatenate, ParamSpec, TypeVar, cast

P = ParamSpec("P")
S = TypeVar("S")
T = TypeVar("T")
MISSING: Any = object()
HASH = "hash of all levels"


def cached_method(method: Callable[Concatenate[S, P], T]) -> Callable[Concatenate[S, P], T]:
    """The method, computing its answer for the same arguments only once for each object.

    A subclass's method of the same name keeps its answers apart, so that `super().f()` is what the class above says.
    """
    place = f"answers of {method.__module__}.{method.__qualname__}"

    @wraps(method)
    def recalling(self: S, *args: P.args, **kwargs: P.kwargs) -> T:
        own = self.__dict__
        answers: dict[object, Any] = own[place] if place in own else own.setdefault(place, {})
        known = (args, *kwargs.items()) if kwargs else args
        found: T = answers.get(known, MISSING)
        if found is MISSING:
            found = answers[known] = method(self, *args, **kwargs)
        return found

    return cast("Callable[Concatenate[S, P], T]", recalling)


def hashed_once(kind: type[T]) -> type[T]:
    """The frozen dataclass, its hash kept with each object: that of a tree goes through all its levels."""
    by_fields = kind.__hash__

    def remembering(self: object) -> int:
        own = self.__dict__
        if HASH not in own:
            own[HASH] = by_fields(self)
        found: int = own[HASH]
        return found

    kind.__hash__ = remembering  # type: ignore[method-assign]
    return kind

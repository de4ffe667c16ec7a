"""Results kept with the object that computed them, so that they go when it goes."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Concatenate, ParamSpec, TypeVar, cast

P = ParamSpec("P")
S = TypeVar("S")
T = TypeVar("T")


def cached_method(method: Callable[Concatenate[S, P], T]) -> Callable[Concatenate[S, P], T]:
    """The method, computing its answer for the same arguments only once for each object.

    A subclass's method of the same name keeps its answers apart, so that `super().f()` is what the class above says.
    """
    place = f"answers of {method.__module__}.{method.__qualname__}"

    @wraps(method)
    def recalling(self: S, *args: P.args, **kwargs: P.kwargs) -> T:
        answers = cast("dict[object, T]", vars(self).setdefault(place, {}))
        known = (args, *kwargs.items()) if kwargs else args
        if known not in answers:
            answers[known] = method(self, *args, **kwargs)
        return answers[known]

    return cast("Callable[Concatenate[S, P], T]", recalling)

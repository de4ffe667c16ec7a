"""The methods there are: whatever stands in `methods/`."""

from __future__ import annotations

from difflib import get_close_matches
from functools import cache

from ..errors import Problem, UnknownNameError
from ..packages import modules_of
from .method import Method

ENSEMBLES = "ensembles"  # many motions side by side, in a kernel of their own


@cache
def _methods() -> dict[str, Method]:
    found: list[Method] = [module.METHOD for module in modules_of("deltaq.simulation.methods")]
    return {method.id: method for method in sorted(found, key=lambda method: (method.order, method.id))}


def method_ids() -> tuple[str, ...]:
    """Ids of all methods, by rising order."""
    return tuple(_methods())


def families() -> tuple[str, ...]:
    """The families of methods, explicit ones first; each has kernels of its own."""
    return tuple(dict.fromkeys(method.family for method in _methods().values()))


def kernel_groups() -> tuple[str, ...]:
    """What is compiled, and waited for, by itself: the families of methods, and the lanes of ensembles."""
    first, *others = families()
    return (first, ENSEMBLES, *others)


def get_method(identifier: str) -> Method:
    """The method of this id. Raises UnknownNameError if there is none."""
    if identifier not in _methods():
        near = get_close_matches(identifier, method_ids(), n=1)
        parameters = {"name": identifier[:64], "suggestion": near[0] if near else "", "known": ", ".join(method_ids())}
        raise UnknownNameError(Problem("unknown-method", "/method", parameters=parameters))
    return _methods()[identifier]

"""Finding what stands in a package: adding a scene kind, a rule or a method is adding one file."""

from __future__ import annotations

from functools import cache
from importlib import import_module
from pkgutil import iter_modules
from types import ModuleType


@cache
def names_of(package: str) -> tuple[str, ...]:
    """The names of the modules directly inside a package, in order, none imported; a leading _ makes one private."""
    path = import_module(package).__path__
    return tuple(sorted(module.name for module in iter_modules(path) if not module.name.startswith("_")))


@cache
def modules_of(package: str) -> tuple[ModuleType, ...]:
    """The modules directly inside a package, in the order of their names."""
    return tuple(import_module(f"{package}.{name}") for name in names_of(package))


@cache
def classes_of(package: str, attribute: str) -> dict[str, type]:
    """The classes that modules of a package define, by the value of the class attribute that names them."""
    return {
        str(getattr(thing, attribute)): thing
        for module in modules_of(package)
        for thing in vars(module).values()
        if isinstance(thing, type) and thing.__module__ == module.__name__ and hasattr(thing, attribute)
    }

"""Other code in the place of a module's own: when it is read, or in the functions that have been read."""

from __future__ import annotations

import gc
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping
from importlib.machinery import SourceFileLoader
from pathlib import Path
from types import CodeType, FunctionType

Place = tuple[str, int, int]  # of a function in its module: its name, its line, and the how manieth it is there


def replace(codes: Mapping[str, CodeType]) -> None:
    """From now on an import of these files runs this code."""
    sound = SourceFileLoader.get_code

    def get_code(loader: SourceFileLoader, fullname: str) -> CodeType | None:
        return codes.get(loader.path) or sound(loader, fullname)

    SourceFileLoader.get_code = get_code  # type: ignore[method-assign]


class Functions:
    """All functions alive that modules have made, wherever they are kept."""

    def __init__(self, modules: Iterable[Path]) -> None:
        places = {str(module): {code: place for place, code in _places(_sound(module))} for module in modules}
        self._living: dict[str, list[tuple[Place, FunctionType]]] = defaultdict(list)
        for one in gc.get_objects():
            if isinstance(one, FunctionType) and one.__code__ in places.get(one.__code__.co_filename, {}):
                file = one.__code__.co_filename
                self._living[file].append((places[file][one.__code__], one))

    def put(self, module: Path, code: CodeType) -> bool:
        """Has the functions of a module run its other code; whether one could be replaced by another."""
        codes = dict(_places(code))
        changes = False
        try:
            for place, function in self._living[str(module)]:
                changes |= function.__code__ != codes[place]
                function.__code__ = codes[place]
        except (KeyError, ValueError):  # a function is gone, or needs other variables from around it
            return False
        return changes


def _sound(module: Path) -> CodeType:
    return compile(module.read_text(encoding="utf-8"), str(module), "exec", dont_inherit=True)


def _places(code: CodeType) -> Iterator[tuple[Place, CodeType]]:
    count: Counter[tuple[str, int]] = Counter()
    for one in _inside(code):
        here = one.co_qualname, one.co_firstlineno
        yield (*here, count[here]), one
        count[here] += 1


def _inside(code: CodeType) -> Iterator[CodeType]:
    for one in code.co_consts:
        if isinstance(one, CodeType):
            yield one
            yield from _inside(one)

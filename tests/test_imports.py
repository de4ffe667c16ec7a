"""Who may know whom: the direction of imports, read from the source."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[1] / "backend" / "deltaq"

# What each package may know, besides itself and the modules that stand beside the packages.
MAY_KNOW = {
    "language": set(),
    "mechanics": {"language"},
    "derivation": {"language", "mechanics"},
    "narration": {"language", "mechanics", "derivation", "contract"},
    "model": {"language", "mechanics"},
    "contract": set(),
    "simulation": {"language", "mechanics", "model", "contract"},
    "lab": {"language", "mechanics", "model", "simulation", "contract"},
    "homework": {"language", "mechanics", "derivation", "narration", "contract"},
    "handout": {"language", "mechanics", "derivation", "narration", "contract"},
    "commands": {"mechanics", "narration", "simulation", "lab", "homework", "handout", "contract", "api"},
    "api": {
        *("language", "mechanics", "derivation", "narration", "model", "simulation", "lab", "homework", "handout"),
        "contract",
    },
}
# Who may know the modules beside the packages.
BESIDE = {
    "": {"errors", "packages", "ownership", "vocabulary"},
    "api": {"errors", "packages", "ownership", "settings", "vocabulary"},
    "commands": {"errors", "bench", "settings"},
}
FORBIDDEN = {
    "sympy": {"mechanics", "model", "simulation", "lab", "api", "scenes"},
    "numpy": {"language", "mechanics", "derivation", "narration", "homework", "api", "handout"},
    "symengine": {
        "language",
        "mechanics",
        "derivation",
        "narration",
        "homework",
        "simulation",
        "lab",
        "api",
        "handout",
    },
    "numba": {"language", "mechanics", "derivation", "narration", "homework", "api", "handout"},
    "fastapi": set(MAY_KNOW) - {"api"},
    "pydantic": set(MAY_KNOW) - {"api", "contract"},
}
FILES = sorted(PACKAGE.rglob("*.py"))


def package_of(file: Path) -> str:
    """The package that a file belongs to, or "" for a module beside the packages."""
    parts = file.relative_to(PACKAGE).parts
    return parts[0] if len(parts) > 1 else ""


def imports_of(file: Path) -> tuple[str, ...]:
    """Full names of the modules that a file imports, wherever in it; also those imported by name."""
    return _imports_in(file, file.read_text(encoding="utf-8"))


@cache
def _imports_in(file: Path, source: str) -> tuple[str, ...]:
    return tuple(_each_import(file, source))


def _each_import(file: Path, source: str) -> Iterator[str]:
    here = ("deltaq", *file.relative_to(PACKAGE).with_suffix("").parts)
    for node in ast.walk(ast.parse(source)):
        match node:
            case ast.Import(names):
                yield from (name.name for name in names)
            case ast.ImportFrom(module, names, level):
                base = [*here[: len(here) - level], *([module] if module else [])] if level else [module or ""]
                yield from (".".join([*base, name.name]) for name in names)
            case ast.Call(ast.Name("import_module"), [ast.Constant(str(name)), *_]):
                yield name


def module_of(file: Path) -> str:
    """The name by which a file is imported."""
    return ".".join(("deltaq", *file.relative_to(PACKAGE).with_suffix("").parts)).removesuffix(".__init__")


def import_graph(imports: dict[str, set[str]]) -> dict[str, set[str]]:
    """The modules that each module imports, also inside functions; a name is that of a module or stands in one."""
    graph = {}
    for module, names in imports.items():
        whole = {name if name in imports else name.rpartition(".")[0] for name in names}
        graph[module] = whole & imports.keys() - {module}
    return graph


def circles(graph: dict[str, set[str]]) -> list[str]:
    """What is left when all modules are taken away that import none of the rest, or that none of the rest imports."""
    left = set(graph)
    while True:
        imported = set().union(*(graph[module] for module in left))
        free = {module for module in left if not graph[module] & left or module not in imported}
        if not free:
            return sorted(left)
        left -= free


def known_packages(file: Path) -> set[str]:
    """The packages and modules of deltaq that a file imports from."""
    names = [name.split(".") for name in imports_of(file)]
    return {name[1] for name in names if name[0] == "deltaq" and len(name) > 1}


@pytest.mark.parametrize("file", FILES, ids=lambda file: str(file.relative_to(PACKAGE)))
def test_file_imports_only_what_its_package_may_know(file: Path) -> None:
    package = package_of(file)
    beside = {one.stem for one in PACKAGE.glob("*.py")}
    known = known_packages(file) - {"__version__", package}
    if package:
        assert known & set(MAY_KNOW) <= MAY_KNOW[package]
        assert known & beside <= BESIDE.get(package, BESIDE[""]) | {package}
    elif file.stem != "cli":
        assert not known & set(MAY_KNOW)


@pytest.mark.parametrize("library", FORBIDDEN)
def test_library_is_used_only_where_it_belongs(library: str) -> None:
    users = {package_of(file) for file in FILES if any(name.split(".")[0] == library for name in imports_of(file))}
    assert users & FORBIDDEN[library] == set()


def test_nothing_calls_out() -> None:
    """Connections are taken by the command line, and made to no more than the Redis that a setting names."""
    network = {"socket", "ssl", "http", "urllib.request", "ftplib", "smtplib", "requests", "httpx", "aiohttp", "redis"}
    used = {
        (str(file.relative_to(PACKAGE)), library)
        for file in FILES
        for name in imports_of(file)
        for library in network
        if f"{name}.".startswith(f"{library}.")
    }
    assert used == {("commands/serve.py", "socket"), ("api/stores/shared.py", "redis")}


def test_every_package_has_its_rule() -> None:
    packages = {folder.name for folder in PACKAGE.iterdir() if any(folder.glob("*.py"))}
    assert packages <= set(MAY_KNOW)


def test_rules_have_no_cycle() -> None:
    def reaches(start: str, goal: str) -> bool:
        return any(one == goal or reaches(one, goal) for one in MAY_KNOW[start])

    assert [one for one in MAY_KNOW if reaches(one, one)] == []


def test_no_module_imports_itself_by_way_of_others() -> None:
    """Modules that import each other are one concern: one file."""
    imports = {module_of(file): set(imports_of(file)) for file in FILES}
    assert circles(import_graph(imports)) == []


@pytest.mark.parametrize(
    ("imports", "expected"),
    [
        pytest.param({"a": {"b.x"}, "b": {"a"}, "c": {"a"}}, ["a", "b"], id="two"),
        pytest.param({"a": {"b"}, "b": {"c.f"}, "c": {"a.g", "d"}, "d": set()}, ["a", "b", "c"], id="three"),
        pytest.param({"p": set(), "p.a": {"p.b"}, "p.b": {"p.c"}, "p.c": set()}, [], id="none"),
        pytest.param({"p": {"p.a.f"}, "p.a": {"p.CONSTANT"}}, ["p", "p.a"], id="a package and its module"),
    ],
)
def test_circles_are_found(imports: dict[str, set[str]], expected: list[str]) -> None:
    assert circles(import_graph(imports)) == expected


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        pytest.param("from ..mechanics.scene import Scene", {"mechanics"}, id="relative"),
        pytest.param("from .. import errors", {"errors"}, id="relative to the package"),
        pytest.param("from deltaq.api import app", {"api"}, id="absolute"),
        pytest.param("import deltaq.model.model as m", {"model"}, id="import"),
        pytest.param("def f():\n    from ..api.app import x", {"api"}, id="inside a function"),
        pytest.param("import_module('deltaq.lab.x')", {"lab"}, id="by name"),
        pytest.param("from .neighbour import x\nimport numpy", {"language"}, id="own package"),
    ],
)
def test_imports_are_found(source: str, expected: set[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Path, "read_text", lambda self, encoding: source)
    assert known_packages(PACKAGE / "language" / "example.py") == expected

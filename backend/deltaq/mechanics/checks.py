"""What the frozen types of this package check about themselves, and what reading their documents needs."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from itertools import accumulate

from ..errors import Problem, SceneError

NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,31}")  # of places and loads: they become classes and keys of the page

LATEX = re.compile(r"(?:\\[A-Za-z]+|[A-Za-z0-9_^{} ,'*+-])*")
# An index without anything to it; two carets are more than that: TeX reads ^^5c as a backslash.
BARE_INDEX = re.compile(r"[_^]\s*(?:[_^}'+*,-]|$)")
ACCENTS = ("mathrm", "mathbf", "mathit", "mathcal", "mathsf", "text", "bar", "hat", "tilde", "vec", "underline")
BARE_ACCENT = re.compile(rf"\\(?:{'|'.join(ACCENTS)})\s*(?:[_^}}'+*,-]|$)")
# fmt: off
COMMANDS = frozenset(
    [
        "alpha", "beta", "gamma", "delta", "epsilon", "varepsilon", "zeta", "eta", "theta", "vartheta", "iota",
        "kappa", "lambda", "mu", "nu", "xi", "pi", "varpi", "rho", "varrho", "sigma", "varsigma", "tau",
        "upsilon", "phi", "varphi", "chi", "psi", "omega", "Gamma", "Delta", "Theta", "Lambda", "Xi", "Pi",
        "Sigma", "Upsilon", "Phi", "Psi", "Omega", "ell", "hbar", "prime", "infty", "parallel", "perp",
        *ACCENTS,
    ]
)
# fmt: on


def demand(*problems: Problem | None) -> None:
    """Raises SceneError if there is any problem."""
    found = [problem for problem in problems if problem is not None]
    if found:
        raise SceneError(*found)


def name_problem(name: str, pointer: str = "/name") -> Problem | None:
    """The problem of a name that is none; None if it is one."""
    if NAME.fullmatch(name):
        return None
    return Problem("invalid-name", pointer, parameters={"name": name[:40]})


def load_name_problem(name: str, pointer: str) -> Problem | None:
    """Loads of one kind without names of their own are told apart by a number: gravity-2."""
    kind, hyphen, number = name.rpartition("-")
    problem = name_problem(kind if hyphen and number.isdecimal() else name, pointer)
    return problem and Problem("invalid-name", pointer, parameters={"name": name[:40]})


def latex_problem(latex: str, pointer: str = "/latex") -> Problem | None:
    """A symbol in LaTeX: letters, digits, indices and a few commands; it is printed as it is, so no more."""
    commands = set(re.findall(r"\\([A-Za-z]*)", latex))
    known = len(latex) <= 40 and LATEX.fullmatch(latex) and commands <= COMMANDS
    whole = _is_balanced(latex) and not BARE_INDEX.search(latex) and not BARE_ACCENT.search(latex)
    return None if known and whole else Problem("invalid-latex", pointer, parameters={"latex": latex[:40]})


def _is_balanced(latex: str) -> bool:
    depths = list(accumulate({"{": 1, "}": -1}.get(character, 0) for character in latex))
    return not depths or (min(depths) >= 0 and depths[-1] == 0)


def range_problems(value: float, low: float | None, high: float | None) -> Iterator[Problem]:
    """The value must be finite and lie between its bounds."""
    numbers = {"/value": value, "/min": low, "/max": high}
    not_finite = [key for key, number in numbers.items() if number is not None and not math.isfinite(number)]
    yield from (Problem("not-finite", key) for key in not_finite)
    if not_finite:
        return
    if low is not None and high is not None and low >= high:
        yield Problem("empty-range", "/max", parameters={"min": low, "max": high})
    elif (low is not None and value < low) or (high is not None and value > high):
        yield Problem("outside-range", "/value", parameters={"value": value, "min": str(low), "max": str(high)})


def as_float(value: object) -> float:
    """A number of a document; infinite where it is too large, NaN where it is none."""
    try:
        return float(value) if isinstance(value, int | float) and not isinstance(value, bool) else math.nan
    except OverflowError:
        return math.inf


def default_name(kinds: list[str], index: int, joint: str) -> str:
    """A thing without a name is called by its kind, with a number where there are several of the kind: gravity-2,
    particle2; things that are of no kind have no such name.
    """
    kind, name = kinds[index], kinds[index].replace("-", "_")
    return name if not kind or kinds.count(kind) < 2 else f"{name}{joint}{kinds[: index + 1].count(kind)}"

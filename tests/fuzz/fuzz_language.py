"""Coverage-guided fuzzing of the expression language with atheris, which is no dependency: install it for a run.

    python tests/fuzz/fuzz_language.py plain corpus/ -max_total_time=300 -max_len=400

What must hold for every text: it is read, or refused with one ExpressionError whose place lies in the text; what was
read becomes SymPy or is refused, in less than 0.2 s; what is printed is read again, display does not take long, and
both keep the value.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import atheris
import sympy

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parents[2] / "backend")]

with atheris.instrument_imports(include=["deltaq.language"]):
    from deltaq.errors import ExpressionError
    from deltaq.language.canonical import display, zero_test
    from deltaq.language.parser import parse
    from deltaq.language.plain_printer import plain
    from deltaq.language.sympy_algebra import to_sympy

from tests.language.hostile import BOMBS, CODE, LARGE, LATEX  # noqa: E402
from tests.language.scene_names import NAMES, SYMBOLS  # noqa: E402

SYNTAX = "latex" if sys.argv[1:2] == ["latex"] else "plain"
SLOW_READING, SLOW_SHOWING = 0.4, 2.0  # seconds; instrumented code takes about twice as long as it should
BOUNDS = {
    *("too-long", "too-many-digits", "too-many-nodes", "too-deep", "value-too-large", "value-too-small"),
    *("degree-too-large", "exponent-too-large", "not-real", "outside-domain", "division-by-zero"),
}


def one_text(data: bytes) -> None:
    """Read one text and check what must hold."""
    text = data.decode("utf-8", "replace")
    value, took = timed_reading(text)
    if took > SLOW_READING:
        # A pause of the machine does not come twice.
        value, took = timed_reading(text)
    assert took < SLOW_READING, (took, text)
    if isinstance(value, sympy.Expr):
        round_trip(text, value)


def timed_reading(text: str) -> tuple[object, float]:
    """The SymPy value of a text, None if it is refused, and how long this took in seconds."""
    started = time.process_time()
    try:
        value = to_sympy(parse(text, NAMES, SYNTAX).tree, SYMBOLS)
    except ExpressionError as error:
        value = None
        (problem,) = error.problems
        if problem.offset is not None:
            assert 0 <= problem.offset <= len(text), (text, problem)
            assert 0 <= (problem.length or 0) <= len(text) - problem.offset, (text, problem)
    return value, time.process_time() - started


def round_trip(text: str, value: sympy.Expr) -> None:
    """What is printed is read back with the same value; display keeps the value."""
    started = time.process_time()
    try:
        again = to_sympy(parse(plain(value), NAMES).tree, SYMBOLS)
        shown = display(value, SYMBOLS)
        took = time.process_time() - started
        assert took < SLOW_SHOWING, (took, text)
        same = again == value or zero_test(again - value, SYMBOLS).outcome is not False
        kept = zero_test(shown - value, SYMBOLS).outcome is not False
    except ExpressionError as error:
        if error.problems[0].code not in BOUNDS:
            raise
    else:
        assert same, (text, value, again)
        assert kept, (text, value, shown)


def seeds(folder: Path) -> None:
    """Write the tables of the tests as first corpus."""
    from tests.language import test_latex_syntax, test_plain_syntax

    tables = test_latex_syntax if SYNTAX == "latex" else test_plain_syntax
    texts = [row[0] for row in (*tables.ACCEPTED, *tables.REFUSED)] + (
        LATEX if SYNTAX == "latex" else [*CODE, *BOMBS, *LARGE]
    )
    folder.mkdir(parents=True, exist_ok=True)
    for i, text in enumerate(texts):
        (folder / f"seed-{i}").write_bytes(text.encode("utf-8", "surrogatepass"))


if __name__ == "__main__":
    if len(sys.argv) > 2 and not Path(sys.argv[2]).is_file():
        seeds(Path(sys.argv[2]))
    atheris.Setup([sys.argv[0], *sys.argv[2:]], one_text)
    atheris.Fuzz()

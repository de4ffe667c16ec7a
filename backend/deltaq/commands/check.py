"""`deltaq check`: a table of answers, graded."""

from __future__ import annotations

import argparse
from pathlib import Path

HELP = "check a table of answers"
DESCRIPTION = """Checks the answers of a CSV table with the columns task and answer, and student, scene, syntax (plain
or latex), seed and line where wanted; writes the verdicts, and tells which mistakes were made how often. With a column
line the rows of a student on a scene are a working. The table may be written as spreadsheets do: with commas,
semicolons or tabs, in UTF-8, UTF-16 or Windows-1252; the verdicts are then, too."""


EXAMPLE = "deltaq check answers.csv --assignment sheet.toml --output verdicts.csv"


def arguments(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    parser.add_argument("answers", type=Path, help="CSV with a header")
    parser.add_argument("--output", type=Path, help="where the results go (default: beside, -results.csv)")
    parser.add_argument("--assignment", type=Path, help="TOML or JSON file with scenes, tasks and points")
    parser.add_argument("--lang", choices=("en", "de"), default="en", help="language (default: %(default)s)")


def run(options: argparse.Namespace) -> None:
    """Check the answers, and print what went wrong how often."""
    from ..homework.command import check_file

    output = options.output or options.answers.with_name(f"{options.answers.stem}-results.csv")
    print(check_file(options.answers, output, options.assignment, options.lang))
    print(f"→ {output}")

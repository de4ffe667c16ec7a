"""`deltaq check`: a table of answers, graded."""

from __future__ import annotations

import argparse
from pathlib import Path

from ._common import scene_of

HELP = "check the answers of a class"
DESCRIPTION = """Checks the answers of a CSV table with the columns task and answer, and student, id, scene, syntax
(plain or latex), seed, line, time (ISO 8601) and file where wanted; or what students handed in on the homework page: a
zip, a folder or a file, with the assignment that it answers. A file that cannot be taken is named. Writes the
verdicts, and tells which mistakes were made how often. A task earns its points once: of several answers of a student
the best counts. With a column line the rows of a student on a scene are a working in the order of these numbers: a
line may follow from the last answer to each task before it, so a mistake that has been corrected carries nothing any
more; a row without a number stands alone. Late answers, and those beyond the attempts that are allowed, count by the
rule of the assignment. The homework page marks by the same rules. For an assignment the points are written as Moodle
and Canvas import them, too. The table may be written as spreadsheets do: with commas, semicolons or tabs, in UTF-8,
UTF-16 or Windows-1252; the verdicts are then, too."""


EXAMPLE = "deltaq check answers.csv --assignment sheet.toml --output verdicts.csv"


def arguments(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    parser.add_argument(
        "answers", type=Path, help="CSV with a header; or a zip, a folder or a file of what was handed in"
    )
    parser.add_argument("--output", type=Path, help="where the results go (default: beside, -results.csv)")
    parser.add_argument("--assignment", type=Path, help="TOML or JSON file with scenes, tasks and points")
    parser.add_argument("--scene", default="", help="where the table names none: a built-in scene's id, or a TOML file")
    parser.add_argument("--lang", choices=("en", "de"), default="en", help="language (default: %(default)s)")


def run(options: argparse.Namespace) -> None:
    """Check the answers, and print what went wrong how often."""
    from ..homework.assignment import load_assignment
    from ..homework.command import check_file
    from ..homework.grading import Sheet

    assignment = load_assignment(options.assignment) if options.assignment else None
    sheet = Sheet(assignment, scene_of(options.scene))
    output = options.output or options.answers.with_name(f"{options.answers.stem}-results.csv")
    print(check_file(options.answers, output, sheet, options.lang))
    print(f"→ {output}")

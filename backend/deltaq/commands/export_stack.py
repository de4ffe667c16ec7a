"""`deltaq export-stack`: tasks as questions of Moodle's STACK."""

from __future__ import annotations

import argparse
from pathlib import Path

HELP = "export tasks as questions of STACK"
DESCRIPTION = "Writes tasks of a built-in scene, or a whole assignment, as Moodle XML of the question type STACK."


EXAMPLE = "deltaq export-stack pendulum kinetic-energy equation:phi --output pendulum.xml"


def arguments(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("scene", nargs="?", help="id of a built-in scene")
    what.add_argument("--assignment", type=Path, help="TOML or JSON file with scenes, tasks and points: all its tasks")
    parser.add_argument("tasks", nargs="*", help="ids of tasks such as equation:phi (default: all)")
    parser.add_argument("--output", type=Path, required=True, help="where the XML goes")
    parser.add_argument("--lang", choices=("en", "de"), default="en", help="language (default: %(default)s)")


def run(options: argparse.Namespace) -> None:
    """Write the questions."""
    from ..narration.catalog import text

    count, left_out = _written(options)
    print(f"{count} → {options.output}")
    if left_out:
        print(text(options.lang, "homework.stack.left-out", tasks=", ".join(left_out)))


def _written(options: argparse.Namespace) -> tuple[int, list[str]]:
    """How many questions were written, and what STACK cannot judge."""
    from ..homework.assignment import load_assignment
    from ..homework.command import stack_file, stack_sheet

    if options.assignment:
        return stack_sheet(load_assignment(options.assignment), options.output, options.lang)
    return stack_file(options.scene, options.tasks, options.output, options.lang)

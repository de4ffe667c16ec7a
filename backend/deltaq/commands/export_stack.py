"""`deltaq export-stack`: tasks as questions of Moodle's STACK."""

from __future__ import annotations

import argparse
from pathlib import Path

HELP = "export tasks as questions of STACK"
DESCRIPTION = "Writes tasks of a built-in scene as Moodle XML of the question type STACK."


EXAMPLE = "deltaq export-stack pendulum kinetic-energy equation:phi --output pendulum.xml"


def arguments(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    parser.add_argument("scene", help="id of a built-in scene")
    parser.add_argument("tasks", nargs="*", help="ids of tasks such as equation:phi (default: all)")
    parser.add_argument("--output", type=Path, required=True, help="where the XML goes")
    parser.add_argument("--lang", choices=("en", "de"), default="en", help="language (default: %(default)s)")


def run(options: argparse.Namespace) -> None:
    """Write the questions."""
    from ..homework.command import stack_file
    from ..narration.catalog import text

    count, left_out = stack_file(options.scene, options.tasks, options.output, options.lang)
    print(f"{count} → {options.output}")
    if left_out:
        print(text(options.lang, "homework.stack.left-out", tasks=", ".join(left_out)))

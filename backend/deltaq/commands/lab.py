"""`deltaq lab`: an experiment from the shell, with a progress bar and files."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import CommandError
from ..lab.library import experiment_ids, get_experiment
from ._common import compilation_told, field_argument, language_argument, question_of, scene_argument

if TYPE_CHECKING:
    from ..lab.report import Report

HELP = "run an experiment on a scene"
DESCRIPTION = """Runs an experiment, such as work-precision, stability or fidelity, on a built-in scene (by its id) or
one of your own (a TOML file), and writes what was found: JSON with all numbers, CSV with the curves, HTML with the
charts. Times are measured anew each time; with them is written when, and how busy the machine was."""
EXAMPLE = "deltaq lab work-precision double-pendulum --set t_end=20 --output chart.html --output numbers.csv"
FILES = (".json", ".csv", ".html")
WIDTH = 40


def arguments(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    parser.add_argument("experiment", help=f"one of {', '.join(experiment_ids())}")
    scene_argument(parser)
    field_argument(parser)
    parser.add_argument(
        "--output",
        type=Path,
        action="append",
        default=[],
        help="a file, by its suffix .json, .csv or .html; several may be given (default: .json and .html here)",
    )
    language_argument(parser)


def run(options: argparse.Namespace) -> None:
    """Measure, and write the files."""
    from ..lab.charts.words import taken, words
    from ..lab.experiment import drawn
    from ..narration.catalog import text

    for output in options.output:  # before anything is measured
        if output.suffix not in FILES or not output.parent.is_dir():
            raise CommandError(
                f"{output} is not a file in a folder that is there, with the suffix {' or '.join(FILES)}"
            )
    experiment = get_experiment(options.experiment)
    question, result = question_of(options), dict[str, Any]()
    with compilation_told():
        for report in _with_progress(experiment.run(question)):
            result = report.result
    charts = drawn(experiment, result, text, options.lang)
    outputs = options.output or [Path(f"{experiment.id}-{result['scene']}{suffix}") for suffix in (".json", ".html")]
    for output in outputs:
        output.write_text(_file(output.suffix, {**result, "charts": charts}, options.lang), encoding="utf-8")
        print(f"→ {output}")
    if "taken" in result:
        print(taken(result["taken"], words(text, options.lang)))


def _with_progress(reports: Iterator[Report]) -> Iterator[Report]:
    """The reports; on the error stream a bar grows with them, or a line comes at each tenth where it is no terminal."""
    at_terminal, told = sys.stderr.isatty(), -1
    for report in reports:
        share = report.done / max(report.total, 1)
        if at_terminal:
            bar = "#" * int(WIDTH * share)
            print(f"\r[{bar:.<{WIDTH}}] {report.done}/{report.total}", end="", file=sys.stderr, flush=True)
        elif int(10 * share) > told:
            told = int(10 * share)
            print(f"{report.done}/{report.total}", file=sys.stderr, flush=True)
        yield report
    if at_terminal:
        print(file=sys.stderr)


def _file(suffix: str, result: dict[str, Any], lang: str) -> str:
    from ..lab.export import page, table

    match suffix:
        case ".csv":
            return table(result["charts"])
        case ".html":
            return page(result["charts"], lang)
        case _:
            return json.dumps(result, ensure_ascii=False, indent=1)

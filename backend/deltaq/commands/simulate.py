"""`deltaq simulate`: a motion as numbers."""

from __future__ import annotations

import argparse
import json
import sys
from typing import Any

from ..errors import CommandError
from ._common import (
    compilation_told,
    field_argument,
    language_argument,
    output_argument,
    question_of,
    scene_argument,
    table,
    write,
)

HELP = "simulate a scene"
DESCRIPTION = """Simulates a scene to a tolerance: a table of time, coordinates, rates and estimated error as CSV, or
everything as JSON. What went wrong on the way is said on the error stream; the exit code is then 2."""


EXAMPLE = (
    'deltaq simulate pendulum --t-end 20 --set tolerance=1e-9 --set \'initial={"phi":{"value":2}}\' --output motion.csv'
)


def arguments(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    scene_argument(parser)
    parser.add_argument("--t-end", type=float, default=10.0, help="seconds of motion (default: %(default)s)")
    parser.add_argument("--samples", type=int, default=201, help="number of samples (default: %(default)s)")
    parser.add_argument("--format", choices=("csv", "json"), default="csv", help="default: %(default)s")
    field_argument(parser)
    output_argument(parser)
    language_argument(parser)


def run(options: argparse.Namespace) -> None:
    """Simulate, write what is right, and say what is not."""
    from ..narration.outcome import explained
    from ..simulation.service import run as simulate

    question = {"t_end": options.t_end, "samples": options.samples, **question_of(options)}
    with compilation_told():
        found: dict[str, Any] = simulate(question)
    answer = found | explained(found, options.lang)
    write(json.dumps(answer, ensure_ascii=False) if options.format == "json" else _table(answer), options.output)
    if answer["status"] != "ok":
        raise CommandError(f"{answer['reason']} {answer['remedy']}")
    print(f"deltaq: {answer['method']}, {answer['cost']['steps']} steps", file=sys.stderr)


def _table(answer: dict[str, Any]) -> str:
    columns = {"t": answer["t"], **answer["coordinates"]}
    columns |= {f"dot({name})": rates for name, rates in answer["rates"].items()}
    columns |= {"error": answer["error"]["estimate"]}
    return table(columns)

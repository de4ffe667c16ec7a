"""`deltaq ensemble`: many motions of one scene as numbers."""

from __future__ import annotations

import argparse
import json
import sys
from typing import Any

from ._common import (
    compilation_told,
    field_argument,
    language_argument,
    named,
    output_argument,
    question_of,
    scene_argument,
    table,
    write,
)

HELP = "simulate a scene with many initial values or parameters"
DESCRIPTION = """Simulates a scene once for each of many values: a table with a row for each run as CSV (what varies,
the status, the estimated error, the coordinates at the end), or everything as JSON. How many runs are done is said on
the error stream."""
EXAMPLE = (
    "deltaq ensemble double-pendulum --t-end 10 "
    '--vary \'initial.phi1.value={"normal":[1,0.01],"count":1000}\' --output cloud.csv'
)


def arguments(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    scene_argument(parser)
    parser.add_argument("--t-end", type=float, default=10.0, help="seconds of motion (default: %(default)s)")
    parser.add_argument(
        "--vary",
        action="append",
        default=[],
        required=True,
        type=_variation,
        metavar="QUANTITY=VALUES",
        help='initial.NAME.value, initial.NAME.rate or parameters.NAME, and as JSON [1,2], {"from":0,"to":1,"count":5} '
        'or {"normal":[1,0.1],"count":100,"seed":1}',
    )
    parser.add_argument("--format", choices=("csv", "json"), default="csv", help="default: %(default)s")
    field_argument(parser)
    output_argument(parser)
    language_argument(parser)


def run(options: argparse.Namespace) -> None:
    """Run all of them, and write what came of each."""
    from ..narration.outcome import outcomes_explained
    from ..simulation.ensemble_answer import run as simulate

    question = {"t_end": options.t_end, "vary": dict(options.vary), **question_of(options)}
    with compilation_told():
        found: dict[str, Any] = simulate(question, lambda done: print(f"deltaq: {done} runs done", file=sys.stderr))
    answer = found | outcomes_explained(found.pop("outcomes"), options.lang)
    write(json.dumps(answer, ensure_ascii=False) if options.format == "json" else _table(answer), options.output)
    for status, reason in answer["reasons"].items():
        print(f"deltaq: {answer['status'].count(status)} runs {status}: {reason}", file=sys.stderr)


def _variation(text: str) -> tuple[str, Any]:
    name, value = named(text, "QUANTITY=VALUES")
    try:
        return name, json.loads(value)
    except json.JSONDecodeError:
        raise argparse.ArgumentTypeError(f"values are JSON, such as [1,2]; this is not: {value}") from None


def _table(answer: dict[str, Any]) -> str:
    ends = {name: [column[-1] if column else "" for column in runs] for name, runs in answer["coordinates"].items()}
    errors = ["" if error is None else error for error in answer["error"]]
    columns = {**answer["quantities"], "status": answer["status"], "error": errors, **ends}
    return table(columns)

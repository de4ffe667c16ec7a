"""`deltaq ensemble`: many motions of one scene as numbers."""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
from time import monotonic
from typing import Any

from ..errors import CommandError
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
DESCRIPTION = """Simulates a scene once for each of many values. As CSV, a row for each run (what varies, status,
estimated error, coordinates at the end); with statistics, a row for each time; with a section, a row for each point of
each run. Or everything as JSON. How many runs are done is said on the error stream."""
EXAMPLE = (
    "deltaq ensemble double-pendulum --t-end 10 "
    '--vary \'initial.phi1.value={"normal":[1,0.01],"count":1000}\' --statistics mean quantiles --output cloud.csv'
)
STATISTICS = ("mean", "quantiles", "density")
PAUSE = 1.0  # seconds between two lines about progress


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
    parser.add_argument("--statistics", nargs="+", default=[], choices=STATISTICS, help="over the runs, at each time")
    section = parser.add_argument_group("section", "where each run passes zero of an expression")
    section.add_argument("--section", metavar="EXPRESSION", help="of coordinates, rates (dot(q)), parameters and t")
    section.add_argument(
        "--direction", choices=("rising", "falling", "both"), default="rising", help="default: %(default)s"
    )
    section.add_argument("--points", type=int, default=100, help="of each run, at most (default: %(default)s)")
    parser.add_argument(
        "--table",
        choices=tuple(TABLES),
        help="which one is written as CSV (default: points of a section, else statistics, else runs)",
    )
    parser.add_argument("--format", choices=("csv", "json"), default="csv", help="default: %(default)s")
    parser.add_argument(
        "--scheduler", metavar="ADDRESS", help="a Dask that works out large ensembles, such as tcp://host:8786"
    )
    field_argument(parser)
    output_argument(parser)
    language_argument(parser)


def run(options: argparse.Namespace) -> None:
    """Run all of them, and write what came of each."""
    from ..lab.engine import SCHEDULER, cluster
    from ..narration.outcome import outcomes_explained
    from ..simulation.ensemble_answer import run as simulate

    question, wanted = _question(options), _wanted(options)
    if options.scheduler:
        os.environ[SCHEDULER] = options.scheduler
    with compilation_told(), cluster() as executor:
        found: dict[str, Any] = simulate(question, _progress(), executor)
    answer = found | outcomes_explained(found.pop("outcomes"), options.lang)
    written = json.dumps(answer, ensure_ascii=False) if options.format == "json" else table(TABLES[wanted](answer))
    write(written, options.output)
    ends = list(zip(answer["status"], answer.get("section", answer)["status"], strict=True))
    for status, reason in answer["reasons"].items():
        print(f"deltaq: {sum(status in each for each in ends)} runs {status}: {reason}", file=sys.stderr)


def _question(options: argparse.Namespace) -> dict[str, Any]:
    """The request; what is given as a field counts for more than what is not given as an option."""
    question: dict[str, Any] = {"t_end": options.t_end, "vary": dict(options.vary)}
    if options.statistics:
        question["statistics"] = list(dict.fromkeys(options.statistics))
    if options.section is not None:
        question["section"] = {"value": options.section, "direction": options.direction, "points": options.points}
    return question | question_of(options)


def _wanted(options: argparse.Namespace) -> str:
    """The table to be written. Raises CommandError for one of what was not asked for."""
    fields = dict(options.fields)
    asked = {
        "section": options.section is not None or "section" in fields,
        "statistics": bool(options.statistics or fields.get("statistics")),
        "runs": True,
    }
    wanted: str = options.table or next(name for name, is_asked in asked.items() if is_asked)
    if not asked[wanted]:
        raise CommandError(f"--table {wanted} needs --{wanted}")
    return wanted


def _progress() -> Callable[[int], None]:
    """Tells how many runs are done, now and again, whether or not anybody watches."""
    next_time = monotonic()

    def tell(done: int) -> None:
        nonlocal next_time
        if monotonic() >= next_time:
            next_time = monotonic() + PAUSE
            print(f"deltaq: {done} runs done", file=sys.stderr, flush=True)

    return tell


def _variation(text: str) -> tuple[str, Any]:
    name, value = named(text, "QUANTITY=VALUES")
    try:
        return name, json.loads(value)
    except json.JSONDecodeError:
        raise argparse.ArgumentTypeError(f"values are JSON, such as [1,2]; this is not: {value}") from None


def _runs(answer: Mapping[str, Any]) -> dict[str, Sequence[object]]:
    """A row for each run."""
    coordinates = answer.get("coordinates", {})
    ends = {name: [column[-1] if column else "" for column in runs] for name, runs in coordinates.items()}
    return {**answer["quantities"], "status": answer["status"], "error": _known(answer["error"]), **ends}


def _statistics(answer: Mapping[str, Any]) -> dict[str, Sequence[object]]:
    """A row for each time that any run reached."""
    columns: dict[str, Sequence[object]] = {f"{name} mean": row for name, row in answer.get("mean", {}).items()}
    quantiles = answer.get("quantiles", {"levels": (), "values": {}})
    for name, rows in quantiles["values"].items():
        columns |= {f"{name} {level:.0%}": row for level, row in zip(quantiles["levels"], rows, strict=True)}
    for name, density in answer.get("density", {}).items():
        edges = density["edges"]
        intervals = [f"{name} {low:.6g} … {high:.6g}" for low, high in pairwise(edges)]
        columns |= dict(zip(intervals, zip(*density["values"], strict=True), strict=True))
    reached = len(next(iter(columns.values())))
    return {"t": answer["t"][:reached], **columns}


def _points(answer: Mapping[str, Any]) -> dict[str, Sequence[object]]:
    """A row for each point of each run; runs are numbered from 0 and come with what varies in them."""
    section = answer["section"]
    runs = [index for index, times in enumerate(section["t"]) for _ in times]
    found: dict[str, Sequence[object]] = {"run": runs}
    found |= {name: [column[index] for index in runs] for name, column in answer["quantities"].items()}
    found |= {"t": _chained(section["t"]), "t_error": _known(_chained(section["t_error"]))}
    found |= {name: _chained(columns) for name, columns in section["coordinates"].items()}
    found |= {f"dot({name})": _chained(columns) for name, columns in section["rates"].items()}
    return found | {"error": _known(_chained(section["error"]))}


def _chained(columns: Sequence[Sequence[object]]) -> list[object]:
    return [value for column in columns for value in column]


def _known(errors: Sequence[object]) -> list[object]:
    """Errors that are not known are left empty."""
    return ["" if error is None else error for error in errors]


TABLES: Mapping[str, Callable[[Mapping[str, Any]], dict[str, Sequence[object]]]] = {
    "runs": _runs,
    "statistics": _statistics,
    "section": _points,
}

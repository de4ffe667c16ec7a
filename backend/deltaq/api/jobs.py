"""The jobs that are more than one call: JSON document in, JSON document out, in a worker.

Others name what answers them, `deltaq.homework.service:check_request`; it is imported in the worker, where SymPy and
Numba begin.
"""

from __future__ import annotations

from collections.abc import Generator
from importlib import import_module
from json import loads
from time import monotonic
from typing import TYPE_CHECKING, Any

from ..errors import MOST_PROBLEMS, Problem
from ..lab.library import get_experiment
from ..mechanics.document import examine
from ..mechanics.toml import read_toml
from ..narration.catalog import text
from ..narration.outcome import explained, outcomes_explained
from ..narration.problems import described

if TYPE_CHECKING:
    from ..derivation.effort import Allowance
    from ..lab.charts.chart import Chart
    from ..lab.experiment import Experiment

Document = dict[str, Any]
Parts = Generator[Document, None, Document]  # yields parts, returns the answer
PART_PAUSE = 0.4  # seconds between two parts of a stream


def derive(document: Document) -> Parts:
    """A derivation with its content hash; before it what leads to the equations of motion."""
    derive_parts = import_module("deltaq.narration.derive").derive_parts
    parts = derive_parts(document["request"], _allowance(document["seconds"]))
    return (yield from _with_id(parts, document["id"]))


def _allowance(seconds: float) -> Allowance:
    """So many seconds from now on."""
    effort = import_module("deltaq.derivation.effort")
    found: Allowance = effort.Allowance(seconds, effort.since_now())
    return found


def export(document: Document) -> Parts:
    """A file; where the time is not enough for all of it, a part that is one without, and TimeIsUp."""
    export_parts = import_module("deltaq.handout.service").export_parts
    parts: Parts = export_parts(document["request"], _allowance(document["seconds"]))
    return (yield from parts)


def _with_id(parts: Parts, identifier: str) -> Parts:
    while True:
        try:
            part = next(parts)
        except StopIteration as end:
            return {"id": identifier, **end.value}
        yield {"id": identifier, **part}


def vary(document: Document) -> Document:
    """A first variation with its content hash."""
    answer: Document = import_module("deltaq.narration.vary").vary_request(document["request"])
    return {**answer, "id": document["id"]}


def simulate(document: Document) -> Document:
    """A trajectory; why it ended, and what to do about it, said in the language asked for."""
    answer: Document = import_module("deltaq.simulation.service").run(document["request"])
    return answer | explained(answer, document["request"]["lang"])


def simulate_at_once(document: Document) -> Document | None:
    """The same while kernels are being compiled; None for a motion that has to wait for them."""
    answer: Document | None = import_module("deltaq.simulation.service").run_at_once(document["request"])
    return None if answer is None else answer | explained(answer, document["request"]["lang"])


def simulate_meanwhile(document: Document) -> Document | None:
    """The same by the kernels that are there, with more patience for those that are not."""
    answer: Document | None = import_module("deltaq.simulation.service").run_meanwhile(document["request"])
    return None if answer is None else answer | explained(answer, document["request"]["lang"])


def ensemble(document: Document) -> Document:
    """Many motions of a scene, on a cluster if there is one; what each status that occurs means, in words."""
    with import_module("deltaq.lab.engine").cluster() as cluster:
        answer: Document = import_module("deltaq.simulation.ensemble_answer").run(document["request"], cluster=cluster)
    return answer | outcomes_explained(answer.pop("outcomes"), document["request"]["lang"])


def judge_ensemble(document: Document) -> Document:
    """Nothing, if it makes sense to run what is asked; InputError as `ensemble` raises it before anything runs."""
    import_module("deltaq.simulation.ensemble_answer").meant_by(document["request"])
    return {}


def ensemble_in_blocks(document: Document) -> Parts:
    """The same, some runs at a time as they are done; then what is told of all of them."""
    language = document["request"]["lang"]
    with import_module("deltaq.lab.engine").cluster() as cluster:
        parts = import_module("deltaq.simulation.ensemble_answer").run_in_parts(document["request"], cluster)
        while True:
            try:
                part = next(parts)
            except StopIteration as end:
                answer: Document = end.value
                return answer | outcomes_explained(answer.pop("outcomes"), language)
            yield part | outcomes_explained(part.pop("outcomes"), language)


def validate(document: Document) -> Document:
    """Whether a scene document can be used, and all its errors and warnings."""
    _, problems = examine(document["scene"])
    told = [*problems[:MOST_PROBLEMS], *([Problem("more-problems")] if len(problems) > MOST_PROBLEMS else ())]
    valid = not any(problem.severity == "error" for problem in problems)
    return {"valid": valid, "problems": described(told, document["lang"])}


def read_scene_toml(document: Document) -> Document:
    """A scene document in TOML as JSON."""
    return {"scene": read_toml(document["text"])}


def typeset_all(document: Document) -> Document:
    """What each of several expressions means, or what is wrong with it."""
    answers, problems = import_module("deltaq.narration.expressions").typeset_all(document)
    told = (described(one, document["lang"]) for one in problems)
    return {"expressions": [{**answer, "problems": list(one)} for answer, one in zip(answers, told, strict=True)]}


def warm(document: Document) -> Document:
    """Bring the compiled kernels of a family of methods to disk, so that nobody else waits for a compiler."""
    import_module("deltaq.simulation.service").warm(document["family"])
    return document


def experiment(document: Document) -> Parts:
    """Parts with the charts so far, not more often than they can be looked at; then the result, which has no words."""
    given = {key: value for key, value in document.items() if key != "experiment"}
    found, shown, result = get_experiment(document["experiment"]), 0.0, {}
    for report in found.run(given):
        result = report.result
        if monotonic() - shown > PART_PAUSE:
            yield {"done": report.done, "total": report.total, "charts": _charts(found, result, document["lang"])}
            shown = monotonic()
    return {"experiment": found.id, **result}


def draw_charts(document: Document) -> Document:
    """A result, given as JSON, with its charts in a language."""
    result: Document = loads(document["result"])
    return result | {"charts": _charts(get_experiment(result["experiment"]), result, document["lang"])}


def _charts(found: Experiment[Any], result: Document, lang: str) -> list[Chart]:
    charts: list[Chart] = import_module("deltaq.lab.experiment").drawn(found, result, text, lang)
    return charts


def export_charts(document: Document) -> Document:
    """Charts as a file."""
    export = import_module("deltaq.lab.export")
    if document["form"] == "csv":
        return {"text": export.table(document["charts"])}
    return {"text": export.page(document["charts"], document["lang"])}


def warm_laboratory(document: Document) -> Document:
    """Bring the kernels that only experiments need to disk."""
    import_module("deltaq.lab.monodromy").warm()
    import_module("deltaq.lab.divergence").warm()
    return document

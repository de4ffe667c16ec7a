"""Answers to `POST /ensembles`: plain data in, plain data out."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterable, Iterator, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from operator import itemgetter
from time import perf_counter

import numpy as np

from ..contract.ensemble import LARGEST, Drawn, EnsembleRequest, Evenly, Variation
from ..contract.reading import read
from ..errors import Problem as Mistake
from ..errors import RequestError, SceneError, escaped
from ..language.spelling import spell_rate
from ..mechanics.bounds import Bound, broken_bounds, start_of
from ..mechanics.coordinate import LARGEST as LARGEST_INITIAL
from ..mechanics.coordinate import too_large
from ..mechanics.requests import begun_scene, inside
from ..mechanics.scene import Scene
from .answer import Document
from .columns import WRITERS, Column
from .ensemble import Ensemble, run_ensemble
from .ensemble_parts import Part, in_parts, joined
from .ensemble_section import Points, Section
from .plane import SIGNS, parsed
from .problem import Floats
from .rounding import rounded, short
from .service import problem_of, require_no_event

INTERVALS, NARROWEST = 64, 1e-9  # of densities; what they cover at least, over the size of a coordinate
LEVELS = (0.05, 0.25, 0.5, 0.75, 0.95)


@dataclass(frozen=True)
class Varied:
    """An ensemble with the values of what varies in it, `quantities` by name: each of shape (runs,)."""

    ensemble: Ensemble
    quantities: Mapping[str, Floats]


@dataclass(frozen=True)
class Meant:
    """What a request means: all that is known before anything runs."""

    asked: EnsembleRequest
    scene: Scene
    varied: Varied
    section: Section | None


def meant_by(document: Mapping[str, object]) -> Meant:
    """What a request means. Raises InputError for what cannot be read, or asks for what makes no sense."""
    asked = read(EnsembleRequest, document)
    scene = begun_scene(asked)
    varied = varied_of(asked, scene)
    return Meant(asked, scene, varied, section_of(asked, scene, varied.ensemble))


def run(
    document: Mapping[str, object],
    report: Callable[[int], None] | None = None,
    cluster: Executor | None = None,
) -> Document:
    """Runs what the request names. Raises InputError as `meant_by`; `report` hears how many runs are done."""
    start, meant = perf_counter(), meant_by(document)
    ensemble, tolerance = meant.varied.ensemble, meant.asked.tolerance
    if cluster is None and meant.section is None:
        found = Part(0, run_ensemble(ensemble, tolerance, report=report))
    else:
        found = joined(_reported(in_parts(ensemble, tolerance, cluster, meant.section), report))
    return _answered(meant, found) | {"wall_time": perf_counter() - start}


def _reported(parts: Iterable[Part], report: Callable[[int], None] | None) -> Iterator[Part]:
    done = 0
    for part in parts:
        done += len(part)
        if report is not None:
            report(done)
        yield part


def run_in_parts(
    document: Mapping[str, object], cluster: Executor | None = None
) -> Generator[Document, None, Document]:
    """The same, with what is told of some runs as soon as they are done; what is told of all of them is returned.

    Columns of the parts, put together in the order of `first`, are those of the whole. Runs are not kept unless there
    are to be statistics of them.
    """
    start, meant = perf_counter(), meant_by(document)
    asked, varied = meant.asked, meant.varied
    names, count = [coordinate.name for coordinate in meant.scene.free], len(varied.ensemble)
    times, outcomes = np.zeros(0), list[tuple[int, Document]]()
    values = np.empty((count, asked.samples, len(names))) if asked.statistics else None
    for part in in_parts(varied.ensemble, asked.tolerance, cluster, meant.section):
        places = slice(part.first, part.first + len(part))
        quantities = {name: each[places] for name, each in varied.quantities.items()}
        outcomes.append((part.first, _first_of_each(part)))
        yield {"first": part.first, "runs": len(part), "of": count, **_of_runs(asked, names, quantities, part)}
        times = part.motion.times
        if values is not None:
            values[places] = part.motion.values
    answer: Document = {"runs": count, "t": WRITERS[asked.columns].write(times), "columns": asked.columns}
    answer["outcomes"] = {
        status: told for _, each in sorted(outcomes, reverse=True, key=itemgetter(0)) for status, told in each.items()
    }
    statistics = {} if values is None else _statistics(asked, names, values)
    return answer | statistics | {"wall_time": perf_counter() - start}


def section_of(asked: EnsembleRequest, scene: Scene, ensemble: Ensemble) -> Section | None:
    """The section that a request means. Raises InputError, at its field, for one that motions cannot be followed to."""
    if asked.section is None:
        return None
    model = ensemble.problem.model
    if model.events is not None or model.switches is not None or model.recurrences.conditions:
        raise RequestError(Mistake("ensemble-section-events", "/section"))
    places = {f"parameters.{one.name}": place for place, one in enumerate(scene.parameters)}
    varied = tuple(places[name] for name in asked.vary if name in places)
    value = parsed(asked.section.value, model.scene, "/section/value")
    found = Section(model.scene, value, SIGNS[asked.section.direction], asked.section.points, varied)
    with inside("/section/value"):
        if found.function.is_constant:
            raise RequestError(Mistake("section-plane-constant", parameters={"plane": value.text[:80]}))
    return found


def varied_of(asked: EnsembleRequest, scene: Scene) -> Varied:
    """The ensemble that a request means. Raises RequestError for a quantity that the scene does not have."""
    with inside("/scene"):
        problem = problem_of(scene, asked.t_end, asked.samples)
        require_no_event(scene, problem)
    if problem.is_constrained:
        told = {"name": "POST /ensembles", "other": "POST /simulations"}
        raise RequestError(Mistake("method-constraints", "/scene", parameters=told))
    places = _places(scene)
    unknown = [name for name in asked.vary if name not in places]
    if unknown:
        known = ", ".join(places)
        missing = [
            Mistake("ensemble-quantity", f"/vary/{escaped(n)}", parameters={"name": n[:80], "known": known})
            for n in unknown
        ]
        raise RequestError(*missing)
    mistakes = [mistake for name, one in asked.vary.items() for mistake in _drawing_mistakes(name, one)]
    if mistakes:
        raise RequestError(*mistakes)
    own = [_values(one, i) for i, one in enumerate(asked.vary.values())]
    _require_positive(asked, scene, own)
    _require_beginning(asked, own)
    columns = _combined(own, asked.combine)
    count = len(columns[0])
    table = np.repeat(np.array([*problem.values, *problem.rates, *problem.parameters])[None, :], count, axis=0)
    for name, column in zip(asked.vary, columns, strict=True):
        table[:, places[name]] = column
    split = 2 * problem.degrees
    ensemble = Ensemble(problem, np.ascontiguousarray(table[:, :split]), np.ascontiguousarray(table[:, split:]))
    _require_bounds(asked, scene, table, own, columns)
    _require_beginnings(scene, ensemble)
    return Varied(ensemble, dict(zip(asked.vary, columns, strict=True)))


def _require_bounds(
    asked: EnsembleRequest, scene: Scene, table: Floats, own: list[Floats], columns: list[Floats]
) -> None:
    """Raises RequestError for the first run whose values break a bound of the scene, at the value that does it.

    `table` has shape (runs, quantities); `own` are the values of each quantity that varies, `columns` those of all.
    """
    keys, start = _keys(scene), start_of(scene)
    for row, numbers in enumerate(table.tolist()):
        for bound in broken_bounds(scene, start | dict(zip(keys, numbers, strict=True))):
            raise RequestError(replace(bound.problem, pointer=_blamed(asked, bound, row, own, columns)))


def _blamed(asked: EnsembleRequest, bound: Bound, row: int, own: list[Floats], columns: list[Floats]) -> str:
    """Where the value stands that breaks a bound in a run; all that varies if it takes several."""
    found = [i for i, name in enumerate(asked.vary) if _coordinate_of(name) in bound.names]
    if len(found) != 1:
        return "/vary"
    (i,) = found
    name, place = list(asked.vary)[i], int(np.flatnonzero(own[i] == columns[i][row])[0])
    variation = asked.vary[name]
    if isinstance(variation, Evenly):
        return f"/vary/{escaped(name)}/{'to' if place else 'from'}"
    return f"/vary/{escaped(name)}/{'normal' if isinstance(variation, Drawn) else place}"


def _coordinate_of(name: str) -> str:
    """The parameter or coordinate of a quantity, such as `initial.x.rate`."""
    return name.split(".")[1]


def _keys(scene: Scene) -> list[str]:
    """How expressions spell each quantity, in the order of values, rates and parameters."""
    free = [coordinate.name for coordinate in scene.free]
    return [*free, *(spell_rate(name, 1) for name in free), *(parameter.name for parameter in scene.parameters)]


def _require_beginnings(scene: Scene, ensemble: Ensemble) -> None:
    """Raises RequestError for the first run that begins behind an event, or at contacts that say nothing of its way."""
    for index in range(len(ensemble) if scene.events else 0):
        try:
            require_no_event(scene, ensemble.member(index))
        except SceneError as error:
            raise RequestError(*(replace(one, pointer="/vary") for one in error.problems)) from None


def _places(scene: Scene) -> dict[str, int]:
    """Where each quantity stands among values, rates and parameters."""
    names = [
        *(f"initial.{coordinate.name}.value" for coordinate in scene.free),
        *(f"initial.{coordinate.name}.rate" for coordinate in scene.free),
        *(f"parameters.{parameter.name}" for parameter in scene.parameters),
    ]
    return {name: place for place, name in enumerate(names)}


def _values(variation: Variation, number: int) -> Floats:
    """The values of one quantity, the `number`-th that varies: shape (count,)."""
    if isinstance(variation, Evenly):
        return np.linspace(variation.begin, variation.to, variation.count)
    if isinstance(variation, Drawn):
        mean, deviation = variation.normal
        return np.random.default_rng([variation.seed, number]).normal(mean, deviation, variation.count)
    return np.array(variation, dtype=np.float64)


def _drawing_mistakes(name: str, variation: Variation) -> Iterator[Mistake]:
    """What is wrong with mean and standard deviation of values that are drawn."""
    least = (-LARGEST, 0.0)
    for i, value in enumerate(variation.normal if isinstance(variation, Drawn) else ()):
        pointer = f"/vary/{escaped(name)}/normal/{i}"
        if value < least[i]:
            yield Mistake("request-too-small", pointer, parameters={"ge": least[i]})
        elif value > LARGEST:
            yield Mistake("request-too-large", pointer, parameters={"le": LARGEST})


def _require_positive(asked: EnsembleRequest, scene: Scene, columns: list[Floats]) -> None:
    """Raises RequestError for the first value of each parameter that is not positive, where the scene says it is."""
    positive = {f"parameters.{one.name}": one.name for one in scene.parameters if one.positive}
    mistakes = []
    for (name, variation), values in zip(asked.vary.items(), columns, strict=True):
        below = np.flatnonzero(values <= 0.0)
        if name in positive and below.size:
            told: dict[str, str | float] = {"name": positive[name], "value": float(values[below[0]])}
            pointer = f"/vary/{escaped(name)}/{_place_of(variation, int(below[0]))}"
            mistakes.append(Mistake("not-positive", pointer, parameters=told))
    if mistakes:
        raise RequestError(*mistakes)


def _require_beginning(asked: EnsembleRequest, columns: list[Floats]) -> None:
    """Raises RequestError for the first of each initial value that no motion is followed from."""
    mistakes = []
    for (name, variation), values in zip(asked.vary.items(), columns, strict=True):
        beyond = np.flatnonzero(np.abs(values) > LARGEST_INITIAL)
        if name.startswith("initial.") and beyond.size:
            place = int(beyond[0])
            pointer = f"/vary/{escaped(name)}/{_source_of(variation, float(values[place]), place)}"
            mistakes.append(too_large(float(values[place]), pointer))
    if mistakes:
        raise RequestError(*mistakes)


def _source_of(variation: Variation, value: float, index: int) -> str:
    """Where in a variation a value of this size comes from."""
    if isinstance(variation, Evenly):
        return "from" if abs(variation.begin) >= abs(value) else "to"
    return "normal" if isinstance(variation, Drawn) else str(index)


def _place_of(variation: Variation, index: int) -> str:
    """Where in a variation its value of a number comes from."""
    if isinstance(variation, Evenly):
        return "from" if variation.begin <= variation.to or index == 0 else "to"
    return "normal" if isinstance(variation, Drawn) else str(index)


def _combined(columns: list[Floats], how: str) -> list[Floats]:
    if how == "together":
        return columns
    return [np.ascontiguousarray(grid.ravel()) for grid in np.meshgrid(*columns, indexing="ij")]


def _answered(meant: Meant, found: Part) -> Document:
    asked, motion, names = meant.asked, found.motion, [coordinate.name for coordinate in meant.scene.free]
    answer = {"runs": len(found), "t": WRITERS[asked.columns].write(motion.times)}
    return answer | _of_runs(asked, names, meant.varied.quantities, found) | _statistics(asked, names, motion.values)


def _of_runs(asked: EnsembleRequest, names: list[str], quantities: Mapping[str, Floats], part: Part) -> Document:
    """What is told of each run."""
    written, found = WRITERS[asked.columns].write, part.motion
    answer: Document = {
        "quantities": {name: written(column) for name, column in quantities.items()},
        "status": [outcome.status for outcome in found.outcomes],
        "outcomes": _first_of_each(part),
        "error": _errors(found.worst, asked.columns),
        "steps": found.steps.tolist(),
        "columns": asked.columns,
    }
    if asked.runs:
        errors = np.nan_to_num(found.errors).max(axis=2)
        values = [rounded(one, each) for one, each in zip(found.values, errors, strict=True)]
        answer["coordinates"] = {
            name: [_reached(np.ascontiguousarray(one[:, i]), written) for one in values] for i, name in enumerate(names)
        }
    return answer if asked.section is None else answer | {"section": _of_points(asked, names, part.points)}


def _of_points(asked: EnsembleRequest, names: list[str], points: tuple[Points, ...]) -> Document:
    """What is told of the points of each run in the section."""
    written, n = WRITERS[asked.columns].write, len(names)
    states = [rounded(each.states, np.nan_to_num(each.errors)) for each in points]
    columns = [[written(np.ascontiguousarray(each[:, i])) for each in states] for i in range(2 * n)]
    return {
        "status": [each.status for each in points],
        "t": [written(rounded(each.times, np.nan_to_num(each.time_errors))) for each in points],
        "coordinates": dict(zip(names, columns[:n], strict=True)),
        "rates": dict(zip(names, columns[n:], strict=True)),
        "error": [_errors(each.errors, asked.columns) for each in points],
        "t_error": [_errors(each.time_errors, asked.columns) for each in points],
    }


def _first_of_each(part: Part) -> Document:
    """For each status the outcome of the first run that has it: what that says in words is said of all."""
    ends: Document = {one.status: (one.code, dict(one.parameters)) for one in part.points[::-1]}
    return ends | {one.status: (one.code, dict(one.parameters)) for one in part.motion.outcomes[::-1]}


def _errors(worst: Floats, columns: str) -> list[float | None] | str:
    """As a column, shape (runs,); what is not known is null among numbers, and NaN where they are packed."""
    if columns != "numbers":
        return WRITERS[columns].write(np.array([short(one) for one in worst]))  # type: ignore[return-value]
    return [None if np.isnan(one) else short(one) for one in worst]


def _reached(values: Floats, written: Callable[[Floats], Column]) -> Column:
    """A column as far as its run came."""
    missing = np.isnan(values)
    return written(values[: int(missing.argmax())] if missing.any() else values)


def _statistics(asked: EnsembleRequest, names: list[str], values: Floats) -> Document:
    """Over the runs that reached a sample; a sample that none reached is left out, with all behind it.

    `values` has shape (runs, samples, n).
    """
    written, answer = WRITERS[asked.columns].write, Document()
    values = values[:, : int(np.isfinite(values).any(axis=(0, 2)).sum())]
    if "mean" in asked.statistics:
        mean = np.nanmean(values, axis=0)
        answer["mean"] = {name: written(np.ascontiguousarray(mean[:, i])) for i, name in enumerate(names)}
    if "quantiles" in asked.statistics:
        levels = np.nanquantile(values, LEVELS, axis=0)
        columns = {name: [written(np.ascontiguousarray(row[:, i])) for row in levels] for i, name in enumerate(names)}
        answer["quantiles"] = {"levels": list(LEVELS), "values": columns}
    if "density" in asked.statistics:
        answer["density"] = {name: _density(values[:, :, i], written) for i, name in enumerate(names)}
    return answer


def _density(values: Floats, written: Callable[[Floats], Column]) -> Document:
    """Of a coordinate, shape (runs, samples), the runs over their number and the width of an interval."""
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    least = NARROWEST * max(abs(low), abs(high), 1.0)
    if high - low < least:
        low, high = low - least, high + least
    edges = np.linspace(low, high, INTERVALS + 1)
    columns = (column[np.isfinite(column)] for column in values.T)
    counts = [np.histogram(column, edges)[0] / (len(column) * (high - low) / INTERVALS) for column in columns]
    return {"edges": written(edges), "values": [written(each) for each in counts]}

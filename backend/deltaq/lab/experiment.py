"""What an experiment is, and how its result is drawn."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from .charts.chart import Chart
from .charts.words import Say, called, spoken, words
from .report import Document, Report


@dataclass(frozen=True)
class Experiment:
    """What is measured, and how it is shown.

    `run` reads a request and reports until it is done; it raises InputError for what cannot be read. `charts` draws
    a result, also an unfinished one.
    """

    id: str
    run: Callable[[Mapping[str, object]], Iterator[Report]]
    charts: Callable[[Document, Say], list[Chart]]


def drawn(experiment: Experiment, result: Document, text: Callable[..., str], language: str) -> list[Chart]:
    """The charts of a result; each says which scene with which values it is about.

    `text(language, key, **parameters)` has the words.
    """
    subject = _subject(result, language)
    return [{**chart, "subject": subject} for chart in experiment.charts(result, words(text, language))]


def _subject(result: Mapping[str, Any], language: str) -> str:
    titles = result["title"]
    values = {called(result, name): value for name, value in result["parameters"].items()}
    values |= {f"{called(result, name)}(0)": start["value"] for name, start in result["initial"].items()}
    told = ", ".join(f"{name} = {spoken(value, language)}" for name, value in values.items())
    return f"{titles.get(language) or next(iter(titles.values()), result['scene'])}: {told}"

"""What an experiment is, and how its result is drawn."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from ..contract.experiment import ExperimentRequest
from ..contract.reading import read
from .charts.chart import Chart
from .charts.words import Say, called, spoken, words
from .report import Document, Report

R = TypeVar("R", bound=ExperimentRequest)


@dataclass(frozen=True)
class Experiment(Generic[R]):
    """What is asked, how it is measured, and how it is shown.

    `measure` takes what was asked and reports until it is done; it raises InputError for names that do not exist.
    `charts` draws a result, also an unfinished one.
    """

    request: type[R]
    measure: Callable[[R], Iterator[Report]]
    charts: Callable[[Document, Say], list[Chart]]

    @property
    def id(self) -> str:
        """As its contract names it."""
        return self.request.experiment

    def run(self, document: Mapping[str, object]) -> Iterator[Report]:
        """The reports on the request in a document. Raises RequestError with all that is wrong with its fields."""
        yield from self.measure(read(self.request, document))


def drawn(experiment: Experiment[Any], result: Document, text: Callable[..., str], language: str) -> list[Chart]:
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

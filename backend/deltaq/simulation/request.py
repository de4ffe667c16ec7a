"""Reading a request for a simulation: every field is checked, every problem told with its JSON pointer."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..errors import RequestError
from ..mechanics.changes import change
from ..mechanics.initial import with_initial
from ..mechanics.requests import requested_scene
from ..mechanics.scene import Scene
from .choice import AUTO
from .fields import Fields

COLUMNS = ("numbers", "base64")  # how arrays may be written (`columns`)
PARTS = ("coordinates", "rates", "positions", "loads", "energy", "error")
FIELDS = ("scene", "guides", "freeze", "parameters", "initial", "t_end", "samples", "method", "tolerance", "step")
LARGEST_SPAN, SAMPLES, DEFAULT_SAMPLES = 1e5, (2, 20001), 501
SHORTEST = 1e-250  # seconds; parts of less are no longer different numbers
TOLERANCES, DEFAULT_TOLERANCE = (1e-13, 1e-1), 1e-6


@dataclass(frozen=True)
class Request:
    """A simulation to run. `scene` has the parameter and initial values wanted; exactly one of step and tolerance."""

    scene: Scene
    t_end: float
    samples: int
    method: str
    step: float | None
    tolerance: float | None
    include: frozenset[str]
    columns: str


def read_request(document: Mapping[str, object]) -> Request:
    """The request in a document. Raises InputError with all problems of the fields, or of the scene."""
    fields = Fields(document)
    t_end = fields.number("t_end", 0.0, LARGEST_SPAN, required=True)
    step = fields.number("step", 0.0, max(t_end or 0.0, 0.0) or LARGEST_SPAN)
    tolerance = fields.number("tolerance", *TOLERANCES, closed=True)
    for key, value in {"t_end": t_end, "step": step}.items():
        if value is not None and value < SHORTEST:
            fields.complain("request-outside", f"/{key}", value=value, min=SHORTEST, max=LARGEST_SPAN)
    if step is not None and tolerance is not None:
        fields.complain("request-step-and-tolerance", "/tolerance")
    samples, method = fields.whole("samples", *SAMPLES, DEFAULT_SAMPLES), fields.text("method", AUTO)
    include, values = fields.some_of("include", PARTS), fields.numbers("parameters")
    initial, guides, freeze = fields.initial(), fields.guides(), fields.names("freeze")
    if not isinstance(document.get("scene"), str | Mapping):
        fields.complain("request-scene-type", "/scene")
    columns = fields.one_of("columns", COLUMNS)
    fields.reject_all_but((*FIELDS, "include", "columns", "lang"))
    if fields.problems:
        raise RequestError(*fields.problems)
    scene, parameters = requested_scene(document["scene"], values)
    changed = change(with_initial(scene, initial, freeze), guides, freeze, parameters)
    wanted = DEFAULT_TOLERANCE if step is None and tolerance is None else tolerance
    return Request(changed, t_end or 0.0, samples, method, step, wanted, include, columns)

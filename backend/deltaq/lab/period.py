"""The period of a scene: the shortest time after which everything that depends on the time explicitly repeats.

The time may stand in sines and cosines of ω t + α only. With several frequencies their ratios must be rational, with
small numbers, as those of a Fourier series are.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields, is_dataclass
from fractions import Fraction

from ..errors import Problem, SceneError
from ..language.floats import evaluate
from ..language.tree import Call, Name, Node, walk
from ..mechanics.scene import Scene

LARGEST_DENOMINATOR = 12
CLOSE = 1e-9


def period(scene: Scene, parameters: Mapping[str, float] | None = None) -> float:
    """The period in seconds at these parameter values (else the scene's own).

    Raises SceneError `not-periodic` where the time stands elsewhere or the frequencies have no common one, and
    `no-period` where nothing depends on the time.
    """
    values = scene.parameter_values | dict(parameters or {})
    return common_period(tuple(clocks(scene)), values)


def common_period(arguments: Iterable[Node], values: Mapping[str, float]) -> float:
    """The period of what has these arguments of sines and cosines. Raises SceneError as `period` does."""
    found = sorted({frequency for clock in arguments if (frequency := _frequency(clock, values)) > 0.0})
    if not found:
        raise SceneError(Problem("no-period", "/guides"))
    ratios = [Fraction(frequency / found[0]).limit_denominator(LARGEST_DENOMINATOR) for frequency in found]
    if any(abs(float(r) * found[0] - f) > CLOSE * f for r, f in zip(ratios, found, strict=True)):
        raise SceneError(Problem("not-periodic", "/guides"))
    return math.tau / found[0] * math.lcm(*(ratio.denominator for ratio in ratios))


def clocks(part: object) -> Iterator[Node]:
    """The arguments of all sines and cosines that the time stands in. Raises SceneError if it stands elsewhere."""
    match part:
        case Call("sin" | "cos", (argument,)) if Name("t") in walk(argument):
            yield argument
        case Name("t"):
            raise SceneError(Problem("not-periodic", "/guides"))
        case tuple():
            for each in part:
                yield from clocks(each)
        case _ if is_dataclass(part):
            for field in fields(part):
                yield from clocks(getattr(part, field.name))


def _frequency(clock: Node, values: Mapping[str, float]) -> float:
    """|ω| of an argument ω t + α."""
    try:
        first, second, third = (evaluate(clock, {**values, "t": time}) for time in (0.0, 1.0, 2.0))
    except (KeyError, ArithmeticError, ValueError):  # it depends on a coordinate, or has no value
        raise SceneError(Problem("not-periodic", "/guides")) from None
    if abs(third - 2.0 * second + first) > CLOSE * (abs(second - first) + 1.0):
        raise SceneError(Problem("not-periodic", "/guides"))
    return abs(second - first)

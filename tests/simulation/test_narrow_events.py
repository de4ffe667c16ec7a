"""Gaps, kinks and rates of slipping that dip below zero for less than a step, against closed forms."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import mpmath as mp
import pytest

from deltaq.simulation.service import run

PLACE, END, FORCE = 1.2345, 2.2, 0.1
STEEP = math.sqrt(math.log(1.5))  # 1.5 exp(−z²) = 1 at z = −STEEP first
NAMES = ("b", "w", "F")


@dataclass(frozen=True)
class Narrow:
    """A free mass of 1 kg that begins at (0, 1) with the rate (1, 0); `end`, where it ends, by the width w."""

    end: Callable[[float], tuple[float, float]]
    events: str = ""
    loads: tuple[dict[str, Any], ...] = ()

    def scene(self, width: float) -> dict[str, Any]:
        parameters = zip(NAMES, (PLACE, width, FORCE), strict=True)
        bounces = [{"name": "contact", "value": self.events, "then": "bounce", "restitution": "1"}]
        return {
            "format": 1,
            "id": "narrow",
            "dimension": 2,
            "coordinates": [{"name": "x", "value": 0.0, "rate": 1.0}, {"name": "y", "value": 1.0, "rate": 0.0}],
            "parameters": [{"name": name, "value": value, "positive": False} for name, value in parameters],
            "bodies": [{"name": "mass", "kind": "particle", "mass": "1", "position": ["x", "y"]}],
            "loads": list(self.loads),
            "events": bounces if self.events else [],
        }


def off_a_bump(width: float) -> tuple[float, float]:
    """v′ = v − 2 (v·n) n/n², n = (2 z/w, 1) with z = (x − b)/w, where the bump is met."""
    slope = -2.0 * STEEP / width
    met = PLACE - STEEP * width
    push = -2.0 * slope / (1.0 + slope * slope)
    return met + (1.0 + push * slope) * (END - met), 1.0 + push * (END - met)


def off_a_table(width: float) -> tuple[float, float]:
    """ẏ′ = 2 ż of the table, whose height is z."""
    met = PLACE - STEEP * width
    return END, 1.0 + 4.0 * STEEP / width * (END - met)


def off_a_string(width: float) -> tuple[float, float]:
    """ẏ′ = 2 dℓ/dt, ℓ = 4 + w (1 − 1.5 exp(−z²)), and the mass 4 m above the other end, which goes along with it."""
    return END, 1.0 - 4.0 * STEEP * (END - PLACE + STEEP * width)


def pushed_while(width: float) -> tuple[float, float]:
    """1/w N while |x − b| < w STEEP."""
    return END, 1.0 + 2.0 * STEEP * (END - PLACE)


def pushed_by(width: float) -> tuple[float, float]:
    """The impulse ∫ max(0, 1.5 exp(−z²) − 1) dz, about b."""
    impulse = mp.quad(lambda z: 1.5 * mp.exp(-z * z) - 1.0, [-STEEP, STEEP])
    return END, 1.0 + float(impulse) * (END - PLACE)


def on_a_belt(width: float) -> tuple[float, float]:
    """Friction brakes by F, and drives by F between the times at which belt and mass are equally fast."""

    def ahead(t: Any, since: float, rate: float) -> Any:
        return 1.5 * mp.exp(-(((t - PLACE) / width) ** 2)) - rate - FORCE * (t - since)

    begin = float(mp.findroot(lambda t: ahead(t, 0.0, 1.0) + 2.0 * FORCE * t, (PLACE - 2.0 * width, PLACE), "anderson"))
    rate = 1.0 - FORCE * begin
    end = float(mp.findroot(lambda t: ahead(t, begin, rate), (PLACE, PLACE + 2.0 * width), "anderson"))
    gained = 2.0 * FORCE * ((end - begin) * (END - 0.5 * (begin + end)))
    return END - 0.5 * FORCE * END**2 + gained, 1.0


HILL, PULSE = "1.5*exp(-((x - b)/w)^2)", "1.5*exp(-((t - b)/w)^2)"


def force(along_y: str) -> tuple[dict[str, Any], ...]:
    return ({"kind": "force", "at": "mass", "force": ["0", along_y]},)


CASES = {
    "a bump on a floor": Narrow(off_a_bump, f"y - {HILL}"),
    "a table that jerks": Narrow(off_a_table, f"y - {PULSE}"),
    "a string that is pulled": Narrow(off_a_string, f"4 + w*(1 - {PULSE}) - sqrt((x - t)^2 + (y + 3)^2)"),
    "a push between two places": Narrow(pushed_while, "", force(f"1/w*step({HILL} - 1)")),
    "a push between two times": Narrow(pushed_while, "", force(f"1/w*step({PULSE} - 1)")),
    "a push by what is above": Narrow(pushed_by, "", force(f"1/w*max(0, {HILL} - 1)")),
    "a push by what is later above": Narrow(pushed_by, "", force(f"1/w*max(0, {PULSE} - 1)")),
    "a belt that jerks": Narrow(
        on_a_belt, "", ({"kind": "friction", "coordinate": "x", "force": "F", "surface_rate": PULSE},)
    ),
}


@pytest.mark.parametrize("width", [0.1, 1e-2, 1e-4, 1e-5])
@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("method", ["auto", "dop853", "taylor", "radau-5", "rk4"])
def test_what_is_narrower_than_a_step_is_met(name: str, method: str, width: float) -> None:
    case = CASES[name]
    found = run({"scene": case.scene(width), "t_end": END, "method": method, "tolerance": 1e-6})
    end = [found["coordinates"][each][-1] for each in ("x", "y")]
    assert found["status"] == "ok"
    assert end == pytest.approx(case.end(width), rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("left", [0.04, 0.02, 0.01, 0.004])
@pytest.mark.parametrize("method", ["rk4", "heun", "dop853", "dormand-prince-54", "gauss-4", "newmark", "taylor"])
@pytest.mark.parametrize("push", ["-k*max(0, x - 1)", "-k*(1 + sign(x - 1))/2*(x - 1)"])
def test_of_two_runs_that_have_less_than_a_step_left_one_takes_several(push: str, method: str, left: float) -> None:
    """A spring with ω = 60/s that is met at x = t = 1 m, so that x = 1 + sin(ωs)/ω."""
    scene = Narrow(pushed_by, loads=({"kind": "force", "at": "mass", "force": [push, "0"]},)).scene(1.0)
    scene["parameters"] = [{"name": "k", "value": 3600.0}]
    found = run({"scene": scene, "t_end": 1.0 + left, "method": method, "step": 0.1})
    off = abs(found["coordinates"]["x"][-1] - 1.0 - math.sin(60.0 * left) / 60.0)
    assert found["status"] == "ok"
    assert off <= 1.5 * found["error"]["estimate"][-1] + 1e-13

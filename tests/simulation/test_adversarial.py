"""No answer is silently wrong: motions made to fool a simulation, asked as users ask, beside their truth.

A few of each kind, the same each time; `tests.benchmarks.bench_adversarial` draws a thousand.
"""

from __future__ import annotations

import math
from functools import partial
from random import Random

import numpy as np
import pytest
from tests.simulation.adversaries import Draw, aimed_drive, on_line, pulse, under_waves
from tests.simulation.adversaries_of_state import KINDS, chain_of_springs, contact, relative_coordinates
from tests.simulation.judging import Motion, Trial, Verdict, draw_motions, draw_trial, judge

EACH, SEED = 3, "few"


def told(verdict: Verdict) -> str:
    return (
        f"{verdict.status}, true error {verdict.worst:.2g}, over the estimate {verdict.wrong:.3g}: "
        f"{verdict.trial.motion.family}, {verdict.trial.label}"
    )


@pytest.mark.one_in(3)
@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_no_answer_is_silently_wrong(kind: Draw) -> None:
    verdicts = [judge(draw_trial(motion, random)) for motion, random in draw_motions(kind, SEED, EACH)]
    assert [told(v) for v in verdicts if v.is_silently_wrong()] == []


@pytest.mark.parametrize("part", [0.3, 1.5, 4.0])  # of a stay on the spring
@pytest.mark.parametrize("method", ["taylor", "symplectic-euler", "stormer-verlet"])
def test_steps_longer_than_the_time_between_two_bends_of_a_force(method: str, part: float) -> None:
    motions = [contact(Random(f"bends {number}")) for number in range(8)]
    drawn = [Trial(motion, method, ("step", part * motion.traps[0]), 101) for motion in motions]
    verdicts = [judge(trial) for trial in drawn if trial.motion.t_end / trial.accuracy[1] < 1_000]
    assert len(verdicts) > 3
    assert [told(v) for v in verdicts if v.is_silently_wrong()] == []


def test_no_drive_aimed_at_the_steps_is_overlooked() -> None:
    verdicts = [judge(aimed_drive(Random(f"gate {number}"))) for number in range(6)]
    assert [told(v) for v in verdicts if v.is_silently_wrong()] == []


def sine(frequency: float, stiffness: float, span: float, start: tuple[float, float] = (1.0, 0.0)) -> Motion:
    """m = 1: x″ = −k x + ω sin ωt."""
    pace = 2.0 * math.pi * frequency
    scene = on_line("-k*x + omega*sin(omega*t)", start, {"k": stiffness, "omega": pace})
    wave = (np.longdouble(pace), np.longdouble(pace), -np.longdouble(math.pi) / 2)
    return Motion("sine", scene, span, ("x",), partial(under_waves, stiffness, start, [wave]), 1e-12)


@pytest.mark.parametrize("method", ["rk4", "stormer-verlet", "newmark", "gauss-4", "implicit-midpoint"])
@pytest.mark.parametrize("frequency", [20.0, 40.0, 80.0])
def test_drives_of_which_first_steps_meet_only_zeros(method: str, frequency: float) -> None:
    verdict = judge(Trial(sine(frequency, 1.0, 10.0), method, ("tolerance", 1e-3), 501))
    assert not verdict.is_silently_wrong(), told(verdict)


@pytest.mark.parametrize("method", ["rk4", "heun", "gauss-6", "radau-5", "variational-midpoint"])
def test_step_that_cannot_see_the_drive_says_so(method: str) -> None:
    """400 Hz, four periods in a step."""
    verdict = judge(Trial(sine(400.0, 1.0, 5.0), method, ("step", 0.01), 501))
    assert not verdict.is_silently_wrong(), told(verdict)


@pytest.mark.parametrize("width", [2e-2, 2e-3, 2e-4])
@pytest.mark.parametrize("stiffness", [0.0, 2.0])
def test_default_call_sees_a_pulse(width: float, stiffness: float) -> None:
    verdict = judge(Trial(pulse(stiffness, 10.0, (7.3, width), (2.0, 0.0), 1.0), "auto", ("tolerance", 1e-6), 501))
    assert not verdict.is_silently_wrong(), told(verdict)


def test_drive_at_the_rate_of_the_samples_is_no_alarm() -> None:
    """A free mass at 50 Hz: 501 samples in ten seconds see it stand still, or go straight on."""
    verdict = judge(Trial(sine(50.0, 0.0, 10.0, (0.0, 0.0)), "auto", ("tolerance", 1e-6), 501))
    assert not verdict.is_false_alarm, told(verdict)


@pytest.mark.one_in(2)
@pytest.mark.parametrize("light", [1.7e-7, 3.3e-8, 1e-9])
def test_rounding_with_a_light_mass_is_told(light: float) -> None:
    """The scene is not singular, and the estimate covers the error of M's last digits whether or not it is small."""
    motion = chain_of_springs(Random("light 7"), [light, 1.0], 10.0, "light")
    verdict = judge(Trial(motion, "dop853", ("tolerance", 1e-11), 201))
    assert not verdict.is_false_alarm, told(verdict)
    assert verdict.uncovered <= 1.0, told(verdict)


def test_sound_scenes_are_not_refused() -> None:
    """Relative coordinates make M nearly singular, and no more than that."""
    verdicts = [judge(draw_trial(motion, random)) for motion, random in draw_motions(relative_coordinates, "sound", 8)]
    assert [told(v) for v in verdicts if v.is_false_alarm or v.is_silently_wrong()] == []

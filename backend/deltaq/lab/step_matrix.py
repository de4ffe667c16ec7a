"""The growth of a linear motion ẏ = J y, y = (q, q̇), in one step of a method: the spectral radius of the step's matrix.

For Runge–Kutta methods that is the largest |R(hλ)|. Methods that treat positions and momenta unlike each other see
p = P y and ṗ = S y, so for them it is no function of the λ alone unless the motion is a sum of damped vibrations.
Source: Hairer, Wanner, Solving Ordinary Differential Equations II, IV.2–IV.3; Hairer, Lubich, Wanner, II.2 and VI.3.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import singledispatch

import numpy as np

from ..simulation import weights
from ..simulation.method import Newmark, Partitioned, Series, Tableau
from ..simulation.problem import Floats, Problem
from ..simulation.stiffness import jacobians

NUDGE = 1e-6

Step = Callable[[float], Floats]


@dataclass(frozen=True)
class Linear:
    """A motion ẏ = J y linearized at its start, y = (q, q̇): J is zero where it has no value.

    `jacobian` is J = ∂ẏ/∂y, shape (2n, 2n); `momentum` P = ∂p/∂y and `rate` S = ∂ṗ/∂y have shape (n, 2n).
    """

    jacobian: Floats
    momentum: Floats
    rate: Floats


def linear(problem: Problem) -> Linear:
    """The linearization of a problem at its initial state, by central differences."""
    n, start = problem.degrees, problem.state[: 2 * problem.degrees]
    jacobian = jacobians(problem, np.zeros(1), start[None, :])[0]
    nudges = NUDGE * np.maximum(1.0, np.abs(start))
    states = np.concatenate([start + np.diag(nudges), start - np.diag(nudges)])
    table = problem.model.phase.function.table(problem.inputs(np.zeros(len(states)), states))
    ahead, behind = np.split(table[:, n * (n + 1) // 2 :], 2)
    found = ((ahead - behind) / (2.0 * nudges[:, None])).T
    return Linear(np.nan_to_num(jacobian, posinf=0.0, neginf=0.0), found[:n], found[n : 2 * n])


def step_growth(scheme: object, motion: Linear) -> Callable[[float], float]:
    """The factor by which the fastest growing part grows in a step h; infinite where the step has no solution."""
    matrix = step_matrix(scheme, motion)

    def grown(h: float) -> float:
        try:
            return float(np.abs(np.linalg.eigvals(matrix(h))).max())
        except np.linalg.LinAlgError:
            return math.inf

    return grown


@singledispatch
def step_matrix(scheme: object, _motion: Linear) -> Step:
    """The matrix of a step h: y₁ = R(h) y₀."""
    raise TypeError(f"no step is known for {type(scheme).__name__}")


@step_matrix.register
def _of_tableau(scheme: Tableau, motion: Linear) -> Step:
    """kᵢ = J (1 + h Σ aᵢⱼ kⱼ), R = 1 + h Σ bᵢ kᵢ"""
    one = np.eye(len(motion.jacobian))
    a, b = weights.matrix(scheme.a, scheme.stages), weights.matrix((scheme.b,), scheme.stages)

    def matrix(h: float) -> Floats:
        slopes = np.zeros((scheme.stages, *one.shape))
        for place in range(scheme.stages):
            slopes[place] = motion.jacobian @ (one + h * np.tensordot(a[place, :place], slopes[:place], 1))
        return np.asarray(one + h * np.tensordot(b[0], slopes, 1))

    return matrix


@step_matrix.register
def _of_series(scheme: Series, motion: Linear) -> Step:
    """R = Σ (h J)ᵏ/k!, by Horner's rule."""
    one = np.eye(len(motion.jacobian))

    def matrix(h: float) -> Floats:
        found = one
        for k in range(scheme.order, 0, -1):
            found = one + h / k * motion.jacobian @ found
        return np.asarray(found)

    return matrix


@step_matrix.register
def _of_pair(scheme: Partitioned, motion: Linear) -> Step:
    """Q = q + h A V and P (Q, V) = p + h Â S (Q, V) at all stages; then q + h Σ bᵢ Vᵢ and p + h Σ bᵢ S (Qᵢ, Vᵢ)."""
    n, s, p = len(motion.momentum), scheme.stages, motion.momentum
    tables = (weights.matrix(scheme.a, s), weights.matrix(scheme.momentum_a, s), weights.matrix((scheme.b,), s))
    a, hat, b = (np.kron(table, np.eye(n)) for table in tables)
    p_q, p_v, s_q, s_v = (
        np.kron(np.eye(s), part[:, half]) for part in (p, motion.rate) for half in (slice(0, n), slice(n, 2 * n))
    )
    many, place = np.ones((s, 1)), np.eye(n, 2 * n)
    start, begun = np.kron(many, place), np.kron(many, p)

    def matrix(h: float) -> Floats:
        at_places, at_speeds = p_q - h * hat @ s_q, p_v - h * hat @ s_v
        speeds = np.linalg.solve(h * at_places @ a + at_speeds, begun - at_places @ start)
        end = place + h * b @ speeds
        momentum = p + h * b @ (s_q @ (start + h * a @ speeds) + s_v @ speeds)
        return np.vstack([end, np.linalg.solve(p[:, n:], momentum - p[:, :n] @ end)])

    return matrix


@step_matrix.register
def _of_newmark(scheme: Newmark, motion: Linear) -> Step:
    """a = q̈ at both ends; q₁ = q + h q̇ + h² ((½ − β) a + β a₁), q̇₁ = q̇ + h ((1 − γ) a + γ a₁)."""
    n, beta, gamma = len(motion.momentum), float(scheme.beta), float(scheme.gamma)
    one, law = np.eye(2 * n), motion.jacobian[n:]

    def matrix(h: float) -> Floats:
        free = one + h * np.eye(2 * n, k=n)
        before = free + np.vstack([h * h * (0.5 - beta) * law, h * (1.0 - gamma) * law])
        after = one - np.vstack([h * h * beta * law, h * gamma * law])
        return np.asarray(np.linalg.solve(after, before))

    return matrix

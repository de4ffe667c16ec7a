"""Where methods are stable: the growth of a linear motion in one step, and the largest step that does not make it grow.

A linear motion with the eigenvalues λ and λ̄ is the oscillator ẍ = 2 Re(λ) ẋ − |λ|² x. One step of size h multiplies
(x, ẋ) by a matrix that depends on z = hλ alone; its spectral radius is the growth, for Runge–Kutta methods |R(z)|.
Source: Hairer, Wanner, Solving Ordinary Differential Equations II, IV.2–IV.3; Hairer, Lubich, Wanner, I.1 and VI.3.
"""

from __future__ import annotations

import math
from functools import cache, singledispatch
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .method import Newmark, Partitioned, Scheme, Series, Tableau
from .problem import Floats
from .weights import matrix, numbers

FINENESS, FARTHEST = 0.01, 20.0
ROUNDING = 1e-9  # of a growth that is 1 on paper
FIRST, LAST, STEPS = 1e-3, 1e3, 1200  # of h times the largest |λ|, looked at in even ratios

Complexes = NDArray[np.complex128]


@singledispatch
def growth(scheme: object, _z: Complexes) -> Floats:
    """The factor by which a step makes a motion with the eigenvalues z/h grow, for z of any shape (…,).

    For Runge–Kutta methods it is |R(z)|. Raises TypeError for a scheme of an unknown family.
    """
    raise TypeError(f"no stability function is known for {type(scheme).__name__}")


@growth.register
def _of_tableau(scheme: Tableau, z: Complexes) -> Floats:
    """|R(z)|, R(z) = 1 + z bᵀ k with kᵢ = 1 + z Σ aᵢⱼ kⱼ, stage by stage"""
    a, b = matrix(scheme.a, scheme.stages), numbers(scheme.b)
    derivatives: list[NDArray[Any]] = []
    for row in a:
        derivatives.append(1.0 + z * sum((weight * k for weight, k in zip(row, derivatives, strict=False)), 0.0 * z))
    return np.asarray(np.abs(1.0 + z * sum((weight * k for weight, k in zip(b, derivatives, strict=True)), 0.0 * z)))


@growth.register
def _of_series(scheme: Series, z: Complexes) -> Floats:
    """|Σ zᵏ/k!| up to the order, by Horner's rule"""
    value = np.ones_like(np.asarray(z, dtype=np.complex128))
    for k in range(scheme.order, 0, -1):
        value = 1.0 + z / k * value
    return np.asarray(np.abs(value))


@growth.register
def _of_pair(scheme: Partitioned, z: Complexes) -> Floats:
    """From the stages Q = x 𝟙 + A V, V = ẋ 𝟙 + Â F, F = 2 Re(z) V − |z|² Q, with h = 1."""
    s, z = scheme.stages, np.asarray(z)[..., None, None]
    a, hat, b = matrix(scheme.a, s), matrix(scheme.momentum_a, s), numbers(scheme.b)
    damping, square = 2.0 * z.real, np.abs(z) ** 2
    system = np.eye(s) - hat @ (damping * np.eye(s) - square * a)
    start = np.stack([-square[..., 0] * hat.sum(axis=1), np.ones((*z.shape[:-2], s))], axis=-1)  # of V, by x and by ẋ
    speed = np.linalg.solve(system, start)
    place = a @ speed + np.array([1.0, 0.0])
    force = damping * speed - square * place
    return _radius(np.eye(2) + np.stack([b @ speed, b @ force], axis=-2))


@growth.register
def _of_newmark(scheme: Newmark, z: Complexes) -> Floats:
    """a = 2 Re(z) v − |z|² x at both ends; x₁ = x + v + (½ − β) a + β a₁, v₁ = v + (1 − γ) a + γ a₁, with h = 1."""
    beta, gamma = float(scheme.beta), float(scheme.gamma)
    damping, square = 2.0 * np.asarray(z).real, np.abs(z) ** 2
    law = np.stack([-square, damping], axis=-1)[..., None, :]
    before = np.array([[1.0, 1.0], [0.0, 1.0]]) + np.array([[0.5 - beta], [1.0 - gamma]]) @ law
    after = np.eye(2) - np.array([[beta], [gamma]]) @ law
    return _radius(np.linalg.solve(after, before))


def largest_stable_step(scheme: Scheme, eigenvalues: Complexes) -> float:
    """The first step size from which on some part grows that would not grow by itself, in seconds.

    Infinite if there is none up to a thousand times that of the fastest part, 0 if every step makes it grow.
    `eigenvalues`, in 1/s, has shape (2n,).
    """
    fastest = float(np.abs(eigenvalues).max(initial=0.0))
    passive = eigenvalues[eigenvalues.real <= ROUNDING * fastest]
    if fastest == 0.0 or passive.size == 0:
        return math.inf
    steps = np.geomspace(FIRST, LAST, STEPS) / fastest
    grows = (growth(scheme, steps[:, None] * passive) > 1.0 + ROUNDING).any(axis=1)
    if not grows.any():
        return math.inf
    return float(steps[np.argmax(grows) - 1]) if np.argmax(grows) else 0.0


@cache
def real_stability(scheme: Scheme) -> float:
    """How far an explicit method is stable on the negative real axis, to about one percent below; others: unasked."""
    if not isinstance(scheme, Tableau | Series):
        return math.inf
    places = np.arange(FINENESS, FARTHEST, FINENESS)
    unstable = places[growth(scheme, -places.astype(np.complex128)) > 1.0 + ROUNDING]
    return 0.99 * float(unstable[0] if unstable.size else FARTHEST)


def _radius(matrices: Floats) -> Floats:
    return np.asarray(np.abs(np.linalg.eigvals(matrices)).max(axis=-1))

"""What a quantity is asked of: bodies, coordinates, or the scene as a whole ("")."""

from __future__ import annotations

from .equality import frequencies
from .solution import Solution


def bodies(solution: Solution) -> list[str]:
    """Each body."""
    return [body.name for body in solution.scene.bodies]


def coordinates(solution: Solution) -> tuple[str, ...]:
    """Each free coordinate."""
    return solution.free


def whole(_solution: Solution) -> tuple[str, ...]:
    """The scene as a whole."""
    return ("",)


def loaded(solution: Solution) -> tuple[str, ...]:
    """The scene, if loads act on it."""
    return ("",) if solution.load_names else ()


def with_potential(solution: Solution) -> tuple[str, ...]:
    """The scene, if a load has a potential."""
    return ("",) if any(map(solution.is_conservative, solution.load_names)) else ()


def coupled(solution: Solution) -> tuple[str, ...]:
    """The scene, if it has several degrees of freedom."""
    return ("",) if len(solution.free) > 1 else ()


def resting(solution: Solution) -> tuple[str, ...]:
    """Each free coordinate, if the scene has a position of rest."""
    return solution.free if solution.rest is not None else ()


def oscillating(solution: Solution) -> tuple[str, ...]:
    """The scene, if it oscillates about a position of rest."""
    return ("",) if solution.rest is not None and _positive(solution) else ()


def _positive(solution: Solution) -> bool:
    return bool(solution.frequencies) and all(
        frequencies.number_of(each, solution) > 1e-9 for each in solution.frequencies
    )


def numbered(solution: Solution) -> list[str]:
    """Each conserved quantity, by its number."""
    return [str(n) for n, _ in enumerate(solution.conserved_of, 1)]

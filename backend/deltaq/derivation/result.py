"""What a derivation leads to, as expressions: the answer that programs read."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import combinations

import sympy as sp

from ..language.derivatives import beside_jumps
from ..language.memory import cached_method
from ..mechanics.scene import Scene
from ..vocabulary import CurlOutcome, GeneratorFamily, SearchEnd
from . import provenance
from .conditions import Conditions, conditions
from .conservation import Reduction, cyclic, is_energy, jacobi_energy, jacobi_energy_rate
from .contact_equilibria import ContactSearch
from .displacement import meaning
from .equilibria import Search
from .formula import Explicit, Term
from .generator import Generator, Symmetry, solved
from .impacts import Contact, Sticking, contacts, contacts_of, sticking
from .linearization import Linearization
from .matrix_form import forcing, left_side, mass_matrix, slopes
from .multipliers import multipliers
from .optional import (
    contact_search_of,
    kink_search_of,
    left_out_of,
    motions_of,
    reduction_of,
    search_of,
    steady_motions_of,
    symmetries_of,
)
from .released import Release
from .rest_sets import RestSearch
from .rules.curl_test import outcome
from .space import motions
from .steady import SteadyMotion
from .system import System
from .terms import terms_of

Terms = Mapping[str, Mapping[str, tuple[Term, ...]]]


@dataclass(frozen=True)
class Conserved:
    """A quantity that does not change along the motion: a momentum, the Jacobi energy, or that of another symmetry.

    `meaning` says in a word what its generator does, `step` is the id of the step that shows it. `special` holds the
    parameters by others or by a number, where it is conserved for these only; `contacts` those between whose impacts it
    is.
    """

    kind: str
    coordinate: str
    value: sp.Expr
    generator: Generator
    meaning: str
    step: str
    special: Mapping[sp.Symbol, sp.Expr] = field(default_factory=dict)
    contacts: tuple[str, ...] = ()


@dataclass(frozen=True)
class LoadPotential:
    """Whether a load has a potential: the outcome of its curl test, and V where it can be written down.

    `curl` holds ∂Qᵢ/∂qₖ − ∂Qₖ/∂qᵢ for every pair of free coordinates.
    """

    load: str
    outcome: CurlOutcome
    has_potential: bool
    potential: sp.Expr | None
    curl: Mapping[tuple[str, str], sp.Expr]


@dataclass(frozen=True)
class Bound:
    """A constraint as an equation `… = 0`, its multiplier, and what it does: λ in closed form or None, λ aᵢ."""

    name: str
    kind: str
    is_holonomic: bool
    equation: sp.Expr
    multiplier: sp.Symbol
    reaction: sp.Expr | None
    forces: Mapping[str, sp.Expr]


@dataclass(frozen=True)
class Told:
    """An equilibrium with its small motions, and the conditions in the parameters where they are known."""

    linear: Linearization
    conditions: Conditions | None


@dataclass(frozen=True)
class Result:
    """Expressions in the scene's symbols; vectors are columns, forces and equations go by coordinate.

    An equation is the left side of `… = 0`; mass matrix and forcing are those of M(q, t) q̈ = f(q, q̇, t). `is_energy`
    says whether the Jacobi energy is E + V. `terms` are the sums, by what they add up to and by coordinate ("" for what
    belongs to none), with the bodies and loads each term comes from.
    """

    scene: Scene
    positions: Mapping[str, sp.ImmutableMatrix]
    points: Mapping[str, sp.ImmutableMatrix]
    virtual_displacements: Mapping[str, sp.ImmutableMatrix]
    virtual_work: sp.Expr
    kinetic_energy: sp.Expr
    potential_energy: sp.Expr
    total_forces: Mapping[str, sp.Expr]
    conservative_forces: Mapping[str, sp.Expr]
    nonconservative_forces: Mapping[str, sp.Expr]
    lagrangian: sp.Expr
    equations: Mapping[str, sp.Expr]
    mass_matrix: sp.ImmutableMatrix
    forcing: sp.ImmutableMatrix
    jacobi_energy: sp.Expr
    is_energy: bool
    terms: Terms
    loads: tuple[LoadPotential, ...]
    conserved: tuple[Conserved, ...] = ()
    equilibria: tuple[Told, ...] = ()
    resting: ContactSearch | None = None
    search: Search | None = None
    kinked: RestSearch | None = None
    left_out: SearchEnd | None = None
    routh: Reduction | None = None
    steady: tuple[SteadyMotion, ...] = ()
    generators: tuple[GeneratorFamily, ...] = ()
    constraints: tuple[Bound, ...] = ()
    reactions: tuple[Release, ...] = ()
    contacts: tuple[Contact, ...] = ()
    sticking: tuple[Sticking, ...] = ()


def result_of(system: System) -> Result:
    """What a derivation leads to, computed once for the system; SceneError where an integral has no closed form."""
    return completed(system, equations_of(system))


def completed(system: System, result: Result) -> Result:
    """The result with what the last chapter finds."""
    integrals = {f"noether:{n}": _integral_terms(system, each) for n, each in enumerate(symmetries_of(system), 1)}
    return replace(
        result,
        conserved=tuple(_conserved(system)),
        equilibria=tuple(Told(linear, conditions(system, linear)) for linear in motions_of(system)),
        search=search_of(system),
        resting=contact_search_of(system),
        kinked=kink_search_of(system),
        left_out=left_out_of(system),
        routh=reduction_of(system),
        steady=steady_motions_of(system),
        generators=_searched(system),
        terms={**result.terms, "integrals": integrals},
    )


def equations_of(system: System) -> Result:
    """What the chapters up to the equations of motion lead to."""
    bodies = [body.name for body in system.scene.bodies]
    return Result(
        scene=system.scene,
        positions={name: system.position(name) for name in bodies},
        points={point.name: system.position(point.name) for point in system.scene.points},
        virtual_displacements={name: system.virtual_displacement(name) for name in bodies},
        virtual_work=system.collected(sum(map(system.virtual_work, system.scene.contributions), system.zero)),
        kinetic_energy=system.kinetic_energy,
        potential_energy=system.potential_energy,
        total_forces={q: system.generalized_force(q) for q in system.free},
        conservative_forces={q: system.conservative_force(q) for q in system.free},
        nonconservative_forces={q: system.nonconservative_force(q) for q in system.free},
        lagrangian=system.lagrangian,
        equations={q: left_side(system, q) for q in system.free},
        mass_matrix=mass_matrix(system),
        forcing=forcing(system),
        jacobi_energy=jacobi_energy(system),
        is_energy=is_energy(system),
        terms=_terms(system),
        loads=tuple(_potential_of(system, load) for load in system.load_names),
        constraints=tuple(_bound(system)),
        contacts=contacts(system),
        sticking=sticking(system),
    )


def _bound(system: System) -> Iterator[Bound]:
    found = multipliers(system)
    for condition, constraint in zip(system.conditions, system.scene.constraints, strict=True):
        symbol = system.multiplier(condition)
        yield Bound(
            condition.source,
            constraint.kind,
            condition.is_holonomic,
            system.condition(condition),
            symbol,
            found.values[symbol] if found else None,
            {q: system.reaction_share(condition, q) for q in system.bound(condition)},
        )


def _terms(system: System) -> Terms:
    whole = {
        "virtual_work": provenance.of_virtual_work,
        "kinetic_energy": provenance.of_kinetic_energy,
        "potential_energy": provenance.of_potential_energy,
        "lagrangian": provenance.of_lagrangian,
        "jacobi_energy": provenance.of_jacobi_energy,
    }
    by_coordinate = {
        "total": provenance.of_force,
        "conservative": provenance.of_conservative_force,
        "nonconservative": provenance.of_nonconservative_force,
        "momentum": provenance.of_momentum,
    }
    return {
        **{key: {"": terms_of(system, shares(system))} for key, shares in whole.items()},
        **{key: {q: terms_of(system, of(system, q)) for q in system.free} for key, of in by_coordinate.items()},
        "equations": {q: _equation_terms(system, q) for q in system.free},
        "forcing": {q: _forcing_terms(system, q) for q in system.free},
        "mass_matrix": dict(_mass_terms(system)),
    }


def _searched(system: System) -> tuple[GeneratorFamily, ...]:
    """Among which generators symmetries were sought."""
    if "integrals" in system.effort.left_out:
        return ()
    return ("affine", "motions-of-space") if motions(system) else ("affine",)


def _integral_terms(system: System, symmetry: Symmetry) -> tuple[Term, ...]:
    """Term by term; those of the gauge function come from all bodies and loads."""
    gauge = symmetry.gauge.xreplace(solved(symmetry.conditions, system)).expand()
    sources = (*system.body_sources, *(f"load:{load}" for load in system.load_names))
    parts = [term.as_coeff_Mul() for term in sp.Add.make_args(gauge) if term != 0]
    outside = tuple(Term(Explicit(abs(c) * rest), sources, -1 if c > 0 else 1) for c, rest in parts)
    return terms_of(system, provenance.of_symmetry(system, symmetry)) + outside


def _mass_terms(system: System) -> Iterator[tuple[str, tuple[Term, ...]]]:
    """What stands before the acceleration of the second coordinate in the equation of the first."""
    for q in system.free:
        row = slopes(system, _equation_terms(system, q))
        for other in system.free:
            entry = row.get(system.acceleration(other), ())
            yield f"{q} {other}", tuple(replace(term, formula=Explicit(slope)) for term, slope in entry)


def _forcing_terms(system: System, coordinate: str) -> tuple[Term, ...]:
    """What hangs neither on accelerations nor on multipliers, on the right."""
    at_rest = dict.fromkeys((*map(system.acceleration, system.free), *system.multipliers), system.zero)
    rests = ((term, term.written_out.xreplace(at_rest)) for term in _equation_terms(system, coordinate))
    return tuple(replace(term, formula=Explicit(rest), sign=-term.sign) for term, rest in rests if rest != 0)


@cached_method
def _equation_terms(system: System, coordinate: str) -> tuple[Term, ...]:
    """The left side of the equation, the sources apart."""
    return terms_of(system, provenance.of_equation(system, coordinate))


def _potential_of(system: System, load: str) -> LoadPotential:
    known = system.has_potential(load)
    differences = {pair: system.zero if known or system.is_zero(curl) else curl for pair, curl in system.curl(load)}
    beside = {pair: system.display(beside_jumps(curl)) for pair, curl in differences.items()}
    shown = {pair: curl for pair, curl in beside.items() if curl != 0 or differences[pair] == 0}  # else no number
    hidden = differences.keys() - shown.keys()  # at a jump alone
    curl = {pair: shown.get(pair, system.zero) for pair in combinations(system.free, 2) if pair not in hidden}
    potential = system.load_potential(load) if system.is_conservative(load) else None
    return LoadPotential(load, outcome(system, load), system.has_potential(load), potential, curl)


def _conserved(system: System) -> list[Conserved]:
    """Momenta of cyclic coordinates, the Jacobi energy where nothing changes it, and what other symmetries lead to."""
    found = [_momentum(system, q) for q in cyclic(system)]
    if system.is_zero(jacobi_energy_rate(system)):
        generator = Generator({}, sp.Integer(1))
        found.append(Conserved("energy", "", jacobi_energy(system), generator, "time", "jacobi-energy"))
    for number, each in enumerate(symmetries_of(system), 1):
        word, special = meaning(system, each.generator).word, solved(each.conditions, system)
        found.append(Conserved("symmetry", "", each.value, each.generator, word, f"noether:{number}", special))
    return [replace(each, contacts=contacts_of(system, each.generator)) for each in found]


def _momentum(system: System, coordinate: str) -> Conserved:
    generator = Generator({coordinate: sp.Integer(1)}, system.zero)
    word, step = meaning(system, generator).word, f"cyclic-coordinate:{coordinate}"
    return Conserved("momentum", coordinate, system.momentum(coordinate), generator, word, step)

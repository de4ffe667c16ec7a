"""How quantities are written: **r**, δ**r**, E, V, L, Q₁ …, with the classes that give each its colour on the page."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

from ..derivation.formula import Quantity
from ..derivation.rules.position import UNGUIDED
from ..language.memory import cached_method
from ..language.typography import dotted
from ..mechanics.loads.spring import Spring
from ..mechanics.scene import Scene
from .catalog import text
from .letters import Letters, in_symbol, letters_of
from .prose import CatalogText
from .things import called

NUMBERED = re.compile(r"q_\{?(\d+)\}?")

# Symbol of a quantity, and the class of the page it belongs to ("" for none). {of} is a name, {i} a coordinate's index.
SYMBOLS: Mapping[str, tuple[str, str]] = {
    "coordinate": ("{q}", ""),
    "position": (r"\mathbf{{r}}{of}", "body-{name}"),
    "virtual-displacement": (r"\delta\mathbf{{r}}{of}", "body-{name}"),
    "differential": (r"\mathrm{{d}}\mathbf{{r}}{of}", "body-{name}"),
    "velocity": (r"\mathbf{{v}}{of}", "body-{name}"),
    "force": (r"\mathbf{{F}}{of}", "load-{name}"),
    "force-density": (r"\mathbf{{f}}{of}", "load-{name}"),
    "moment": ("M{of}", "load-{name}"),
    "angular-velocity": (r"\omega{of}", "body-{name}"),
    "dissipation-function": ("R{of}", "load-{name}"),
    "friction-force": ("R{of}", "load-{name}"),
    "slip": ("s{of}", "load-{name}"),
    "generalized-potential": ("U{of}", "load-{name}"),
    "virtual-work": (r"\delta W{of}", "load-{name}"),
    "generalized-force": ("Q_{{{i}}}{part}", ""),
    "nonconservative-force": ("Q_{{{i}}}^{{d}}", ""),
    "constraint": (r"\Phi{of}", "constraint-{name}"),
    "constraint-matrix": (r"\mathbf{{A}}", ""),
    "reaction-work": (r"\delta W^{{z}}{of}", "constraint-{name}"),
    "reaction": ("Z_{{{q}}}", ""),
    "held-reaction": ("Z_{{{q}}}^{{h}}", ""),
    "reaction-impulse": (r"\hat Z_{{{q}}}", ""),
    "rod-force": ("S_{{{q}}}", ""),
    "gap": ("g_{{N}}{of}", ""),
    "gap-rate-behind": (r"\dot g_{{N}}^{{+}}", ""),
    "impulse": (r"\Lambda{of}", ""),
    "contact-reaction": (r"\lambda_{{N}}{of}", ""),
    "force-below": ("f_{{-}}", ""),
    "force-above": ("f_{{+}}", ""),
    "kink-share": (r"\sigma{of}", ""),
    "constraint-impulse": (r"\Lambda{of}", "constraint-{name}"),
    "momentum-jump": (r"\Delta p_{{{i}}}", ""),
    "momentum-behind": ("p_{{{i}}}^{{+}}", ""),
    "rate-jump": (r"\Delta{rate}", ""),
    "impact-loss": (r"E^{{-}} - E^{{+}}", ""),
    "holding-force": ("R^{{h}}{of}", "load-{name}"),
    "largest-holding-force": ("F^{{0}}{of}", "load-{name}"),
    "kinetic-energy": ("E{of}", "energy-kinetic"),
    "potential-energy": ("V{of}", "energy-potential"),
    "lagrangian": ("L", ""),
    "variation-of-lagrangian": (r"\delta L", ""),
    "integral-of-motion": ("I{of}", ""),
    "integral-functional": ("S", ""),
    "variation-of-integral": (r"\delta S", ""),
    "momentum": ("p_{{{i}}}", ""),
    "mass-matrix": (r"\mathbf{{M}}", ""),
    "mass-scalar": ("M", ""),
    "forcing-vector": (r"\mathbf{{f}}", ""),
    "forcing-scalar": ("f", ""),
    "coordinates-vector": (r"\mathbf{{q}}", ""),
    "rates-vector": (r"\dot{{\mathbf{{q}}}}", ""),
    "accelerations-vector": (r"\ddot{{\mathbf{{q}}}}", ""),
    "linear-mass-matrix": (r"\mathbf{{M}}_0", ""),
    "linear-mass-scalar": ("M_0", ""),
    "reduced-mass-matrix": (r"\mathbf{{M}}_r", ""),
    "reduced-mass-scalar": ("M_r", ""),
    "reduced-damping-matrix": (r"\mathbf{{D}}_r", ""),
    "reduced-damping-scalar": ("D_r", ""),
    "reduced-stiffness-matrix": (r"\mathbf{{K}}_r", ""),
    "reduced-stiffness-scalar": ("K_r", ""),
    "linear-constraint-matrix": (r"\mathbf{{A}}_0", ""),
    "constraint-matrix-transposed": (r"\mathbf{{A}}^{{T}}", ""),
    "multipliers-vector": (r"\boldsymbol{{\lambda}}", ""),
    "tangent-basis": (r"\mathbf{{N}}", ""),
    "tangent-basis-transposed": (r"\mathbf{{N}}^{{T}}", ""),
    "chosen-deviation-vector": (r"\mathbf{{y}}", ""),
    "chosen-deviation-scalar": ("y", ""),
    "chosen-deviation-rate-vector": (r"\dot{{\mathbf{{y}}}}", ""),
    "chosen-deviation-rate-scalar": (r"\dot{{y}}", ""),
    "chosen-deviation-acceleration-vector": (r"\ddot{{\mathbf{{y}}}}", ""),
    "chosen-deviation-acceleration-scalar": (r"\ddot{{y}}", ""),
    "linear-damping-matrix": (r"\mathbf{{D}}_0", ""),
    "linear-damping-scalar": ("D_0", ""),
    "linear-stiffness-matrix": (r"\mathbf{{K}}_0", ""),
    "linear-stiffness-scalar": ("K_0", ""),
    "deviation-vector": (r"\mathbf{{x}}", ""),
    "deviation-scalar": ("x", ""),
    "deviation-rate-vector": (r"\dot{{\mathbf{{x}}}}", ""),
    "deviation-rate-scalar": (r"\dot{{x}}", ""),
    "deviation-acceleration-vector": (r"\ddot{{\mathbf{{x}}}}", ""),
    "deviation-acceleration-scalar": (r"\ddot{{x}}", ""),
    "zero-vector": (r"\mathbf{{0}}", ""),
    "mode": (r"\mathbf{{a}}{of}", ""),
    "mode-real": (r"\mathbf{{u}}{of}", ""),
    "mode-imaginary": (r"\mathbf{{w}}{of}", ""),
    "work-of-loop": ("W", ""),
    "jacobi-energy": ("h", ""),
    "routh-function": ("R", ""),
    "negative-routh-function": ("-R", ""),
    "effective-potential": ("U", ""),
    "hamiltonian": ("H", ""),
}
AXES = ("1", "2", "3")  # the principal axes of a body
ALWAYS_INDEXED = ("moment",)
BY_PLACE = ("position", "virtual-displacement", "differential", "velocity")


class SymbolTable(Protocol):
    """What the narration asks of the symbols of a scene, or of a derivation without one."""

    @property
    def coordinate_latex(self) -> Mapping[str, str]:
        """LaTeX of each coordinate or function."""

    @property
    def wrap(self) -> Callable[[str, str], str]:
        """Puts LaTeX into a class of the page."""

    def latex(self, quantity: Quantity) -> str:
        """The symbol of a quantity."""

    def label(self, name: str) -> CatalogText:
        """What a sentence calls a place or a load."""

    def is_varied(self, name: str) -> bool:
        """Whether this is the name of a coordinate that virtual displacements change."""


@dataclass(frozen=True)
class QuantitySymbols:
    """LaTeX of quantities in one scene. With a single place the index is left out, as the lecture does."""

    scene: Scene
    language: str
    coordinate_latex: Mapping[str, str]
    wrap: Callable[[str, str], str]

    @cached_method
    def latex(self, quantity: Quantity) -> str:
        pattern, css = SYMBOLS[quantity.kind]
        symbol = self._own(quantity.kind, pattern).format(
            of=self._index(quantity),
            i=self._colored(quantity.of, self.index(quantity.of)),
            q=self._colored(quantity.of, self._written(quantity.of)),
            rate=self._colored(quantity.of, dotted(self.coordinate_latex.get(quantity.of, ""))),
            part=f"^{{{self._word(quantity.part)}}}" if quantity.part else "",
        )
        named = css.format(name=quantity.of) if quantity.of or "{" not in css else ""
        return self.wrap(named, symbol)

    @cached_property
    def letters(self) -> Letters:
        """What stands for the letters that the scene has taken."""
        return letters_of(self.scene.names)

    def _own(self, kind: str, pattern: str) -> str:
        """A moment has the index of its load, which tells it from a parameter M."""
        return pattern if kind in ALWAYS_INDEXED else in_symbol(pattern, self.letters)

    def label(self, name: str) -> CatalogText:
        return called(self.scene, name, self.language)

    def is_varied(self, name: str) -> bool:
        return any(coordinate.name == name for coordinate in self.scene.free)

    def _written(self, name: str) -> str:
        """LaTeX of a coordinate, or of a length whose reaction is meant."""
        symbol = self.scene.names.get(name)
        return self.coordinate_latex.get(name, symbol.typeset if symbol else "")

    def _colored(self, coordinate: str, latex: str) -> str:
        names = tuple(self.coordinate_latex)
        return self.wrap(f"q-{names.index(coordinate)}", latex) if coordinate in names else latex

    def index(self, coordinate: str) -> str:
        """q₂ has the index 2, φ the index φ."""
        latex = self.coordinate_latex.get(coordinate, "")
        number = NUMBERED.fullmatch(latex)
        return number.group(1) if number else latex

    def _index(self, quantity: Quantity) -> str:
        if not quantity.of:
            return "_{a}" if quantity.kind == "virtual-work" else ""
        words = [] if self._is_alone(quantity) else [self._word(name) for name in self._names(quantity)]
        if quantity.kind in BY_PLACE:
            words += [upright(held) for held in self._held(quantity)]
        return f"_{{{', '.join(words)}}}" if words else ""

    def _is_alone(self, quantity: Quantity) -> bool:
        """Whether it is the only body's, which needs no name."""
        return quantity.kind in BY_PLACE and [body.name for body in self.scene.bodies] == [quantity.of]

    def _held(self, quantity: Quantity) -> Iterator[str]:
        """The lecture's r_el and r_gef: how the place is held, if by a guide or by a spring at its pivot."""
        if self.is_guided(quantity.of):
            if quantity.part != UNGUIDED:
                yield text(self.language, "rules.indices.guided")
        elif self._is_alone(quantity) and _hangs_on_spring(self.scene, quantity.of):
            yield text(self.language, "rules.indices.elastic")

    @cached_method
    def is_guided(self, place: str) -> bool:
        """Whether a guide moves the place."""
        guided = {guide.coordinate for guide in self.scene.guides}
        return bool(guided & _names_in(self.scene, place))

    def _names(self, quantity: Quantity) -> tuple[str, ...]:
        """Whose it is, and which part of it; with a single body only what tells it from its like."""
        if not quantity.part or quantity.part == UNGUIDED:
            return (quantity.of,)
        if len(self.scene.bodies) > 1:
            return quantity.of, quantity.part
        return (quantity.part,) if quantity.part in AXES else (quantity.of,)

    def _word(self, name: str) -> str:
        return name if name in AXES else upright(self.label(name))


def _names_in(scene: Scene, place: str) -> frozenset[str]:
    """The names that its position depends on by."""
    known = {*scene.places, *(body.name for body in scene.bodies)}
    return (
        frozenset[str]().union(*(component.names for component in scene.place(place)))
        if place in known
        else frozenset()
    )


def _hangs_on_spring(scene: Scene, body: str) -> bool:
    """Whether it moves with a point without mass at the end of a spring, its pivot."""
    coordinates = {coordinate.name for coordinate in scene.coordinates}
    pivots = {point.name for point in scene.points} & {
        end for load in scene.loads if isinstance(load, Spring) for end in (load.start, load.end)
    }
    moves = frozenset[str]().union(*(_names_in(scene, pivot) for pivot in pivots)) & coordinates
    return bool(moves & _names_in(scene, body))


def upright(name: str) -> str:
    """A name of places or loads as upright text; what LaTeX would read as a command is left out."""
    plain = re.sub(r"[^\w .,()-]", "", name).replace("_", r"\_")
    return rf"\text{{{plain}}}"

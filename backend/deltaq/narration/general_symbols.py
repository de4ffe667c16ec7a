"""How the general proof writes its quantities, as the lecture does."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from ..derivation.formula import Quantity
from ..language.names import Names, Symbol
from .prose import CatalogText, words

# Symbol of a quantity; {i} is its index.
SYMBOLS: Mapping[str, str] = {
    "coordinate": "q_{{{i}}}",
    "position": r"\mathbf{{r}}",
    "velocity": r"\mathbf{{v}}",
    "acceleration": r"\dot{{\mathbf{{v}}}}",
    "function-of-vector": "f",
    "function-of-function": "f",
    "function-of-functions": "f",
    "ordinary-derivative": r"\frac{{\mathrm{{d}} f}}{{\mathrm{{d}} x}}",
    "ordinary-limit": r"\lim_{{h \to 0}} \frac{{f(x + h) - f(x)}}{{h}}",
    "limit-along": r"\lim_{{h \to 0}} \frac{{f(\mathbf{{x}} + h\,\mathbf{{e}}_{{{i}}}) - f(\mathbf{{x}})}}{{h}}",
    "directional-derivative": r"D_{{\mathbf{{v}}}} f(\mathbf{{x}})",
    "first-variation": r"\delta_{{v(t)}} f(x(t))",
    "identity-functional": "I_{{t_0}}",
    "variation-of-identity": r"\delta_{{v(t)}} I_{{t_0}}(x(t))",
    "variation-of-function": r"\delta x",
    "gradient": r"\operatorname{{grad}} f",
    "direction": r"\mathbf{{v}}",
    "variation-of-field-along": r"\delta_{{\mathbf{{v}}(t)}} f(\mathbf{{x}}(t))",
    "variation-of-field": r"\delta f(\mathbf{{x}}(t))",
    "direction-component": "v_{{{i}}}(t)",
    "variation-component": r"\delta x_{{{i}}}(t)",
    "slope-along": r"\left.\frac{{\partial f}}{{\partial x_{{{i}}}}}\right|_{{\mathbf{{x}}(t)}}",
    "coefficient": r"\frac{{\partial\,\delta f}}{{\partial\,\delta x_{{{i}}}}}",
    "virtual-displacement": r"\delta\mathbf{{r}}",
    "variation-along-axis": r"\delta {i}",
    "virtual-work": r"\delta W_{{a}}",
    "inner-virtual-work": r"\delta W_{{i}}",
    "work-of-inertia": r"\delta W_{{Mb}}",
    "force-density": r"\mathbf{{f}}_{{{i}}}",
    "force": r"\mathbf{{F}}",
    "moment": "M",
    "generalized-force": "Q_{{{i}}}",
    "only-generalized-force": "Q",
    "conservative-force": "Q_{{{i}}}^{{p}}",
    "nonconservative-force": "Q_{{{i}}}^{{d}}",
    "kinetic-energy": "E",
    "potential-energy": "V",
    "lagrangian": "L",
}
CLASSES: Mapping[str, str] = {"kinetic-energy": "energy-kinetic", "potential-energy": "energy-potential"}
NAMES = Names(
    (
        *(Symbol(f"q_{i}", "coordinate", f"q_{{{i}}}") for i in ("i", "k")),
        *(Symbol(name, "coordinate", latex) for name, latex in (("x", "x"), ("X", r"\mathbf{x}"), ("v", "v"))),
        *(Symbol(f"x_{i}", "coordinate", f"x_{{{i}}}") for i in ("i", "k")),
        Symbol("P", "material", r"\mathcal{P}"),
        Symbol("t_0", "parameter", "t_0"),
        *(Symbol(f"F_{axis}", "parameter", f"F_{axis}") for axis in "xyz"),
        Symbol("phi", "coordinate", r"\varphi"),
        Symbol("a", "parameter", positive=True),
        Symbol("h", "parameter"),
    )
)
# What each function is moved by, "" for δ of its own name.
DIRECTIONS: Mapping[str, str] = {
    "q_i": "", "q_k": "", "x": "v", "v": "v", "X": r"\mathbf{v}", "x_i": "v_i", "x_k": "v_k",
}  # fmt: skip


@dataclass(frozen=True)
class GeneralSymbols:
    """LaTeX of the quantities of the general proof."""

    wrap: Callable[[str, str], str]
    coordinate_latex: Mapping[str, str] = field(default_factory=dict)

    def latex(self, quantity: Quantity) -> str:
        return self.wrap(CLASSES.get(quantity.kind, ""), SYMBOLS[quantity.kind].format(i=quantity.of))

    def label(self, name: str) -> CatalogText:
        return words(name)

    def is_varied(self, name: str) -> bool:
        return name in DIRECTIONS

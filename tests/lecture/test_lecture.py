"""Every formula of the lecture, in its order, as the app writes it: which request, which step, which line."""

from __future__ import annotations

import re

import pytest
from tests.lecture.answers import answer, steps

GAP = re.compile(r"(?<=\\\\)\[[\d.]+em\]")  # between rows
I_DR = r"\frac{\partial \mathbf{r}}{\partial q_{i}}"
LEFT = rf"\int_{{\mathcal{{B}}}} {I_DR} \cdot \dot{{\mathbf{{v}}}} \,\mathrm{{d}}m"
HALF = r"\frac{\mathbf{v} \cdot \mathbf{v}}{2}"
DDT = r"\frac{\mathrm{d}}{\mathrm{d} t}"
BY_RATE, BY_Q = r"\frac{\partial}{\partial \dot{q}_{i}}", r"\frac{\partial}{\partial q_{i}}"
MEAN = rf"\int_{{\mathcal{{B}}}} {HALF} \,\mathrm{{d}}m"
SURFACE = rf"\int_{{S}} {I_DR} \cdot \mathbf{{f}}_{{S}} \,\mathrm{{d}}S"
VOLUME = rf"\int_{{V}} {I_DR} \cdot \mathbf{{f}}_{{V}} \,\mathrm{{d}}V"
POSITION = r"\begin{bmatrix} \ell \sin q_2 \\ q_1 + \ell \cos q_2 \end{bmatrix}"
EL, GEF = r"\mathbf{r}_{\text{el}}", r"\mathbf{r}_{\text{gef}}"
GUIDED_TANGENT = r"\begin{bmatrix} \ell \cos q_2 \\ -\ell \sin q_2 \end{bmatrix}"
FREE_VARIATION = (
    r"\begin{bmatrix} \ell \cos q_2 \, \delta q_2 \\ \delta q_1 - \ell \sin q_2 \, \delta q_2 \end{bmatrix}"
)
GUIDED_VARIATION = r"\begin{bmatrix} \ell \cos q_2 \, \delta q_2 \\ -\ell \sin q_2 \, \delta q_2 \end{bmatrix}"
FORCE = r"\begin{bmatrix} F_0 \cos q_2 \\ -F_0 \sin q_2 \end{bmatrix}"


def line(name: str, request: str, step: str, latex: str) -> object:
    return pytest.param(request, step, latex, id=name)


LECTURE = [
    # Motion, and why the difference quotient fails
    line("r = r(P, t, q)", "proof", "general-motion", r"\mathbf{r} &= \mathbf{r}(\mathcal{P}, t, q_{i})"),
    line("q = q(t)", "proof", "general-motion", r"q_{i} &= q_{i}(t)"),
    line(
        "difference quotient",
        "proof",
        "difference-quotient",
        r"\frac{\mathrm{d} f}{\mathrm{d} x} &= \lim_{h \to 0} \frac{f(x + h) - f(x)}{h}",
    ),
    line("unsuitable for vectors", "proof", "difference-quotient", r"\neq"),
    line(
        "directional derivative as a limit",
        "proof",
        "directional-derivative",
        r"D_{\mathbf{v}} f(\mathbf{x}) &= \lim_{h \to 0} \frac{f(\mathbf{x} + h\,\mathbf{v}) - f(\mathbf{x})}{h}",
    ),
    line(
        "directional derivative by h",
        "proof",
        "directional-derivative",
        r"&= \left.\frac{\partial}{\partial h} f(\mathbf{x} + h\,\mathbf{v})\right|_{h=0}",
    ),
    # Variation
    line(
        "Gâteaux differential",
        "proof",
        "gateaux-definition",
        r"\delta_{v(t)} f(x(t)) &= \left.\frac{\partial}{\partial h} f(x(t) + h\,v(t))\right|_{h=0}",
    ),
    line("identity functional", "proof", "identity-functional", r"I_{t_0}(x(t)) &= x(t_0)"),
    line(
        "variation of the identity functional",
        "proof",
        "identity-functional",
        r"\delta_{v(t)} I_{t_0}(x(t)) &= \left.\frac{\partial}{\partial h} I_{t_0}(x(t) + h\,v(t))\right|_{h=0}",
    ),
    line(
        "its value put in",
        "proof",
        "identity-functional",
        r"&= \left.\frac{\partial}{\partial h} \left(x(t_0) + h\,v(t_0)\right)\right|_{h=0} \\  &= v(t_0)",
    ),
    line("notation δx = v", "proof", "identity-functional", r"\delta x &= v"),
    line(
        "identity functional on request",
        "identity",
        "variation-by-definition",
        r"\left.\frac{\partial}{\partial h} \left(x(t_0) + h\,v(t_0)\right)\right|_{h=0} \\  &= v(t_0)",
    ),
    # Chain rule
    line(
        "D_v f = grad f · v",
        "proof",
        "chain-rule-of-direction",
        r"&= \operatorname{grad} f \cdot \mathbf{v} \\  &= \frac{\partial f}{\partial x_{i}}\,v_{i}",
    ),
    line(
        "chain rule of the first variation",
        "proof",
        "chain-rule-of-variation",
        r"\delta_{\mathbf{v}(t)} f(\mathbf{x}(t)) &= \left.\frac{\partial}{\partial h}"
        r" f(\mathbf{x}(t) + h\,\mathbf{v}(t))\right|_{h=0} \\"
        r"  &= \left.\frac{\partial f}{\partial x_{i}}\right|_{\mathbf{x}(t)}\,v_{i}(t)",
    ),
    line(
        "notation δf",
        "proof",
        "chain-rule-of-variation",
        r"\delta f(\mathbf{x}(t)) &= \left.\frac{\partial f}{\partial x_{i}}\right|_{\mathbf{x}(t)}\,\delta x_{i}(t)",
    ),
    line(
        "comparison of coefficients",
        "proof",
        "chain-rule-of-variation",
        r"\frac{\partial\,\delta f}{\partial\,\delta x_{i}} &= \frac{\partial f}{\partial x_{i}}",
    ),
    line(
        "chain rule for several functions on request",
        "several functions",
        "variation-by-chain-rule",
        r"\delta f &= \frac{\partial f}{\partial x_{1}}\,\delta x_{1}"
        r" + \frac{\partial f}{\partial x_{2}}\,\delta x_{2}",
    ),
    line("δr = ∂r/∂q δq", "proof", "variation-of-position", rf"&= {I_DR}\,\delta q_{{i}}"),
    # Pendulum with moving pivot
    line("r_el", "base-pendulum", "position:bob", rf"{EL}(q_1, q_2) &= {POSITION}"),
    line(
        "δr_el by the chain rule",
        "base-pendulum",
        "virtual-displacement:bob",
        rf"\delta{EL}(q_1, q_2) &= \frac{{\partial {EL}}}{{\partial q_1}}\,\delta q_1"
        rf" + \frac{{\partial {EL}}}{{\partial q_2}}\,\delta q_2",
    ),
    line(
        "δr_el by its tangents",
        "base-pendulum",
        "virtual-displacement:bob",
        rf"&= \begin{{bmatrix}} 0 \\ 1 \end{{bmatrix}}\,\delta q_1 + {GUIDED_TANGENT}\,\delta q_2",
    ),
    line("δr_el", "base-pendulum", "virtual-displacement:bob", rf"&= {FREE_VARIATION}"),
    line("δr_el without a scene", "position", "both-routes", rf"&= {FREE_VARIATION}"),
    line("the guide", "guided-pendulum", "guide:y", r"q_1 &= y_0 \sin(\omega t)"),
    line(
        "r_gef",
        "guided-pendulum",
        "guided-position:bob",
        r"\begin{bmatrix} \ell \sin q_2 \\ \ell \cos q_2 + y_0 \sin(\omega t) \end{bmatrix}",
    ),
    line("r_gef(q2, t)", "guided-pendulum", "guided-position:bob", rf"{GEF}(q_2, t) &="),
    line(
        "δr_gef by the chain rule",
        "guided-pendulum",
        "virtual-displacement:bob",
        rf"\delta{GEF}(q_2, t) &= \frac{{\partial {GEF}}}{{\partial q_2}}\,\delta q_2 \\"
        rf"  &= {GUIDED_TANGENT}\,\delta q_2",
    ),
    line("δr_gef", "guided-pendulum", "virtual-displacement:bob", rf"&= {GUIDED_VARIATION}"),
    line(
        "dr_gef by the chain rule",
        "guided-pendulum",
        "total-differential:bob",
        rf"\mathrm{{d}}{GEF}(q_2, t) &= \frac{{\partial {GEF}}}{{\partial q_2}}\,\mathrm{{d}}q_2"
        rf" + \frac{{\partial {GEF}}}{{\partial t}}\,\mathrm{{d}}t",
    ),
    line(
        "dr_gef by its parts",
        "guided-pendulum",
        "total-differential:bob",
        rf"&= {GUIDED_TANGENT}\,\mathrm{{d}}q_2"
        r" + \begin{bmatrix} 0 \\ y_0 \omega \cos(\omega t) \end{bmatrix}\,\mathrm{d}t",
    ),
    line(
        "dr_gef",
        "guided-pendulum",
        "total-differential:bob",
        r"&= \begin{bmatrix} \ell \cos q_2 \, \mathrm{d}q_2 \\"
        r" -\ell \sin q_2 \, \mathrm{d}q_2 + y_0 \omega \cos(\omega t) \, \mathrm{d}t \end{bmatrix}",
    ),
    # Generalized forces
    line(
        "δW_a with surface and volume integrals",
        "proof",
        "definition-of-generalized-force",
        rf"&= \left({SURFACE} + {VOLUME}\right)\,\delta q_{{i}}",
    ),
    line("definition of Q", "proof", "definition-of-generalized-force", rf"&= {SURFACE} + {VOLUME}\end"),
    line(
        "single force",
        "proof",
        "single-force",
        r"\mathbf{F} &= \begin{bmatrix} F_x \\ F_y \\ F_z \end{bmatrix}",
    ),
    line("δW of a single force", "proof", "single-force", r"&= F_x\,\delta x + F_y\,\delta y + F_z\,\delta z"),
    line("Q_x = F_x", "proof", "single-force", r"Q_{x} &= F_x \\ Q_{y} &= F_y \\ Q_{z} &= F_z"),
    line("δW of a free moment", "proof", "free-moment", r"&= M\,\delta \varphi"),
    line("Q = M", "proof", "free-moment", r"Q &= M"),
    line(
        "F · δr",
        "elastic-pendulum",
        "work-of-force:drive",
        rf"&= {FORCE} \cdot {FREE_VARIATION}",
    ),
    line(
        "δW of the external force",
        "elastic-pendulum",
        "work-of-force:drive",
        r"&= -F_0 \sin q_2 \, \delta q_1 + F_0 \ell \, \delta q_2",
    ),
    line(
        "δW = Q_1 δq_1 + Q_2 δq_2",
        "elastic-pendulum",
        "generalized-forces",
        r"&= Q_{1}\,\delta q_1 + Q_{2}\,\delta q_2",
    ),
    line(
        "Q = Q^p and no rest",
        "pendulum",
        "decomposition",
        r"Q_{\varphi}^{d} &= 0",
    ),
    # From d'Alembert's principle
    line("δW_i = 0", "proof", "dalembert-principle", r"\delta W_{i} &= 0"),
    line(
        "δW_Mb",
        "proof",
        "dalembert-principle",
        rf"\delta W_{{Mb}} &= \int_{{\mathcal{{B}}}} \delta\mathbf{{r}} \cdot \dot{{\mathbf{{v}}}} \,\mathrm{{d}}m"
        rf" \\  &= \left({LEFT}\right)\,\delta q_{{i}}",
    ),
    line(
        "δW_Mb = Q δq",
        "proof",
        "dalembert-principle",
        rf"\left({LEFT}\right)\,\delta q_{{i}} = Q_{{i}}\,\delta q_{{i}}",
    ),
    line("∫ ∂r/∂q · dv/dt dm = Q", "proof", "dalembert-principle", rf"& {LEFT} = Q_{{i}}"),
    line(
        "product rule",
        "proof",
        "general-product-rule",
        rf"{I_DR} \cdot \dot{{\mathbf{{v}}}} &= {DDT}\left({I_DR} \cdot \mathbf{{v}}\right)"
        rf" - {DDT}\left({I_DR}\right) \cdot \mathbf{{v}}",
    ),
    line(
        "v = dr/dt",
        "proof",
        "general-cancellation",
        r"\mathbf{v} &= \frac{\mathrm{d} \mathbf{r}}{\mathrm{d} t} \\"
        r"  &= \frac{\partial \mathbf{r}}{\partial q_{k}}\,\dot{q}_{k}",
    ),
    line(
        "∂v/∂q̇ = ∂r/∂q",
        "proof",
        "general-cancellation",
        rf"\frac{{\partial \mathbf{{v}}}}{{\partial \dot{{q}}_{{i}}}} &= {I_DR}",
    ),
    line(
        "d/dt ∂r/∂q = ∂v/∂q",
        "proof",
        "general-exchange",
        rf"{DDT}\left({I_DR}\right) &= {BY_Q}\left(\frac{{\mathrm{{d}} \mathbf{{r}}}}{{\mathrm{{d}} t}}\right)"
        r" \\  &= \frac{\partial \mathbf{v}}{\partial q_{i}}",
    ),
    line(
        "integrand by velocities",
        "proof",
        "general-integrand",
        rf"{I_DR} \cdot \dot{{\mathbf{{v}}}} &= "
        rf"{DDT}\left(\frac{{\partial \mathbf{{v}}}}{{\partial \dot{{q}}_{{i}}}} \cdot \mathbf{{v}}\right)"
        r" - \frac{\partial \mathbf{v}}{\partial q_{i}} \cdot \mathbf{v}",
    ),
    line(
        "integrand as kinetic energy",
        "proof",
        "general-integrand",
        rf"&= {DDT}\left({BY_RATE}\left({HALF}\right)\right) - {BY_Q}\left({HALF}\right)",
    ),
    line(
        "left side integrated",
        "proof",
        "general-integral",
        rf"{LEFT} &= {DDT}\left(\int_{{\mathcal{{B}}}} {BY_RATE}\left({HALF}\right) \,\mathrm{{d}}m\right)"
        rf" - \int_{{\mathcal{{B}}}} {BY_Q}\left({HALF}\right) \,\mathrm{{d}}m",
    ),
    line(
        "exchange of integration and differentiation",
        "proof",
        "general-integral",
        rf"&= {DDT}\left({BY_RATE}\left({MEAN}\right)\right) - {BY_Q}\left({MEAN}\right)",
    ),
    line("E", "proof", "general-integral", rf"E &= {MEAN}"),
    line(
        "Lagrange's equations of the second kind",
        "proof",
        "general-lagrange-equation",
        rf"{DDT}\left(\frac{{\partial E}}{{\partial \dot{{q}}_{{i}}}}\right)"
        r" - \frac{\partial E}{\partial q_{i}} = Q_{i}",
    ),
    # Decomposition and Lagrange function
    line("Q = Q^p + Q^d", "proof", "general-decomposition", r"Q_{i} &= Q_{i}^{p} + Q_{i}^{d}"),
    line("Q^p = −∂V/∂q", "proof", "general-decomposition", r"Q_{i}^{p} &= - \frac{\partial V}{\partial q_{i}}"),
    line(
        "with V on the left",
        "proof",
        "general-decomposition",
        rf"{DDT}\left(\frac{{\partial E}}{{\partial \dot{{q}}_{{i}}}}\right) - \frac{{\partial E}}{{\partial q_{{i}}}}"
        r" + \frac{\partial V}{\partial q_{i}} = Q_{i}^{d}",
    ),
    line("L = E − V", "proof", "general-lagrange-function", r"L &= E - V"),
    line(
        "final form",
        "proof",
        "general-lagrange-function",
        rf"{DDT}\left(\frac{{\partial L}}{{\partial \dot{{q}}_{{i}}}}\right)"
        r" - \frac{\partial L}{\partial q_{i}} = Q_{i}^{d}",
    ),
    line("∂V/∂q̇ = 0", "proof", "general-lagrange-function", r"\frac{\partial V}{\partial \dot{q}_{i}} &= 0"),
]


@pytest.mark.parametrize(("request_name", "step", "latex"), LECTURE)
def test_line(request_name: str, step: str, latex: str) -> None:
    found = steps(request_name)[step]
    assert latex in GAP.sub("", found["latex"])
    assert found["verified"] is True


def test_the_neighbour_is_written_after_what_it_is_beside() -> None:
    gateaux = steps("base-pendulum")["gateaux-differential:bob"]["latex"]
    assert rf"\delta{EL}(q_1, q_2) &=" in gateaux
    assert r"\ell \sin(q_2 + h \, \delta q_2)" in gateaux


def test_a_closed_path_has_four_sides() -> None:
    """Once around the rectangle: each coordinate there and back again."""
    first = steps("elastic-pendulum")["closed-loop:drive"]["latex"].partition(r"\\")[0]
    assert [first.count(rf"\mathrm{{d}}q_{i}") for i in (1, 2)] == [2, 2]
    assert first.count(r"\int") == 4


@pytest.mark.parametrize("scene", ["pendulum", "base-pendulum", "spring-pendulum", "double-pendulum"])
def test_where_all_forces_have_a_potential_nothing_is_left(scene: str) -> None:
    free = [term["coordinate"] for term in answer(scene)["result"]["generalized_forces"]["nonconservative"]]
    assert steps(scene)["decomposition"]["latex"].count(r"^{d} &= 0") == len(free)
    assert "Q_i^d = 0" in steps(scene)["decomposition"]["text"]


def test_a_rate_of_growth_has_its_unit_as_a_power() -> None:
    """Behind a number, 1/s would read as one more digit."""
    told = [s["latex"] for name in ("pendulum", "elastic-pendulum") for s in steps(name).values()]
    assert any(r"\,\mathrm{s}^{-1}" in latex for latex in told)
    assert not any("{1/s}" in latex for latex in told)


def test_generalized_forces_of_the_external_force() -> None:
    forces = answer("elastic-pendulum")["result"]["generalized_forces"]["nonconservative"]
    assert {force["coordinate"]: force["latex"] for force in forces} == {"y": r"-F_0 \sin q_2", "phi": r"F_0 \ell"}


def test_the_identity_functional_has_the_direction_as_its_variation() -> None:
    assert answer("identity")["result"] == {
        "first_variation": {"plain": "v", "latex": "v(t_0)", "spoken": "v of t zero", "at": "t0"}
    }

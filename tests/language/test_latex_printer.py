"""LaTeX as the lecture writes it."""

from __future__ import annotations

import pytest
from sympy import Add, Expr, Float, Function, Mul, Pow, Rational, cos, exp, pi, sin, sqrt
from tests.language.scene_names import read

from deltaq.language.latex_printer import Typography, latex
from deltaq.language.names import Names, Symbol

LECTURE = Names(
    (
        Symbol("y", "coordinate", "q_1"),
        Symbol("phi", "coordinate", "q_2"),
        *(Symbol(name, "parameter", positive=True) for name in ("m", "g", "k", "y0", "omega", "F0")),
        Symbol("l", "parameter", r"\ell", positive=True),
    )
)

ROWS = [
    pytest.param("m*l^2*ddot(phi)", r"m \ell^{2} \ddot{q}_2", id="acceleration"),
    pytest.param("l*sin(phi)", r"\ell \sin q_2", id="no needless parentheses"),
    pytest.param("sin(omega*t)", r"\sin(\omega t)", id="parentheses around a product"),
    pytest.param("cos(2*phi)", r"\cos(2 q_2)", id="double angle"),
    pytest.param("sin(phi)^2", r"\sin^{2} q_2", id="power of a function"),
    pytest.param("sin(phi/2)", r"\sin\left(\frac{q_2}{2}\right)", id="half angle"),
    pytest.param("m*dot(y)^2/2", r"\frac{1}{2} m \dot{q}_1^{2}", id="one half in front"),
    pytest.param("k*y/m", r"\frac{k q_1}{m}", id="quotient of symbols"),
    pytest.param("3*m/2", r"\frac{3}{2} m", id="three halves"),
    pytest.param("pi/2", r"\frac{\pi}{2}", id="half of pi"),
    pytest.param("-m*g*(y + l*cos(phi))", r"-m g (q_1 + \ell \cos q_2)", id="bracket"),
    pytest.param("9.81*m", "9.81 m", id="decimal"),
    pytest.param("delta(y) - l*sin(phi)*delta(phi)", r"\delta q_1 - \ell \sin q_2 \, \delta q_2", id="variation"),
    pytest.param("y0*omega*cos(omega*t)*d(t)", r"y_{0} \omega \cos(\omega t) \, \mathrm{d}t", id="time differential"),
    pytest.param("[l*cos(phi), -l*sin(phi)]",
                 r"\begin{bmatrix} \ell \cos q_2 \\ -\ell \sin q_2 \end{bmatrix}", id="column"),
    pytest.param("[[m, 0], [0, k]]", r"\begin{bmatrix} m & 0 \\ 0 & k \end{bmatrix}", id="matrix"),
    pytest.param("m*ddot(y) = m*g", r"m \ddot{q}_1 = m g", id="equation"),
    pytest.param("y = 0; phi = 0", r"\begin{aligned} q_1 &= 0 \\ q_2 &= 0 \end{aligned}", id="system"),
    pytest.param("exp(-k*t)", r"\mathrm{e}^{-k t}", id="exponential"),
    pytest.param("exp(1)", r"\mathrm{e}^{1}", id="e"),
    pytest.param("sqrt(y^2 + l^2)", r"\sqrt{q_1^{2} + \ell^{2}}", id="root"),
    pytest.param("1/sqrt(m)", r"\frac{1}{\sqrt{m}}", id="root below the line"),
    pytest.param("m^(1/3)", r"m^{1/3}", id="cube root"),
    pytest.param("abs(y)", r"\left|q_1\right|", id="absolute value"),
    pytest.param("atan2(l, y)", r"\operatorname{atan2}(\ell, q_1)", id="two arguments"),
    pytest.param("sin(phi)*(m + k)*(dot(y) + 1)", r"(m + k) \sin(q_2) (\dot{q}_1 + 1)", id="function before a bracket"),
    pytest.param("l*sin(phi)*dot(y)", r"\ell \sin q_2 \, \dot{q}_1", id="function before a rate"),
    pytest.param("sin(phi)^2*ddot(y)", r"\sin^{2} q_2 \, \ddot{q}_1", id="power of a function before a rate"),
    pytest.param("sin(phi)*cos(omega*t)*dot(y)", r"\sin q_2 \cos(\omega t) \dot{q}_1", id="function before a function"),
    pytest.param("cos(phi)*sign(phi)", r"\cos q_2 \operatorname{sgn}(q_2)", id="function before a sign"),
    pytest.param("sin(m)*y", r"q_1 \sin m", id="parameter as argument"),
    pytest.param("sin(m)*cos(phi)*sqrt(y)*exp(t)*dot(y)",
                 r"\sqrt{q_1} \sin m \cos q_2 \, \mathrm{e}^{t} \dot{q}_1", id="function before an exponential"),
    pytest.param("sin(phi)*abs(y)", r"\left|q_1\right| \sin q_2", id="bars"),
    pytest.param("sin(phi)*dot(y)*(dot(y) + 1)", r"\sin q_2 \, \dot{q}_1 (\dot{q}_1 + 1)", id="rate and bracket"),
    pytest.param("2*2^(1/3)", r"2 \cdot 2^{1/3}", id="digits side by side"),
    pytest.param("sign(y)^2*m", r"m (\operatorname{sgn}(q_1))^{2}", id="no power after sgn"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "written"), ROWS)
def test_written_as(text: str, written: str) -> None:
    assert latex(read(text, names=LECTURE), Typography(LECTURE)) == written


def test_marks_wrap_each_symbol() -> None:
    typography = Typography(LECTURE, lambda name, written: rf"\htmlClass{{{name}}}{{{written}}}")
    assert latex(read("m*dot(y)", names=LECTURE), typography) == r"\htmlClass{m}{m} \htmlClass{dot(y)}{\dot{q}_1}"


def test_marked_symbols_are_set_off_as_well() -> None:
    typography = Typography(LECTURE, lambda name, written: rf"\htmlClass{{{name}}}{{{written}}}")
    written = latex(read("sin(phi)*dot(y)", names=LECTURE), typography)
    assert written == r"\sin\htmlClass{phi}{q_2} \, \htmlClass{dot(y)}{\dot{q}_1}"
    power = latex(read("m*dot(y)^2", names=LECTURE), typography)
    # Else the 2 would stand behind the index, not above it.
    assert power == r"\htmlClass{m}{m} \htmlClass{dot(y)}{\dot{q}_1^{2}}"


def test_terms_of_a_sum_are_wrapped_without_their_signs() -> None:
    total = read("m - k*y", names=LECTURE)
    first, second = read("m", names=LECTURE), read("-k*y", names=LECTURE)
    wraps = {first: lambda term: f"<{term}>", second: lambda term: f"[{term}]"}
    typography = Typography(LECTURE, summands={total: wraps})
    assert latex(total, typography) == "<m> - [k q_1]"
    assert latex(read("g*(m - k*y)", names=LECTURE), typography) == "g (<m> - [k q_1])"
    assert latex(read("m + k*y", names=LECTURE), typography) == "k q_1 + m"


@pytest.mark.parametrize(
    ("name", "written"),
    [
        ("y", "q_1"),
        ("dot(y)", r"\dot{q}_1"),
        ("ddot(y)", r"\ddot{q}_1"),
        ("dddot(y)", r"\dddot{q}_1"),
        ("ddddot(y)", r"\ddddot{q}_1"),
        ("d(y)", r"\mathrm{d}q_1"),
        ("delta(phi)", r"\delta q_2"),
        ("dot(delta(phi))", r"\delta \dot{q}_2"),
        ("ddot(delta(phi))", r"\delta \ddot{q}_2"),
        ("dot(theta_12)", r"\dot{\theta}_{12}"),
        ("epsilon_max", r"\varepsilon_{\mathrm{max}}"),
    ],
)
def test_a_symbol_by_its_plain_name(name: str, written: str) -> None:
    assert Typography(LECTURE).symbol(name) == written


@pytest.mark.parametrize(
    ("number", "written"),
    [
        pytest.param(-1, "-(m + k)", id="sign"),
        pytest.param(Rational(1, 2), r"\frac{1}{2} (m + k)", id="fraction"),
        pytest.param(Rational(-1, 2), r"-\frac{1}{2} (m + k)", id="negative fraction"),
        pytest.param(2, "2 (m + k)", id="number"),
    ],
)
def test_a_number_multiplies_the_whole_sum(number: Rational, written: str) -> None:
    total = read("m + k", names=LECTURE)
    assert latex(Mul(number, total, evaluate=False), Typography(LECTURE)) == written


@pytest.mark.parametrize(
    ("text", "written"),
    [
        ("sqrt(y^2 + l^2)", "s"),
        ("y^2 + l^2", "s^{2}"),
        ("(y^2 + l^2)^(3/2)", "s^{3}"),
        ("k/sqrt(y^2 + l^2)", r"\frac{k}{s}"),
        ("k/(y^2 + l^2)", r"\frac{k}{s^{2}}"),
        ("k*(sqrt(y^2 + l^2) - m)", "k (s - m)"),
        ("(y^2 + l^2)^(1/3)", r"(s^{2})^{1/3}"),
        ("sqrt(y^2 + m^2)", r"\sqrt{q_1^{2} + m^{2}}"),
    ],
)
def test_a_root_that_has_a_letter_is_written_by_it(text: str, written: str) -> None:
    typography = Typography(LECTURE, roots={read("y^2 + l^2", names=LECTURE): "s"})
    assert latex(read(text, names=LECTURE), typography) == written


def test_a_function_without_a_command_is_written_upright_with_brackets() -> None:
    y = read("y", names=LECTURE)
    assert latex(Function("f")(y), Typography(LECTURE)) == r"\operatorname{f}(q_1)"
    assert latex(Function("f")(y) ** 2 * y, Typography(LECTURE)) == r"q_1 (\operatorname{f}(q_1))^{2}"


Y, M, K, PHI, DY, VARIED = (read(name, names=LECTURE) for name in ("y", "m", "k", "phi", "d(y)", "delta(y)"))
BUILT = [
    (Rational(-3), "-3"),
    (Rational(-1, 3), r"-\frac{1}{3}"),
    (Float("0.7"), "0.7"),
    (Float("-0.25"), "-0.25"),
    (Float("2.0"), "2"),
    (Rational(1, 20), "0.05"),
    (Rational(2, 3) ** Y, r"\left(\frac{2}{3}\right)^{q_1}"),
    (Pow(-2, Y), "(-2)^{q_1}"),
    (Float("9.81") ** Y, "9.81^{q_1}"),
    (Add(Y, Add(M, K, evaluate=False), evaluate=False), "q_1 + (m + k)"),
    ((M + K) / Y, r"\frac{m + k}{q_1}"),
    (1 / (M + K), r"\frac{1}{m + k}"),
    (M * (K + 1) / Y, r"\frac{m (1 + k)}{q_1}"),
    ((M + K) * (Y + 1) / K, r"\frac{(m + k) (q_1 + 1)}{k}"),
    (pi * M / 2, r"\frac{1}{2} \pi m"),
    (3 * pi / 4, r"\frac{3}{4} \pi"),
    (3 * Y / 4, r"\frac{3}{4} q_1"),
    (3 * M * Y / 4, r"\frac{3}{4} m q_1"),
    (M / (2 * K), r"\frac{m}{2 k}"),
    (M / sin(PHI), r"\frac{m}{\sin q_2}"),
    (sin(Y) ** -2, r"\frac{1}{\sin^{2} q_1}"),
    (sin(Y) ** K, r"(\sin q_1)^{k}"),
    (sin(Y**2), r"\sin(q_1^{2})"),
    (sin(M + K) ** 2, r"\sin^{2}(m + k)"),
    (Y ** (-K), "q_1^{-k}"),
    (Y ** Rational(3, 2), "q_1^{3/2}"),
    (DY**2, r"(\mathrm{d}q_1)^{2}"),
    (VARIED**2, r"(\delta q_1)^{2}"),
    (M * DY, r"m \, \mathrm{d}q_1"),
    (sin(PHI) * DY, r"\sin q_2 \, \mathrm{d}q_1"),
    (cos(PHI) * (M + K), r"(m + k) \cos q_2"),
    ((M + K) ** 2, "(m + k)^{2}"),
    ((M * K) ** Y, "(m k)^{q_1}"),
    (sqrt(M + K), r"\sqrt{m + k}"),
    (exp(exp(Y)), r"\mathrm{e}^{\mathrm{e}^{q_1}}"),
    (M * exp(Y), r"m \mathrm{e}^{q_1}"),
]


@pytest.mark.parametrize(("value", "written"), BUILT, ids=[written for _, written in BUILT])
def test_values_are_written_with_the_brackets_they_need(value: Expr, written: str) -> None:
    assert latex(value, Typography(LECTURE)) == written

"""Verdicts in full: all that is said of an answer, and nothing besides."""

from __future__ import annotations

import pytest

from deltaq.errors import Problem
from deltaq.homework.checking import check
from deltaq.homework.verdict import Counterexample, Slip, Verdict
from deltaq.homework.workbook import workbook_of
from deltaq.language.tree import Span

ROD, POLE = r"\ell \sin\varphi", r"\ell \cos\varphi"
KINETIC, WEIGHT = r"\frac{1}{2} m \ell^{2} \dot{\varphi}^{2}", r"m g \ell"
STATE = {"m": 1.0, "l": 1.0, "g": 9.81, "phi": 1.3, "dot(phi)": 0.5}
RATES = {name: STATE[name] for name in ("m", "l", "phi", "dot(phi)")}
# A parameter that is 1 hides its power; there m and l are 1.3 and 1.4.
OTHER = {"m": 1.3, "l": 1.4, "phi": 1.3, "dot(phi)": 0.5}


def written(before: str, slip: str, after: str = "") -> str:
    return rf"{before}\htmlClass{{slip}}{{{slip}}}{after}"


def column(*components: str) -> str:
    return r"\begin{bmatrix} " + r" \\ ".join(components) + r" \end{bmatrix}"


CASES = [
    pytest.param("kinetic-energy", "m*l^2*dot(phi)^2/2", Verdict("correct", KINETIC), id="right"),
    pytest.param(
        "potential-energy",
        "m*g*l - m*g*l*cos(phi)",
        Verdict("correct", rf"{WEIGHT} - {WEIGHT} \cos\varphi", "constant"),
        id="right up to a constant",
    ),
    pytest.param(
        "kinetic-energy",
        "m*(",
        Verdict("invalid", problems=(Problem("unexpected-end", offset=3, length=0),)),
        id="unreadable",
    ),
    pytest.param(
        "position:bob",
        "[l*sin(phi), log(cos(phi) - 2)]",
        Verdict("undecided", column(ROD, r"\ln(\cos\varphi - 2)"), parts=("correct", "undecided")),
        id="undecided",
    ),
    pytest.param("equation:phi", "0 = 0", Verdict("wrong", "0 = 0", "degenerate"), id="says nothing"),
    pytest.param(
        "equation:phi",
        "phi*(l*ddot(phi) + g*sin(phi)) = 0",
        Verdict("wrong", r"\varphi (\ell \ddot{\varphi} + g \sin\varphi) = 0", "factor-vanishes"),
        id="a factor that vanishes",
    ),
    pytest.param(
        "kinetic-energy",
        "m*l^2*dot(phi)^2",
        Verdict(
            "wrong",
            r"m \ell^{2} \dot{\varphi}^{2}",
            misconceptions=("half-in-kinetic-energy",),
            slips=(Slip("double", r"m \ell^{2} \dot{\varphi}^{2}", Span(0, 16)),),
            counterexample=Counterexample(RATES, 0.25, 0.125),
            marked=written("", r"m \, \ell^{2} \, \dot{\varphi}^{2}"),
        ),
        id="a misconception",
    ),
    pytest.param(
        "potential-energy",
        "m*g*l*cos(phi)",
        Verdict(
            "wrong",
            rf"{WEIGHT} \cos\varphi",
            misconceptions=("gravity-sign", "potential-sign"),
            about="weight",
            slips=(Slip("sign", rf"{WEIGHT} \cos\varphi", Span(0, 14)),),
            marked=written("", r"m \, g \, \ell \, \cos(\varphi)"),
            counterexample=Counterexample(
                {n: STATE[n] for n in ("m", "l", "g", "phi")}, 2.62416, 16.9958, reference={"phi": 0.0}
            ),  # g cos 1.3, and 2g − g cos 1.3, which is g at 0 as well
        ),
        id="several misconceptions",
    ),
    pytest.param(
        "position:bob",
        "[l*sin(phi), -l*cos(phi)]",
        Verdict(
            "wrong",
            column(ROD, f"-{POLE}"),
            slips=(Slip("sign", f"-{POLE}", Span(13, 11), part=1),),
            counterexample=Counterexample({"l": 1.0, "phi": 1.3}, -0.267499, 0.267499, "2"),  # cos 1.3
            parts=("correct", "wrong"),
            partial=0.5,
            marked=written(r"\begin{bmatrix} \ell \, \sin(\varphi) \\ ", r"-\ell \, \cos(\varphi)", r" \end{bmatrix}"),
        ),
        id="a slip",
    ),
    pytest.param(
        "kinetic-energy",
        "3*m*dot(phi)^2/7",
        Verdict(
            "wrong",
            r"\frac{3}{7} m \dot{\varphi}^{2}",
            misconceptions=("other-unit",),
            counterexample=Counterexample(RATES, 0.107143, 0.125),
            parameters={"found": "kg s⁻²", "expected": "kg m² s⁻²"},
        ),
        id="another unit",
    ),
    pytest.param(
        "kinetic-energy",
        "m*dot(phi)^2/2 + m",
        Verdict(
            "wrong",
            r"\frac{1}{2} m \dot{\varphi}^{2} + m",
            misconceptions=("wrong-dimension",),
            counterexample=Counterexample(RATES, 1.125, 0.125),
            parameters={"term": "$m$", "found": "kg", "expected": "kg s⁻²"},
        ),
        id="terms that cannot be added",
    ),
    pytest.param(
        "equation:phi",
        "l*ddot(phi) = g + m",
        Verdict(
            "wrong",
            r"\ell \ddot{\varphi} = m + g",
            misconceptions=("wrong-dimension",),
            counterexample=Counterexample({"m": 1.0, "l": 1.0, "g": 9.81, "phi": 1.3}, 10.81, -9.45251, "ddot(phi)"),
            parameters={"term": "$m$", "found": "kg", "expected": "m s⁻²"},
        ),
        id="terms of an equation that cannot be added",
    ),
    pytest.param(
        "equation:phi",
        "l*ddot(phi) = g",
        Verdict(
            "wrong",
            r"\ell \ddot{\varphi} = g",
            counterexample=Counterexample({"m": 1.0, "l": 1.0, "g": 9.81, "phi": 1.3}, 9.81, -9.45251, "ddot(phi)"),
        ),
        id="an equation may have any unit",
    ),
    pytest.param(
        "conserved:1",
        "m*dot(phi)",
        Verdict(
            "wrong",
            r"m \dot{\varphi}",
            counterexample=Counterexample(STATE, 0.5, 7.31084, reference={"phi": 0.0, "dot(phi)": 0.0}),
        ),
        id="a conserved quantity may have any unit",
    ),
    pytest.param(
        "kinetic-energy",
        "m*l^2*dot(phi)^2/2 + m*g*l*cos(phi)",
        Verdict(
            "wrong",
            rf"{KINETIC} + {WEIGHT} \cos\varphi",
            slips=(Slip("superfluous", rf"{WEIGHT} \cos\varphi", Span(21, 14)),),
            counterexample=Counterexample(STATE, 2.74916, 0.125),
            marked=written(r"\frac{m \, \ell^{2} \, \dot{\varphi}^{2}}{2} + ", r"m \, g \, \ell \, \cos(\varphi)"),
        ),
        id="a term too much",
    ),
]
ELSEWHERE = [
    pytest.param(
        "elastic-pendulum",
        "generalized-force:phi",
        "F0*l",
        Verdict(
            "wrong",
            r"F_0 \ell",
            misconceptions=("load-missing",),
            about="weight",
            slips=(Slip("missing", ""),),
            counterexample=Counterexample(
                {"m": 1.0, "l": 1.0, "g": 9.81, "F0": 2.0, "phi": 0.9}, 2.0, -5.68444
            ),  # 2 − 9.81 sin 0.9
        ),
        id="what the misconception is about",
    ),
    pytest.param(
        "pendulum",
        "eigenfrequencies",
        "g/l",
        Verdict(
            "wrong",
            r"\frac{g}{\ell}",
            misconceptions=("frequency-without-root",),
            counterexample=Counterexample({"l": 1.0, "g": 9.81}, 9.81, 3.13209),  # √9.81
        ),
        id="a frequency",
    ),
    pytest.param(
        "cart-pendulum",
        "equations",
        "x = 0; ddot(x) = 0",
        Verdict(
            "wrong",
            r"\begin{aligned} x &= 0 \\ \ddot{x} &= 0 \end{aligned}",
            "degenerate",
            parts=("wrong", "wrong"),
        ),
        id="a set that says nothing",
    ),
    pytest.param(
        "cart-pendulum",
        "kinetic-energy",
        "(M + m)*dot(x)^2/2 + m*l*dot(x)*dot(phi)*sin(phi) + m*l^2*dot(phi)^2/2",
        Verdict(
            "wrong",
            rf"\frac{{1}}{{2}} (M + m) \dot{{x}}^{{2}} + m {ROD} \, \dot{{x}} \dot{{\varphi}} + {KINETIC}",
            slips=(Slip("function", r"\sin\varphi", Span(41, 8)),),
            counterexample=Counterexample(
                {"M": 2.0, "m": 1.0, "l": 0.8, "phi": 1.5, "dot(x)": 0.6, "dot(phi)": 0.9}, 1.23012, 0.829758
            ),
            marked=written(
                r"\frac{(M + m) \, \dot{x}^{2}}{2} + m \, \ell \, \dot{x} \, \dot{\varphi} \, ",
                r"\sin(\varphi)",
                r" + \frac{m \, \ell^{2} \, \dot{\varphi}^{2}}{2}",
            ),
        ),
        id="a function",
    ),
]


@pytest.mark.parametrize(
    ("scene", "task", "answer", "verdict"),
    [*(pytest.param("pendulum", *case.values, id=case.id) for case in CASES), *ELSEWHERE],
)
def test_the_whole_verdict(scene: str, task: str, answer: str, verdict: Verdict) -> None:
    workbook = workbook_of({"scene": scene})
    assert check(workbook, workbook.task(task), answer, "plain") == verdict


@pytest.mark.parametrize("task", ["kinetic-energy", "equilibria", "stability:1"])
def test_an_answer_that_is_too_long_is_told_from_where_on(task: str) -> None:
    """2000 characters are read, by whatever judge."""
    workbook = workbook_of({"scene": "pendulum"})
    told = Problem("too-long", offset=2000, length=3, parameters={"length": 2003, "limit": 2000})
    assert check(workbook, workbook.task(task), "(".ljust(2003, "0"), "plain") == Verdict("invalid", problems=(told,))
    assert check(workbook, workbook.task(task), "(".ljust(2000, "0"), "plain").problems[0].code != "too-long"


def test_terms_are_told_in_the_syntax_of_the_answer() -> None:
    workbook = workbook_of({"scene": "pendulum"})
    verdict = check(workbook, workbook.task("kinetic-energy"), r"\frac{m}{2}\dot\varphi^2 + m g", "latex")
    assert verdict.misconceptions == ("wrong-dimension",)
    assert verdict.parameters["found"] == "kg m s⁻²"

"""Derivations as LaTeX and Markdown: complete, balanced, and without a sign that means what it should not."""

from __future__ import annotations

import re
import shutil
import subprocess
from functools import cache
from pathlib import Path

import pytest
from tests.derived import derived

from deltaq.handout import latex, markdown
from deltaq.handout.document import Handout, handout_of, written_down
from deltaq.mechanics.library import load_scene, scene_ids
from deltaq.narration.prose import CatalogText, words

FORMULA = re.compile(r"\\displayed\{(.*)\}$", re.MULTILINE)
INLINE = re.compile(r"\$[^$]*\$")
# All in LaTeX itself, amsmath, amssymb or graphicx, but for those that the preamble defines.
COMMANDS = set(
    re.findall(
        r"\w+",
        """
    documentclass usepackage setlength parindent parskip newsavebox formula newcommand displayed sbox
    displaystyle ifdim wd linewidth resizebox usebox else fi step par medskip textbf quad nopagebreak substep
    smallskip hspace textit title author date begin end maketitle paragraph section textbackslash textasciitilde
    textasciicircum varphi partial frac ell mathbf dot sin text mathrm delta cos left right vartheta psi omega
    cdot ddot Omega beta kappa int Longleftrightarrow approx sqrt det alpha pi lambda varepsilon neq leq arcsin
    Delta Lambda boldsymbol
    arccos arctan surd tfrac theta phi gamma eta mu rho sigma tau Phi tan exp ln le ge to zeta xi nu chi infty quad
    qquad operatorname times sum pm mathcal
""",
    )
)
ROADS = ("dalembert-lagrange", "hamilton")


@cache
def written(identifier: str, language: str) -> Handout:
    return written_down(*derived(identifier, ROADS[language == "en"]), language)


def opened_and_closed(text: str) -> bool:
    """Whether braces nest, and every \\begin has its \\end and every \\left its \\right."""
    bare = re.sub(r"\\[{}\\]", "", text)
    depth = 0
    for sign in bare:
        depth += {"{": 1, "}": -1}.get(sign, 0)
        if depth < 0:
            return False
    stack: list[str] = []
    for kind, name in re.findall(r"\\(begin|end)\{(\w+\*?)\}|\\(?:left|right)(?![a-z])", bare):
        if kind == "begin":
            stack.append(name)
        elif kind == "end" and (not stack or stack.pop() != name):
            return False
    pairs = len(re.findall(r"\\left(?![a-z])", text)) == len(re.findall(r"\\right(?![a-z])", text))
    return depth == 0 and not stack and pairs


@pytest.mark.one_in(6)
@pytest.mark.parametrize("language", ["de", "en"])
@pytest.mark.parametrize("identifier", scene_ids())
def test_latex_file_is_sound(identifier: str, language: str) -> None:
    handout = written(identifier, language)
    text = latex.latex_file(handout)
    assert opened_and_closed(text)
    formulas = FORMULA.findall(text)
    assert len(formulas) == sum(bool(line.latex) for part in handout.parts for line in part.lines)
    assert all(opened_and_closed(formula) for formula in formulas)
    assert set(re.findall(r"\\([A-Za-z]+)", text)) <= COMMANDS
    sentences = INLINE.sub("", "\n".join(line for line in text.splitlines() if not line.startswith("\\displayed")))
    assert re.findall(r"[^\x00-\x7f\u00a1-\u00ff„“”‚‘’–—…]", sentences) == []
    told = [sentence for part in handout.parts for line in part.lines for sentence in (line.title, line.text)]
    asked = sum(INLINE.sub("", sentence).count("?") for sentence in (handout.title.plain, handout.summary.plain, *told))
    assert sentences.count("?") == asked, "a sign was left out"


@pytest.mark.parametrize(
    ("language", "mark", "other"), [pytest.param("de", "{,}", ".", id="de"), pytest.param("en", ".", "{,}", id="en")]
)
def test_numbers_of_formulas_have_the_mark_of_the_language(language: str, mark: str, other: str) -> None:
    handout = written("stick-slip", language)
    steps = [line.latex for part in handout.parts for line in part.lines]
    formulas = [*steps, *(value.equation for value in handout.parameters)]
    numbers = [number for latex in formulas for number in re.findall(r"\d(\.|\{,\})\d+(?!\d|em)", latex)]
    assert mark in numbers
    assert other not in numbers
    assert all(rf"0{mark}2" in text for text in (markdown.markdown_file(handout), latex.latex_file(handout)))


def test_balance_is_really_looked_at() -> None:
    assert not opened_and_closed(r"\frac{1}{2")
    assert not opened_and_closed(r"\begin{aligned}\begin{bmatrix}\end{aligned}\end{bmatrix}")
    assert not opened_and_closed(r"\left( x")
    assert opened_and_closed(r"\left\{ x \right\}")


@pytest.mark.parametrize("identifier", ["elastic-pendulum", "triple-pendulum"])
def test_latex_file_compiles(identifier: str, tmp_path: Path) -> None:
    engine = next(
        (path for name in ("tectonic", "pdflatex", "lualatex", "xelatex") if (path := shutil.which(name))), None
    )
    if engine is None:
        pytest.skip("no LaTeX engine on this machine: balance and commands are tested, compiling is not")
    file = tmp_path / "handout.tex"
    file.write_text(latex.latex_file(written(identifier, "de")), encoding="utf-8")
    options = [] if engine.endswith("tectonic") else ["-interaction=nonstopmode", "-halt-on-error"]
    done = subprocess.run([engine, *options, file.name], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-2000:]


@pytest.mark.parametrize(
    ("text", "written"),
    [
        pytest.param("50 % & 3_2 #1", r"50 \% \& 3\_2 \#1", id="special signs"),
        pytest.param("\\input{/etc/passwd}", r"\textbackslash{}input\{/etc/passwd\}", id="a command"),
        pytest.param("x^2 ~ y", r"x\textasciicircum{}2 \textasciitilde{} y", id="accents"),
        pytest.param("δr, φ̇ und ṙ²", r"$\delta$r, $\dot{\varphi}$ und $\dot{r}$²", id="letters of mechanics"),
        pytest.param("Kräfte „außen“ – ok", "Kräfte „außen“ – ok", id="German"),
        pytest.param("振り子 a\nb", "??? a b", id="what has no font"),
        pytest.param("$", r"\$", id="a dollar sign"),
    ],
)
def test_text_in_latex(text: str, written: str) -> None:
    assert latex.escaped(text) == written


@pytest.mark.parametrize(
    ("sentence", "written"),
    [
        pytest.param(CatalogText("Ableitung nach $q_1$ dort"), "Ableitung nach $q_1$ dort", id="a formula"),
        pytest.param(words("a_b"), r"a\_b", id="no formula"),
    ],
)
def test_sentences_with_formulas(sentence: CatalogText, written: str) -> None:
    assert latex.prose(sentence) == written
    assert markdown.prose(sentence) == written


def test_a_dollar_sign_of_a_user_opens_no_formula() -> None:
    assert latex.prose(words("costs 5 $")) == r"costs 5 \$"
    assert markdown.prose(words("costs 5 $")) == "costs 5 ＄"  # viewers seek formulas where the backslash is gone


@pytest.mark.one_in(8)
@pytest.mark.parametrize("identifier", scene_ids())
def test_markdown_file_holds_every_step(identifier: str) -> None:
    handout = written(identifier, "en")
    text = markdown.markdown_file(handout)
    lines = [line for part in handout.parts for line in part.lines]
    assert text.count("\n$$\n") == 2 * sum(bool(line.latex) for line in lines)
    for line in lines:
        assert line.latex in text
        assert f"{line.number} " in text
    assert "<" not in re.sub(r"\$\$.*?\$\$|\$[^$]*\$|\\<", "", text, flags=re.DOTALL)


def test_markdown_has_no_meaning_of_its_own() -> None:
    assert markdown.escaped("<b> *x* [a](b) `c`") == r"\<b\> \*x\* \[a\](b) \`c\`"


def test_substeps_may_be_left_out() -> None:
    scene = load_scene("pendulum")
    whole, short = (handout_of(scene, "en", ROADS[0], substeps=told) for told in (True, False))
    lines = [line for part in short.parts for line in part.lines]
    assert {line.depth for line in lines} == {0}
    assert lines == [line for part in whole.parts for line in part.lines if line.depth == 0]


def test_labels_of_a_user_do_not_break_the_formulas() -> None:
    """What a scene calls its loads stands within formulas, too."""
    document = {
        "format": 1,
        "id": "labels",
        "title": {"en": "100 % {pendulum}"},
        "summary": {"en": "a_b"},
        "coordinates": [{"name": "phi", "value": 0.5}],
        "parameters": [{"name": "m"}, {"name": "l"}, {"name": "g", "value": 9.81}],
        "bodies": [{"name": "bob", "kind": "particle", "mass": "m", "position": ["l*sin(phi)", "l*cos(phi)"]}],
        "loads": [{"name": "weight", "kind": "gravity", "acceleration": ["0", "g"]}],
        "labels": {"weight": {"en": "50 % of \\it {all & #1"}},
    }
    from deltaq.mechanics.document import read_scene

    text = latex.latex_file(handout_of(read_scene(document), "en", ROADS[0]))
    assert opened_and_closed(text)
    assert re.findall(r"(?<!\\)[%#]", "\n".join(FORMULA.findall(text))) == []


def test_what_holds_a_rod_stands_behind_the_equations_of_motion() -> None:
    parts = handout_of(load_scene("pendulum"), "en", ROADS[0], release=("l",)).parts
    plain = handout_of(load_scene("pendulum"), "en", ROADS[0]).parts
    titles = ["".join(map(str, part.title)) for part in parts]
    (added,) = [k for k, part in enumerate(parts) if part.title not in [each.title for each in plain]]
    assert 0 < added < len(parts) - 1, titles
    assert parts[added].lines[-1].latex.endswith(r"S_{\ell} &= m (\ell \dot{\varphi}^{2} + g \cos\varphi)\end{aligned}")

"""Exported questions run in Maxima as STACK runs them: question variables, an answer, feedback variables, the tree.

One process serves any number of questions and answers, which stand in Maxima's own syntax as STACK's tests of questions
do. Of STACK itself only what the export uses is stood in for: the constants pi and e, and AlgEquiv of booleans.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import tempfile
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree as ET

MAXIMA = shutil.which("maxima")
PRELUDE = Path(__file__).with_name("answer_tests.mac")
LINE = re.compile(r"^GRADED (\S+) (\S+) (\S+) (\S+)$", re.MULTILINE)


@dataclass(frozen=True)
class Graded:
    """The score of an answer, the note of the branch by which it left the tree, and the penalty."""

    score: float
    note: str
    penalty: str


def run(questions: Sequence[tuple[ET.Element, Sequence[str]]], timeout: float = 600) -> list[list[Graded]]:
    """What each question says to each of its answers."""
    assert MAXIMA is not None
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "questions.mac"
        program.write_text("\n".join(_program(questions)), encoding="utf-8")
        command = [MAXIMA, "--very-quiet", f'--batch-string=load("{program.as_posix()}")$ quit()$']
        done = subprocess.run(command, capture_output=True, text=True, timeout=timeout, check=False, cwd=folder)
    found = {(a, b): Graded(float(c), *d.split("|")) for a, b, c, d in LINE.findall(done.stdout)}
    wanted = [[(str(n), str(k)) for k in range(len(answers))] for n, (_, answers) in enumerate(questions)]
    missing = [pair for row in wanted for pair in row if pair not in found]
    assert not missing, (missing[:3], done.stdout[-3000:], done.stderr[-1000:])
    return [[found[pair] for pair in row] for row in wanted]


def _program(questions: Sequence[tuple[ET.Element, Sequence[str]]]) -> Iterable[str]:
    yield PRELUDE.read_text(encoding="utf-8")
    for number, (question, answers) in enumerate(questions):
        yield question.findtext("questionvariables/text") or ""
        local = "[score: 0, penalty: 0, note: none]"
        yield f"grade_{number}(ans1) := block({local}, {_tree(question)}, [score, note, penalty])$"
        for index, answer in enumerate(answers):
            typed = re.sub(r'(["\\])', r"\\\1", answer)
            yield f'told("{number} {index}", errcatch(grade_{number}(eval_string("{typed}"))))$'


def _tree(question: ET.Element) -> str:
    """Feedback variables, then the first node; each leads on to others."""
    variables = (question.findtext("prt/feedbackvariables/text") or "").strip().rstrip(";")
    nodes = {node.findtext("name"): node for node in question.findall("prt/node")}
    return f"{variables.replace(';', ',')}, {_node(nodes, '0')}"


def _node(nodes: dict[str | None, ET.Element], name: str) -> str:
    node = nodes[name]
    assert node.findtext("answertest") == "AlgEquiv"
    test = f"at_alg_equiv({node.findtext('sans')}, {node.findtext('tans')})"
    return f"if {test} then ({_branch(nodes, node, 'true')}) else ({_branch(nodes, node, 'false')})"


def _branch(nodes: dict[str | None, ET.Element], node: ET.Element, which: str) -> str:
    score, penalty = node.findtext(f"{which}score"), node.findtext(f"{which}penalty") or "0.1"
    assert node.findtext(f"{which}scoremode") == "="
    done = f'score: {score}, penalty: {penalty}, note: "{node.findtext(f"{which}answernote")}"'
    following = node.findtext(f"{which}nextnode") or "-1"
    return done if following == "-1" else f"{done}, {_node(nodes, following)}"

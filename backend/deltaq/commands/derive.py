"""`deltaq derive`: a derivation as a document, a program or data."""

from __future__ import annotations

import argparse
import json
from typing import Any

from ._common import field_argument, language_argument, output_argument, question_of, scene_argument, write

HELP = "derive the equations of motion of a scene"
DESCRIPTION = """Derives the equations of motion of a scene step by step: as JSON with all steps and results, as LaTeX
or Markdown to read, as a Python program that computes the motion with SciPy, or as a Jupyter notebook with both."""


EXAMPLE = "deltaq derive double-pendulum --format notebook --output double-pendulum.ipynb"


def arguments(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    scene_argument(parser)
    forms = ("markdown", "latex", "json", "python", "notebook")
    parser.add_argument("--format", choices=forms, default="markdown", help="default: %(default)s")
    field_argument(parser)
    output_argument(parser)
    language_argument(parser)


def run(options: argparse.Namespace) -> None:
    """Derive, and write."""
    question = question_of(options)
    match options.format:
        case "json":
            text = json.dumps(_derived(question), ensure_ascii=False, indent=1)
        case "notebook":
            text = _notebook(_exported(question, "markdown"), _exported(question, "python"))
        case form:
            text = _exported(question, form)
    write(text, options.output)


def _derived(question: dict[str, Any]) -> dict[str, Any]:
    """What POST /derivations answers to the same question, with the same id."""
    from ..api.routes.derivations import named
    from ..contract.derivation import DerivationRequest
    from ..contract.reading import checked
    from ..narration.derive import derive_request

    request = checked(question, DerivationRequest)
    identifier, _ = named(request)
    return {"id": identifier, **derive_request(request)}


def _exported(question: dict[str, Any], form: str) -> str:
    from ..contract.export import ExportRequest
    from ..contract.reading import checked
    from ..handout.service import export_request

    return str(export_request({**checked(question, ExportRequest), "form": form})["text"])


def _notebook(derivation: str, program: str) -> str:
    """Notebook format 4: the derivation by chapters, then the program."""
    chapters = [f"## {part}" if index else part for index, part in enumerate(derivation.split("\n## "))]
    cells = [_cell("markdown", text) for text in chapters] + [_cell("code", program)]
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    named = [{"id": f"part-{index}", **cell} for index, cell in enumerate(cells)]
    return json.dumps(
        {"nbformat": 4, "nbformat_minor": 5, "metadata": {"kernelspec": kernel}, "cells": named}, ensure_ascii=False
    )


def _cell(kind: str, text: str) -> dict[str, Any]:
    code: dict[str, Any] = {"execution_count": None, "outputs": []} if kind == "code" else {}
    return {"cell_type": kind, "metadata": {}, "source": text.splitlines(keepends=True), **code}

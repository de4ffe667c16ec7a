"""Answers as somebody has read and approved them, to be told when a change of the code changes any of them.

`approved/` has a file for each derivation: each step with its formulas and the digest of all else that is said of it in
both languages (words, terms and where they come from, evidence, substeps), and the digest of each part of the result.

    python -m tests.narration.approved write            after a change that is wanted: git shows what it changes
    python -m tests.narration.approved show pendulum    an answer in full, to compare those of two checkouts with `diff`
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any
from zlib import crc32

from tests.derived import told

from deltaq.mechanics.library import scene_ids
from deltaq.narration.derive import derive_request

FOLDER = Path(__file__).with_name("approved")
LANGUAGES = ("en", "de")
# What not every derivation has: the canonical equations, and Hamilton's principle as the starting point.
CANONICAL = ("bead-on-rotating-hoop", "elastic-pendulum", "heavy-top", "rotating-pivot-pendulum", "wind-on-rod")
HAMILTON = ("double-pendulum", "quarter-car", "spherical-pendulum")
NAMES = (
    *scene_ids(),
    *(f"{scene}.canonical" for scene in CANONICAL),
    *(f"{scene}.hamilton" for scene in HAMILTON),
)

Answer = Mapping[str, Any]


def answer(name: str, language: str) -> Answer:
    """The answer of `POST /derivations` by the name of its file."""
    scene, _, kind = name.partition(".")
    if kind == "canonical":
        return derive_request({"scene": scene, "canonical": True, "lang": language})
    return told(scene, language, kind) if kind else told(scene, language)


def digest(*parts: object) -> str:
    return f"{crc32(json.dumps(parts, sort_keys=True).encode()):08x}"


def lines(answers: tuple[Answer, ...]) -> Iterator[str]:
    """Formulas, and digests of what the answers say beside them; the answers are the same in different languages."""
    for chapters in zip(*(one["chapters"] for one in answers), strict=True):
        yield f"# {chapters[0]['id']}"
        for steps in zip(*(chapter["steps"] for chapter in chapters), strict=True):
            yield f"{steps[0]['id']} ({digest(*steps)})"
            yield f"  {steps[0]['latex']}"
    yield "# result"
    for part in answers[0]["result"]:
        yield f"{part} ({digest(*(one['result'][part] for one in answers))})"


def text(name: str) -> str:
    return "\n".join(lines(tuple(answer(name, language) for language in LANGUAGES))) + "\n"


def main(command: str, *names: str) -> None:
    for name in names or NAMES:
        if command == "write":
            (FOLDER / f"{name}.txt").write_text(text(name), encoding="utf-8")
        elif command == "show":
            print(
                json.dumps({language: answer(name, language) for language in LANGUAGES}, indent=1, ensure_ascii=False)
            )
        else:
            raise SystemExit(f"{command}: write or show")


if __name__ == "__main__":
    main(*sys.argv[1:])

"""What the types of problem documents mean: the pages below /problems, to which `type` leads (RFC 9457 §3.1.1).

Each says what has happened, what to do, and shows an answer of this type, with a request for it where one alone is
enough.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from html import escape
from typing import Any

from ..errors import Problem
from ..narration.catalog import text
from ..settings import Settings
from ..vocabulary import Language
from .heads import LONGEST
from .languages import LANGUAGES
from .page import Content
from .problems import (
    BODY_NOT_CALLED_JSON,
    BODY_TOO_LARGE,
    BODY_TOO_SLOW,
    HEAD_TOO_LARGE,
    INTERNAL_ERROR,
    INTERRUPTED,
    INVALID_JSON,
    INVALID_REQUEST,
    METHOD_NOT_ALLOWED,
    NOT_FOUND,
    OVERLOADED,
    QUOTA_EXCEEDED,
    RETRY_AFTER,
    TYPES,
    UNKNOWN_NAME,
    ProblemType,
    Report,
)

_JSON = "content-type: application/json"


@dataclass(frozen=True)
class Example:
    """A request as it is written, empty where no single one fails in this way for certain; and the answer to it."""

    answer: Report
    request: str = ""


def example_of(kind: ProblemType, settings: Settings) -> Example:
    """An answer of this type, with the limits that the settings set."""
    if kind in _EXAMPLES:
        return _EXAMPLES[kind]
    parameters: Mapping[ProblemType, Mapping[str, Any]] = {
        BODY_TOO_LARGE: {"limit": settings.largest_body},
        BODY_TOO_SLOW: {"seconds": settings.body_timeout},
        HEAD_TOO_LARGE: {"limit": LONGEST},
        QUOTA_EXCEEDED: {"seconds": RETRY_AFTER},
        OVERLOADED: {"seconds": RETRY_AFTER},
        INTERRUPTED: {"seconds": RETRY_AFTER},
        INTERNAL_ERROR: {"incident": "3f2a9c41b07e"},
    }
    return Example(Report(kind, parameters=parameters.get(kind, {})))


_EXAMPLES: Mapping[ProblemType, Example] = {
    INVALID_REQUEST: Example(
        Report(INVALID_REQUEST, (Problem("request-not-above", "/t_end", parameters={"gt": 0.0}),)),
        f'POST /api/v1/simulations\n{_JSON}\n\n{{"scene": "pendulum", "t_end": -5}}',
    ),
    INVALID_JSON: Example(
        Report(INVALID_JSON, (Problem("json-syntax", offset=10),)),
        f'POST /api/v1/derivations\n{_JSON}\n\n{{"scene": pendulum}}',
    ),
    UNKNOWN_NAME: Example(
        Report(
            UNKNOWN_NAME,
            (Problem("request-unknown-language", parameters={"name": "fr", "known": ", ".join(LANGUAGES)}),),
        ),
        "GET /api/v1/catalogs/fr",
    ),
    NOT_FOUND: Example(Report(NOT_FOUND), "GET /api/v1/pendulum"),
    METHOD_NOT_ALLOWED: Example(
        Report(METHOD_NOT_ALLOWED, parameters={"allowed": "GET, HEAD"}), "DELETE /api/v1/scenes"
    ),
    BODY_NOT_CALLED_JSON: Example(
        Report(BODY_NOT_CALLED_JSON, parameters={"syntax": "JSON", "media": "application/json"}),
        'POST /api/v1/derivations\ncontent-type: text/plain\n\n{"scene": "pendulum"}',
    ),
}


def explained(kind: ProblemType, language: Language, settings: Settings) -> dict[str, Any]:
    """The type in words, with its example: what the page shows, for programs."""
    example = example_of(kind, settings)
    answer = example.answer.document(language)
    words = {part: text(language, f"errors.type.{kind.name}.{part}") for part in ("meaning", "remedy")}
    head = {"type": kind.address, "status": kind.status, "title": answer["title"]}
    return head | words | {"example": {"request": example.request, "answer": answer}}


def page_of(kind: ProblemType, language: Language, settings: Settings) -> Content:
    """The page of a type."""
    told = explained(kind, language, settings)
    return Content(
        language, told["title"], _main(told["title"], "\n".join(_explanation(told, language)), language, kind)
    )


def overview(language: Language) -> Content:
    """The page that lists all types."""
    title = _word(language, "title")
    return Content(language, title, _main(title, _paragraph(_word(language, "lead")), language))


def unknown(name: str, language: Language) -> Content:
    """The page of a type that there is not."""
    title = _word(language, "unknown", name=name[:64])
    return Content(language, title, _main(title, _paragraph(_word(language, "unknown-lead")), language))


def _word(language: Language, key: str, **parameters: object) -> str:
    return text(language, f"errors.problem-page.{key}", **parameters)


def _explanation(told: Mapping[str, Any], language: Language) -> Iterator[str]:
    example = told["example"]
    answer = json.dumps(example["answer"], ensure_ascii=False, indent=2)
    yield f'<p class="kind">{told["status"]} {escape(told["type"])}</p>'
    for part in ("meaning", "remedy"):
        yield _heading(_word(language, part)) + _paragraph(told[part])
    if example["request"]:
        yield _heading(_word(language, "request")) + _code(example["request"])
    yield _heading(_word(language, "answer")) + _code(answer)


def _main(title: str, body: str, language: Language, here: ProblemType | None = None) -> str:
    """The main part: what is said under its title, and the way to all types."""
    entries = "\n".join(_entry(kind, language, "page" if kind == here else "false") for kind in TYPES)
    every = escape(_word(language, "all"))
    return (
        '<main class="reference problem" id="problem" tabindex="-1">\n'
        f'<article class="calls">\n<h1>{escape(title)}</h1>\n{body}\n</article>\n'
        f'<nav aria-label="{every}"><ul>\n{entries}\n</ul></nav>\n</main>'
    )


def _entry(kind: ProblemType, language: Language, current: str) -> str:
    title = escape(example_of(kind, Settings()).answer.document(language)["title"])
    return f'<li><a href="{kind.address}?lang={language}" aria-current="{current}">{title}</a></li>'


def _heading(words: str) -> str:
    return f"<h2>{escape(words)}</h2>\n"


def _paragraph(words: str) -> str:
    """A paragraph in which names stand between backticks."""
    parts = (f"<code>{part}</code>" if index % 2 else part for index, part in enumerate(escape(words).split("`")))
    return f"<p>{''.join(parts)}</p>"


def _code(lines: str) -> str:
    return f'<pre tabindex="0"><code>{escape(lines)}</code></pre>'

"""Which language an answer is in."""

from __future__ import annotations

from typing import get_args

from starlette.requests import Request

from ..vocabulary import Language

LANGUAGES: tuple[Language, ...] = get_args(Language)
DEFAULT: Language = "en"


def language_of(request: Request) -> Language:
    """`lang` of the body or the query, else the best of Accept-Language, else English."""
    asked = getattr(request.state, "lang", None) or request.query_params.get("lang")
    return next((one for one in LANGUAGES if one == asked), None) or negotiated(
        request.headers.get("accept-language", "")
    )


def negotiated(header: str) -> Language:
    """The language of highest quality in an Accept-Language header that we speak."""
    wishes = [_wish(part) for part in header[:1000].split(",")]
    spoken = [(quality, one) for tag, quality in wishes for one in LANGUAGES if tag == one and quality > 0]
    return max(spoken, key=lambda pair: pair[0])[1] if spoken else DEFAULT


def _wish(part: str) -> tuple[str, float]:
    tag, _, quality = part.partition(";")
    try:
        weight = float(quality.strip().removeprefix("q=") or 1)
    except ValueError:
        weight = 0.0
    return tag.strip().lower().split("-")[0], weight

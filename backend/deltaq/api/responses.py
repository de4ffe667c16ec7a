"""Responses that carry an entity tag and are compressed once."""

from __future__ import annotations

import gzip
import json
from collections.abc import Iterable
from typing import Any

from fastapi import Request, Response

from .assets import ASK_AGAIN, FOR_EVER
from .cache import content_hash
from .service import source_digest

JSON = "application/json"


def accepts_gzip(request: Request) -> bool:
    """Whether the client takes gzip."""
    return coding_for(request, ("gzip",)) is not None


def coding_for(request: Request, offered: Iterable[str]) -> str | None:
    """The first of the offered content codings that the client takes."""
    given = request.headers.get("accept-encoding", "").lower()
    accepted = {part.split(";")[0].strip() for part in given.split(",") if not part.replace(" ", "").endswith(";q=0")}
    return next((coding for coding in offered if coding in accepted), None)


def not_modified(request: Request, etag: str) -> bool:
    """Whether a GET or HEAD names the version that the client already has (RFC 9110 §13.1.2)."""
    known = request.headers.get("if-none-match", "")
    return request.method in {"GET", "HEAD"} and etag in {tag.strip().removeprefix("W/") for tag in known.split(",")}


def tagged(request: Request, document: Any) -> Response:
    """A JSON document of this version of δq, whose entity tag is the hash of its content.

    Who asks with `source`, the digest of the version, may keep it: under this address it never changes.
    """
    etag = f'"{content_hash(document)}"'
    lasting = FOR_EVER if request.query_params.get("source") == source_digest() else ASK_AGAIN
    headers = {"ETag": etag, "Cache-Control": lasting, "Vary": "Accept-Language"}
    if not_modified(request, etag):
        return Response(status_code=304, headers=headers)
    return Response(json.dumps(document, ensure_ascii=False).encode(), headers=headers, media_type=JSON)


def packed(request: Request, key: str, answer: bytes, location: str | None = None) -> Response:
    """A gzipped answer that its key names for ever; `location` is where it can be fetched again, if it can."""
    etag = f'"{key}"'
    lasting = FOR_EVER if location == request.url.path else ASK_AGAIN
    headers = {"ETag": etag, "Cache-Control": lasting, "Vary": "Accept-Language, Accept-Encoding"}
    if location:
        headers["Content-Location"] = location
    if not_modified(request, etag):
        return Response(status_code=304, headers=headers)
    if accepts_gzip(request):
        return Response(answer, headers=headers | {"Content-Encoding": "gzip"}, media_type=JSON)
    return Response(gzip.decompress(answer), headers=headers, media_type=JSON)

"""The pages and their files; nothing comes from elsewhere."""

from __future__ import annotations

import hashlib

from fastapi import APIRouter, Request, Response
from fastapi.routing import APIRoute
from starlette.exceptions import HTTPException
from starlette.responses import RedirectResponse
from starlette.routing import Match
from starlette.types import Scope

from ..assets import ASK_AGAIN, Asset
from ..headers import content_security_policy
from ..page import import_map_hash
from ..responses import coding_for, not_modified
from ..service import service_of
from .common import PREFIX


class PageRoute(APIRoute):
    """A route of the pages: it leaves the addresses of the API to themselves, so that those know their methods."""

    def matches(self, scope: Scope) -> tuple[Match, Scope]:
        if scope["type"] == "http" and scope["path"].startswith(f"{PREFIX}/"):
            return Match.NONE, {}
        return super().matches(scope)


router = APIRouter(include_in_schema=False, route_class=PageRoute)


@router.api_route("/", methods=["GET", "HEAD"])
def start(request: Request) -> Response:
    """The start page. Scenes were here once: an address that names one leads to where they are now."""
    if "scene" in request.query_params:
        return RedirectResponse(f"/scene?{request.url.query}", 308, {"Cache-Control": ASK_AGAIN})
    html = service_of(request).assets.page("index")
    if html is None:
        raise HTTPException(404)
    return _page(request, html)


@router.api_route("/embed", methods=["GET", "HEAD"])
def embed(request: Request) -> Response:
    """The page of a scene for frames of other pages, which DELTAQ_FRAME_ANCESTORS names."""
    return _framed(request, "scene")


@router.api_route("/embed/proof", methods=["GET", "HEAD"])
def embedded_proof(request: Request) -> Response:
    """The general proof for frames of other pages."""
    return _framed(request, "proof")


@router.api_route("/docs/try", methods=["GET", "HEAD"])
def trial(request: Request) -> Response:
    """The page where the API is tried, below the one where it is read."""
    html = service_of(request).assets.page("trial")
    if html is None:
        raise HTTPException(404)
    return _page(request, html)


@router.api_route("/{path:path}", methods=["GET", "HEAD"])
def file(request: Request, path: str) -> Response:
    """A page by its name without suffix, or a file of the pages."""
    assets = service_of(request).assets
    html = assets.page(path)
    if html is not None:
        return _page(request, html)
    asset = assets.find(path)
    if asset is None:
        raise HTTPException(404)
    return _file(request, asset)


def _framed(request: Request, name: str) -> Response:
    """A page as it looks in a frame of another one."""
    html = service_of(request).assets.page(name)
    if html is None:
        raise HTTPException(404)
    return _page(request, html.replace("</head>", '<link rel="stylesheet" href="/styles/embed.css"></head>'))


def _page(request: Request, html: str) -> Response:
    """A page; its policy names the hash of its import map."""
    inline = import_map_hash(html)
    ancestors = service_of(request).settings.frame_ancestors
    policy = content_security_policy(*([inline] if inline else []), frame_ancestors=ancestors)
    return _text(request, html, "text/html", {"Content-Security-Policy": policy})


def _text(request: Request, content: str, media_type: str, headers: dict[str, str] | None = None) -> Response:
    etag = f'"{hashlib.sha256(content.encode()).hexdigest()[:16]}"'
    sent = {"ETag": etag, "Cache-Control": ASK_AGAIN, **(headers or {})}
    if not_modified(request, etag):
        return Response(status_code=304, headers=sent)
    return Response(content, headers=sent, media_type=media_type)


def _file(request: Request, asset: Asset) -> Response:
    headers = {"ETag": asset.etag, "Cache-Control": asset.cache_control, "Vary": "Accept-Encoding"}
    if not_modified(request, asset.etag):
        return Response(status_code=304, headers=headers)
    headers["Content-Type"] = asset.media_type
    coding = coding_for(request, asset.compressed)
    if coding is not None:
        return Response(asset.compressed[coding], headers=headers | {"Content-Encoding": coding})
    return Response(asset.content, headers=headers)

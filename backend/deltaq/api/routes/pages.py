"""The pages and their files; nothing comes from elsewhere."""

from __future__ import annotations

import hashlib
from importlib.resources import files

from fastapi import APIRouter, Request, Response
from fastapi.routing import APIRoute
from starlette.exceptions import HTTPException
from starlette.responses import RedirectResponse
from starlette.routing import Match
from starlette.types import Scope

from ...vocabulary import Language
from ..assets import ASK_AGAIN, Asset
from ..headers import content_security_policy
from ..languages import language_of
from ..lost_page import lost_page
from ..page import Content
from ..problem_pages import explained, overview, page_of, unknown
from ..problems import TYPES, ProblemType
from ..responses import coding_for, not_modified, tagged
from ..service import service_of
from .common import PREFIX

PROBLEMS = "problems"
LECTURES = files("deltaq") / "lectures"
FRAMED = ("styles/embed.css",)  # what a page looks like in a frame of another one


class PageRoute(APIRoute):
    """A route of the pages: it leaves the addresses of the API to themselves, so that those know their methods."""

    def matches(self, scope: Scope) -> tuple[Match, Scope]:
        """No page has an address below that of the API."""
        if scope["type"] == "http" and scope["path"].startswith(f"{PREFIX}/"):
            return Match.NONE, {}
        return super().matches(scope)


router = APIRouter(include_in_schema=False, route_class=PageRoute)


@router.api_route("/", methods=["GET", "HEAD"])
def start(request: Request) -> Response:
    """The start page. Scenes were here once: an address that names one leads to where they are now."""
    if "scene" in request.query_params:
        return RedirectResponse(f"/scene?{request.url.query}", 308, {"Cache-Control": ASK_AGAIN})
    return _page(request, "index")


@router.api_route("/embed", methods=["GET", "HEAD"])
def embed(request: Request) -> Response:
    """The page of a scene for frames of other pages, which DELTAQ_FRAME_ANCESTORS names."""
    return _page(request, "scene", FRAMED)


@router.api_route("/embed/proof", methods=["GET", "HEAD"])
def embedded_proof(request: Request) -> Response:
    """The general proof for frames of other pages."""
    return _page(request, "proof", FRAMED)


@router.api_route("/docs/try", methods=["GET", "HEAD"])
def trial(request: Request) -> Response:
    """The page where the API is tried, below the one where it is read."""
    return _page(request, "trial")


@router.api_route("/lectures/{name}.json", methods=["GET", "HEAD"])
def lecture(request: Request, name: str) -> Response:
    """A lecture that is ready to be given, for the page of own lectures; `seed.en` is one."""
    file = next((one for one in LECTURES.iterdir() if one.name == f"{name}.json"), None)
    if file is None:
        raise HTTPException(404)
    content = file.read_bytes()
    etag = f'"{hashlib.sha256(content).hexdigest()[:16]}"'
    headers = {"ETag": etag, "Cache-Control": ASK_AGAIN}
    if not_modified(request, etag):
        return Response(status_code=304, headers=headers)
    return Response(content, headers=headers, media_type="application/json")


@router.api_route("/problems", methods=["GET", "HEAD"])
def problems(request: Request) -> Response:
    """All types of problem documents."""
    return _page(request, PROBLEMS, content=overview(language_of(request)))


@router.api_route("/problems/{name:path}", methods=["GET", "HEAD"])
def problem(request: Request, name: str) -> Response:
    """What a type of problem document means; as JSON for who asks for that alone."""
    language = language_of(request)
    kind = next((one for one in TYPES if one.name == name), None)
    if _wants_json(request):
        return _explained(request, kind, language)
    if kind is None:
        return _page(request, PROBLEMS, content=unknown(name, language), status=404)
    return _page(request, PROBLEMS, content=page_of(kind, language, service_of(request).settings))


def _wants_json(request: Request) -> bool:
    accepted = request.headers.get("accept", "")
    return "json" in accepted and "text/html" not in accepted


def _explained(request: Request, kind: ProblemType | None, language: Language) -> Response:
    if kind is None:
        raise HTTPException(404)
    answer = tagged(request, explained(kind, language, service_of(request).settings))
    answer.headers.update({"Content-Language": language, "Vary": "Accept, Accept-Language"})
    return answer


@router.api_route("/{path:path}", methods=["GET", "HEAD"])
def file(request: Request, path: str) -> Response:
    """A file of the pages, or a page by its name without suffix; who reads is told where the pages are."""
    assets = service_of(request).assets
    asset = assets.find(path)
    if asset is not None:
        return _file(request, asset)
    if assets.page(path) is None and "text/html" in request.headers.get("accept", ""):
        return _page(request, PROBLEMS, content=lost_page(path, assets.pages, language_of(request)), status=404)
    return _page(request, path)


def _page(
    request: Request, name: str, sheets: tuple[str, ...] = (), content: Content | None = None, status: int = 200
) -> Response:
    """A page; its policy names the hash of its import map. What it says itself is in the language asked for."""
    service = service_of(request)
    page = service.assets.page(name, sheets, content)
    if page is None:
        raise HTTPException(404)
    policy = content_security_policy(page.import_map_hash, frame_ancestors=service.settings.frame_ancestors)
    etag = f'"{hashlib.sha256(page.html.encode()).hexdigest()[:16]}"'
    headers = {"ETag": etag, "Cache-Control": ASK_AGAIN, "Content-Security-Policy": policy}
    if content is not None:
        headers |= {"Content-Language": content.language, "Vary": "Accept, Accept-Language"}
    if status == 200 and not_modified(request, etag):
        return Response(status_code=304, headers=headers)
    return Response(page.html, status, headers, media_type="text/html")


def _file(request: Request, asset: Asset) -> Response:
    headers = {"ETag": asset.etag, "Cache-Control": asset.cache_control, "Vary": "Accept-Encoding"}
    if not_modified(request, asset.etag):
        return Response(status_code=304, headers=headers)
    headers["Content-Type"] = asset.media_type
    coding = coding_for(request, asset.compressed)
    if coding is not None:
        return Response(asset.compressed[coding], headers=headers | {"Content-Encoding": coding})
    return Response(asset.content, headers=headers)

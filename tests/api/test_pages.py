"""The page, its files, and what a browser is told about them."""

from __future__ import annotations

import base64
import gzip
import hashlib
import json
import re
from collections.abc import AsyncIterator
from pathlib import Path

import brotli
import httpx
import pytest

from deltaq.api.app import create_app
from deltaq.api.service import PACKAGE, make_assets, static_root
from deltaq.settings import Settings

pytestmark = pytest.mark.anyio

FRAME = "<!doctype html>\n<html>\n  <head>\n  </head>\n</html>\n"
SITE = {
    "icon": "/icon.svg",
    "font": "/vendor/katex/fonts/a.woff2",
    "styles": ["/styles/page.css"],
    "imports": {"lit-html": "/vendor/lit-html/lit-html.js", "styles/embed.css": "/styles/embed.css"},
    "pages": {
        page: {"description": page, "styles": [], "scripts": [], "modules": [f"/{page}.js"]}
        for page in ("index", "scene", "proof", "trial")
    },
}


@pytest.fixture
def site(tmp_path: Path) -> Path:
    """A small front end, with files beside it that nobody may get."""
    files = {
        "view/frame.html": FRAME,
        "pages.json": json.dumps(SITE),
        "view/drawing.js": "// drawing",
        "view/page.js": 'import { html } from "lit-html";\nimport { draw } from "./drawing.js";',
        "app.js": "export const δq = 1;\n" * 100,
        "icon.svg": "<svg/>",
        "styles/homework.css": '@import "homework/tasks.css";\n',
        "styles/homework/tasks.css": ".tasks {}\n",
        "assets/scene-1.js": "export const δq = 1;\n" * 100,
        "assets/scene-1.js.map": "{}",
        "assets/a-1.woff2": "font",
        "bundle/x.js": "secret",
        "tools/x.js": "secret",
        "package.json": "{}",
        ".npmrc": "secret",
        "node_modules/x/index.js": "secret",
        "tests/x.js": "secret",
        "vendor/lit-html/lit-html.js": "// lit",
        "vendor/katex/fonts/a.woff2": "font",
        "vendor/katex/LICENSE": "MIT",
    }
    root = tmp_path / "site"
    for name, content in files.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(content, encoding="utf-8")
    content = files["assets/scene-1.js"].encode()
    (root / "assets/scene-1.js.br").write_bytes(brotli.compress(content))
    (root / "assets/scene-1.js.gz").write_bytes(gzip.compress(content))
    (tmp_path / "secret.js").write_text("secret", encoding="utf-8")
    (root / "link.js").symlink_to(tmp_path / "secret.js")
    return root


@pytest.fixture
async def browser(site: Path) -> AsyncIterator[httpx.AsyncClient]:
    app = create_app(Settings(workers=1, static=str(site)))
    transport = httpx.ASGITransport(app=app)
    async with httpx.AsyncClient(transport=transport, base_url="http://deltaq.test") as client:
        yield client


async def test_page_names_its_module_and_the_version_of_the_api(browser: httpx.AsyncClient) -> None:
    page = await browser.get("/")
    assert page.headers["content-type"] == "text/html; charset=utf-8"
    assert '<script type="module" src="/index.js"></script>' in page.text
    version = (await browser.get("/api/v1/version")).json()["source"]
    assert f'<meta name="source" content="{version}">' in page.text


async def test_a_page_has_its_name_as_address(browser: httpx.AsyncClient) -> None:
    page = await browser.get("/proof")
    assert page.headers["content-type"] == "text/html; charset=utf-8"
    assert 'src="/proof.js"' in page.text
    assert page.headers["content-security-policy"] == (await browser.get("/")).headers["content-security-policy"]
    assert (await browser.get("/proof", headers={"If-None-Match": page.headers["etag"]})).status_code == 304
    assert (await browser.get("/Proof")).status_code == 404


@pytest.mark.parametrize(
    ("old", "new"),
    [
        pytest.param("/?scene=pendulum", "/scene?scene=pendulum", id="a scene"),
        pytest.param("/?lang=de&scene=own&step=a:b,c", "/scene?lang=de&scene=own&step=a:b,c", id="all of the query"),
        pytest.param("/?scene=%3Cb%3E%0d%0aX:1", "/scene?scene=%3Cb%3E%0d%0aX:1", id="as it was written"),
    ],
)
async def test_an_old_address_of_a_scene_leads_to_it(browser: httpx.AsyncClient, old: str, new: str) -> None:
    answer = await browser.get(old)
    assert (answer.status_code, answer.headers["location"]) == (308, new)


async def test_the_start_page_keeps_its_language(browser: httpx.AsyncClient) -> None:
    assert (await browser.get("/?lang=de")).status_code == 200


async def test_policy_allows_the_import_map_and_no_other_inline_script(browser: httpx.AsyncClient) -> None:
    page = await browser.get("/")
    inline = re.findall(r"<script type=\"importmap\">(.*?)</script>", page.text)
    digest = base64.b64encode(hashlib.sha256(inline[0].encode()).digest()).decode()
    assert page.headers["content-security-policy"] == (
        f"default-src 'self'; script-src 'self' 'sha256-{digest}'; style-src 'self' 'unsafe-inline'; "
        "img-src 'self' data: blob:; font-src 'self' data:; worker-src 'self' blob:; object-src 'none'; "
        "base-uri 'none'; form-action 'self'; frame-ancestors 'self'"
    )


@pytest.mark.parametrize(("path", "script"), [("/embed", "/scene.js"), ("/embed/proof", "/proof.js")])
async def test_a_frame_shows_a_page_where_its_policy_allows(site: Path, path: str, script: str) -> None:
    app = create_app(Settings(workers=1, static=str(site), frame_ancestors=("https://course.test",)))
    transport = httpx.ASGITransport(app=app)
    async with httpx.AsyncClient(transport=transport, base_url="http://deltaq.test") as client:
        page = await client.get(path)
        assert (await client.get("/embed/variations")).status_code == 404
    assert f'src="{script}"' in page.text
    assert '<link rel="stylesheet" href="/styles/embed.css">' in page.text
    assert page.headers["content-security-policy"].endswith("frame-ancestors 'self' https://course.test")


@pytest.mark.parametrize("path", ["/", "/app.js", "/icon.svg", "/api/v1/scenes", "/nothing", "/docs/try"])
async def test_types_are_not_guessed(browser: httpx.AsyncClient, path: str) -> None:
    headers = (await browser.get(path)).headers
    assert headers["x-content-type-options"] == "nosniff"


@pytest.mark.parametrize("path", ["/", "/docs/try", "/icon.svg"])
async def test_documents_have_a_policy(browser: httpx.AsyncClient, path: str) -> None:
    headers = (await browser.get(path)).headers
    assert headers["cross-origin-opener-policy"] == "same-origin"
    assert headers["referrer-policy"] == "same-origin"
    assert headers["content-security-policy"].startswith("default-src 'self'; script-src 'self'")
    assert "unsafe-eval" not in headers["content-security-policy"]


@pytest.mark.parametrize(
    ("path", "media_type", "lasting"),
    [
        pytest.param("/app.js", "text/javascript; charset=utf-8", False, id="module"),
        pytest.param("/view/drawing.js", "text/javascript; charset=utf-8", False, id="in a folder"),
        pytest.param("/icon.svg", "image/svg+xml", False, id="picture"),
        pytest.param("/vendor/lit-html/lit-html.js", "text/javascript; charset=utf-8", False, id="library"),
        pytest.param("/vendor/katex/fonts/a.woff2", "font/woff2", False, id="font"),
        pytest.param("/vendor/katex/LICENSE", "text/plain; charset=utf-8", False, id="licence"),
        pytest.param("/assets/scene-1.js", "text/javascript; charset=utf-8", True, id="bundle"),
        pytest.param("/assets/scene-1.js.map", "application/json", True, id="source map"),
        pytest.param("/assets/a-1.woff2", "font/woff2", True, id="font of the bundle"),
    ],
)
async def test_file(browser: httpx.AsyncClient, path: str, media_type: str, lasting: bool) -> None:
    response = await browser.get(path)
    assert response.status_code == 200
    assert response.headers["content-type"] == media_type
    wanted = "public, max-age=31536000, immutable" if lasting else "no-cache"
    assert response.headers["cache-control"] == wanted
    again = await browser.get(path, headers={"If-None-Match": response.headers["etag"]})
    assert (again.status_code, again.content) == (304, b"")


@pytest.mark.one_in(3)
@pytest.mark.parametrize(
    "path",
    [
        "/package.json",
        "/.npmrc",
        "/node_modules/x/index.js",
        "/tests/x.js",
        "/view",
        "/view/",
        "/nothing.js",
        "/link.js",
        "/../secret.js",
        "/..%2fsecret.js",
        "/view/%2e%2e/%2e%2e/secret.js",
        "/view/..%5c..%5csecret.js",
        "//etc/passwd",
        "/%00",
        "/app.js%00.js",
        "/" + "x" * 5000 + ".js",
        "/assets/scene-2.js",
        "/assets/scene-1.js.br",
        "/bundle/x.js",
        "/tools/x.js",
        "/vendor/../../../secret.js",
    ],
)
async def test_file_that_nobody_may_get(browser: httpx.AsyncClient, path: str) -> None:
    request = browser.build_request("GET", "/")
    request.url = request.url.copy_with(raw_path=path.encode())  # as it is, unlike what a client library makes of it
    response = await browser.send(request)
    assert response.status_code == 404
    assert "secret" not in response.text


CODINGS = [
    pytest.param("gzip, deflate, br, zstd", "br", id="browser"),
    pytest.param("gzip", "gzip", id="no brotli"),
    pytest.param("br;q=0, gzip;q=0.5", "gzip", id="brotli unwanted"),
    pytest.param("identity", None, id="none"),
]


@pytest.mark.parametrize(("accepted", "coding"), CODINGS)
async def test_bundle_is_compressed_as_the_client_takes_it(
    browser: httpx.AsyncClient, site: Path, accepted: str, coding: str | None
) -> None:
    async with browser.stream("GET", "/assets/scene-1.js", headers={"Accept-Encoding": accepted}) as response:
        raw = b"".join([part async for part in response.aiter_raw()])
    assert response.headers.get("content-encoding") == coding
    unpack = {"br": brotli.decompress, "gzip": gzip.decompress, None: bytes}[coding]
    assert unpack(raw) == (site / "assets/scene-1.js").read_bytes()
    assert set(response.headers["vary"].split(", ")) == {"Accept-Encoding"}


async def test_file_is_read_again_when_it_changes(browser: httpx.AsyncClient, site: Path) -> None:
    await browser.get("/app.js")
    (site / "app.js").write_text("changed", encoding="utf-8")
    assert (await browser.get("/app.js")).text == "changed"


async def test_sources_are_sent_as_they_stand(browser: httpx.AsyncClient, site: Path) -> None:
    text = "/** One.\n * @param {number} x */\nexport const one = (x) => x;\n"
    (site / "app.js").write_text(text, encoding="utf-8")
    assert (await browser.get("/app.js")).text == text
    assert (await browser.get("/styles/homework.css")).text == '@import "homework/tasks.css";\n'


@pytest.mark.parametrize(
    "path",
    [
        pytest.param("/styles/homework", id="folder"),
        pytest.param("/styles.css", id="folder with a suffix"),
        pytest.param("/styles/.css", id="no name"),
        pytest.param(f"/{'x' * 300}.css", id="name too long for the file system"),
    ],
)
async def test_no_such_sheet(browser: httpx.AsyncClient, path: str) -> None:
    assert (await browser.get(path)).status_code == 404


READ = ["scenes?summaries=false", "methods", "catalogs/de?sections=page", "scenes/pendulum?lang=en", "proofs?lang=en"]


@pytest.mark.parametrize("path", READ)
async def test_what_is_asked_of_this_version_may_be_kept(browser: httpx.AsyncClient, path: str) -> None:
    version = (await browser.get("/api/v1/version")).json()["source"]
    address = f"/api/v1/{path}{'&' if '?' in path else '?'}source="
    kept, other, plain = [await browser.get(one) for one in (address + version, f"{address}0123", f"/api/v1/{path}")]
    assert kept.status_code == 200
    assert kept.headers["cache-control"] == "public, max-age=31536000, immutable"
    assert {other.headers["cache-control"], plain.headers["cache-control"]} == {"no-cache"}
    assert kept.content == other.content == plain.content
    assert kept.headers["etag"] == plain.headers["etag"]


async def test_head(browser: httpx.AsyncClient) -> None:
    response = await browser.head("/app.js")
    assert (response.status_code, response.content) == (200, b"")


async def test_no_page_at_all(tmp_path: Path) -> None:
    app = create_app(Settings(workers=1, static=str(tmp_path)))
    transport = httpx.ASGITransport(app=app)
    async with httpx.AsyncClient(transport=transport, base_url="http://deltaq.test") as client:
        assert (await client.get("/")).status_code == 404


@pytest.mark.parametrize("path", ["/", "/docs", "/docs/try", "/embed", "/embed/proof"])
@pytest.mark.parametrize("bundled", [False, True], ids=["sources", "bundle"])
async def test_real_page_and_all_that_it_names(request: pytest.FixtureRequest, path: str, bundled: bool) -> None:
    app = create_app(Settings(workers=1, static=str(request.getfixturevalue("bundle")) if bundled else ""))
    transport = httpx.ASGITransport(app=app)
    async with httpx.AsyncClient(transport=transport, base_url="http://deltaq.test") as client:
        page = await client.get(path)
        assert page.status_code == 200
        named = re.findall(r'(?:src|href)="(/[^"]+)"|":"(/[^"]+[^/"])"', page.text)
        answers = {source: await client.get(source) for pair in named for source in pair if source}
    assert len(answers) > 8
    assert [source for source, answer in answers.items() if answer.status_code != 200] == []
    lasting = {answer.headers["cache-control"].endswith("immutable") for answer in answers.values()}
    assert lasting == {bundled}


async def test_static_root(root: Path, tmp_path: Path) -> None:
    assert static_root(str(tmp_path)) == tmp_path
    assert static_root("") in {root / "frontend", PACKAGE / "static"}


@pytest.mark.parametrize("bundled", [False, True], ids=["sources", "bundle"])
async def test_a_package_without_a_bundle_says_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture, bundled: bool
) -> None:
    (tmp_path / ("static/assets" if bundled else "static")).mkdir(parents=True)
    make_assets(Settings(static=str(tmp_path / "static")))  # while the package is elsewhere: a folder of one's own
    monkeypatch.setattr("deltaq.api.service.PACKAGE", tmp_path)
    make_assets(Settings())
    told = [] if bundled else ["the page is not bundled: this package was built without esbuild, and pages open slowly"]
    assert caplog.messages == told

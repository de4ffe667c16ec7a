"""What a page is put together from, in the sources and in the bundle."""

from __future__ import annotations

import json
import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest

from deltaq.api.assets import Assets, Document
from deltaq.api.page import FRAME, Page, Site

SITE = Site(
    icon="/icon.svg",
    font="/serif.woff2",
    styles=("/styles/page.css",),
    imports={"lib": "/vendor/lib.js", "styles/embed.css": "/assets/embed-1.css"},
    pages={"help": Page('"How" & why', ("/styles/help.css",), ("/katex.js",), ("/words.js", "/help.js"))},
)
MAPPED = '{"lib":"/vendor/lib.js","styles/embed.css":"/assets/embed-1.css"}'
FRAME_TEXT = "<html>\n  <head>\n    <title>δq</title>\n  </head>\n</html>\n"


def test_a_page_is_the_frame_with_what_it_needs() -> None:
    assert SITE.assembled(FRAME_TEXT, "help", ["styles/embed.css"], "0123").splitlines() == [
        "<html>",
        "  <head>",
        "    <title>δq</title>",
        '    <link rel="icon" href="/icon.svg" type="image/svg+xml">',
        '    <link rel="preload" href="/serif.woff2" as="font" type="font/woff2" crossorigin>',
        f'    <script type="importmap">{{"imports":{MAPPED}}}</script>',
        '    <meta name="source" content="0123">',
        '    <meta name="description" content="&quot;How&quot; &amp; why">',
        '    <link rel="stylesheet" href="/styles/page.css">',
        '    <link rel="stylesheet" href="/styles/help.css">',
        '    <link rel="stylesheet" href="/assets/embed-1.css">',
        '    <script src="/katex.js" defer fetchpriority="high"></script>',
        '    <link rel="modulepreload" href="/words.js">',
        '    <script type="module" src="/help.js"></script>',
        "  </head>",
        "</html>",
    ]


class Named(HTMLParser):
    """The addresses that a page's elements name, by what they are for."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.styles: list[str] = []
        self.modules: list[str] = []
        self.all: list[str] = []
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        address = given.get("src") or given.get("href")
        if address is None:
            return
        self.all.append(address)
        if given.get("rel") == "stylesheet":
            self.styles.append(address)
        if given.get("rel") == "modulepreload" or given.get("type") == "module":
            self.modules.append(address)


@pytest.fixture(scope="module", params=["sources", "bundle"])
def site(request: pytest.FixtureRequest, root: Path) -> Assets:
    return Assets(root / "frontend" if request.param == "sources" else request.getfixturevalue("bundle"))


PAGES = [
    *("docs", "handout", "help", "homework", "index", "labs", "lecture"),
    *("presenter", "problems", "proof", "scene", "trial", "variations"),
]


def page_of(site: Assets, name: str) -> Document:
    page = site.page(name)
    assert page is not None
    return page


def text_of(site: Assets, address: str) -> str:
    asset = site.find(address.lstrip("/"))
    assert asset is not None, address
    return asset.content.decode()


def maps_of(site: Assets, name: str) -> list[dict[str, Any]]:
    """The source maps of the modules that a page begins with."""
    found = [
        re.search(r"//# sourceMappingURL=(\S+)", text_of(site, one)) for one in Named(page_of(site, name).html).modules
    ]
    return [json.loads(text_of(site, f"assets/{one[1]}")) for one in found if one]


@pytest.mark.parametrize("name", PAGES)
def test_every_page_of_the_site_names_what_is_there(site: Assets, name: str) -> None:
    page = page_of(site, name)
    mapped = re.findall(r'":"(/[^"]+[^/])"', page.html)
    assert len(mapped) > 5
    missing = [one for one in (*Named(page.html).all, *mapped) if site.find(one.lstrip("/")) is None]
    assert missing == []


def test_the_pages_are_those_that_have_a_driver(root: Path) -> None:
    frontend = root / "frontend"
    beside = {"server", "globals.d"}
    assert {file.stem for file in frontend.glob("*.js")} - beside == set(PAGES)


def test_sheets_that_come_later_are_in_the_import_map(site: Assets, root: Path) -> None:
    files = [*(root / "frontend").glob("*.js"), *(root / "frontend/view").rglob("*.js")]
    wanted = {name for file in files for name in re.findall(r'\bsheet\("([a-z]+)"\)', file.read_text(encoding="utf-8"))}
    page = page_of(site, "scene")
    assert len(wanted) > 3
    assert [name for name in wanted if f'"styles/{name}.css":' not in page.html] == []


@pytest.mark.parametrize("name", PAGES)
def test_a_page_brings_what_typesets_if_it_typesets(name: str, bundle: Path) -> None:
    """Asked of the bundle, which names all modules that a page begins with."""
    page = Named(page_of(Assets(bundle), name).html)
    typesets = any("globalThis.katex" in text_of(Assets(bundle), address) for address in page.modules)
    assert any("katex.min" in address for address in page.all) == typesets


@pytest.mark.parametrize("name", PAGES)
def test_a_bundled_page_begins_with_few_files_that_may_be_kept(name: str, bundle: Path) -> None:
    page = Named(page_of(Assets(bundle), name).html)
    assert (len(page.modules) <= 3, len(page.styles)) == (True, 2)
    assert all(address.startswith("/assets/") for address in page.all)


LATER = {
    "scene": ["rows", "overlays", "editor/open", "lecture/open", "figure/open", "share", "summary", "embed"],
    "proof": ["rows", "lecture/open", "share", "embed"],
    "homework": ["rows", "homework/open-classroom", "homework/open-picker"],
}


@pytest.mark.parametrize("name", LATER)
def test_what_is_fetched_later_is_not_part_of_what_a_page_begins_with(bundle: Path, name: str) -> None:
    begun = {file for one in maps_of(Assets(bundle), name) for file in one["sources"]}
    later = {f"../../view/{part}.js" for part in LATER[name]}
    everything = {file for one in (bundle / "assets").glob("*.map") for file in json.loads(one.read_bytes())["sources"]}
    assert f"../../{name}.js" in begun
    assert later <= everything
    assert later & begun == set()


def test_all_that_modules_and_sheets_name_is_in_the_bundle(bundle: Path) -> None:
    assets = bundle / "assets"
    named = {
        name
        for file in assets.iterdir()
        if file.suffix in {".js", ".css"} and ".min-" not in file.name
        for name in re.findall(r'(?:from|import|import\()"\./([^"]+)"', file.read_text(encoding="utf-8"))
    }
    assert len(named) > 20
    assert [name for name in named if not (assets / name).is_file()] == []


def test_a_bundle_asks_no_other_origin(bundle: Path) -> None:
    own = [
        file for file in (bundle / "assets").iterdir() if file.suffix in {".js", ".css"} and ".min-" not in file.name
    ]
    asked = r'(?:from|import|import\(|url\(|fetch\()"?(?:https?:)?//[^"/]'
    assert [file.name for file in own if re.search(asked, file.read_text(encoding="utf-8"))] == []


def test_sources_can_be_seen_from_the_bundle(bundle: Path, root: Path) -> None:
    maps = maps_of(Assets(bundle), "scene")
    sources = {
        f"frontend{name.removeprefix('../..')}": text
        for one in maps
        for name, text in zip(one["sources"], one["sourcesContent"], strict=True)
    }
    assert "frontend/scene.js" in sources
    assert len(sources) > 50
    assert [name for name, text in sources.items() if (root / name).read_text(encoding="utf-8") != text] == []


@pytest.mark.parametrize("gone", ["view/page.js", "styles/page.css", "vendor/lit-html/lit-html.js"])
def test_a_page_comes_without_what_is_not_there(root: Path, tmp_path: Path, gone: str) -> None:
    for name in ("pages.json", FRAME):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_bytes((root / "frontend" / name).read_bytes())
    assert page_of(Assets(tmp_path), "scene") == page_of(Assets(root / "frontend"), "scene")
    assert Assets(tmp_path).find(gone) is None


@pytest.mark.parametrize("name", ["", "Scene", "../scene", "no-such-page", "__proto__"])
def test_no_such_page(site: Assets, name: str) -> None:
    assert site.page(name) is None

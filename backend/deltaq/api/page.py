"""A page as it is sent: the frame of all pages, with the addresses of what it needs in its head.

`pages.json` tells these addresses. That of the sources names them as they stand; the one that the bundler writes has
the same form, and names bundles and all modules that a page begins with, so that none waits for another.
"""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from html import escape
from pathlib import Path

FRAME = "view/frame.html"
SITE = "pages.json"
# What the frame says of itself, where a page comes with content of its own.
_LANGUAGE, _TITLE, _NOTICE = '<html lang="en">', "<title>δq</title>", "<noscript>δq needs JavaScript.</noscript>"


@dataclass(frozen=True)
class Page:
    """What one page has beyond the others, by address; the last of its modules leads to all others."""

    description: str
    styles: tuple[str, ...]
    scripts: tuple[str, ...]
    modules: tuple[str, ...]


@dataclass(frozen=True)
class Content:
    """What a page says before any script has run: its language, its title, and the HTML of its main part."""

    language: str
    title: str
    main: str

    def inside(self, frame: str) -> str:
        """The frame with this content."""
        frame = frame.replace(_LANGUAGE, f'<html lang="{self.language}">')
        frame = frame.replace(_TITLE, f"<title>δq · {escape(self.title)}</title>")
        return frame.replace(_NOTICE, self.main)


@dataclass(frozen=True)
class Site:
    """All pages, what they have in common, and the addresses by the names that modules use for them."""

    icon: str
    font: str
    styles: tuple[str, ...]
    imports: Mapping[str, str]
    pages: Mapping[str, Page]

    @property
    def import_map(self) -> str:
        """The one inline script of every page."""
        return json.dumps({"imports": dict(self.imports)}, separators=(",", ":"))

    @property
    def import_map_hash(self) -> str:
        """What script-src must allow for the import map."""
        return "sha256-" + base64.b64encode(hashlib.sha256(self.import_map.encode()).digest()).decode()

    def assembled(self, frame: str, name: str, sheets: Iterable[str] = (), source: str = "") -> str:
        """The page of a name, told the version of what it asks for; `sheets` of the import map come last."""
        page = self.pages[name]
        styles = (*self.styles, *page.styles, *(self.imports[sheet] for sheet in sheets))
        head = "".join(f"    {line}\n" for line in (*self._common(), *_version(source), *_own(page, styles)))
        return frame.replace("  </head>", f"{head}  </head>")

    def _common(self) -> Iterator[str]:
        yield f'<link rel="icon" href="{self.icon}" type="image/svg+xml">'
        yield f'<link rel="preload" href="{self.font}" as="font" type="font/woff2" crossorigin>'
        yield f'<script type="importmap">{self.import_map}</script>'


def read_site(root: Path) -> Site | None:
    """The site below a folder; None if there is none."""
    file = root / SITE
    if not file.is_file():
        return None
    document = json.loads(file.read_text(encoding="utf-8"))
    pages = {name: _page(page) for name, page in document["pages"].items()}
    return Site(document["icon"], document["font"], tuple(document["styles"]), document["imports"], pages)


def _page(document: Mapping[str, object]) -> Page:
    lists = (document[name] for name in ("styles", "scripts", "modules"))
    styles, scripts, modules = (tuple(map(str, one)) for one in lists if isinstance(one, list))
    return Page(str(document["description"]), styles, scripts, modules)


def _version(source: str) -> Iterator[str]:
    if source:
        yield f'<meta name="source" content="{escape(source)}">'


def _own(page: Page, styles: Iterable[str]) -> Iterator[str]:
    *begun, last = page.modules
    yield f'<meta name="description" content="{escape(page.description)}">'
    yield from (f'<link rel="stylesheet" href="{address}">' for address in styles)
    yield from (f'<script src="{address}" defer fetchpriority="high"></script>' for address in page.scripts)
    yield from (f'<link rel="modulepreload" href="{address}">' for address in begun)
    yield f'<script type="module" src="{last}"></script>'

"""What a reader sees at an address where there is nothing: that it is so, which was meant, and where all pages are."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from difflib import get_close_matches
from html import escape
from typing import cast

from ..narration.catalog import catalog, text
from ..vocabulary import Language
from .page import Content

LONGEST = 64  # characters of an address that are said again
HOME = "start"
# The pages that have a name in the menu, in its order.
NAMED = ("scene", "variations", "proof", "labs", "homework", "lecture", "docs", "help")


def lost_page(path: str, pages: Collection[str], language: Language) -> Content:
    """The content of the page for `path`, below /, where the site has these pages; its status is 404."""
    known = [name for name in NAMED if name in pages]
    near = get_close_matches(path.strip("/").lower()[:LONGEST], known, n=1)
    title = text(language, "errors.lost-page.title")
    lead = escape(text(language, "errors.lost-page.lead", path=f"/{path[:LONGEST]}"))
    meant = f"<p>{escape(text(language, 'errors.lost-page.meant'))} {_link(near[0], language)}</p>\n" if near else ""
    every = "\n".join(f"<li>{_link(name, language)}</li>" for name in (HOME, *known))
    return Content(
        language,
        title,
        f'<main class="reference problem" id="problem" tabindex="-1">\n<article class="calls">\n'
        f"<h1>{escape(title)}</h1>\n<p>{lead}</p>\n{meant}</article>\n<nav><ul>\n{every}\n</ul></nav>\n</main>",
    )


def _link(name: str, language: Language) -> str:
    address, words = "" if name == HOME else name, cast("Mapping[str, str]", catalog(language)["page"])
    return f'<a href="/{address}?lang={language}">{escape(words[f"place.{name}"])}</a>'

"""Readers that say what of a text is live: commands of TeX, structure of Markdown and HTML, blocks of CASText.

Each is written after the rules of the program it stands for, and knows nothing of how δq makes its texts inert.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from functools import cache
from html.parser import HTMLParser

from markdown_it import MarkdownIt

# Commands that print one sign each: what a word may become in LaTeX.
SIGNS = frozenset({"textbackslash", "textasciitilde", "textasciicircum", "textquotedbl", *"&%$#_{}", ","})


HIDDEN = re.compile(r"\^\^(?:([0-9a-f]{2})|([\x00-\x7f]))")
TOKEN = re.compile(
    r"(?P<command>\\(?:[A-Za-z]+|[\s\S]|$))|(?P<comment>%[^\n]*)|(?P<begin>\{)|(?P<end>\})|(?P<math>\$)|(?P<parameter>#)"
    r"|(?P<active>[~\"])"
)


def tex_tokens(source: str) -> Iterator[tuple[str, str]]:
    """Tokens that are no letters, as TeX makes them with its usual category codes; ^^5c is a backslash to it.

    Source: Knuth, The TeXbook, chapters 7 and 8.
    """
    while hidden := HIDDEN.search(source):
        sign = chr(int(hidden[1], 16)) if hidden[1] else chr((ord(hidden[2]) + 64) % 128)
        source = source[: hidden.start()] + sign + source[hidden.end() :]
        yield "hidden", sign
    for token in TOKEN.finditer(source):
        yield str(token.lastgroup), token[0]


@cache
def tex_live(source: str) -> Counter[tuple[str, str]]:
    """Whatever TeX would do for the text, but for printing one sign; braces that do not match are told, too."""
    found: Counter[tuple[str, str]] = Counter()
    depth, letters = 0, 0
    for kind, value in tex_tokens(source):
        depth += {"begin": 1, "end": -1}.get(kind, 0)
        letters += kind == "math"
        if depth < 0:
            found["unmatched", "}"] += 1
        if kind not in ("begin", "end", "math") and not (kind == "command" and value[1:] in SIGNS):
            found[kind, value] += 1
    if depth or letters % 2:
        found["unmatched", f"{depth} {letters % 2}"] += 1
    return found


JUPYTER = re.compile(r"\$\$?|\\(?:begin|end)\{[a-z]*\*?\}|\\\\[()\[\]]", re.IGNORECASE)
ADDRESS = re.compile(r"(?<![\\])(?:https?|ftp)://|(?<![\\\w])www\.|[\w.+-]+@[\w-]+\.\w", re.IGNORECASE)
READER = MarkdownIt("commonmark").enable(["table", "strikethrough"])


def markdown_live(source: str) -> list[str]:
    """Blocks and spans by kind in their order, marks of mathematics, and addresses that viewers would make links.

    What stands between the marks of formulas is mathematics, which the reader of TeX looks at.
    """
    words = re.sub(r"\$\$\n.*?\n\$\$|\$[^$\n]*\$", "×", source)
    spans = [token for block in READER.parse(words) for token in (block, *(block.children or ()))]
    kinds = [f"{token.type} {token.tag}" for token in spans if token.type not in ("text", "softbreak", "text_special")]
    return [*kinds, *JUPYTER.findall(source), *JUPYTER.findall(words), *ADDRESS.findall(words)]


class _Tags(HTMLParser):
    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.found: list[str] = []
        self.shown: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found.append(f"<{tag} {sorted(name for name, _ in attrs)}>")

    def handle_endtag(self, tag: str) -> None:
        self.found.append(f"</{tag}>")

    def handle_comment(self, data: str) -> None:
        self.found.append("<!--")

    def handle_decl(self, decl: str) -> None:
        self.found.append("<!")

    def handle_pi(self, data: str) -> None:
        self.found.append("<?")

    def handle_data(self, data: str) -> None:
        self.shown.append(data)


def html_live(source: str) -> list[str]:
    """The tags with the names of their attributes, in their order."""
    reader = _Tags()
    reader.feed(source)
    reader.close()
    return reader.found


CASTEXT = re.compile(r"\[\[|\]\]|\{@|@\}|\{#|#\}|<!--|\{[A-Z]+:|\{mlang|\[\w+[ \]]")
MATHJAX = re.compile(r"\\[()\[\]]|\$\$|\\begin\{")


def castext_live(source: str) -> list[str]:
    """Blocks and values of CASText and of filters in the source; tags; mathematics that is sought in the finished page.

    Source: STACK documentation, "CASText"; MathJax documentation, "TeX and LaTeX input", delimiters.
    """
    reader = _Tags()
    reader.feed(source)
    reader.close()
    return [*CASTEXT.findall(source), *reader.found, *MATHJAX.findall("".join(reader.shown))]

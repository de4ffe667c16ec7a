"""What a page is put together from."""

from __future__ import annotations

from pathlib import Path

import pytest

from deltaq.api.assets import Assets
from deltaq.api.page import FRAME, assembled, imported, names
from deltaq.api.service import static_root

NAMED = (("lib", "/vendor/lib/lib.js"), ("lib/", "/vendor/lib/"))
SITE = static_root("")
PAGES = sorted(file.stem for file in SITE.glob("*.html"))


@pytest.mark.parametrize(
    ("files", "found"),
    [
        pytest.param({"a.js": 'import { b } from "./b.js";', "b.js": ""}, {"/b.js"}, id="beside it"),
        pytest.param(
            {"a.js": 'import { b } from "./v/b.js";', "v/b.js": 'export { c } from "../m/c.js";', "m/c.js": ""},
            {"/v/b.js", "/m/c.js"},
            id="what the imported imports, and passes on",
        ),
        pytest.param(
            {"a.js": 'import {\n  b,\n  c,\n} from "./b.js";', "b.js": ""}, {"/b.js"}, id="over several lines"
        ),
        pytest.param(
            {"a.js": 'import l from "lib";', "vendor/lib/lib.js": 'x;import{y}from"./y.js";', "vendor/lib/y.js": ""},
            {"/vendor/lib/lib.js", "/vendor/lib/y.js"},
            id="by name, and without blanks",
        ),
        pytest.param(
            {"a.js": 'import l from "lib/y.js";', "vendor/lib/y.js": ""}, {"/vendor/lib/y.js"}, id="by folder"
        ),
        pytest.param(
            {"a.js": 'import b from "./b.js";', "b.js": 'import a from "./a.js";'}, {"/a.js", "/b.js"}, id="in a circle"
        ),
        pytest.param({"a.js": 'const later = () => import("./b.js");'}, set(), id="not what is fetched later"),
        pytest.param({"a.js": '/** @typedef {import("./b.js").B} B */\n// from "./c.js"'}, set(), id="not types"),
    ],
)
def test_modules_that_one_leads_to(tmp_path: Path, files: dict[str, str], found: set[str]) -> None:
    for name, content in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(content, encoding="utf-8")
    assert imported(tmp_path, "/a.js", NAMED) == found


@pytest.mark.parametrize(
    ("name", "address"),
    [
        pytest.param("./gone.js", "/gone.js", id="beside it"),
        pytest.param("lib/gone.js", "/vendor/lib/gone.js", id="in a library"),
        pytest.param("nobody/gone.js", "nobody/gone.js", id="by a name that the import map lacks"),
    ],
)
def test_a_page_comes_without_what_is_not_there(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, name: str, address: str
) -> None:
    (tmp_path / "a.js").write_text(f'import {{ b }} from "./b.js";\nimport {{ g }} from "{name}";\n', encoding="utf-8")
    (tmp_path / "b.js").write_text("", encoding="utf-8")
    assert imported(tmp_path, "/a.js", NAMED) == {"/b.js"}
    assert caplog.messages == [f"the page imports {address}, which is not there"]


def test_a_page_is_the_frame_with_its_own_lines_and_modules(tmp_path: Path) -> None:
    (tmp_path / "view").mkdir()
    (tmp_path / FRAME).write_text("<html>\n  <head>\n    <title>δq</title>\n  </head>\n</html>\n", encoding="utf-8")
    (tmp_path / "help.html").write_text('<link rel="stylesheet" href="/styles/help.css">\n', encoding="utf-8")
    (tmp_path / "help.js").write_text('import { t } from "./view/words.js";\n', encoding="utf-8")
    (tmp_path / "view/words.js").write_text("export const t = 1;\n", encoding="utf-8")
    assert assembled(tmp_path, "help").splitlines() == [
        "<html>",
        "  <head>",
        "    <title>δq</title>",
        '    <link rel="stylesheet" href="/styles/help.css">',
        '    <link rel="modulepreload" href="/view/words.js">',
        '    <script type="module" src="/help.js"></script>',
        "  </head>",
        "</html>",
    ]


@pytest.mark.parametrize("page", PAGES)
def test_every_page_of_the_site(page: str, caplog: pytest.LogCaptureFixture) -> None:
    modules = imported(SITE, f"/{page}.js", names((SITE / FRAME).read_text(encoding="utf-8")))
    assert caplog.messages == []  # else it imports what is not there
    assert [address for address in modules if Assets(SITE).find(address.lstrip("/")) is None] == []
    typesets = any(
        "globalThis.katex" in (SITE / address.lstrip("/")).read_text(encoding="utf-8") for address in modules
    )
    assert ("katex.min.js" in (SITE / f"{page}.html").read_text(encoding="utf-8")) == typesets


def test_there_are_pages() -> None:
    assert {"index", "scene", "homework", "labs", "proof", "variations", "docs", "help"} <= set(PAGES)

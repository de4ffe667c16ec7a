"""One's own scene is on the page as the service understands it, also where it leaves something to be understood."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Iterator
from pathlib import Path
from random import Random
from typing import Any

from tests.frontend.node import run

import deltaq.scenes
from deltaq.language.spelling import latex_of
from deltaq.mechanics.document import read_scene
from deltaq.mechanics.writing import write_scene

Document = dict[str, Any]
FILES = sorted(Path(deltaq.scenes.__path__[0]).glob("*.toml"))
LEFT_OUT = {
    "coordinates": ("unit", "value", "rate", "latex"),
    "parameters": ("unit", "value", "latex"),
    "loads": ("name",),
}
PLANE = 2
RANGE = ("min", "max")  # of which the usual value knows nothing
NAMES = [
    *("abc", "q", "x1", "q_max", "phi", "phi_1", "epsilon", "omega0", "Omega_12", "Gamma_x"),
    *("varphi", "ell", "alpha_beta", "m_rod", "l_0_1", "xx", "muon", "theta_dot"),
]


def documents() -> Iterator[Document]:
    """Every library scene as it is written, and with some of what may be left out left out."""
    for file in FILES:
        for round_ in range(3):
            yield thinned(tomllib.loads(file.read_text(encoding="utf-8")), Random(f"{file.stem} {round_}"), round_ / 2)


def thinned(document: Document, random: Random, part: float) -> Document:
    """Without drawing and labels, which name loads; of what else may be left out, each is with this chance."""
    for member in ("drawing", "labels", "events"):
        document.pop(member, None)
    for section, members in LEFT_OUT.items():
        for row in document.get(section, []):
            for member in (*members, *RANGE):
                if member in RANGE or random.random() < part:
                    row.pop(member, None)
    if document.get("dimension") == PLANE and random.random() < part:
        del document["dimension"]
    for member in ("summary", "title"):
        if random.random() < part:
            document[member] = "A plain text"
    return document


def shown(scene: Document) -> Document:
    """What the page shows of a scene as it is written."""
    symbols = {
        section: [{**row, "latex": row["latex"] or latex_of(row["name"])} for row in scene[section]]
        for section in ("coordinates", "parameters")
    }
    of_symbols = ("name", "latex", "unit", "value", "rate")
    rows = {section: [{key: row.get(key) for key in of_symbols} for row in all_] for section, all_ in symbols.items()}
    named = {
        section: [(row["name"], row.get("kind")) for row in scene[section]] for section in ("points", "bodies", "loads")
    }
    return {key: scene[key] for key in ("title", "summary", "dimension", "guides")} | rows | named


def on_the_page(root: Path, asked: object) -> Any:
    done = run("node", "tests/frontend/own.js", cwd=root, sent=json.dumps(asked))
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_what_a_document_leaves_out_is_the_same_on_the_page_as_in_the_service(root: Path) -> None:
    given = [*documents()]
    found = on_the_page(root, {"documents": given, "names": []})["documents"]
    wanted = [json.loads(json.dumps(write_scene(read_scene(one)))) for one in given]
    assert len(given) == 3 * len(FILES) > 90
    for document, page, service in zip(given, found, wanted, strict=True):
        assert shown(page) == shown(service), document


def test_names_are_typeset_as_the_service_typesets_them(root: Path) -> None:
    assert dict(zip(NAMES, on_the_page(root, {"documents": [], "names": NAMES})["names"], strict=True)) == {
        name: latex_of(name) for name in NAMES
    }

"""Loads and bodies without a name are called by the word for their kind, in either language."""

from __future__ import annotations

from dataclasses import replace

import pytest

from deltaq.mechanics.library import load_scene
from deltaq.narration.catalog import LANGUAGES, catalog
from deltaq.narration.things import called
from deltaq.packages import classes_of

SCENE = replace(load_scene("pendulum"), labels={"bob": {"de": "Masse"}})


@pytest.mark.parametrize(
    ("name", "language", "word"),
    [
        pytest.param("gravity", "de", "Gewicht", id="a kind"),
        pytest.param("gravity", "en", "weight", id="a kind in English"),
        pytest.param("spring-2", "de", "Feder 2", id="one of several loads"),
        pytest.param("particle2", "de", "Massenpunkt 2", id="one of several bodies"),
        pytest.param("bob", "de", "Masse", id="a label"),
        pytest.param("bob", "en", "bob", id="a label in the other language only"),
        pytest.param("spring-left", "de", "spring-left", id="a name that begins like a kind"),
    ],
)
def test_what_has_no_label_is_called_by_its_kind(name: str, language: str, word: str) -> None:
    assert called(SCENE, name, language) == word


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_kind_has_a_word(language: str) -> None:
    kinds = [*classes_of("deltaq.mechanics.loads", "kind"), *classes_of("deltaq.mechanics.bodies", "kind")]
    words = catalog(language)["page"]
    assert isinstance(words, dict)
    assert [kind for kind in kinds if f"kinds.{kind}" not in words] == []

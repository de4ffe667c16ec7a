"""The catalogs: the same keys in every language, and a text for everything the code can say."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from importlib.resources import files
from itertools import chain, product
from pathlib import Path
from string import Formatter

import pytest
from tests.derived import derived

from deltaq.derivation.abstract_motion import sample
from deltaq.derivation.proof import CHAPTERS
from deltaq.errors import Problem
from deltaq.mechanics.library import scene_ids
from deltaq.narration.catalog import LANGUAGES, catalog, filled, language_of, message, template, text
from deltaq.packages import modules_of

SOURCE = Path(str(files("deltaq")))
CODE = re.compile(r'(?:Problem|complain|\.refuse|_refuse)\(\s*"([a-z-]+)"')


def leaves(node: Mapping[str, object], path: str = "") -> Iterator[tuple[str, str]]:
    for key, value in node.items():
        if isinstance(value, Mapping):
            yield from leaves(value, f"{path}{key}.")
        else:
            yield f"{path}{key}", str(value)


def texts(language: str) -> dict[str, str]:
    return dict(leaves(catalog(language)))


def test_every_language_says_the_same() -> None:
    english, german = texts("en"), texts("de")
    assert english.keys() == german.keys()
    for key, sentence in english.items():
        assert fields(sentence) == fields(german[key]), f"{key} has other placeholders in German"
        assert bool(sentence.strip()) is bool(german[key].strip()), f"{key} is empty in one language only"
        assert sentence.strip() or key.endswith(".remedy"), f"{key} is empty"


# What is German, or was never said, in English sentences on mechanics.
FALSE_FRIENDS = {
    "differentiate by, for: with respect to": (
        r"\b(derivatives?|differentiat\w+)\b[^.:;]{0,60}?"
        r"\bby (\{|\$|“|time\b|each\b|one\b|the (rate|coord))"
    ),
    "the proof, for: check": r"\bThe proof:",
    "inner, for: internal": r"\binner (virtual )?(work|force)",
    "belongs, for: has": r"\bTo (each|\{\w+\}|every)[^.]* belongs?\b",
    "linear, for: affine": r"\bvelocity[^.]{0,30} is linear in the",
    "has no potential at all": r"depends on rates: it has no potential\.",
}


@pytest.mark.parametrize("friend", FALSE_FRIENDS)
def test_english_sentences_are_english(friend: str) -> None:
    found = {key for key, sentence in texts("en").items() if re.search(FALSE_FRIENDS[friend], sentence)}
    assert found == set()


# A sentence that begins with the pronoun of a noun told elsewhere, in a heading say, which not every place shows. The
# polite Sie has verbs in the plural.
NOUN_ELSEWHERE = {"de": r"(Er|Ihn|Ihm|Sie (?!sind\b)\w+(?<!en)) ", "en": r"(They|He|She|It (was|must|stays|bears)) "}
TOLD_ALONE = ("errors.", "labs.", "status.", "homework.", "lectures.", "rules.steps.jacobi-energy.")


@pytest.mark.parametrize("language", LANGUAGES)
def test_no_sentence_begins_with_a_pronoun_whose_noun_stands_elsewhere(language: str) -> None:
    alone = {
        key: sentence for key, sentence in texts(language).items() if language == "de" or key.startswith(TOLD_ALONE)
    }
    assert {key for key, sentence in alone.items() if re.match(NOUN_ELSEWHERE[language], sentence)} == set()


# Of these there are never one: why.
NEVER_ONE = {
    "errors.answers-many": "beyond a bound",
    "errors.handins-many": "beyond a bound",
    "errors.answer-not-vector": "components of a vector",
    "labs.stability.caption": "eigenvalues come in pairs",
    "labs.stability-map.caption": "points of a map",
    "labs.chaos.map-caption": "motions of a map",
    "labs.bifurcation.by-period": "values of a sweep",
    "labs.bifurcation.by-plane": "values of a sweep",
    "labs.basins.starts": "starts of a map",
    "page.status.coarse": "samples of a motion",
    "start.start.scenes-lead": "built-in scenes",
}


def test_one_is_not_told_as_several() -> None:
    """`1 orbits lose their digits`: what {count} counts has a sentence for one, in every language."""
    plural = re.compile(r"(?<!of )\{count\} (?:[a-z]+ )?[a-z]{2,}s\b(?<!is)(?<!was)")
    counted = {key for key, sentence in texts("en").items() if plural.search(sentence)} - NEVER_ONE.keys()
    assert len(counted) > 15
    assert [key for key in counted if f"{key}-one" not in texts("en")] == []
    for key, language in product((one for one in counted if one.startswith("labs.")), LANGUAGES):
        given = dict.fromkeys(fields(template(language, key)), "…")
        assert text(language, key, **given | {"count": 1}) == text(language, f"{key}-one", **given)
        assert text(language, key, **given | {"count": "1"}) != text(language, key, **given | {"count": 2})


def fields(template: str) -> set[str]:
    return {name for _, name, _, _ in Formatter().parse(template) if name is not None}


@pytest.mark.parametrize("language", LANGUAGES)
def test_braces_of_formulas_are_no_placeholders(language: str) -> None:
    """Of sentences that are filled: M^{-1} would lose its exponent. Laws are formulas and never filled."""
    found = {
        key: [one for one in fields(sentence) if not re.fullmatch(r"\d|[A-Za-z_]\w*", one)]
        for key, sentence in texts(language).items()
        if not key.startswith("laws.")
    }
    assert {key: names for key, names in found.items() if names} == {}


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_problem_has_a_sentence(language: str) -> None:
    codes = {code for file in SOURCE.rglob("*.py") for code in CODE.findall(file.read_text(encoding="utf-8"))}
    assert len(codes) > 30, "the pattern no longer finds the codes"
    errors = catalog(language)["errors"]
    assert isinstance(errors, Mapping)
    assert sorted(codes - errors.keys()) == []


@pytest.mark.one_in(7)
@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("identifier", scene_ids())
def test_every_step_has_its_texts(language: str, identifier: str) -> None:
    _, derivation = derived(identifier)
    for chapter in derivation.chapters:
        assert text(language, f"rules.chapters.{chapter.id}")
    for step in derivation.steps():
        key = f"rules.steps.{step.rule}"
        title = text(language, f"{key}.title", **step.about)
        sentence = text(language, f"{key}.{step.about.get('outcome', 'text')}", **step.about)
        used = fields(template(language, f"{key}.title")) | fields(
            template(language, f"{key}.{step.about.get('outcome', 'text')}")
        )
        assert used <= step.about.keys(), f"{key} speaks of what the step does not know"
        assert title
        assert sentence.endswith(".")


@pytest.mark.parametrize("formulation", ["dalembert-lagrange", "hamilton"])
@pytest.mark.parametrize(
    "identifier", ["elastic-pendulum", "guided-pendulum", "heavy-top", "wind-on-rod", "quarter-car"]
)
def test_every_step_has_a_law_and_its_source(identifier: str, formulation: str) -> None:
    _, derivation = derived(identifier, formulation)
    rules = {step.rule for chapter in derivation.chapters for step in chapter.steps}
    laws = catalog("en")["laws"]
    assert isinstance(laws, Mapping)
    assert sorted(rules - laws.keys()) == []


def test_every_rule_states_its_law_and_source() -> None:
    rules = modules_of("deltaq.derivation.rules")
    assert len(rules) >= 15
    for module in rules:
        assert module.__doc__ is not None
        assert "Source:" in module.__doc__, f"{module.__name__} names no source"
        text("en", f"rules.steps.{module.RULE}.title")


def test_every_step_of_the_general_proof_states_its_law_and_source() -> None:
    for rule in chain.from_iterable(CHAPTERS.values()):
        assert rule.__doc__ is not None
        assert "Source:" in rule.__doc__, f"{rule.__name__} names no source"
        text("en", f"rules.steps.{rule(sample()).rule}.title")


def test_placeholders_are_filled_and_user_text_is_never_a_template() -> None:
    assert filled("a {x} b {y}", {"x": "{y}", "y": 2}) == "a {y} b 2"


def test_message_with_a_suggestion() -> None:
    problem = Problem("unknown-place", parameters={"name": "bop", "suggestion": "bob"})
    assert message("en", problem) == "There is no point or body “bop”. Did you mean “bob”?"
    assert message("de", problem) == "Es gibt keinen Punkt oder Körper „bop“. Meinten Sie „bob“?"


@pytest.mark.parametrize(("language", "told"), [("de", "0,25"), ("en", "0.25")])
def test_a_number_in_a_sentence_has_the_mark_of_its_language(language: str, told: str) -> None:
    for code, parameters in (
        ("restitution-outside", {"value": 0.25}),
        ("constraint-not-met", {"gap": 0.25}),
        ("friction-negative", {"name": "0.5*m", "value": 0.25}),
    ):
        assert told in message(language, Problem(code, parameters=parameters))
    assert "0.5*m" in message(language, Problem("friction-negative", parameters={"name": "0.5*m", "value": 1.0}))


@pytest.mark.parametrize(
    ("wanted", "language"),
    [("de", "de"), ("de-CH", "de"), ("en-GB", "en"), ("fr", "en"), ("", "en"), (None, "en")],
)
def test_language_of(wanted: str | None, language: str) -> None:
    assert language_of(wanted) == language


def test_a_missing_text_is_our_bug() -> None:
    with pytest.raises(KeyError, match=r"no text for rules\.steps\.none\.title in en"):
        text("en", "rules.steps.none.title")

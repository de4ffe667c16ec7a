"""General proofs: derivations without a scene."""

from __future__ import annotations

from pydantic import Field

from ..vocabulary import Language
from .base import Answer, Request
from .derivation import Chapter


class ProofRequest(Request):
    """Which proof, by the last part of its address."""

    id: str = "dalembert-lagrange"
    lang: Language | None = None


class ProofAnswer(Answer):
    """A proof, every line checked by computer algebra on arbitrary functions and by numbers on concrete ones."""

    id: str = Field(examples=["dalembert-lagrange"])
    title: str
    chapters: tuple[Chapter, ...]


class ProofEntry(Answer):
    """A proof by its id."""

    id: str = Field(examples=["dalembert-lagrange"])
    title: str


class ProofList(Answer):
    """All proofs."""

    proofs: tuple[ProofEntry, ...]

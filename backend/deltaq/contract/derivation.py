"""Derivations: from a scene to its equations of motion, step by step."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from ..vocabulary import Missing, OptionalPart
from .base import Answer, AskedLanguage, Released, SceneWithChanges, examples
from .result import DerivationResult, Origin

Formulation = Literal["dalembert-lagrange", "hamilton"]
ChaptersAsked = Literal["all", "equations", "model", "ready"]
PRINCIPLE = "the principle from which the equations are derived"


class DerivationRequest(SceneWithChanges):
    """Which scene to derive, what to change before, and in which language."""

    formulation: Formulation = Field("dalembert-lagrange", description=PRINCIPLE)
    release: Released = ()
    canonical: bool = Field(
        default=False, description="whether a last chapter has Hamilton's function and canonical equations"
    )
    chapters: ChaptersAsked = Field(
        "all",
        description="`equations`: those up to the equations of motion; `model`: the last, as soon as it is there;"
        " `ready`: all, if they take no more than a moment, else the equations while the rest is computed, to be asked"
        " for as `model`",
    )
    lang: AskedLanguage = None

    model_config = examples(
        {"scene": "elastic-pendulum"},
        {
            "scene": "base-pendulum",
            "guides": [{"coordinate": "y", "value": "y0*sin(omega*t)"}],
            "parameters": {"y0": 0.1, "omega": 12.0},
        },
        {"scene": "pendulum", "release": ["l"]},
    )


class TermOfLine(Answer):
    """A summand of a line: with `marked`, its class there is `t-` and the numbers behind the `/` of its id."""

    id: str = Field(
        description="step/line.member.term, counted from 0: the third member of the first line has 0.2",
        examples=["equation:phi/0.1.0"],
    )
    latex: str = Field(description="with its sign", examples=["-m g \\ell \\sin\\varphi"])
    spoken: str = Field("", description="the same in words")
    sources: tuple[str, ...] = Field(description="bodies and loads that it comes from")
    origins: tuple[Origin, ...] = Field(
        alias="from",
        description="the terms it comes from: of the member before it, and of steps that this one rests on",
    )


class NamedRoot(Answer):
    """A letter that a step has for a root that recurs in it: `with s = √(x² + y²)`."""

    symbol: str = Field(description="its plain name", examples=["s"])
    symbol_latex: str = Field(examples=["s"])
    symbol_spoken: str = Field(examples=["s"])
    plain: str = Field(description="the root", examples=["sqrt(x^2 + y^2)"])
    latex: str = Field(examples=["\\sqrt{x^{2} + y^{2}}"])
    spoken: str


class Evidence(Answer):
    """How it is known that a step holds."""

    kind: Literal["exact", "sampled", "stated"] = Field(
        description="all members have one normal form; they agree at random points; nothing is said to be equal"
    )
    points: int = Field(description="how many random points, each in ball arithmetic; 0 if not sampled")
    digits: int = Field(description="to how many decimal digits the members agree there; 0 if not sampled")


class Step(Answer):
    """One law applied once."""

    id: str = Field(examples=["virtual-displacement:bob"])
    rule: str = Field(description="the law", examples=["virtual-displacement"])
    title: str
    text: str
    announced: str = Field("", description="title and text as they are read aloud, without mathematics between signs")
    latex: str = Field(examples=["\\delta E = m\\ell^2\\dot{\\varphi}\\,\\delta\\dot{\\varphi}"])
    marked: str = Field(description="the same with \\htmlClass hooks that tell which term is what")
    spoken: str = Field("", description="the same in words of the language of the answer, to be read aloud")
    spoken_terms: tuple[int, ...] = Field((), description="where in `spoken` each term begins, with its sign before it")
    verified: bool = Field(description="whether an independent route confirmed the step")
    evidence: Evidence
    premises: tuple[str, ...] = Field(description="ids of the steps that this one rests on")
    sources: tuple[str, ...] = Field(description="bodies and loads that the terms come from")
    terms: tuple[TermOfLine, ...] = Field(description="the summands of all lines, with where they come from")
    where: tuple[NamedRoot, ...] = Field(
        (), description="letters that `latex`, `marked`, `spoken` and the terms have for roots; results have none"
    )
    cancelled: tuple[str, ...] = Field(description="ids of terms that cancelled in this step")
    substeps: tuple[Step, ...]


class Chapter(Answer):
    """Steps that belong together."""

    id: str = Field(examples=["variation"])
    title: str
    steps: tuple[Step, ...]


class LeftOut(Answer):
    """A part that is missing: one of the last chapter, or multipliers written out."""

    part: OptionalPart = Field(description="`model` is all of it")
    reason: Missing = Field(
        description="`later`: ask for it; `budget`: its operations are spent; `time`: its time is; `failed`: our bug; "
        "others are of the scene's own"
    )
    text: str = Field(description="that it is missing, and what to do about it")


class DerivationAnswer(Answer):
    """The derivation, and its results as plain expressions and as LaTeX."""

    id: str = Field(description="content hash; GET /derivations/{id} answers the same", examples=["9f3c…"])
    scene: str = Field(description="id of the scene", examples=["pendulum"])
    formulation: Formulation = Field(description=PRINCIPLE)
    chapters: tuple[Chapter, ...] = Field(description="those that were asked for")
    result: DerivationResult
    left_out: tuple[LeftOut, ...] = Field(
        (), description="what is missing, in the last chapter most of all, and in the results that come from it"
    )

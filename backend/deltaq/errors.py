"""The exception tree. An input error is the user's to mend; what is raised and is none of these is our bug.

    DeltaqError
    ├── CommandError          a command of the shell cannot do what it was asked
    ├── SettingsError         an environment variable does not hold what its setting needs (settings)
    ├── JobError              a worker could not finish a job: killed, too large, too many waiting … (api)
    └── InputError            carries Problems: where, what, and what to write instead
        ├── ExpressionError   in the text of one expression (language)
        ├── SceneError        in a scene document (mechanics)
        ├── RequestError      in the other fields of a request (api, simulation)
        └── UnknownNameError  a scene, method or coordinate that does not exist

Messages are not written here: a Problem names a `code` and its `parameters`, and the catalogs of
`narration/locales` turn the two into a sentence in the user's language.

A failed computation (a trajectory that diverges, say) is a result with a status, never an exception.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType

from .vocabulary import Severity

Parameter = str | int | float

MOST_PROBLEMS = 50  # that are told of one input: who has mended these asks again


@dataclass(frozen=True)
class Problem:
    """One thing that is wrong with the input, and where.

    `pointer` is the JSON pointer (RFC 6901) of the field, "" for the whole document; `offset` and `length` count
    characters (code points) inside the text of that field.
    """

    code: str
    pointer: str = ""
    offset: int | None = None
    length: int | None = None
    parameters: Mapping[str, Parameter] = field(default_factory=dict)
    severity: Severity = "error"

    def __post_init__(self) -> None:
        object.__setattr__(self, "parameters", MappingProxyType(dict(self.parameters)))

    def below(self, pointer: str) -> Problem:
        """The same problem seen from an enclosing document, in which it stands at `pointer`."""
        return replace(self, pointer=pointer + self.pointer)

    def __reduce__(self) -> tuple[type[Problem], tuple[object, ...]]:
        # A mapping proxy cannot be pickled; a problem must cross process borders.
        return Problem, (self.code, self.pointer, self.offset, self.length, dict(self.parameters), self.severity)


class DeltaqError(Exception):
    """Anything that δq raises on purpose."""


class CommandError(DeltaqError):
    """A command of the shell cannot do what it was asked; the text says why and what to do."""


class InputError(DeltaqError):
    """The input is wrong, and `problems` say where and why."""

    def __init__(self, *problems: Problem) -> None:
        super().__init__(*problems)
        self.problems = problems

    def __str__(self) -> str:
        return "; ".join(
            f"{p.code}{f' at {p.pointer}' if p.pointer else ''}"
            f"{f' character {p.offset}' if p.offset is not None else ''}"
            f"{f' {dict(p.parameters)}' if p.parameters else ''}"
            for p in self.problems
        )


class ExpressionError(InputError):
    """The text of one expression cannot be read."""


class SceneError(InputError):
    """A scene document does not describe a mechanical system."""


class RequestError(InputError):
    """A field of a request outside the scene is wrong."""


class UnknownNameError(InputError):
    """A scene, method, coordinate or task of this name does not exist."""


def escaped(name: str) -> str:
    """A name as part of a JSON pointer (RFC 6901); bounded, for it may be the client's."""
    return name[:64].replace("~", "~0").replace("/", "~1")

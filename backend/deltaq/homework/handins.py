"""What a class hands in: many files, or an archive of them, as one table of answers.

A file is JSON and nothing else: nothing in it is carried out, and what cannot be taken is named with its reason and
keeps no other file from being marked. The columns are those of a TableRow; the line of an answer is the number of its
task, so that what follows from a wrong answer to an earlier task is seen.
"""

from __future__ import annotations

import io
import json
import zipfile
import zlib
from base64 import b32encode
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from hashlib import sha256

from ..contract.assignment import AssignmentDocument, instant
from ..contract.handin import FORMAT, HandIn
from ..contract.reading import made_of
from ..contract.table import COLUMNS
from ..errors import Problem, RequestError
from ..mechanics.user_text import UserText
from ..narration.catalog import message
from .assignment import scene_of
from .gradebook import Refused, content_of
from .table import Row, Style, Table

ARCHIVE = (b"PK\x03\x04", b"PK\x05\x06")  # how a zip begins, the second one being empty
LARGEST = 65_536  # bytes of a file: the answers to 20 tasks are some 4,000
MOST_FILES = 4000
HIDDEN = ("__MACOSX/", ".DS_Store")
CODE_BYTES = 5

File = tuple[str, bytes]  # its name and what is in it


def code_of(assignment: AssignmentDocument) -> str:
    """The code by which a file says which assignment it answers: the same for the same tasks in the same values.

    Points, deadline and title may be changed without making it another one.
    """
    asked = [[content_of(scene_of(one)), one.task] for one in assignment.tasks]
    digest = sha256(json.dumps([assignment.individual, asked]).encode()).digest()
    letters = b32encode(digest[:CODE_BYTES]).decode()
    return f"{letters[:4]}-{letters[4:]}"


def is_archive(data: bytes) -> bool:
    """Whether these are the bytes of a zip."""
    return data.startswith(ARCHIVE)


def archived(data: bytes) -> list[File]:
    """The files of a zip, at most one byte more of each than a file may have. Raises RequestError if it is broken."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            members = [one for one in archive.infolist() if not _is_hidden(one.filename)]
            if len(members) > MOST_FILES:
                raise RequestError(Problem("handins-many", parameters={"count": len(members), "most": MOST_FILES}))
            return [(one.filename, _content(archive, one)) for one in members]
    except (zipfile.BadZipFile, zlib.error, OSError, ValueError, NotImplementedError, EOFError):
        raise RequestError(Problem("handins-archive")) from None


def _is_hidden(name: str) -> bool:
    return name.endswith("/") or any(part in name for part in HIDDEN)


def _content(archive: zipfile.ZipFile, member: zipfile.ZipInfo) -> bytes:
    """Nothing of a member that is encrypted or broken: it is no hand-in, and the others are read."""
    try:
        with archive.open(member) as file:
            return file.read(LARGEST + 1)
    except (zipfile.BadZipFile, zlib.error, RuntimeError, NotImplementedError, EOFError):
        return b""


class _WrongFile(Exception):
    """Why a file cannot be taken."""

    def __init__(self, code: str, **parameters: str) -> None:
        super().__init__(code)
        self.problem = Problem(code, parameters=parameters)


@dataclass(frozen=True)
class HandIns:
    """The table of all answers, and the files that could not be taken."""

    table: Table
    refused: tuple[Refused, ...]


def handed_in(files: Sequence[File], assignment: AssignmentDocument | None, language: str) -> HandIns:
    """The answers of all files as one table. Raises RequestError if there is no assignment that they could answer."""
    if assignment is None:
        raise RequestError(Problem("handins-assignment"))
    code, before = code_of(assignment), dict[bytes, str]()
    rows: list[Row] = []
    refused: list[Refused] = []
    for name, content in files:
        try:
            rows.extend(_rows(name, _handin(name, content, code, before), assignment))
        except _WrongFile as wrong:
            refused.append(Refused(UserText(name).line, message(language, wrong.problem)))
    style = Style(";" if language == "de" else ",", marked=True)  # as spreadsheets in this language open it
    return HandIns(Table(COLUMNS, tuple(rows), style, tuple(range(1, len(rows) + 1))), tuple(refused))


def _handin(name: str, content: bytes, code: str, before: dict[bytes, str]) -> HandIn:
    """What a file says. Raises _WrongFile."""
    if len(content) > LARGEST:
        raise _WrongFile("handin-large", most=str(LARGEST // 1024))
    if content in before:
        raise _WrongFile("handin-twice", other=before[content])
    found = _read(content)
    if found.sheet.strip().upper() != code:
        raise _WrongFile("handin-sheet", name=found.sheet[:40], expected=code)
    if not (UserText(found.student) or UserText(found.id)):
        raise _WrongFile("handin-name")
    try:
        instant(found.time)
    except (ValueError, OverflowError):
        raise _WrongFile("handin-time", name=found.time) from None
    before[content] = name
    return found


def _read(content: bytes) -> HandIn:
    try:
        found = json.loads(content.decode("utf-8-sig"))
    except (ValueError, RecursionError):
        raise _WrongFile("handin-json") from None
    try:
        return made_of(found, HandIn)
    except RequestError as error:
        places = [one.pointer[1:65] for one in error.problems]
        if {"", "format"} & set(places):
            raise _WrongFile("handin-format", format=FORMAT) from None
        raise _WrongFile("handin-field", field=places[0]) from None


def _rows(name: str, handin: HandIn, assignment: AssignmentDocument) -> Iterator[Row]:
    """The answers of a file as rows of a table. Raises _WrongFile, before any, if it answers what was not asked.

    Whoever has values of their own has those of the name as it was typed.
    """
    tasks, seed = len(assignment.tasks), handin.student.strip() if assignment.individual else ""
    beyond = [one.task for one in handin.answers if one.task > tasks]
    if beyond:
        raise _WrongFile("handin-task", number=str(beyond[0]), count=str(tasks))
    if len(handin.answers) > tasks:
        raise _WrongFile("handin-field", field="answers")
    if not handin.answers:
        raise _WrongFile("handin-empty")
    student, identity = UserText(handin.student).line, UserText(handin.id).line
    for one in handin.answers:
        yield {
            "student": student or identity,
            "id": identity,
            "task": str(one.task),
            "line": str(one.task),
            "answer": one.value,
            "syntax": one.syntax,
            "seed": seed,
            "time": handin.time.strip(),
            "file": UserText(name).line,
        }

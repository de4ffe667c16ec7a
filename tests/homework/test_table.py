"""Tables as spreadsheets write them, and how they are written back."""

from __future__ import annotations

import pytest

from deltaq.errors import RequestError
from deltaq.homework.table import BEYOND, Row, Style, read_table

HEADER, ANSWER = ("task", "answer"), {"task": "größe", "answer": "m"}
COMMA, SEMICOLON = "Task,Answer\ngröße,m\n", "Task; Answer \r\ngröße;m\r\n"


@pytest.mark.parametrize(
    ("data", "style"),
    [
        pytest.param(COMMA.encode(), Style(), id="comma"),
        pytest.param(SEMICOLON.encode(), Style(";"), id="semicolon"),
        pytest.param(COMMA.replace(",", "\t").encode(), Style("\t"), id="tab"),
        pytest.param(COMMA.encode("utf-8-sig"), Style(marked=True), id="byte order mark"),
        pytest.param(SEMICOLON.encode("cp1252"), Style(";", marked=True), id="Windows-1252"),
        pytest.param(COMMA.replace(",", "\t").encode("utf-16"), Style("\t", marked=True), id="UTF-16"),
        pytest.param(COMMA.replace("\n", "\r").encode(), Style(), id="carriage returns"),
        pytest.param(b"sep=;\r\n" + SEMICOLON.encode(), Style(";"), id="separator told"),
        pytest.param(b"sep=\t\n" + COMMA.replace(",", "\t").encode(), Style("\t"), id="tab told"),
        pytest.param(b'"Task","Answer"\n"gr\xc3\xb6\xc3\x9fe","m"\n', Style(), id="quotes"),
        pytest.param(COMMA.encode() + b",\n \n\n,,,\n", Style(), id="empty rows"),
        pytest.param("Task,Answer,,\ngröße,m,,\n".encode(), Style(), id="columns without a name"),
    ],
)
def test_tables_of_spreadsheets(data: bytes, style: Style) -> None:
    table = read_table(data)
    assert [{name: row[name] for name in HEADER} for row in table.rows] == [ANSWER]
    assert BEYOND not in table.rows[0]
    assert table.style == style


@pytest.mark.parametrize(
    ("line", "row"),
    [
        pytest.param("1", {"task": "1", "answer": ""}, id="too few cells"),
        pytest.param("1,m,", {"task": "1", "answer": "m"}, id="an empty cell too many"),
        pytest.param("1,m,x,y", {"task": "1", "answer": "m", BEYOND: "x y"}, id="cells too many"),
        pytest.param('1,"a, ""b""\n+ c"', {"task": "1", "answer": 'a, "b"\n+ c'}, id="quoted"),
    ],
)
def test_rows(line: str, row: Row) -> None:
    assert read_table(f"task,answer\n{line}\n".encode()).rows == (row,)


@pytest.mark.parametrize(
    ("content", "code", "row"),
    [
        pytest.param('a,b\n1,"2\n3,4\n', "answers-quote", 2, id="a quote that is never closed"),
        pytest.param('a,b\n\n1,2\n3,"4', "answers-quote", 4, id="in the last row"),
        pytest.param(f"a,b\n1,2\n3,{'x' * 200_000}\n", "answers-cell", 3, id="a cell beyond all bounds"),
    ],
)
def test_a_table_that_cannot_be_read_says_where(content: str, code: str, row: int) -> None:
    with pytest.raises(RequestError) as found:
        read_table(content.encode())
    assert [(one.code, dict(one.parameters)) for one in found.value.problems] == [(code, {"row": row})]


@pytest.mark.parametrize("data", [b"", b"\n\n", b"\xef\xbb\xbf"])
def test_a_table_of_nothing(data: bytes) -> None:
    table = read_table(data)
    assert (table.header, table.rows) == ((), ())


@pytest.mark.parametrize(
    ("style", "written"),
    [
        pytest.param(Style(), 'a,b\nx,1.5\n\'=1,"p,q"\n', id="comma"),
        pytest.param(Style(";", marked=True), "\ufeffa;b\nx;1,5\n'=1;p,q\n", id="semicolon"),
    ],
)
def test_writing(style: Style, written: str) -> None:
    assert style.written(("a", "b"), [("x", 1.5), ("=1", "p,q")]).decode() == written


@pytest.mark.parametrize(
    "data",
    [
        pytest.param("task,answer\n1,m".encode("utf-16") + b"\x00", id="UTF-16 that is cut off"),
        pytest.param(b"task,answer\n1,m\x81\n", id="no character of Windows-1252"),
    ],
)
def test_what_cannot_be_decoded_is_marked(data: bytes) -> None:
    assert read_table(data).rows == ({"task": "1", "answer": "m\ufffd"},)


def test_what_has_no_encoding_becomes_a_question_mark() -> None:
    assert Style().written(("a",), [("x\ud800",)]) == b"a\nx?\n"


def test_rows_are_counted_as_a_spreadsheet_does() -> None:
    """Empty rows count, a row of several lines is one, and the line that tells the separator is none."""
    table = read_table(b'sep=;\n\ntask;answer\n1;"a\nb"\n;\n2;c\n')
    assert [row["answer"] for row in table.rows] == ["a\nb", "c"]
    assert table.numbers == (3, 5)

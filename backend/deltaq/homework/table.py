"""Tables as spreadsheets write and read them: comma, semicolon or tab between the cells, and several encodings.

Where a semicolon separates the cells, the comma stands in the numbers. A table is written as the one that it answers
was, so that whoever could open that one can open it. A cell that a spreadsheet would take for a formula is made a text.
"""

from __future__ import annotations

import csv
import io
from codecs import BOM_UTF8, BOM_UTF16_BE, BOM_UTF16_LE
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from ..errors import Problem, RequestError
from ..mechanics.user_text import as_cell

SEPARATORS = ",;\t"
TOLD = "sep="  # the first line by which spreadsheets tell each other the separator
BEYOND = "beyond the header"  # the key of cells for which the header has no name
END = "\0end"  # a line after the last one: a quote that is never closed swallows it

Row = dict[str, str]


@dataclass(frozen=True)
class Style:
    """How a table is written; `marked` says that it begins with a byte order mark, for which spreadsheets look."""

    separator: str = ","
    marked: bool = False

    def written(self, header: Sequence[str], rows: Iterable[Sequence[object]]) -> bytes:
        """The table as the bytes of a file."""
        out = io.StringIO()
        writer = csv.writer(out, delimiter=self.separator, lineterminator="\n")
        writer.writerow(header)
        writer.writerows([self._cell(value) for value in row] for row in rows)
        return (BOM_UTF8 if self.marked else b"") + out.getvalue().encode(errors="replace")

    def _cell(self, value: object) -> str:
        if isinstance(value, float):
            return f"{value:.10g}".replace(".", "," if self.separator == ";" else ".")
        return as_cell(str(value))


@dataclass(frozen=True)
class Table:
    """Names of the columns in lower case, the rows that are not empty, and how it was written.

    `numbers` are those of the rows as a spreadsheet counts them: empty ones count, and the header is one.
    """

    header: tuple[str, ...]
    rows: tuple[Row, ...]
    style: Style
    numbers: tuple[int, ...] = ()


def read_table(data: bytes) -> Table:
    """The table of a file. Cells for which the header has no name stand under BEYOND.

    Raises RequestError with the row for a quote that is never closed, or a cell beyond all bounds.
    """
    content = _decoded(data)
    first, _, rest = content.partition("\n")
    told = first.strip(' "')  # not of tabs: one of them may be what is told
    separator = told[len(TOLD) :] if told.lower().startswith(TOLD) else ""
    if separator in tuple(SEPARATORS):
        content = rest
    else:
        separator = max(SEPARATORS, key=first.count)
    filled = [(number, line) for number, line in enumerate(_lines(content, separator), 1) if _is_filled(line)]
    (_, names), *lines = filled or [(1, [])]
    header = tuple(name.strip().lower() for name in names)
    rows = tuple(_row(header, line) for _, line in lines)
    return Table(header, rows, Style(separator, _is_marked(data)), tuple(number for number, _ in lines))


def _lines(content: str, separator: str) -> list[list[str]]:
    lines: list[list[str]] = []
    try:
        lines.extend(csv.reader(io.StringIO(f"{content}\n{END}\n"), delimiter=separator))
    except csv.Error:
        raise RequestError(Problem("answers-cell", parameters={"row": len(lines) + 1})) from None
    if lines[-1] != [END]:
        raise RequestError(Problem("answers-quote", parameters={"row": len(lines)}))
    return lines[:-1]


def _decoded(data: bytes) -> str:
    """UTF-16 and UTF-8 by their marks, UTF-8 without, else what a spreadsheet in the west of Europe writes."""
    if data.startswith((BOM_UTF16_LE, BOM_UTF16_BE)):
        text = data.decode("utf-16", errors="replace")
    else:
        try:
            text = data.decode("utf-8-sig")
        except UnicodeDecodeError:
            text = data.decode("cp1252", errors="replace")
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _is_marked(data: bytes) -> bool:
    """Not UTF-8 without a mark, as programs write it."""
    try:
        return data.decode("utf-8").startswith("\ufeff")
    except UnicodeDecodeError:
        return True


def _is_filled(line: Sequence[str]) -> bool:
    return any(cell.strip() for cell in line)


def _row(header: Sequence[str], line: Sequence[str]) -> Row:
    cells = [*line, *[""] * len(header)]
    beyond = [cell for cell in cells[len(header) :] if cell.strip()]
    return {**dict(zip(header, cells, strict=False)), **({BEYOND: " ".join(beyond)} if beyond else {})}

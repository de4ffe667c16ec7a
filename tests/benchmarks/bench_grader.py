"""The shell and the page mark the same class tables: whether their files are the same, byte for byte.

Run it from the checkout: `python -m tests.benchmarks.bench_grader [tables]`, 200 if no number is given. The page's
modules run in Node and ask a service on this machine. Prints; exits with 1 if two files differ.
"""

from __future__ import annotations

import csv
import io
import sys
import tempfile
from collections import Counter
from contextlib import redirect_stdout
from pathlib import Path
from time import perf_counter

from tests.homework.both_graders import by_page, by_shell
from tests.homework.classes import class_archive, class_table
from tests.serving import served

ROOT = Path(__file__).parents[2]
FIRST = 1000  # seeds that no test draws


def main(count: int) -> int:
    """Mark the tables both ways."""
    seeds = range(FIRST, FIRST + count)
    tables = [class_archive(seed) if seed % 5 == 0 else class_table(seed) for seed in seeds]
    begin = perf_counter()
    with served(workers=1) as service:
        pages = list(by_page(tables, service.address, ROOT))
    middle = perf_counter()
    with tempfile.TemporaryDirectory() as folder, redirect_stdout(io.StringIO()):
        shells = [by_shell(table, Path(folder)) for table in tables]
    end = perf_counter()
    differing = [table.seed for table, one, other in zip(tables, pages, shells, strict=True) if one != other]
    print(
        f"{count} tables, {sum(len(table.rows) for table in tables)} rows: {count - len(differing)} files are the same"
    )
    told = dict(outcomes([one.results for one in shells]))
    print(f"page {middle - begin:.0f} s, shell {end - middle:.0f} s; outcomes {told}")
    print(f"differing: {differing}")
    return 1 if differing else 0


def outcomes(files: list[bytes]) -> Counter[str]:
    """How often each outcome comes up, and points in part or none for what is right."""
    found: Counter[str] = Counter()
    for file in files:
        text = file.decode("utf-8-sig")
        first = text.split("\n", 1)[0]
        separator = max(",;\t", key=first.count)
        for row in csv.DictReader(io.StringIO(text), delimiter=separator):
            found[row["outcome"]] += 1
            found["right again, no points"] += row["outcome"] == "correct" and row["points"] == "0"
    return found


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else 200))

"""What several commands take, and how they read and write it."""

from __future__ import annotations

import argparse
import csv
import io
import json
import logging
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ..errors import CommandError


def scene_argument(parser: argparse.ArgumentParser) -> None:
    """Adds `scene`: a built-in scene or a file."""
    parser.add_argument("scene", help="id of a built-in scene, or a TOML file")


def field_argument(parser: argparse.ArgumentParser) -> None:
    """Adds `--set FIELD=VALUE`, which may be repeated."""
    parser.add_argument(
        "--set",
        dest="fields",
        action="append",
        default=[],
        type=_field,
        metavar="FIELD=VALUE",
        help='a further field of the request, its value as JSON: t_end=20, methods=["rk4"], parameters={"k":100}',
    )


def language_argument(parser: argparse.ArgumentParser) -> None:
    """Adds `--lang`."""
    parser.add_argument("--lang", choices=("en", "de"), default="en", help="language (default: %(default)s)")


def output_argument(parser: argparse.ArgumentParser) -> None:
    """Adds `--output`, a file in place of the screen."""
    parser.add_argument("--output", type=Path, help="where it goes (default: the screen)")


def _field(text: str) -> tuple[str, Any]:
    name, value = named(text, "FIELD=VALUE")
    try:
        return name, json.loads(value)
    except json.JSONDecodeError:
        return name, value  # a word without its quotes


def named(text: str, form: str) -> tuple[str, str]:
    """A name and what stands behind its sign of equality; `form` is how that is written."""
    name, sign, value = text.partition("=")
    if not sign:
        raise argparse.ArgumentTypeError(f"{form} is needed, not {text}")
    return name, value


def question_of(options: argparse.Namespace) -> dict[str, Any]:
    """The request in the arguments: fields, scene and language."""
    return {**dict(options.fields), "scene": scene_of(options.scene), "lang": options.lang}


def scene_of(given: str) -> object:
    """A built-in scene by its id, or the document in a file."""
    if not given.endswith(".toml"):
        return given
    from ..mechanics.toml import read_toml

    try:
        return read_toml(Path(given).read_text(encoding="utf-8-sig"))
    except UnicodeDecodeError:
        raise CommandError(f"{given} is not in UTF-8; have your editor save it so") from None


@contextmanager
def compilation_told() -> Iterator[None]:
    """What is compiled meanwhile is told on the error stream: on a new machine that takes half a minute."""
    logger, screen = logging.getLogger("deltaq.simulation"), logging.StreamHandler()
    screen.setFormatter(logging.Formatter("deltaq: %(message)s"))
    level = logger.level
    logger.addHandler(screen)
    logger.setLevel(logging.INFO)
    try:
        yield
    finally:
        logger.setLevel(level)
        logger.removeHandler(screen)


def table(columns: Mapping[str, Sequence[object]]) -> str:
    """CSV of columns of one length, by their names."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(zip(*columns.values(), strict=True))
    return out.getvalue()


def write(text: str, output: Path | None) -> None:
    """To a file, which is named on the screen; or to the screen."""
    if output is None:
        sys.stdout.write(text if text.endswith("\n") else f"{text}\n")
    else:
        output.write_text(text, encoding="utf-8")
        print(f"→ {output}")

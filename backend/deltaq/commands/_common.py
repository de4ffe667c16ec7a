"""What several commands take, and how they read and write it."""

from __future__ import annotations

import argparse
import json
import sys
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
    name, sign, value = text.partition("=")
    if not sign:
        raise argparse.ArgumentTypeError(f"FIELD=VALUE is needed, not {text}")
    try:
        return name, json.loads(value)
    except json.JSONDecodeError:
        return name, value  # a word without its quotes


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


def write(text: str, output: Path | None) -> None:
    """To a file, which is named on the screen; or to the screen."""
    if output is None:
        sys.stdout.write(text if text.endswith("\n") else f"{text}\n")
    else:
        output.write_text(text, encoding="utf-8")
        print(f"→ {output}")

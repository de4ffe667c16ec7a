"""The command line: `deltaq` and its commands, which stand in `commands/`."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from types import ModuleType

from . import __version__
from .commands.serve import settings_help
from .errors import CommandError, InputError
from .packages import modules_of

MENDABLE = 2
UNREAD = 141  # what a shell says of a program whose reader has gone


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command; the exit code is 0, or 2 for what the user can mend, which is said in one line each."""
    commands = {name_of(module): module for module in modules_of("deltaq.commands")}
    parser = _parser(commands)
    options = parser.parse_args(arguments)
    if options.command is None:
        parser.print_help()
        return 0
    try:
        return _run(commands[options.command], options)
    except BrokenPipeError:
        # Whoever reads has read enough, as `head` has; what is left to write must not complain either.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return UNREAD
    except CommandError as error:
        print(f"deltaq: {error}", file=sys.stderr)
    except OSError as error:
        print(f"deltaq: {error.filename}: {error.strerror}" if error.filename else f"deltaq: {error}", file=sys.stderr)
    except InputError as error:
        print(_told(error, getattr(options, "lang", "en")), file=sys.stderr)
    return MENDABLE


def _run(command: ModuleType, options: argparse.Namespace) -> int:
    code: int = command.run(options) or 0
    sys.stdout.flush()
    return code


def name_of(module: ModuleType) -> str:
    """`export-stack` for the module `export_stack`."""
    return module.__name__.rpartition(".")[2].replace("_", "-")


def _parser(commands: dict[str, ModuleType]) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="deltaq",
        description="Derives and simulates analytical mechanics.",
        epilog=settings_help(),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"deltaq {__version__}")
    below = parser.add_subparsers(dest="command", metavar="command")
    for name, module in commands.items():
        example = f"example: {module.EXAMPLE}" if hasattr(module, "EXAMPLE") else None
        module.arguments(below.add_parser(name, help=module.HELP, description=module.DESCRIPTION, epilog=example))
    return parser


def _told(error: InputError, language: str) -> str:
    """Why it could not be done, one line for each problem."""
    from .narration.catalog import message

    return "\n".join(f"deltaq: {p.pointer + ': ' if p.pointer else ''}{message(language, p)}" for p in error.problems)


if __name__ == "__main__":
    sys.exit(main())

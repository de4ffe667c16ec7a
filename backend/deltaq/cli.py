"""The command line: `deltaq serve`."""

from __future__ import annotations

import argparse
import errno
import socket
import sys
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from . import __version__

if TYPE_CHECKING:
    from .settings import Settings

BUSY = 2


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; the exit code is 0, or 2 for what the user can mend."""
    parser = _parser()
    options = parser.parse_args(arguments)
    if options.command == "serve":
        return serve(options.host, options.port, open_page=options.open)
    if options.command == "check":
        return check(options)
    if options.command == "export-stack":
        return export_stack(options)
    if options.command == "bench":
        return bench(tuple(options.names))
    parser.print_help()
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="deltaq",
        description="Derives and simulates analytical mechanics.",
        epilog=_settings_help(),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"deltaq {__version__}")
    commands = parser.add_subparsers(dest="command", metavar="command")
    serve_parser = commands.add_parser(
        "serve",
        help="serve the page and the API",
        description="Serves the page and the API.",
        epilog=_settings_help(),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    serve_parser.add_argument("--host", default="127.0.0.1", help="address to bind (default: %(default)s)")
    serve_parser.add_argument(
        "--port", type=_port, default=8000, help="port; 0 takes a free one (default: %(default)s)"
    )
    serve_parser.add_argument("--open", action="store_true", help="open the page in the browser")
    check_parser = commands.add_parser(
        "check",
        help="check a table of answers",
        description="Checks the answers of a CSV table with the columns task and answer, and student, scene, syntax "
        "(plain or latex) and seed where wanted; writes the verdicts, and tells which mistakes were made how often.",
    )
    check_parser.add_argument("answers", type=Path, help="CSV with a header")
    check_parser.add_argument("--output", type=Path, help="where the results go (default: beside, -results.csv)")
    check_parser.add_argument("--assignment", type=Path, help="TOML or JSON file with scenes, tasks and points")
    check_parser.add_argument("--lang", choices=("en", "de"), default="en", help="language (default: %(default)s)")
    stack_parser = commands.add_parser(
        "export-stack",
        help="export tasks as questions of STACK",
        description="Writes tasks of a built-in scene as Moodle XML of the question type STACK.",
    )
    stack_parser.add_argument("scene", help="id of a built-in scene")
    stack_parser.add_argument("tasks", nargs="*", help="ids of tasks such as equation:phi (default: all)")
    stack_parser.add_argument("--output", type=Path, required=True, help="where the XML goes")
    stack_parser.add_argument("--lang", choices=("en", "de"), default="en", help="language (default: %(default)s)")
    bench_parser = commands.add_parser(
        "bench",
        help="measure speed and accuracy against peers (in a checkout)",
        description="Runs the benchmarks of the checkout: tables with ratios to C, SciPy, SymPy and, where installed, "
        "heyoka. Without names all of them, which takes about half an hour.",
    )
    bench_parser.add_argument("names", nargs="*", help="which: simulation, derivation, chain, rhs …")
    return parser


def _settings_help() -> str:
    """The environment variables of the service."""
    from .settings import described

    own = "\n".join(f"  {line}" for line in described())
    return f"environment variables of the service:\n{own}\n  NUMBA_CACHE_DIR is where compiled kernels go."


def bench(names: tuple[str, ...]) -> int:
    """Run benchmarks by name."""
    from .bench import benchmark_names, run_benchmarks

    known = benchmark_names()
    if not known:
        print("deltaq: the benchmarks are part of a checkout, not of the installed package", file=sys.stderr)
        return BUSY
    if unknown := [name for name in names if name not in known]:
        print(f"deltaq: no benchmark {', '.join(unknown)}; there are {', '.join(known)}", file=sys.stderr)
        return BUSY
    return run_benchmarks(names or known)


def export_stack(options: argparse.Namespace) -> int:
    """Write questions for STACK."""
    from .errors import InputError
    from .homework.command import stack_file, told

    try:
        count = stack_file(options.scene, options.tasks, options.output, options.lang)
    except InputError as error:
        print(told(error, options.lang), file=sys.stderr)
        return BUSY
    except OSError as error:
        print(f"deltaq: {error}", file=sys.stderr)
        return BUSY
    print(f"{count} → {options.output}")
    return 0


def check(options: argparse.Namespace) -> int:
    """Check a table of answers, and print what went wrong how often."""
    from .errors import InputError
    from .homework.command import check_file, told

    output = options.output or options.answers.with_name(f"{options.answers.stem}-results.csv")
    try:
        print(check_file(options.answers, output, options.assignment, options.lang))
    except InputError as error:
        print(told(error, options.lang), file=sys.stderr)
        return BUSY
    except (OSError, UnicodeDecodeError) as error:
        print(f"deltaq: {error}", file=sys.stderr)
        return BUSY
    print(f"→ {output}")
    return 0


def _port(text: str) -> int:
    number = int(text) if text.isdecimal() else -1
    if not 0 <= number <= 65535:
        raise argparse.ArgumentTypeError(f"a port is a number from 0 to 65535, not {text}")
    return number


def serve(host: str, port: int, *, open_page: bool) -> int:
    """Serve until interrupted. The port is taken before anything is loaded, so that a busy one is told at once."""
    try:
        listener = _listen(host, port)
    except OSError as error:
        print(_cannot_listen(host, port, error), file=sys.stderr)
        return BUSY
    from .settings import Settings, SettingsError

    try:
        settings = Settings.from_environment()
    except SettingsError as error:
        print(f"deltaq: {error}", file=sys.stderr)
        return BUSY
    if not settings.allowed_hosts and listener.getsockname()[0] in {"127.0.0.1", "::1"}:
        settings = replace(settings, allowed_hosts=("localhost",))
    address = _address(host, listener.getsockname()[1])
    print(f"δq is at {address}  (Ctrl-C ends it)", flush=True)
    if open_page:
        import webbrowser

        webbrowser.open(address)
    with suppress(KeyboardInterrupt):
        _run(listener, settings)
    return 0


def _run(listener: socket.socket, settings: Settings) -> None:
    import uvicorn

    from .api.app import create_app
    from .api.connection import Patience, connections
    from .api.logs import configure

    configure(settings.log_level)
    config = uvicorn.Config(
        create_app(settings),
        http=connections(Patience(settings.head_timeout, settings.reading_timeout)),  # type: ignore[arg-type]
        ws="none",
        log_config=None,
        access_log=False,
        server_header=False,
        timeout_keep_alive=15,
        timeout_graceful_shutdown=settings.drain_timeout,
        forwarded_allow_ips=list(settings.trusted_proxies),
        h11_max_incomplete_event_size=32768,
    )
    uvicorn.Server(config).run(sockets=[listener])


def _listen(host: str, port: int) -> socket.socket:
    """A socket that already takes connections; they wait until the service is loaded."""
    family, kind, protocol, _, place = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0]
    listener = socket.socket(family, kind, protocol)
    try:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind(place)
        listener.listen(2048)
    except OSError:
        listener.close()
        raise
    return listener


def _cannot_listen(host: str, port: int, error: OSError) -> str:
    if error.errno == errno.EADDRINUSE:
        return f"deltaq: port {port} is in use. Take another one: deltaq serve --port {min(port + 1, 65535)}"
    if error.errno == errno.EACCES:
        return f"deltaq: port {port} is not for ordinary users. Take one above 1023: deltaq serve --port 8000"
    return f"deltaq: cannot listen at {host}: {error.strerror or error}"


def _address(host: str, port: int) -> str:
    shown = {"0.0.0.0": "127.0.0.1", "::": "[::1]"}.get(host, f"[{host}]" if ":" in host else host)  # noqa: S104
    return f"http://{shown}:{port}/"


if __name__ == "__main__":
    sys.exit(main())

"""`deltaq serve`: the page and the API."""

from __future__ import annotations

import argparse
import errno
import socket
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING

from ..errors import CommandError

if TYPE_CHECKING:
    from ..settings import Settings

HELP = "serve the page and the API"
DESCRIPTION = "Serves the page and the API."


def arguments(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    parser.epilog = settings_help()
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.add_argument("--host", default="127.0.0.1", help="address to bind (default: %(default)s)")
    parser.add_argument("--port", type=_port, default=8000, help="port; 0 takes a free one (default: %(default)s)")
    parser.add_argument("--open", action="store_true", help="open the page in the browser")


def settings_help() -> str:
    """The environment variables of the service."""
    from ..settings import described

    own = "\n".join(f"  {line}" for line in described())
    return f"environment variables of the service:\n{own}\n  NUMBA_CACHE_DIR is where compiled kernels go."


def run(options: argparse.Namespace) -> None:
    """Serve until interrupted. The port is taken before anything is loaded, so that a busy one is told at once."""
    try:
        listener = _listen(options.host, options.port)
    except OSError as error:
        raise CommandError(_cannot_listen(options.host, options.port, error)) from None
    with listener, suppress(KeyboardInterrupt):
        settings = _settings(listener)
        address = _address(options.host, listener.getsockname()[1])
        print(f"δq is at {address}  (Ctrl-C ends it)", flush=True)
        if options.open:
            import webbrowser

            webbrowser.open(address)
        _run(listener, settings)


def _settings(listener: socket.socket) -> Settings:
    """As the environment has them; on loopback the service has no other names."""
    from ..settings import Settings, SettingsError

    try:
        settings = Settings.from_environment()
    except SettingsError as error:
        raise CommandError(str(error)) from None
    if missing := settings.missing_package():
        raise CommandError(missing)
    if not settings.allowed_hosts and listener.getsockname()[0] in {"127.0.0.1", "::1"}:
        return replace(settings, allowed_hosts=("localhost",))
    return settings


def _port(text: str) -> int:
    number = int(text) if text.isdecimal() else -1
    if not 0 <= number <= 65535:
        raise argparse.ArgumentTypeError(f"a port is a number from 0 to 65535, not {text}")
    return number


def _run(listener: socket.socket, settings: Settings) -> None:
    from ..api.workers.kernels import take_own_folder
    from ..api.workers.worker import start_fork_server

    take_own_folder()
    start_fork_server()  # first of all: it loads SymPy and the kernels while the web server is loaded here
    import uvicorn

    from ..api.app import create_app
    from ..api.connection import ACCEPTED, Timeouts, connections, most_connections
    from ..api.logs import configure
    from ..api.server import Server, give_large_blocks_back

    give_large_blocks_back()
    configure(settings.log_level)
    config = uvicorn.Config(
        create_app(settings),
        http=connections(Timeouts(settings.head_timeout, settings.reading_timeout), most_connections()),  # type: ignore[arg-type]  # makes protocols
        ws="none",
        log_config=None,
        access_log=False,
        server_header=False,
        timeout_keep_alive=15,
        timeout_graceful_shutdown=settings.drain_timeout,
        proxy_headers=False,  # api.clients reads them
        h11_max_incomplete_event_size=32768,
        backlog=ACCEPTED,
    )
    Server(config).run(sockets=[listener])


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
        return f"port {port} is in use. Take another one: deltaq serve --port {min(port + 1, 65535)}"
    if error.errno == errno.EACCES:
        return f"port {port} is not for ordinary users. Take one above 1023: deltaq serve --port 8000"
    return f"cannot listen at {host}: {error.strerror or error}"


def _address(host: str, port: int) -> str:
    shown = {"0.0.0.0": "127.0.0.1", "::": "[::1]"}.get(host, f"[{host}]" if ":" in host else host)  # noqa: S104
    return f"http://{shown}:{port}/"

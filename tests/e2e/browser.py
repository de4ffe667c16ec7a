"""Finding a browser: named by CHROMIUM_PATH, else on PATH, else fetched into a cache folder."""

from __future__ import annotations

import os
import shutil
from functools import cache
from pathlib import Path

from tests.frontend.node import node_folder, run

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
# The last version that runs on node 20.
PACKAGE = "@sparticuz/chromium@147.0.0"
SCRIPT = "import('@sparticuz/chromium').then(async ({default: c}) => console.log(await c.executablePath()))"
FLAGS = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    "--disable-quic",
)


@cache
def chromium() -> str | None:
    """The browser's path, or None if none can be had."""
    named = os.environ.get("CHROMIUM_PATH")
    found = (shutil.which(name) for name in ((named,) if named else NAMES))
    return next((path for path in found if path), None) or _fetched()


def _fetched() -> str | None:
    if node_folder() is None:
        return None
    cache_home = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    folder = cache_home / "deltaq" / "browser"
    folder.mkdir(parents=True, exist_ok=True)
    if not (folder / "node_modules" / "@sparticuz" / "chromium").is_dir():
        done = run(
            "npm", "install", "--ignore-scripts", "--no-audit", "--no-fund", "--prefix", ".", PACKAGE, cwd=folder
        )
        if done.returncode:
            return None
    path = run("node", "--eval", SCRIPT, cwd=folder).stdout.strip()
    return path if path and Path(path).is_file() else None

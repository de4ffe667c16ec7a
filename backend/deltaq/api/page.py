"""A page as it is sent: what all pages have, the lines of its own, and the modules that it needs.

A browser learns what a module imports when it has read the module. Here it is told at once of all that the page's own
module leads to, so that nothing waits for anything.
"""

from __future__ import annotations

import base64
import hashlib
import json
import logging
import os
import re
from functools import lru_cache
from pathlib import Path
from posixpath import dirname, join, normpath

LOGGER = logging.getLogger("deltaq.api")
FRAME = "view/frame.html"

Names = tuple[tuple[str, str], ...]

_IMPORT_MAP = re.compile(r'<script type="importmap"[^>]*>(.*?)</script>', re.DOTALL)
_IMPORT = re.compile(r'(?:^|;)(?:import|export)\b[^;]*?\bfrom ?"([^"]+)"', re.MULTILINE)


def assembled(root: Path, name: str) -> str:
    """The page of <name>.html, which holds what its head has beyond that of others, and of <name>.js."""
    frame = (root / FRAME).read_text(encoding="utf-8")
    module = f"/{name}.js"
    head = [
        *(root / f"{name}.html").read_text(encoding="utf-8").splitlines(),
        *(f'<link rel="modulepreload" href="{address}">' for address in sorted(imported(root, module, names(frame)))),
        f'<script type="module" src="{module}"></script>',
    ]
    return frame.replace("  </head>", "".join(f"    {line}\n" for line in head) + "  </head>")


def import_map_hash(page: str) -> str | None:
    """What script-src must allow for the page's import map, the one inline script there is."""
    found = _IMPORT_MAP.search(page)
    if found is None:
        return None
    return "sha256-" + base64.b64encode(hashlib.sha256(found[1].encode()).digest()).decode()


def names(page: str) -> Names:
    """The import map of a page: addresses by the names that modules use for them."""
    found = _IMPORT_MAP.search(page)
    return tuple(json.loads(found[1])["imports"].items()) if found else ()


def imported(root: Path, module: str, named: Names) -> set[str]:
    """The addresses of all modules that one leads to; those that are fetched later, by import(), do not count.

    What is imported and not there is told in the log, and the page comes without it.
    """
    found: set[str] = set()
    waiting = [module]
    while waiting:
        module = waiting.pop()
        file = f"{root}{module}"
        try:
            modified = os.stat(file).st_mtime_ns  # noqa: PTH116  a Path takes longer, and a page has dozens of modules
        except FileNotFoundError:
            LOGGER.error("the page imports %s, which is not there", module)  # noqa: TRY400  its trace tells no more
            found.discard(module)
            continue
        fresh = _imports(file, module, named, modified) - found
        found |= fresh
        waiting += fresh
    return found


@lru_cache(maxsize=1024)
def _imports(file: str, module: str, named: Names, _modified: int) -> frozenset[str]:
    """What a module itself imports; read again when it has been modified."""
    return frozenset(_address(name, module, dict(named)) for name in _IMPORT.findall(Path(file).read_text("utf-8")))


def _address(name: str, module: str, named: dict[str, str]) -> str:
    """Where a module finds what it calls by a name: beside itself, or by the import map."""
    if name.startswith("."):
        return normpath(join(dirname(module), name))
    if name in named:
        return named[name]
    folder, _, rest = name.partition("/")
    return named.get(f"{folder}/", f"{folder}/") + rest

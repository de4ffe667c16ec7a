"""Which branches of the parser and of the supervisor the tests take, with coverage, which is no dependency.

Run it from the checkout: `python -m tests.branches`. Workers are measured, too, but for those that are killed. It ends
by itself, with 1 if a branch is left out.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

SETTINGS = """
[run]
branch = true
parallel = true
source_pkgs = {package}
data_file = {folder}/data
concurrency = thread, multiprocessing
patch = subprocess, fork, _exit

[report]
fail_under = 100
show_missing = true
skip_covered = true
exclude_also =
    if TYPE_CHECKING:
    ^\\s*def .*: \\.\\.\\.$
# A match over all kinds of nodes does not fall through: mypy sees to that.
partial_also =
    case Equation\\(left, right\\):
    case Negation\\(operand\\) \\| TimeDerivative\\(operand\\):
"""
MEASURED = {"deltaq.language": "tests/language", "deltaq.api.workers": "tests/api/workers"}


def measure(package: str, tests: str) -> bool:
    """Print what is left out; whether that is nothing."""
    with tempfile.TemporaryDirectory() as name:
        file = Path(name) / "settings"
        file.write_text(SETTINGS.format(package=package, folder=name), encoding="utf-8")
        chosen = f"--rcfile={file}"
        coverage(["run", chosen, "-m", "pytest", "-q", "--numprocesses=0", tests], quiet=True)
        coverage(["combine", chosen], quiet=True)  # what a killed process left behind cannot be read
        print(package, flush=True)
        return coverage(["report", chosen]) == 0


def coverage(arguments: list[str], *, quiet: bool = False) -> int:
    """The exit code of a command of coverage."""
    output = subprocess.DEVNULL if quiet else None
    command = [sys.executable, "-m", "coverage", *arguments]
    return subprocess.run(command, check=False, stdout=output, stderr=output).returncode


if __name__ == "__main__":
    complete = [measure(package, tests) for package, tests in MEASURED.items()]
    sys.exit(not all(complete))

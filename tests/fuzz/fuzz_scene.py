"""Coverage-guided fuzzing of the scene loader with atheris, which is no dependency: install it for a run.

    python tests/fuzz/fuzz_scene.py corpus/ -max_total_time=300 -max_len=20000

The seeds are the built-in scenes, in JSON and in TOML; the mutations keep to the structure of documents most of the
time. What must hold for every text: it is a document, or refused with problems. A document is read within two seconds;
each of its problems has a sentence in both languages and points at a field, within its text. What has no errors is
a scene that is written and read back the same.
"""

from __future__ import annotations

import random
import sys
import time
from pathlib import Path
from typing import Any

import atheris

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parents[2] / "backend")]

with atheris.instrument_imports(include=["deltaq.language", "deltaq.mechanics", "deltaq.api.strict_json"]):
    from deltaq.api.strict_json import loads
    from deltaq.errors import InputError, Problem
    from deltaq.mechanics.document import examine, read_scene
    from deltaq.mechanics.library import load_scene, scene_ids
    from deltaq.mechanics.toml import read_toml
    from deltaq.mechanics.writing import write_scene

from tests.fuzz.mutations import mutated, read, write  # noqa: E402

from deltaq.narration.catalog import message  # noqa: E402

SLOW = 2.0  # seconds of processor time, as the service allows
SEEDS = tuple(write_scene(load_scene(identifier)) for identifier in scene_ids())


def one_text(data: bytes) -> None:
    """Read one text as the service would, and check what must hold."""
    problems: tuple[Problem, ...] = ()
    document: Any = None
    try:
        document = loads(data) if data.startswith(b"{") else read_toml(data.decode("utf-8", "replace"))
    except InputError as error:
        problems = error.problems
    tell(problems)
    if isinstance(document, dict):
        one_document(document)


def one_document(document: dict[str, Any]) -> None:
    """Examine one document and check what must hold."""
    scene, problems, took = timed(document)
    if took > SLOW:
        # A pause of the machine does not come twice.
        scene, problems, took = timed(document)
    assert took < SLOW, took
    tell(problems)
    for problem in problems:
        point(document, problem)
    if not any(problem.severity == "error" for problem in problems):
        assert scene is not None
        assert read_scene(write_scene(scene)) == scene


def timed(document: dict[str, Any]) -> tuple[Any, tuple[Problem, ...], float]:
    """What is examined, and the seconds this took."""
    started = time.process_time()
    scene, problems = examine(document)
    return scene, problems, time.process_time() - started


def tell(problems: tuple[Problem, ...]) -> None:
    """Every problem has a sentence in every language."""
    for problem in problems:
        assert all(message(language, problem) for language in ("de", "en")), problem


def point(document: dict[str, Any], problem: Problem) -> None:
    """A problem stands at a field, or at one that is missing in a table or list; an offset lies in its text."""
    part: Any = document
    *parents, last = problem.pointer.split("/") if problem.pointer else [""]
    for name in [*parents[1:], last] if problem.pointer else []:
        assert isinstance(part, dict | list), problem
        part = child(part, name)
    if problem.offset is not None:
        assert isinstance(part, str), problem
        assert 0 <= problem.offset <= len(part), problem
        assert 0 <= (problem.length or 0) <= len(part) - problem.offset, problem


def child(part: Any, name: str) -> Any:
    """A member by its escaped name; names are cut where they are too long."""
    if isinstance(part, list):
        return part[int(name)] if int(name) < len(part) else None
    plain = name.replace("~1", "/").replace("~0", "~")
    return part.get(plain, next((part[key] for key in part if key[:40] == plain), None))


def mutate(data: bytes, largest: int, seed: int) -> bytes:
    """A change of the document most of the time, of its bytes else."""
    draw = random.Random(seed)
    document = read(data)
    if document is None or draw.random() < 0.05:
        return bytes(atheris.Mutate(data, largest))
    return write(mutated(document, SEEDS, draw), toml=draw.random() < 0.2)[:largest]


def write_seeds(folder: Path) -> None:
    """The built-in scenes as first corpus, in JSON and in TOML."""
    folder.mkdir(parents=True, exist_ok=True)
    for document in SEEDS:
        for form in ("json", "toml"):
            (folder / f"seed-{document['id']}.{form}").write_bytes(write(document, toml=form == "toml"))


if __name__ == "__main__":
    if len(sys.argv) > 1 and not Path(sys.argv[1]).is_file():
        write_seeds(Path(sys.argv[1]))
    atheris.Setup(sys.argv, one_text, custom_mutator=mutate)
    atheris.Fuzz()

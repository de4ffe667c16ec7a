"""The command line, run as a user runs it."""

from __future__ import annotations

import json
import os
import re
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import redirect_stderr, redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any
from unittest.mock import patch

import httpx
import pytest

from deltaq import __version__
from deltaq.bench import benchmark_names, run_benchmarks
from deltaq.cli import main
from deltaq.commands._common import compilation_told
from deltaq.contract.simulation import SimulationAnswer
from deltaq.simulation.kernels.compiler import kernel
from deltaq.simulation.kernels.marks import declared, mark

COMMAND = [sys.executable, "-m", "deltaq.cli"]


def command(*arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """A command as `deltaq` runs it, in this process: starting Python each time takes longer than the rest."""
    with (
        redirect_stdout(StringIO()) as out,
        redirect_stderr(StringIO()) as errors,
        patch.dict(os.environ, environment),
    ):
        try:
            code = main(arguments)
        except SystemExit as ended:  # as argparse ends
            code = int(ended.code or 0)
    return subprocess.CompletedProcess(arguments, code, out.getvalue(), errors.getvalue())


@pytest.fixture
def busy_port() -> Iterator[int]:
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        listener.listen()
        yield listener.getsockname()[1]


def test_kernels_that_are_there_are_not_compiled_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    mark(*declared())
    assert main(["compile"]) == 0
    assert capsys.readouterr().out == "all kernels are there\n"


def test_what_is_compiled_on_the_way_is_told(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """On a new machine nobody knows why there is no answer for half a minute."""
    place = tmp_path / "halved.py"
    place.write_text("def halved(x: float) -> float:\n    return 0.5 * x\n", encoding="utf-8")
    namespace: dict[str, Any] = {}
    exec(compile(place.read_text(encoding="utf-8"), str(place), "exec"), namespace)
    compiled = kernel(namespace["halved"])
    with compilation_told():
        assert compiled(3.0) == 1.5
        assert compiled(5.0) == 2.5
    assert compiled(2) == 1.0
    assert capsys.readouterr().err == "deltaq: compiling halved for this machine, once\n"


@pytest.mark.parametrize("arguments", [["scenes"], ["derive", "pendulum"]], ids=["a short text", "a long text"])
def test_a_reader_who_has_read_enough(arguments: list[str]) -> None:
    read, write = os.pipe()
    os.close(read)
    with os.fdopen(write, "w") as unread:
        done = subprocess.run(
            [*COMMAND, *arguments], stdout=unread, stderr=subprocess.PIPE, text=True, check=False, timeout=300
        )
    assert (done.returncode, done.stderr) == (141, "")


def test_serve_prints_the_address_serves_and_ends_on_interrupt() -> None:
    with subprocess.Popen(
        [*COMMAND, "serve", "--port", "0"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as server:
        assert server.stdout is not None
        found = re.fullmatch(r"δq is at (http://127\.0\.0\.1:\d+/)  \(Ctrl-C ends it\)\n", server.stdout.readline())
        assert found is not None
        try:
            answer = httpx.get(f"{found[1]}api/v1/health", timeout=30)
            assert answer.json()["version"] == __version__
            assert "server" not in answer.headers
            rebound = httpx.get(f"{found[1]}api/v1/health", headers={"Host": "attacker.example"}, timeout=30)
            assert rebound.status_code == 421  # on loopback it has no other names
        finally:
            server.send_signal(signal.SIGINT)
            _, errors = server.communicate(timeout=30)
        assert errors == ""
        assert server.returncode in {0, -signal.SIGINT}


def test_the_program_itself_prints_and_ends_as_the_command_does() -> None:
    for arguments in (["scenes"], ["derive", "double-pendulun"]):
        ended = subprocess.run([*COMMAND, *arguments], capture_output=True, text=True, check=False, timeout=300)
        same = command(*arguments)
        assert (ended.returncode, ended.stdout, ended.stderr) == (same.returncode, same.stdout, same.stderr)


def test_busy_port_names_the_remedy(busy_port: int) -> None:
    ended = command("serve", "--port", str(busy_port))
    assert (ended.returncode, ended.stdout) == (2, "")
    remedy = f"deltaq serve --port {busy_port + 1}"
    assert ended.stderr == f"deltaq: port {busy_port} is in use. Take another one: {remedy}\n"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        pytest.param(["serve", "--port", "99999"], "a port is a number from 0 to 65535, not 99999", id="too large"),
        pytest.param(["serve", "--port", "http"], "a port is a number from 0 to 65535, not http", id="port is a word"),
        pytest.param(["serv"], "invalid choice: 'serv'", id="misspelt command"),
    ],
)
def test_wrong_arguments(arguments: list[str], message: str) -> None:
    ended = command(*arguments)
    assert ended.returncode == 2
    assert message in ended.stderr


def test_wrong_setting_is_told_without_a_trace() -> None:
    ended = command("serve", "--port", "0", DELTAQ_WORKERS="none")
    assert (ended.returncode, ended.stderr) == (2, "deltaq: DELTAQ_WORKERS must be a whole number, not 'none'\n")


def test_host_that_does_not_exist() -> None:
    ended = command("serve", "--host", "192.0.2.1", "--port", "0")
    assert ended.returncode == 2
    assert re.fullmatch(r"deltaq: cannot listen at 192\.0\.2\.1: .+\n", ended.stderr)


def test_version(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["--version"])
    assert ended.value.code == 0
    assert capsys.readouterr().out == f"deltaq {__version__}\n"


def test_no_command_shows_the_help(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([]) == 0
    assert "serve the page and the API" in capsys.readouterr().out


@pytest.mark.parametrize("arguments", [["--help"], ["serve", "--help"]], ids=["deltaq", "serve"])
def test_help_lists_the_settings(arguments: list[str]) -> None:
    ended = command(*arguments)
    assert ended.returncode == 0
    assert re.search(r"\n  DELTAQ_QUEUE_LENGTH +jobs that may wait before others are refused \[1024\]\n", ended.stdout)


@pytest.mark.parametrize("module", ["fastapi", "pydantic", "uvicorn", "sympy", "numpy", "asyncio"])
def test_command_line_itself_loads_nothing_heavy(module: str) -> None:
    code = f"import deltaq.cli, sys; sys.exit({module!r} in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_bench_runs_programs_of_the_checkout_by_name(tmp_path: Path) -> None:
    folder = tmp_path / "tests" / "benchmarks"
    folder.mkdir(parents=True)
    (folder / "bench_good.py").write_text("print('12 ns, ratio 3')")
    (folder / "bench_bad.py").write_text("raise SystemExit(3)")
    assert benchmark_names(tmp_path) == ("bad", "good")
    assert run_benchmarks(("good",), tmp_path) == 0
    assert run_benchmarks(("bad", "good"), tmp_path) == 3


def test_unknown_benchmark() -> None:
    found = command("bench", "speed")
    assert found.returncode == 2
    assert found.stderr == f"deltaq: no benchmark speed; there are {', '.join(benchmark_names())}\n"


def test_lab_writes_what_it_found(tmp_path: Path) -> None:
    outputs = [tmp_path / name for name in ("found.json", "found.csv", "found.html")]
    chosen = [part for output in outputs for part in ("--output", str(output))]
    asked = ("--set", "t_end=1", "--set", 'methods=["heun"]', "--set", "fresh=true")
    ended = command("lab", "convergence", "pendulum", *asked, *chosen)
    assert ended.returncode == 0
    steps = [tuple(map(int, line.split("/"))) for line in ended.stderr.splitlines()]
    assert steps == sorted(steps)
    assert 1 < len(steps) <= 11
    assert steps[-1][0] == steps[-1][1]
    found = json.loads(outputs[0].read_text(encoding="utf-8"))
    *files, taken = ended.stdout.splitlines()
    assert files == [f"→ {output}" for output in outputs]
    assert found["taken"]["date"][:10] in taken
    assert found["orders"]["heun"]["theory"] == 2
    assert outputs[1].read_text(encoding="utf-8").startswith("chart,curve,x,y,z\nconvergence,Heun")
    assert "<figure>" in outputs[2].read_text(encoding="utf-8")


def test_lab_takes_a_scene_of_ones_own(tmp_path: Path, root: Path) -> None:
    scene = tmp_path / "own.toml"
    scene.write_text((root / "backend/deltaq/scenes/pendulum.toml").read_text(encoding="utf-8"), encoding="utf-8")
    output = tmp_path / "found.json"
    ended = command("lab", "chaos", str(scene), "--set", "t_end=2", "--output", str(output), "--lang", "de")
    assert ended.returncode == 0
    assert json.loads(output.read_text(encoding="utf-8"))["charts"][0]["title"] == "Zwillinge"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        pytest.param(
            ["chaoss", "pendulum"],
            "deltaq: There is no experiment “chaoss”. Did you mean “chaos”? There are: basins, bifurcation, chaos, "
            "convergence, energy-drift, fidelity, poincare-section, stability, stability-map, uncertainty, "
            "work-precision.\n",
            id="experiment",
        ),
        pytest.param(
            ["chaos", "pendulum", "--set", "speed=1"], "deltaq: /speed: There is no field “speed” here.\n", id="field"
        ),
        pytest.param(["chaos", "nowhere.toml"], "deltaq: nowhere.toml: No such file or directory\n", id="file"),
    ],
)
def test_lab_says_what_is_wrong(arguments: list[str], message: str) -> None:
    ended = command("lab", *arguments)
    assert (ended.returncode, ended.stderr) == (2, message)


def test_scenes_are_listed_with_their_degrees_of_freedom() -> None:
    ended = command("scenes", "--lang", "de")
    assert (ended.returncode, ended.stderr) == (0, "")
    assert re.search(r"^double-pendulum +2  Doppelpendel$", ended.stdout, re.MULTILINE)
    assert re.search(r"^cartesian-pendulum +1  ", ended.stdout, re.MULTILINE)  # two coordinates, a rod


@pytest.mark.parametrize(
    ("form", "beginning", "inside"),
    [
        pytest.param("markdown", "# ", "$$", id="markdown"),
        pytest.param("latex", "\\documentclass", "\\varphi", id="latex"),
        pytest.param("python", "# ", "solve_ivp", id="python"),
        pytest.param("json", "{", '"chapters"', id="json"),
    ],
)
def test_a_derivation_in_each_form(form: str, beginning: str, inside: str) -> None:
    ended = command("derive", "pendulum", "--format", form)
    assert (ended.returncode, ended.stderr) == (0, "")
    assert ended.stdout.startswith(beginning)
    assert inside in ended.stdout


def test_a_notebook_holds_the_derivation_and_a_program_that_runs(tmp_path: Path) -> None:
    output = tmp_path / "pendulum.ipynb"
    ended = command("derive", "pendulum", "--format", "notebook", "--output", str(output))
    assert (ended.returncode, ended.stdout) == (0, f"→ {output}\n")
    notebook = json.loads(output.read_text(encoding="utf-8"))
    kinds = [cell["cell_type"] for cell in notebook["cells"]]
    assert (notebook["nbformat"], kinds[-1], set(kinds[:-1])) == (4, "code", {"markdown"})
    compile("".join(notebook["cells"][-1]["source"]), "cell", "exec")


def test_a_motion_as_a_table() -> None:
    ended = command("simulate", "pendulum", "--t-end", "1", "--samples", "3", "--set", "tolerance=1e-9")
    assert ended.returncode == 0
    assert re.fullmatch(r"deltaq: \S+, \d+ steps\n", ended.stderr)
    rows = [line.split(",") for line in ended.stdout.splitlines()]
    assert rows[0] == ["t", "phi", "dot(phi)", "error"]
    assert [float(row[0]) for row in rows[1:]] == [0.0, 0.5, 1.0]
    assert all(float(row[3]) < 1e-9 for row in rows[1:])


def test_a_motion_that_fails_gives_its_good_part_and_the_reason() -> None:
    euler = ["--set", "method=explicit-euler", "--set", "step=5", "--t-end", "5000"]
    ended = command("simulate", "elastic-pendulum", *euler)
    assert ended.returncode == 2
    assert ended.stdout.startswith("t,")
    assert ended.stderr.startswith("deltaq: ")
    assert "smaller step" in ended.stderr


def test_a_motion_as_json_says_what_the_api_says() -> None:
    ended = command("simulate", "pendulum", "--t-end", "1", "--samples", "3", "--format", "json", "--lang", "de")
    answer = json.loads(ended.stdout)
    assert (answer["status"], answer["reason"]) == ("ok", "Die Bewegung ist bis zum Ende berechnet.")
    assert SimulationAnswer.model_validate(answer).remedy == ""


def test_an_event_is_said_in_words() -> None:
    ended = command("simulate", "string-pendulum", "--t-end", "2", "--samples", "3", "--lang", "de")
    assert ended.returncode == 2
    assert ended.stdout.splitlines()[-1].startswith("0.70772")
    assert "t = 0,707723 s" in ended.stderr
    assert "Der Faden wird schlaff" in ended.stderr


@pytest.mark.parametrize("name", ["derive", "simulate"])
def test_a_scene_that_does_not_exist_is_told_with_the_nearest(name: str) -> None:
    ended = command(name, "double-pendulun")
    assert (ended.returncode, ended.stdout) == (2, "")
    told = "deltaq: /scene: There is no scene “double-pendulun”. Did you mean “double-pendulum”? There are: atwood, "
    assert ended.stderr.startswith(told)
    assert len(re.findall("double-pendulum(?!-)", ended.stderr)) == 2


@pytest.mark.parametrize(
    ("encoding", "code", "told"),
    [
        pytest.param("utf-8-sig", 0, "", id="byte order mark"),
        pytest.param("utf-16", 2, "deltaq: {file} is not in UTF-8; have your editor save it so\n", id="UTF-16"),
    ],
)
def test_a_scene_as_editors_save_it(tmp_path: Path, root: Path, encoding: str, code: int, told: str) -> None:
    file = tmp_path / "scene.toml"
    scene = (root / "backend/deltaq/scenes/pendulum.toml").read_text(encoding="utf-8")
    file.write_text(scene, encoding=encoding)
    ended = command("derive", str(file))
    assert (ended.returncode, ended.stderr) == (code, told.format(file=file))


@pytest.mark.parametrize(
    ("field", "message"),
    [
        pytest.param("guides=3", "deltaq: /guides: An array is needed here.\n", id="no list"),
        pytest.param("speed=1", "deltaq: /speed: There is no field “speed” here.\n", id="no such field"),
        pytest.param("freeze=[1]", "deltaq: /freeze/0: Text is needed here.\n", id="no text"),
        pytest.param('freeze=["x"]', "deltaq: /freeze/0: There is no free coordinate “x”.", id="no coordinate"),
    ],
)
@pytest.mark.parametrize("form", ["json", "markdown"])
def test_derive_says_what_is_wrong(form: str, field: str, message: str) -> None:
    ended = command("derive", "pendulum", "--format", form, "--set", field)
    assert (ended.returncode, ended.stdout) == (2, "")
    assert ended.stderr.startswith(message)


@pytest.mark.parametrize("name", ["derive", "simulate", "check", "lab", "scenes", "export-stack"])
def test_help_ends_with_an_example(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main([name, "--help"])
    assert ended.value.code == 0
    assert f"example: deltaq {name} " in " ".join(capsys.readouterr().out.split())

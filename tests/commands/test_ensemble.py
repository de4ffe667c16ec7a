"""`deltaq ensemble` as a user runs it: tables of runs, statistics and points; what is said, and what is wrong."""

from __future__ import annotations

import csv
import json
from io import StringIO
from pathlib import Path

import numpy as np
import pytest
from tests.test_cli import command

PENDULUM = ["ensemble", "pendulum", "--t-end", "3", "--set", "samples=3"]
ANGLES = ["--vary", "initial.phi.value=[0.5,2.0,0.0]"]
CLOUD = ["--vary", 'initial.phi.value={"normal":[1,0.1],"count":200,"seed":4}']


def rows(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(StringIO(text)))


def column(table: list[dict[str, str]], name: str) -> np.ndarray:
    return np.array([float(row[name]) for row in table])


def answer(*arguments: str) -> dict[str, object]:
    found: dict[str, object] = json.loads(command(*arguments, "--format", "json").stdout)
    return found


def test_a_row_for_each_run() -> None:
    done = command(*PENDULUM, *ANGLES, "--vary", 'parameters.l={"from":0.5,"to":1,"count":2}')
    table = rows(done.stdout)
    assert done.returncode == 0
    assert list(table[0]) == ["initial.phi.value", "parameters.l", "status", "error", "phi"]
    assert column(table, "initial.phi.value").tolist() == [0.5, 0.5, 2.0, 2.0, 0.0, 0.0]
    assert [row["status"] for row in table] == ["ok"] * 6
    assert "6 runs done" in done.stderr
    assert "deltaq: 6 runs ok: The motion was computed up to the end." in done.stderr


def test_a_row_of_statistics_for_each_time() -> None:
    """They are those of the answer; densities integrate to one."""
    asked = [*PENDULUM, *CLOUD, "--statistics", "mean", "quantiles", "density"]
    table, whole = rows(command(*asked).stdout), answer(*asked)
    assert column(table, "t").tolist() == whole["t"] == [0.0, 1.5, 3.0]
    assert column(table, "phi mean").tolist() == whole["mean"]["phi"]  # type: ignore[index]
    names = list(table[0])
    assert names[1:7] == ["phi mean", "phi 5%", "phi 25%", "phi 50%", "phi 75%", "phi 95%"]
    quantiles = np.array([column(table, name) for name in names[2:7]])
    assert (np.diff(quantiles, axis=0) > 0.0).all()
    edges = np.array(whole["density"]["phi"]["edges"])  # type: ignore[index]
    densities = np.array([column(table, name) for name in names[7:]])
    np.testing.assert_allclose(np.diff(edges) @ densities, 1.0, rtol=1e-12)
    assert names[7] == f"phi {edges[0]:.6g} … {edges[1]:.6g}"


def test_a_row_for_each_point_of_a_section() -> None:
    """At its lowest point φ̇² = 2g(1 − cos φ₀)/l; a pendulum that hangs lies in the section, and is counted once."""
    done = command(
        *PENDULUM, *ANGLES, "--section", "phi", "--direction", "both", "--set", 'parameters={"l":1,"g":9.81}'
    )
    table = rows(done.stdout)
    assert list(table[0]) == ["run", "initial.phi.value", "t", "t_error", "phi", "dot(phi)", "error"]
    assert {row["run"] for row in table} == {"0", "1"}
    begins, rates = column(table, "initial.phi.value"), column(table, "dot(phi)")
    np.testing.assert_allclose(rates**2, 2.0 * 9.81 * (1.0 - np.cos(begins)), rtol=1e-13)
    assert column(table, "error").max() < 1e-13
    assert "deltaq: 1 runs contained: " in done.stderr
    assert "deltaq: 3 runs ok: " in done.stderr


WHICH = [
    pytest.param([], "status", id="runs"),
    pytest.param(["--statistics", "mean"], "phi mean", id="statistics"),
    pytest.param(["--set", 'statistics=["mean"]'], "phi mean", id="statistics as a field"),
    pytest.param(["--statistics", "mean", "--section", "phi"], "t_error", id="section before statistics"),
    pytest.param(["--statistics", "mean", "--section", "phi", "--table", "statistics"], "phi mean", id="said"),
    pytest.param(["--section", "phi", "--table", "runs"], "status", id="runs though there are points"),
    pytest.param(["--set", "runs=false", "--statistics", "mean", "--table", "runs"], "error", id="runs without ends"),
]


@pytest.mark.parametrize(("options", "name"), WHICH)
def test_which_table_is_written(options: list[str], name: str) -> None:
    assert name in rows(command(*PENDULUM, *ANGLES, *options).stdout)[0]


WRONG = [
    pytest.param(["--table", "section"], "--table section needs --section", id="no section"),
    pytest.param(["--table", "statistics"], "--table statistics needs --statistics", id="no statistics"),
    pytest.param(["--section", "phi +"], "/section/value: ", id="expression"),
    pytest.param(["--section", "phi", "--points", "0"], "/section/points: ", id="no points"),
    pytest.param(["--section", "phi", "--direction", "up"], "invalid choice: 'up'", id="direction"),
    pytest.param(["--statistics", "mode"], "invalid choice: 'mode'", id="statistic"),
    pytest.param(["--vary", "phi=nan?"], "values are JSON", id="no JSON"),
    pytest.param(["--t-end", "1e300"], "/t_end: ", id="without end"),
]


@pytest.mark.parametrize(("options", "message"), WRONG)
def test_what_is_wrong_is_told_at_its_place(options: list[str], message: str) -> None:
    done = command(*PENDULUM, *ANGLES, *options)
    assert (done.returncode, done.stdout) == (2, "")
    assert message in done.stderr
    assert "Traceback" not in done.stderr


def test_without_a_cluster_that_answers_this_machine_does_it(tmp_path: Path) -> None:
    here, there = tmp_path / "here.csv", tmp_path / "there.csv"
    asked = [*PENDULUM, *CLOUD, "--statistics", "mean"]
    assert command(*asked, "--output", str(here)).returncode == 0
    done = command(*asked, "--output", str(there), "--scheduler", "tcp://127.0.0.1:1", DELTAQ_SCHEDULER="")
    assert done.stdout == f"→ {there}\n"
    assert there.read_text(encoding="utf-8") == here.read_text(encoding="utf-8")

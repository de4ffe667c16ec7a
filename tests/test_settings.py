from __future__ import annotations

import os
import re
import subprocess
import sys
from dataclasses import Field, fields
from pathlib import Path
from typing import Any

import pytest

import deltaq
from deltaq.settings import Settings, SettingsError, described


def test_defaults_need_no_environment() -> None:
    assert Settings.from_environment({}) == Settings()
    assert Settings().workers >= 2


def test_every_variable_that_the_code_names_is_a_setting() -> None:
    """Else the service would refuse to start with a variable that some part of it reads."""
    package = Path(deltaq.__file__).parent
    named = {v for file in package.rglob("*.py") for v in re.findall(r"DELTAQ_[A-Z_]+", file.read_text("utf-8"))}
    known = {f"DELTAQ_{field.name.upper()}" for field in fields(Settings)}
    assert named - {"DELTAQ_"} <= known


def test_environment_changes_what_it_names(tmp_path: Path) -> None:
    settings = Settings.from_environment(
        {"DELTAQ_WORKERS": "7", "DELTAQ_QUEUE_PATIENCE": "0.5", "DELTAQ_STATIC": str(tmp_path), "HOME": "/"}
    )
    assert settings == Settings(workers=7, queue_patience=0.5, static=str(tmp_path))


def test_lists_are_separated_by_commas() -> None:
    settings = Settings.from_environment(
        {"DELTAQ_CORS_ORIGINS": "https://a.example,http://b.example:81 ,", "DELTAQ_ALLOWED_HOSTS": ""}
    )
    assert settings == Settings(cors_origins=("https://a.example", "http://b.example:81"))


@pytest.mark.parametrize(
    ("variable", "value", "message"),
    [
        pytest.param("DELTAQ_WORKERS", "many", "DELTAQ_WORKERS must be a whole number, not 'many'", id="not a number"),
        pytest.param("DELTAQ_WORKERS", "0", "DELTAQ_WORKERS must be at least 1", id="no workers"),
        pytest.param("DELTAQ_QUEUE_LENGTH", "-5", "DELTAQ_QUEUE_LENGTH must be at least 1", id="negative"),
        pytest.param("DELTAQ_EXPERIMENT_WORKERS", "0", "DELTAQ_EXPERIMENT_WORKERS must be at least 1", id="no lab"),
        pytest.param("DELTAQ_SIMULATION_DEADLINE", "-1", "DELTAQ_SIMULATION_DEADLINE must be above 0", id="no time"),
        pytest.param("DELTAQ_QUEUE_PATIENCE", "nan", "DELTAQ_QUEUE_PATIENCE must be above 0", id="time that is none"),
        pytest.param(
            "DELTAQ_WORKER_MEMORY",
            "300000000",
            "DELTAQ_WORKER_MEMORY must be at least 1073741824: the libraries need it",
            id="too little memory",
        ),
        pytest.param(
            "DELTAQ_LOG_LEVEL",
            "loud",
            "DELTAQ_LOG_LEVEL must be one of debug, info, warning, error, not 'loud'",
            id="no such level",
        ),
        pytest.param(
            "DELTAQ_FRAME_ANCESTORS",
            "https://moodle.example.org, 'none'; script-src *",
            "DELTAQ_FRAME_ANCESTORS needs origins such as https://example.org, not \"'none'; script-src *\"",
            id="a policy where an origin belongs",
        ),
    ],
)
def test_wrong_value(variable: str, value: str, message: str) -> None:
    with pytest.raises(SettingsError) as caught:
        Settings.from_environment({variable: value})
    assert str(caught.value) == message


NUMBERS = [f for f in fields(Settings) if f.type in ("int", "float")]
NONSENSE = {
    "int": [
        "",
        "many",
        "nan",
        "inf",
        "1.5",
        "1e3",
        "1_000",
        "０",
        "0x10",
        "-1",
        "9" * 30,
        "1 2",
        "1000000000000000000",
    ],
    "float": [
        "",
        "many",
        "nan",
        "inf",
        "-inf",
        "infinity",
        "1_0",
        "1e999",
        "-1",
        "-0.1",
        "0x1p3",
        "1,5",
        "１",
        "9" * 30,
    ],
}


@pytest.mark.parametrize("f", NUMBERS, ids=[f.name for f in NUMBERS])
def test_no_number_is_nonsense(f: Field[Any]) -> None:
    """Neither none at all, nor one without an end, nor below zero: each is refused by its name in one sentence."""
    variable = f"DELTAQ_{f.name.upper()}"
    for value in NONSENSE[str(f.type)]:
        with pytest.raises(SettingsError) as caught:
            Settings.from_environment({variable: value})
        assert str(caught.value).startswith(f"{variable} must be "), value
        assert "\n" not in str(caught.value)


LISTS = {
    "trusted_proxies": (
        [
            "10.0.0.0/33",
            "10.0.0.1/8",
            "0.0.0.0/0",
            "::/0",
            "*",
            "proxy",
            "10.0.0",
            "10.0.0.256",
            "10.0.0.5:80",
            "fe80::1/129",
        ],
        ["127.0.0.1", "::1", "10.0.0.5", "10.2.0.0/16", "2001:db8::/32"],
    ),
    "allowed_hosts": (
        [
            "example.org:8000",
            "https://example.org",
            "example.org/x",
            "a b",
            "*",
            "a..b",
            "[::1]:80",
            "-a.org",
            "a" * 300,
            "*.*.org",
        ],
        ["example.org", "*.example.org", "192.0.2.1", "2001:db8::1", "localhost", "deltaq_1"],
    ),
    "frame_ancestors": (
        [
            "example.org",
            "https://",
            "https://e.org/x",
            "https://e.org:0",
            "https://e.org:99999",
            "https://a@e.org",
            "'self'",
            "ftp://e.org",
        ],
        ["https://e.org", "http://localhost:8080", "https://*.e.org", "*", "https://[2001:db8::1]:8443"],
    ),
    "cors_origins": (
        [
            "null",
            "https://*.e.org",
            "https://e.org/",
            "https://e.org;x",
            "e.org:80",
            "http://e.org:x",
            "https://e .org",
        ],
        ["https://e.org", "http://localhost:8080", "*"],
    ),
    "redis": (
        ["host:6379", "http://host", "redis://", "redis://host:99999", "redis://host:x", "redis://[::1", "redis://a b"],
        ["redis://host", "redis://:password@host:6379/0", "rediss://host:6380", "unix:///run/redis.socket"],
    ),
    "scheduler": (["host:8786", "http://host", "tcp://", "tcp://host:99999"], ["tcp://host:8786", "tls://host:8786"]),
    "log_level": (["loud", "INFO", ""], ["debug", "error"]),
    "static": (["/nowhere", "/etc/passwd"], ["", "/tmp"]),
    "cache_folder": (["/etc/passwd", "/etc/passwd/below", "/dev/null"], ["", "/tmp", "/tmp/not-there-yet"]),
}


def test_each_setting_has_its_nonsense() -> None:
    assert {f.name for f in NUMBERS} | LISTS.keys() == {f.name for f in fields(Settings)}


@pytest.mark.parametrize("name", LISTS)
def test_no_text_is_nonsense(name: str) -> None:
    wrong, right = LISTS[name]
    variable = f"DELTAQ_{name.upper()}"
    for value in wrong:
        with pytest.raises(SettingsError) as caught:
            Settings.from_environment({variable: value})
        assert str(caught.value).startswith(f"{variable} "), value
        assert "\n" not in str(caught.value)
    for value in right:
        assert getattr(Settings.from_environment({variable: value}), name) in (value, (value,), ())


@pytest.mark.parametrize(
    ("name", "address", "package"),
    [("redis", "redis://localhost", "redis"), ("scheduler", "tcp://localhost:8786", "distributed")],
)
def test_a_missing_package_is_named(name: str, address: str, package: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("deltaq.settings.find_spec", lambda wanted: None)
    told = Settings.from_environment({f"DELTAQ_{name.upper()}": address}).missing_package()
    assert told.startswith(f"DELTAQ_{name.upper()} needs the package {package}: pip install 'deltaq[")
    assert Settings().missing_package() == ""


def test_the_service_says_so_before_it_says_where_it_is(tmp_path: Path) -> None:
    """Whatever is wrong with a setting: one sentence, no traceback, no address."""
    (tmp_path / "sitecustomize.py").write_text("import sys; sys.modules['redis'] = None")  # as if it were not installed
    path = os.pathsep.join([str(tmp_path), *filter(None, [os.environ.get("PYTHONPATH")])])
    for settings in ({"DELTAQ_CLIENT_SHARE": "nan"}, {"DELTAQ_REDIS": "redis://localhost"}):
        done = subprocess.run(
            [sys.executable, "-m", "deltaq.cli", "serve", "--port", "0"],
            env=os.environ | {"PYTHONPATH": path} | settings,
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )
        (name,) = settings
        assert (done.returncode, done.stdout, done.stderr.count("\n")) == (2, "", 1), done.stderr
        assert done.stderr.startswith(f"deltaq: {name} ")


def test_misspelt_setting_is_not_ignored() -> None:
    with pytest.raises(SettingsError, match=r"^unknown settings: DELTAQ_WORKER; known are DELTAQ_WORKERS, "):
        Settings.from_environment({"DELTAQ_WORKER": "3"})


def test_each_setting_is_described() -> None:
    lines = list(described())
    assert [line.split()[0] for line in lines] == [f"DELTAQ_{field.name.upper()}" for field in fields(Settings)]
    assert all(len(line) > 35 for line in lines)

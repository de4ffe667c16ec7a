from __future__ import annotations

import re
from dataclasses import fields
from pathlib import Path

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


def test_environment_changes_what_it_names() -> None:
    settings = Settings.from_environment(
        {"DELTAQ_WORKERS": "7", "DELTAQ_QUEUE_PATIENCE": "0.5", "DELTAQ_STATIC": "/srv/page", "HOME": "/"}
    )
    assert settings == Settings(workers=7, queue_patience=0.5, static="/srv/page")


def test_lists_are_separated_by_commas() -> None:
    settings = Settings.from_environment(
        {"DELTAQ_CORS_ORIGINS": "https://a.example,http://b.example:81 ,", "DELTAQ_ALLOWED_HOSTS": ""}
    )
    assert settings == Settings(cors_origins=("https://a.example", "http://b.example:81"))


@pytest.mark.parametrize(
    ("variable", "value", "message"),
    [
        pytest.param("DELTAQ_WORKERS", "many", "DELTAQ_WORKERS must be a number, not 'many'", id="not a number"),
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


def test_misspelt_setting_is_not_ignored() -> None:
    with pytest.raises(SettingsError, match=r"^unknown settings: DELTAQ_WORKER; known are DELTAQ_WORKERS, "):
        Settings.from_environment({"DELTAQ_WORKER": "3"})


def test_each_setting_is_described() -> None:
    lines = list(described())
    assert [line.split()[0] for line in lines] == [f"DELTAQ_{field.name.upper()}" for field in fields(Settings)]
    assert all(len(line) > 35 for line in lines)

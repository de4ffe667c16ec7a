"""Slow clients, gone clients, and the end of the service, over real sockets."""

from __future__ import annotations

import json
import signal
import socket
import ssl
import threading
import time
from collections.abc import Iterator
from contextlib import suppress

import httpx
import pytest
from tests.serving import PATIENCE, PATIENT, Served, served

HEAVY = {"scene": "chain-pendulum", "method": "radau-5", "t_end": 200.0, "tolerance": 1e-12}  # many seconds of work


@pytest.fixture(scope="module")
def service() -> Iterator[Served]:
    with served(workers=1, head_timeout=0.5, reading_timeout=0.5, body_timeout=0.5) as one:
        httpx.get(f"{one.address}api/v1/health", timeout=PATIENCE)
        yield one


def connected(service: Served) -> socket.socket:
    return socket.create_connection(service.place, timeout=PATIENCE)


def received(connection: socket.socket) -> int:
    """How many bytes come before the server ends the connection; TimeoutError if it does not."""
    count = 0
    with suppress(ConnectionResetError):
        while part := connection.recv(2**16):
            count += len(part)
    return count


@pytest.mark.parametrize(
    "beginning",
    [
        pytest.param(b"", id="nothing at all"),
        pytest.param(b"GET /api/v1/health HT", id="half a line"),
        pytest.param(b"GET /api/v1/health HTTP/1.1\r\nHost: localhost\r\nX-A: ", id="half a header"),
        pytest.param(b"GET /api/v1/health HTTP/1.1\r\nHost: localhost\r\n\r\nGET /", id="half of the second request"),
        pytest.param(
            b"GET /app.js HTTP/1.1\r\nHost: localhost\r\nContent-Length: 9\r\n\r\nx", id="body that is not wanted"
        ),
        pytest.param(
            b"POST /api/v1/tasks HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
            b"Content-Length: 9\r\n\r\n{",
            id="half a body",
        ),
    ],
)
def test_slow_sender_is_cut_off(service: Served, beginning: bytes) -> None:
    with connected(service) as connection:
        connection.sendall(beginning)
        received(connection)


def test_head_that_drips_is_cut_off(service: Served) -> None:
    with connected(service) as connection:
        connection.sendall(b"GET / HTTP/1.1\r\n")
        with pytest.raises(OSError, match=r"reset|[Bb]roken pipe"):  # noqa: PT012  each of the sends may be the one
            for number in range(100):
                connection.sendall(f"X-{number}: 1\r\n".encode())
                time.sleep(0.1)


@pytest.mark.parametrize(
    "head",
    [
        pytest.param(b"GET / HTTP/1.1\r\nHost: localhost\r\nX-A: " + b"x" * 100_000 + b"\r\n\r\n", id="a long header"),
        pytest.param(b"GET / HTTP/1.1\r\nHost: localhost\r\n" + 20_000 * b"X-A: 1\r\n" + b"\r\n", id="many headers"),
        pytest.param(b"GET /" + b"x" * 100_000 + b" HTTP/1.1\r\nHost: localhost\r\n\r\n", id="a long address"),
    ],
)
def test_large_head_is_refused(service: Served, head: bytes) -> None:
    with connected(service) as connection:
        with suppress(ConnectionError):  # it may refuse before it has got all
            connection.sendall(head)
        with suppress(ConnectionError):
            assert connection.recv(2**16).startswith((b"HTTP/1.1 400", b"HTTP/1.1 431"))
    assert httpx.get(f"{service.address}api/v1/health", timeout=PATIENCE).status_code == 200


def test_slow_reader_is_cut_off(service: Served) -> None:
    """Long answers are asked for, and none is read; on a busy machine it may take the service a while to write them."""
    long = 100 * len(httpx.get(f"{service.address}api/v1/catalogs/de", timeout=PATIENCE).content)
    assert any(unread(service, seconds) < long for seconds in (2.0, 4.0, 8.0, 16.0))


def unread(service: Served, seconds: float) -> int:
    """How much comes of 300 long answers if they are read that late."""
    request = b"GET /api/v1/catalogs/de HTTP/1.1\r\nHost: localhost\r\n\r\n"
    with socket.socket() as connection:
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        connection.connect(service.place)
        connection.settimeout(PATIENCE)
        connection.sendall(300 * request)
        time.sleep(seconds)
        return received(connection)


def test_patient_connection_is_kept(service: Served) -> None:
    with httpx.Client(base_url=service.address, timeout=PATIENCE) as client:
        for _ in range(3):
            assert client.get("/api/v1/health").status_code == 200
            time.sleep(0.3)


def asked(service: Served, name: str) -> httpx.Response:
    """What it says of itself, asked again and again: to read the certificates of all authorities takes most of it."""
    none = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    return httpx.get(f"{service.address}api/v1/{name}", timeout=PATIENCE, verify=none)


def workers(service: Served, what: str) -> int:
    count: int = asked(service, "health").json()["workers"][what]
    return count


def busy(service: Served) -> int:
    return workers(service, "busy")


def settled(service: Served) -> None:
    """Wait until it is up and has compiled what was not compiled yet."""
    quiet = 0
    while quiet < 3:
        time.sleep(0.2)
        ready = asked(service, "ready").status_code == 200
        quiet = quiet + 1 if ready and not busy(service) else 0


def within(seconds: float, service: Served, wanted: int) -> bool:
    """Whether as many workers as wanted are at work before the time is over."""
    end = time.monotonic() + seconds
    while busy(service) != wanted and time.monotonic() < end:
        time.sleep(0.05)
    return busy(service) == wanted


def ask(service: Served) -> socket.socket:
    """A connection on which a long computation has been asked for."""
    body = json.dumps(HEAVY).encode()
    head = f"POST /api/v1/simulations HTTP/1.1\r\nHost: localhost\r\nContent-Length: {len(body)}\r\n"
    connection = connected(service)
    connection.sendall(head.encode() + b"Content-Type: application/json\r\n\r\n" + body)
    return connection


@pytest.fixture(scope="module")
def patient() -> Iterator[Served]:
    """One worker, so that all who ask for something long ask the same one."""
    with served(workers=1, simulation_deadline=60) as one:
        yield one


def test_work_stops_when_its_client_has_gone(patient: Served) -> None:
    settled(patient)
    kills = workers(patient, "kills")
    with ask(patient):
        assert within(20.0, patient, 1)
    assert within(4.0, patient, 0)
    assert workers(patient, "kills") == kills  # it was given up, not killed for a fault


def measuring(service: Served) -> bool:
    """Whether an experiment is under way."""
    return 'deltaq_workers_busy{pool="experiments"} 1.0' in asked(service, "metrics").text


def test_experiment_stops_when_the_last_who_hears_it_has_gone(patient: Served) -> None:
    question, stream = {"scene": "triple-pendulum", "t_end": 77.0, "peers": True}, {"Accept": "text/event-stream"}
    settled(patient)
    while measuring(patient):  # it still compiles
        time.sleep(0.2)
    address = f"{patient.address}api/v1/experiments/work-precision"
    with httpx.stream("POST", address, json=question, headers=stream, timeout=PATIENCE) as first:
        heard = first.iter_lines()  # whose end would be that of the connection
        assert "event: part" in heard  # behind comments, while nothing else is told
        with httpx.stream("POST", address, json=question, headers=stream, timeout=PATIENCE) as second:
            heard_too = second.iter_lines()
            assert "event: part" in heard_too
        time.sleep(1.5)
        assert measuring(patient)
    end = time.monotonic() + PATIENCE / 8
    while measuring(patient) and time.monotonic() < end:
        time.sleep(0.05)
    assert not measuring(patient)


def test_ensemble_stops_when_who_hears_it_has_gone(patient: Served) -> None:
    """After some blocks of very many; nobody else hears a stream of blocks."""
    values = {"from": 0.1, "to": 1.0, "count": 5000}
    question = {"scene": "triple-pendulum", "t_end": 90.0, "vary": {"initial.phi1.value": values}, "tolerance": 1e-12}
    settled(patient)
    kills, stream = workers(patient, "kills"), {"Accept": "text/event-stream"}
    address = f"{patient.address}api/v1/ensembles"
    with httpx.stream("POST", address, json=question, headers=stream, timeout=PATIENCE) as response:
        assert "event: block" in response.iter_lines()
        assert busy(patient) == 1
    assert within(4.0, patient, 0)
    assert workers(patient, "kills") == kills


def test_work_goes_on_while_anybody_waits_for_it(patient: Served) -> None:
    settled(patient)
    with ask(patient):
        with ask(patient):
            assert within(20.0, patient, 1)
        time.sleep(1.5)
        assert busy(patient) == 1


def test_requests_under_way_are_answered_when_the_service_ends() -> None:
    with served(workers=1, drain_timeout=300, **PATIENT) as service:
        settled(service)
        answers: list[httpx.Response] = []
        address, question = f"{service.address}api/v1/simulations", HEAVY | {"t_end": 15.0}
        asking = threading.Thread(target=lambda: answers.append(httpx.post(address, json=question, timeout=PATIENCE)))
        asking.start()
        assert within(20.0, service, 1)
        service.process.send_signal(signal.SIGTERM)
        asking.join(300.0)
        assert [answer.status_code for answer in answers] == [200]
        service.process.communicate(timeout=PATIENCE)
        with pytest.raises(httpx.ConnectError):
            httpx.get(f"{service.address}api/v1/health")


def heard(service: Served, texts: list[str]) -> None:
    """All that the stream of a long experiment says."""
    question, stream = {"scene": "triple-pendulum", "t_end": 71.0, "peers": True}, {"Accept": "text/event-stream"}
    address = f"{service.address}api/v1/experiments/work-precision"
    texts.append(httpx.post(address, json=question, headers=stream, timeout=PATIENCE).text)


def test_those_who_still_wait_when_the_service_ends_are_told_so() -> None:
    with served(workers=1, drain_timeout=2, simulation_deadline=120) as service:
        settled(service)
        while measuring(service):  # it still compiles
            time.sleep(0.2)
        answers: list[httpx.Response] = []
        texts: list[str] = []
        address = f"{service.address}api/v1/simulations"
        asking = [
            threading.Thread(target=lambda: answers.append(httpx.post(address, json=HEAVY, timeout=PATIENCE))),
            threading.Thread(target=heard, args=(service, texts)),
        ]
        for one in asking:
            one.start()
        assert within(20.0, service, 1)
        end = time.monotonic() + 60
        while not measuring(service) and time.monotonic() < end:
            time.sleep(0.05)
        service.process.send_signal(signal.SIGTERM)
        for one in asking:
            one.join(60)
    assert [(answer.status_code, answer.json()["type"]) for answer in answers] == [(503, "/problems/interrupted")]
    assert answers[0].headers["content-type"] == "application/problem+json"
    last = texts[0].strip().split("\n\n")[-1].split("\n")
    assert last[0] == "event: problem"
    assert json.loads(last[1].removeprefix("data: "))["type"] == "/problems/interrupted"

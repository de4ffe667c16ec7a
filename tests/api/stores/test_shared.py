"""Answers shared through Redis: a real one where it is installed, and none at all."""

from __future__ import annotations

import shutil
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from redis import Redis, RedisError

from deltaq.api.stores import shared
from deltaq.api.stores.shared import PREFIX, Shared

KEY, OTHER = "0123456789abcdef" * 2, "fedcba9876543210" * 2
SERVER = shutil.which("redis-server")
needs_redis = pytest.mark.skipif(SERVER is None, reason="there is no redis-server")


class RedisServer:
    """A Redis at a socket in a folder, which can be stopped and started."""

    def __init__(self, folder: Path) -> None:
        self.socket = folder / "redis.socket"
        self.command = [str(SERVER), "--port", "0", "--unixsocket", str(self.socket), "--dir", str(folder)]
        self.start()

    def start(self) -> None:
        self.process = subprocess.Popen([*self.command, "--save", ""], stdout=subprocess.DEVNULL)
        while not self._answers():  # its socket is there before it listens
            assert self.process.poll() is None, "redis-server has ended"
            time.sleep(0.01)

    def _answers(self) -> bool:
        try:
            return bool(Redis.from_url(self.address).ping())
        except RedisError:
            return False

    def stop(self) -> None:
        self.process.terminate()
        self.process.wait()
        self.socket.unlink(missing_ok=True)

    @property
    def address(self) -> str:
        return f"unix://{self.socket}"


@pytest.fixture
def server(tmp_path: Path) -> Iterator[RedisServer]:
    one = RedisServer(tmp_path)
    yield one
    one.stop()


@needs_redis
def test_replicas_share_answers(server: RedisServer) -> None:
    one, other = Shared(server.address), Shared(server.address)
    assert other.load(KEY) is None
    one.save(KEY, b"answer")
    assert (other.load(KEY), other.load(OTHER)) == (b"answer", None)


@needs_redis
@pytest.mark.parametrize("content", [b"", b"x" * 40], ids=["empty", "something else"])
def test_damaged_answer_is_missing(server: RedisServer, content: bytes) -> None:
    Redis.from_url(server.address).set(PREFIX + KEY, content)
    assert Shared(server.address).load(KEY) is None


@needs_redis
def test_redis_that_goes_and_comes_back(server: RedisServer, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shared, "PAUSE", 0.0)
    store = Shared(server.address)
    store.save(KEY, b"answer")
    server.stop()
    assert store.load(KEY) is None
    store.save(OTHER, b"lost")
    server.start()
    assert store.load(KEY) is None  # it was in memory only
    store.save(KEY, b"answer")
    assert store.load(KEY) == b"answer"


def test_redis_that_is_gone_is_left_alone_for_a_while(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    store = Shared(f"unix://{tmp_path}/nothing")
    store.save(KEY, b"answer")
    assert [store.load(KEY) for _ in range(100)] == [None] * 100
    assert [record.message for record in caplog.records] == ["Redis does not answer: ConnectionError"]

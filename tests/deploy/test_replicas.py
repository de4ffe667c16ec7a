"""Three replicas with a Redis behind nginx, for real where both are installed: the configuration that is shipped."""

from __future__ import annotations

import shutil
import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

import httpx
import pytest
from tests.serving import Served, served

NGINX, REDIS = shutil.which("nginx"), shutil.which("redis-server")
pytestmark = pytest.mark.skipif(not (NGINX and REDIS), reason="needs nginx and redis-server")
MAIN = """
user root; daemon off; master_process off; pid {folder}/pid; error_log {folder}/errors;
events {{}}
http {{
    access_log off;
    client_body_temp_path {folder}/body; proxy_temp_path {folder}/proxy; fastcgi_temp_path {folder}/fastcgi;
    uwsgi_temp_path {folder}/uwsgi; scgi_temp_path {folder}/scgi;
    include {folder}/site;
}}
"""


@dataclass(frozen=True)
class Site:
    """The replicas, and the address of the proxy in front of them."""

    replicas: tuple[Served, ...]
    address: str

    def count(self, name: str) -> int:
        """The sum of a cache's count over all replicas that are up."""
        up = [one for one in self.replicas if one.process.poll() is None]
        health = [httpx.get(f"{one.address}api/v1/health").json()["cache"] for one in up]
        return sum(one[name] for one in health)


def free_port() -> int:
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        port: int = one.getsockname()[1]
        return port


def configure(folder: Path, root: Path, replicas: tuple[Served, ...], port: int) -> Path:
    """The shipped configuration with the replicas and the port of this test."""
    site = (root / "backend/deploy/nginx.conf").read_text(encoding="utf-8")
    servers = " ".join(f"server {one.place[0]}:{one.place[1]} max_fails=1 fail_timeout=5s;" for one in replicas)
    changed = site.replace("server deltaq:8000 max_fails=1 fail_timeout=5s;", servers)
    changed = changed.replace("listen 80;", f"listen 127.0.0.1:{port};")
    assert changed.count("127.0.0.1") == 4
    (folder / "site").write_text(changed, encoding="utf-8")
    (folder / "main").write_text(MAIN.format(folder=folder), encoding="utf-8")
    return folder / "main"


def run(stack: ExitStack, command: list[str | None]) -> None:
    """A process that is killed at the end."""
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    process = stack.enter_context(subprocess.Popen([str(part) for part in command], **quiet))
    stack.callback(process.kill)


@pytest.fixture
def site(tmp_path: Path, root: Path) -> Iterator[Site]:
    with ExitStack() as stack:
        address = f"unix://{tmp_path}/redis.socket"
        redis = [REDIS, "--port", "0", "--unixsocket", f"{tmp_path}/redis.socket", "--save", "", "--dir", str(tmp_path)]
        run(stack, redis)
        replicas = tuple(stack.enter_context(served(workers=1, redis=address)) for _ in range(3))
        port = free_port()
        nginx = [NGINX, "-p", str(tmp_path), "-c", str(configure(tmp_path, root, replicas, port))]
        run(stack, nginx)
        one = Site(replicas, f"http://127.0.0.1:{port}")
        wait_until_up(one)
        yield one


def wait_until_up(site: Site) -> None:
    end = time.monotonic() + 60.0
    for address in (*(one.address.rstrip("/") for one in site.replicas), site.address):
        while time.monotonic() < end:
            try:
                if httpx.get(f"{address}/api/v1/ready", timeout=60).status_code == 200:
                    break
            except httpx.TransportError:
                pass
            time.sleep(0.1)


def derive(site: Site, mass: float) -> httpx.Response:
    question = {"scene": "pendulum", "parameters": {"m": mass}}
    return httpx.post(f"{site.address}/api/v1/derivations", json=question, timeout=60)


def test_replicas_share_their_answers(site: Site) -> None:
    first = derive(site, 1.5)
    assert first.status_code == 200
    assert {derive(site, 1.5).content for _ in range(12)} == {first.content}
    assert site.count("misses") == 1
    found = httpx.get(f"{site.address}{first.headers['content-location']}", timeout=60)
    assert (found.status_code, found.json()) == (200, first.json())


def test_a_replica_that_is_lost_costs_no_request(site: Site) -> None:
    site.replicas[0].process.kill()
    assert [derive(site, 2.0 + number).status_code for number in range(8)] == [200] * 8


def test_metrics_are_not_for_everybody(site: Site) -> None:
    assert httpx.get(f"{site.address}/api/v1/metrics").status_code == 404
    assert httpx.get(f"{site.replicas[0].address}api/v1/metrics").status_code == 200

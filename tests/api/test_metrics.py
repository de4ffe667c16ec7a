"""Metrics, read with the parser that Prometheus's own client has."""

from __future__ import annotations

import httpx
import pytest
from prometheus_client.parser import text_string_to_metric_families

pytestmark = pytest.mark.anyio
API = "/api/v1"
Sample = tuple[str, frozenset[tuple[str, str]]]


async def read(client: httpx.AsyncClient) -> dict[Sample, float]:
    response = await client.get(f"{API}/metrics")
    assert response.headers["content-type"].startswith("text/plain; version=")
    families = text_string_to_metric_families(response.text)
    return {(s.name, frozenset(s.labels.items())): s.value for family in families for s in family.samples}


def plain(name: str) -> Sample:
    return name, frozenset()


async def test_requests_are_counted_by_route(client: httpx.AsyncClient) -> None:
    labels = {"method": "GET", "route": "/scenes/{identifier}", "status": "200"}
    name = ("deltaq_request_seconds_count", frozenset(labels.items()))
    before = (await read(client)).get(name, 0.0)
    for scene in ("pendulum", "double-pendulum"):
        await client.get(f"{API}/scenes/{scene}")
    assert (await read(client))[name] == before + 2


async def test_cache_and_workers_are_told(client: httpx.AsyncClient) -> None:
    question = {"expression": "3*m", "scene": "pendulum"}
    first = await client.post(f"{API}/expressions", json=question)
    assert first.status_code == 200, first.text
    before = await read(client)
    await client.post(f"{API}/expressions", json=question)
    after = await read(client)
    hits = ("deltaq_cache_hits_total", frozenset({("store", "memory")}))
    assert after[hits] == before[hits] + 1
    assert after[plain("deltaq_cache_misses_total")] == before[plain("deltaq_cache_misses_total")]
    assert after["deltaq_workers", frozenset({("pool", "requests")})] == 3
    told = {name for name, _ in after}
    assert told >= {
        "deltaq_workers_ready",
        "deltaq_workers_busy",
        "deltaq_queue_length",
        "deltaq_worker_kills_total",
        "deltaq_processor_seconds_total",
        "deltaq_cache_bytes",
        "deltaq_cache_entries",
        "deltaq_compiled_kernels",
    }

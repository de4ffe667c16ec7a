"""What the service counts and measures, for Prometheus."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from operator import attrgetter

from prometheus_client import CollectorRegistry, Histogram, ProcessCollector
from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily, Metric
from prometheus_client.exposition import CONTENT_TYPE_LATEST, generate_latest
from prometheus_client.registry import Collector

from .cache import Cache
from .workers.kernels import compiled_kernels
from .workers.pool import Pool

MEDIA_TYPE = CONTENT_TYPE_LATEST
LATENCIES = (0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 10.0, 30.0, 60.0)  # seconds

_OF_POOLS = (
    (GaugeMetricFamily, "deltaq_workers", "Worker processes wanted", attrgetter("workers")),
    (GaugeMetricFamily, "deltaq_workers_ready", "Worker processes that are up", attrgetter("ready")),
    (GaugeMetricFamily, "deltaq_workers_busy", "Worker processes at work", attrgetter("busy")),
    (GaugeMetricFamily, "deltaq_queue_length", "Jobs that wait for a worker", attrgetter("waiting")),
    (CounterMetricFamily, "deltaq_worker_kills", "Workers killed or dead", attrgetter("kills")),
    (CounterMetricFamily, "deltaq_processor_seconds", "Processor time of jobs", attrgetter("processor_seconds")),
)


@dataclass(frozen=True)
class Metrics:
    """A registry of its own for each service, and the latencies by route."""

    registry: CollectorRegistry
    latencies: Histogram

    def text(self) -> bytes:
        """All of it in the exposition format."""
        return generate_latest(self.registry)


def make_metrics(pools: Mapping[str, Pool], cache: Cache) -> Metrics:
    """Metrics of pools and a cache, which are asked when Prometheus asks."""
    registry = CollectorRegistry()
    registry.register(ServiceCollector(pools, cache))
    ProcessCollector(registry=registry)
    latencies = Histogram(
        "deltaq_request_seconds",
        "Time from the head of a request to the end of its response",
        ("method", "route", "status"),
        buckets=LATENCIES,
        registry=registry,
    )
    return Metrics(registry, latencies)


@dataclass(frozen=True, eq=False)
class ServiceCollector(Collector):
    """Workers, queue, cache and kernels, read at the moment of asking."""

    pools: Mapping[str, Pool]
    cache: Cache

    def collect(self) -> Iterator[Metric]:
        """The metrics of pools and cache as they are now."""
        states = {name: pool.state for name, pool in self.pools.items()}
        for kind, name, meaning, of in _OF_POOLS:
            family = kind(name, meaning, labels=("pool",))
            for pool, state in states.items():
                family.add_metric((pool,), of(state))
            yield family
        hits = CounterMetricFamily("deltaq_cache_hits", "Answers from the cache", labels=("store",))
        for store, count in self.cache.hits.items():
            hits.add_metric((store,), count)
        yield hits
        yield CounterMetricFamily("deltaq_cache_misses", "Answers that had to be computed", self.cache.misses)
        yield GaugeMetricFamily("deltaq_cache_bytes", "Size of the cache in memory", self.cache.memory.used)
        yield GaugeMetricFamily("deltaq_cache_entries", "Answers in memory", len(self.cache.memory))
        yield GaugeMetricFamily("deltaq_compiled_kernels", "Numerical kernels compiled and on disk", compiled_kernels())

"""Caches of answers: in memory, on disk, and in a Redis that replicas share."""

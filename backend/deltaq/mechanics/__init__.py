"""Mechanical systems as data: frozen types that validate themselves. No computer algebra, no numerics."""

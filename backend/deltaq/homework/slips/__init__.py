"""Slips: one term of an answer is wrong, and the answer with that one change is right."""

from .marking import marked_latex
from .search import Slip, SlipSearch, slip_search

__all__ = ["Slip", "SlipSearch", "marked_latex", "slip_search"]

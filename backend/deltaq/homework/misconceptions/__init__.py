"""Misconceptions: one mistake, one file.

The docstring says the mistake and why students make it. The class is the road from the scene to every answer with this
one law got wrong; an answer shows the misconception if it equals the one that this road leads to.
"""

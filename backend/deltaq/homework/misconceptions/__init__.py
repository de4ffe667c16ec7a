"""Misconceptions: one file for each law that is got wrong, one class for each mistake.

The docstring of a class says the mistake and why students make it. The class is the way from the scene to every
answer with this one law got wrong; an answer shows the misconception if it equals the one that this solution gives.
"""

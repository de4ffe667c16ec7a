"""The fidelity ladder: the same scene at lower levels, each with its cost and its error against the full model.

A rung is a scene made from a scene by one or more simplifications, and a way back to the coordinates of the full one.
"""

"""The stepping loops, compiled by Numba: one for each family of methods."""

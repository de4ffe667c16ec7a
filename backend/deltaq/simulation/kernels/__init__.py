"""The stepping loops, compiled by Numba: one for each family of methods.

Everywhere here n is the number of free coordinates, and a state is (q, q̇) or, where power is fed in, (q, q̇, ∫P dt):
`width` is 2n or 2n + 1. Arrays are float64 and contiguous in C order. A packed lower triangle of M has its rows one
behind the other, n (n + 1)/2 numbers. Times are in seconds, all else in the units of the scene. A workspace holds the
arrays that a kernel writes to, since kernels allocate nothing.
"""

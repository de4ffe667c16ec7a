"""The numeric model of a scene, M(q, t) q̈ = f(q, q̇, t), energies and positions:
built by SymEngine, run as machine code.
"""

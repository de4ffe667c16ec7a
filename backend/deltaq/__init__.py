"""δq derives analytical mechanics step by step, simulates it and says how accurate the answer is."""

__version__ = "0.1.0"

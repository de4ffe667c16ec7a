"""Derivations: from positions to equations of motion, one law at a time."""

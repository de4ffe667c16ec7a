"""Formulations: the principles from which the equations of motion are derived. One principle, one file."""

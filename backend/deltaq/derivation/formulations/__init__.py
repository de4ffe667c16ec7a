"""Formulations: the roads that lead to the equations of motion. One road, one file."""

"""Narration: the only place where steps become formulas on paper and sentences."""

"""Ordering tasks (proof blocks): steps of the derivation, to be ordered so that each stands after what it uses."""

"""Experiments on a scene: speed against accuracy, stability of methods and of motions, chaos, the least model."""

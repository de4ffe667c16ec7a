"""Export of tasks as questions of STACK, the Moodle question type with a computer algebra system.

Source: STACK documentation, "Authoring": question structure, inputs, potential response trees, answer tests.
"""

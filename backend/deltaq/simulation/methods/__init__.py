"""One time integrator per file, each with a `METHOD`: a tableau, and a docstring that says what is known of it."""

"""Practice without end: systems drawn at random, and what can be asked about them."""

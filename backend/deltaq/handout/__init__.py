"""What is taken home from a lecture: a derivation as LaTeX or Markdown, and its motion as a program."""

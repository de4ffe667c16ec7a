"""The expression language: text or LaTeX → expression, expression → text and LaTeX, canonical form and equality."""

"""One experiment per file: what is measured, and how it is reported while it runs."""

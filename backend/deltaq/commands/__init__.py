"""The commands of the shell, one per file: its words, its arguments, and what it does.

A command raises InputError or OSError for what the user can mend; `deltaq.cli` says it and ends with exit code 2.
"""

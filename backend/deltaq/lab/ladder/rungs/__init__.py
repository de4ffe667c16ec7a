"""The kinds of simplification. One kind, one file, with its `KIND`."""

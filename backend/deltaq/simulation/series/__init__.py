"""Taylor coefficients of motions: recurrences as machine code, for one motion or for many side by side."""

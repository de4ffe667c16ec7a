"""The addresses of the service, one noun per file; each has a `router`."""

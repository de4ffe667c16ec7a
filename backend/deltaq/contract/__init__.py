"""Requests and answers, each declared once: its fields with their types and bounds, and what they mean.

The API, the shell, the workers and the labs read these declarations; OpenAPI and the page's types are made of them.
"""

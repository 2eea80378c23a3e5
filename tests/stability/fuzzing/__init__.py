"""Requests and files that nobody wrote on purpose, and what must hold of the answers."""

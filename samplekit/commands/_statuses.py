"""Exit statuses of commands."""

DONE = 0
"""The command did what it was asked to do."""
FAILED = 1
"""The request was right, but it could not be carried out."""
WRONG_USE = 2
"""The request cannot be right: an unknown name, a value out of range."""
CHECK_FAILED = 3
"""The command ran, and a check that it made failed."""
INTERRUPTED = 130
"""The user interrupted the command."""

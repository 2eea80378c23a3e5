"""Exit statuses of commands."""

DONE = 0
FAILED = 1
WRONG_USE = 2
CHECK_FAILED = 3
INTERRUPTED = 130

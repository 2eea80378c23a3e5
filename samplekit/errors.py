"""What can go wrong, in one line a user can act on."""


class SamplekitError(Exception):
    """Something failed while running: the message is one clear line. Exit status 1."""


class UsageError(SamplekitError):
    """The request was wrong: the message says what would be right. Exit status 2."""

"""What can go wrong, in one line a user can act on."""


class SamplekitError(Exception):
    """Something failed while running: the message is one clear line. Exit status 1.

    Examples
    --------
    >>> import samplekit
    >>> issubclass(samplekit.UsageError, samplekit.SamplekitError)
    True
    """


class UsageError(SamplekitError):
    """The request was wrong: the message says what would be right. Exit status 2.

    Examples
    --------
    >>> import samplekit
    >>> try:
    ...     samplekit.points("jittered", count=97)
    ... except samplekit.UsageError as error:
    ...     print("nearest" in str(error))
    True
    """

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


class CountError(UsageError):
    """A sampler cannot make the number of points that was asked for.

    Attributes
    ----------
    count
        The number that was asked for.
    below, above
        The nearest numbers that it makes; None where there is none.

    Examples
    --------
    >>> import samplekit
    >>> try:
    ...     samplekit.points("jittered", count=97)
    ... except samplekit.CountError as error:
    ...     print(error.below, error.above)
    96 98
    """

    def __init__(self, message: str, count: int, below: int | None, above: int | None) -> None:
        # All of them are arguments of the exception, so that it survives pickling on its way from a worker.
        super().__init__(message, count, below, above)
        self.count, self.below, self.above = count, below, above

    def __str__(self) -> str:
        return str(self.args[0])

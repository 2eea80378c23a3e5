"""The checks: a module for each property or two. Every :class:`Check` in these modules belongs to the suite."""

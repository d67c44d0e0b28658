"""The one error that ends in one line and exit status 2."""


class Refused(Exception):
    """Input that cannot be run; the message says what, where, and what to do, in one line."""

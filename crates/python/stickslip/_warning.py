"""Warnings that accompany a result."""


class StickslipWarning(UserWarning):
    """A warning of the program, such as a remark of a document."""

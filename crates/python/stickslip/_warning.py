"""What the program says beside a result."""


class StickslipWarning(UserWarning):
    """Something that may have been overlooked, in the program's words."""

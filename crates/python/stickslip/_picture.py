"""A picture of a document, drawn by the program."""

import os


class Picture:
    """What ``stickslip plot`` draws: shown by a notebook, saved by :meth:`save`."""

    def __init__(self, document, **view):
        self._document = document
        self._view = view

    @property
    def svg(self):
        """The picture as SVG text."""
        return self._document.picture("svg", **self._view).decode()

    def _repr_svg_(self):
        return self.svg

    def save(self, path):
        """Writes .svg, .png or .pdf, as the ending says."""
        path = os.fspath(path)
        ending = os.path.splitext(path)[1].lstrip(".")
        picture = self._document.picture(ending, **self._view)
        with open(path, "wb") as file:
            file.write(picture)

"""Pictures and animations of a document, drawn by the program."""

import os

#: Suffixes of animations.
ANIMATIONS = ("gif", "webp", "apng")


class Picture:
    """The picture that ``stickslip plot`` draws. A notebook shows it; :meth:`save` writes it."""

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
        """Writes .svg, .png or .pdf, according to the suffix."""
        path = os.fspath(path)
        ending = os.path.splitext(path)[1].lstrip(".")
        if ending.lower() in ANIMATIONS:
            raise ValueError(f"a picture is an .svg, .png or .pdf: animate().save({path!r}) writes an animation")
        picture = self._document.picture(ending, **self._view)
        with open(path, "wb") as file:
            file.write(picture)


class Animation:
    """The animation that ``stickslip plot -o run.gif`` makes: a tip carving the surface, or a raster growing line by line.
    A notebook plays it; :meth:`save` writes it."""

    def __init__(self, document, **film):
        self._document = document
        self._film = film
        self._apng = None

    def _repr_png_(self):
        """The animation as APNG. Browsers play it; other viewers of notebooks show the first frame."""
        if self._apng is None:
            self._apng = self._document.animation("apng", **self._film)
        return self._apng

    def save(self, path):
        """Writes .gif, .webp or .apng, according to the suffix."""
        path = os.fspath(path)
        ending = os.path.splitext(path)[1].lstrip(".")
        animation = self._document.animation(ending, **self._film)
        with open(path, "wb") as file:
            file.write(animation)

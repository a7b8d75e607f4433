"""Parts of a document: dicts with their entries as attributes."""


class Record(dict):
    """A part of a document, such as ``run.parameters``: ``record.alpha`` is ``record["alpha"]``."""

    def __getattr__(self, name):
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"there is no {name}: there are {', '.join(self)}") from None

    def __dir__(self):
        return sorted({*super().__dir__(), *self})


def recorded(value):
    """The value with every dict, at any depth, as a :class:`Record`."""
    if isinstance(value, dict):
        return Record((name, recorded(part)) for name, part in value.items())
    if isinstance(value, list):
        return [recorded(part) for part in value]
    return value

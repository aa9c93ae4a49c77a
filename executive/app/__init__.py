"""The composition root: the only place that knows all rooms of the house."""

from executive.app.session import Session

__all__ = ["Session"]

"""The composition root: the only package that knows all other packages."""

from executive.app.session import Session

__all__ = ["Session"]

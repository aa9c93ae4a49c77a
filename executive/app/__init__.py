"""The composition root: builds the parts from the settings and runs missions with them."""

from executive.app.session import Session

__all__ = ["Session"]

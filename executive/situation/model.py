"""What use was made of the language model."""

from dataclasses import dataclass


@dataclass
class ModelUse:
    """How often it was asked, how long it took, and whether it was of help."""

    calls: int = 0
    thinking_time_s: float = 0.0
    failure: str = ""
    """Why the language model was of no help, as a clause; empty if it was, or was not asked."""

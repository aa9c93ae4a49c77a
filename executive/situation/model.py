"""What use was made of the language model."""

from dataclasses import dataclass, field

from executive.situation.snapshot import NOT_LOGGED, logged_as


@dataclass
class ModelUse:
    """How often it was asked, how long it took, and whether it was of help."""

    calls: int = field(default=0, metadata=logged_as("llm_calls"))
    thinking_time_s: float = field(default=0.0, metadata=NOT_LOGGED)
    """Measured, and in the outcome."""
    failure: str = field(default="", metadata=logged_as("model_failure"))
    """Why the language model was of no help, as a clause; empty if it was, or was not asked."""

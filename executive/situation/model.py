"""The use of the language model in a mission."""

from dataclasses import dataclass, field

from executive.situation.snapshot import NOT_LOGGED, logged_as


@dataclass
class ModelUse:
    """How often the language model was asked, how long it took, and why it failed."""

    calls: int = field(default=0, metadata=logged_as("llm_calls"))
    thinking_time_s: float = field(default=0.0, metadata=NOT_LOGGED)
    """Measured time; it is in the outcome."""
    failure: str = field(default="", metadata=logged_as("model_failure"))
    """Why the language model did not help, as a clause; empty if it did, or was not asked."""

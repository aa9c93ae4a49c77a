"""How the next token is chosen from the model's scores."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Sampling:
    """How freely to choose: temperature 0 always takes the likeliest token."""

    temperature: float
    top_p: float
    seed: int

"""Sampling parameters: how the next token is chosen from the logits."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Sampling:
    """Temperature 0 always takes the likeliest token; the same seed gives the same choices."""

    temperature: float
    top_p: float
    seed: int

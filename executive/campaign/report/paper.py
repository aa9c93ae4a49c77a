"""The paper's conditions and results, for comparison with ours.

They are in the order of its tables: the systems from left to right, first without default
locations, then with them.
"""

from executive.config import KnowledgeSystem
from executive.types.commands import CommandKind

OKB, LLM, MEM = KnowledgeSystem

SYSTEMS: tuple[KnowledgeSystem, ...] = (OKB, LLM, MEM)

HOME = "four_rooms"
"""Our model of the paper's home."""

COMMANDS = (
    "Find an apple.",
    "Find a power_drill.",
    "Find a colored_wood_blocks.",
    "Find a pitcher.",
    "Find a potted_meat_can.",
    "Take a peach.",
    "Take a mug.",
    "Bring a mustard_bottle.",
    "Bring a sugar_box.",
)
"""The commands in the paper's table: nine, although its text says ten."""

Condition = tuple[KnowledgeSystem, bool]
"""A system, and whether the ontology knows default locations."""

CONDITIONS: tuple[Condition, ...] = tuple((s, d) for d in (False, True) for s in SYSTEMS)

COMPLETION = {OKB: 0.98, LLM: 0.80, MEM: 0.97}
"""Task completion rate, with and without default locations together."""

TIME_S: dict[CommandKind, dict[Condition, float]] = {
    kind: dict(zip(CONDITIONS, times, strict=True))
    for kind, times in {
        CommandKind.FIND: (83.0, 311.8, 338.3, 81.8, 143.8, 157.4),
        CommandKind.TAKE: (99.3, 369.9, 395.4, 105.4, 123.4, 177.3),
        CommandKind.BRING: (224.7, 301.7, 304.4, 225.1, 415.7, 258.0),
    }.items()
}
"""Mean completion time (s) of the missions that succeeded."""

INQUIRIES: dict[Condition, tuple[float, float]] = {
    (OKB, False): (1.0, 0.0),
    (LLM, False): (0.33, 0.47),
    (MEM, False): (0.28, 0.45),
    (OKB, True): (0.8, 0.40),
    (LLM, True): (0.14, 0.35),
    (MEM, True): (0.08, 0.27),
}
"""Number of questions to the person, mean and SD, if recognition and action always succeed."""

VISITS: dict[Condition, tuple[float, float]] = {
    (OKB, False): (1.0, 0.0),
    (LLM, False): (3.68, 2.35),
    (MEM, False): (3.70, 2.41),
    (OKB, True): (1.0, 0.0),
    (LLM, True): (2.45, 1.84),
    (MEM, True): (1.96, 1.45),
}
"""Number of visited pieces of furniture, mean and SD, if recognition and action always succeed."""

COST: dict[str, dict[Condition, float]] = {
    name: dict(zip(((LLM, False), (MEM, False), (LLM, True), (MEM, True)), values, strict=True))
    for name, values in {
        "list generation [s]": (35.27, 30.79, 10.81, 9.95),
        "calls of the LLM": (4.63, 3.14, 1.80, 1.13),
        "each LLM output [s]": (7.62, 9.81, 7.51, 8.75),
        "generated tokens": (201.2, 246.4, 198.8, 223.4),
    }.items()
}
"""Execution cost: means per mission; the last two per call of the model."""

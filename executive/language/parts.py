"""What the rules of a grammar hand to one another, and how the words in it are told apart."""

from dataclasses import dataclass, replace
from typing import Any

from lark import Token

from executive.language.meaning import Task, Thing, Things, Where

Part = Any
"""What a rule has made of its words: a value of `meaning.py`, or a token."""


class Unfit(Exception):
    """The words have the form of a sentence, and make no sense as one; says which word does not."""


@dataclass(frozen=True, slots=True)
class From:
    """Where a thing is to be taken from."""

    place: Where
    told: bool = False
    """Whether it says more of what is named before it: "that is on the desk"."""


@dataclass(frozen=True, slots=True)
class To:
    """Where, or to whom, a thing is to go."""

    place: Where


@dataclass(frozen=True, slots=True)
class Left:
    """What is to stay where it is."""

    things: tuple[Thing, ...]


@dataclass(frozen=True, slots=True)
class Otherwise:
    """What is to be done instead."""

    deed: Task | Things


@dataclass(frozen=True, slots=True)
class Absent:
    """What must not be there, if something is to be done."""

    task: Task


@dataclass(frozen=True, slots=True)
class Further:
    """Other things, or another place, of the deed that was said last."""

    parts: tuple[Part, ...]
    by_and: bool
    """Whether they are joined to it by more than a comma."""


def is_a(part: Part, *types: str) -> bool:
    """Whether it is a token of one of these terminals."""
    return isinstance(part, Token) and part.type in types


def said_of(parts: list[Part]) -> str:
    """The words of a thing as they were said, without articles and exceptions."""
    said = (p.said if isinstance(p, Thing) else p for p in parts if not is_a(p, "A", "THE", "SOME"))
    return " ".join(str(p) for p in said if isinstance(p, str))


def rest_of(parts: list[Part]) -> str:
    """What the grammar takes as it is; empty if nothing was there."""
    return next((str(p) for p in parts if is_a(p, "ANYTHING")), "")


def either_of(parts: list[Part]) -> Where:
    """The first of the places, with the others beside it."""
    first, *others = (p for p in parts if isinstance(p, Where))
    return replace(first, others=tuple(others))


def purpose_of(parts: list[Part], kind: str) -> str:
    """What a thing is for, by a token such as "to drink from"; empty if it is for nothing."""
    token = next((p for p in parts if is_a(p, kind)), "")
    return token.partition(" ")[2]


def exceptions_of(parts: list[Part]) -> tuple[Thing, ...]:
    """What the rule `except_` has made; nothing if there is none."""
    return next((p for p in parts if isinstance(p, tuple) and not isinstance(p, str)), ())

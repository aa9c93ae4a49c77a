"""Draws, by a seed, where a thing is in any home, from the paper's survey."""

import random
from functools import cache

from executive.errors import InputError
from executive.types.home import Place
from kb.ontology.ontology import Ontology
from sim.home.home import Home
from sim.home.home_file import load_home
from sim.home.validation import with_placement
from sim.objects.objects import load_objects

SURVEYED = "four_rooms"
"""The home to whose furniture the survey's default locations refer."""


def commands() -> tuple[str, ...]:
    """A command to find each known thing."""
    return tuple(f"Find the {name}" for name in load_objects())


def drawn(home: Home, thing: str, seed: int) -> dict[str, str]:
    """Draw a placement for a thing: furniture of a kind, in a kind of room, from the survey.

    All such pieces with enough space are equally likely. If the home has no such piece, furniture
    of the kind in any room is; if there is none, or the survey has no record of the thing, all
    furniture is. The placement is empty if none of these pieces has enough space.
    """
    pieces = home.places()
    usual = {(p.kind, p.room_kind) for p in _surveyed(thing)}
    kinds = {kind for kind, _ in usual}
    likely = [p.name for p in pieces if (p.kind, p.room_kind) in usual]
    likely = likely or [p.name for p in pieces if p.kind in kinds] or [p.name for p in pieces]
    for place in random.Random(f"{seed} {thing}").sample(likely, len(likely)):
        try:
            with_placement(home, {thing: place})
        except InputError:
            continue
        return {thing: place}
    return {}


@cache
def _surveyed(thing: str) -> list[Place]:
    home = load_home(SURVEYED)
    usual = Ontology(home.places()).usual_places(thing)
    return [place for place in home.places() if place.name in usual]

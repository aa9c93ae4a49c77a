"""A policy of one's own: another who says where to look; all else stays as it is.

A policy is a function from the parts of a mission to its parts: `dataclasses.replace` puts others
in. This one puts an adviser in that needs no language model: it looks where the person is, first,
and then through the home, room by room, so that it hardly has to ask.

    python docs/examples/own_policy.py

How good is it? A campaign holds it against ours; run it where the module is found:

    cd docs/examples
    python -m executive.campaign --seeds 1 --policy ours --policy own_policy:near_the_person

(`--cluster` wants the module on each worker, too.) A recording keeps the name of its policy, and no
code: `replay(folder, change=near_the_person)` runs it again.
"""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from executive import Outcome, Session, load_settings
from executive.app.parts import Parts
from executive.campaign.baselines import Order, ordered
from executive.campaign.policies import Policy


def rooms_in_turn(parts: Parts) -> Order:
    """The order in which this robot looks: a function of a thing's name and the places allowed."""
    here = parts.home.delivery.room
    rooms = {piece.name: piece.room for piece in parts.home.furniture}

    def order(name: str, places: Sequence[str]) -> list[str]:
        return sorted(places, key=lambda place: (rooms[place] != here, rooms[place]))

    return order


def look_near_the_person(parts: Parts) -> Parts:
    """The policy: the parts with another adviser, and with more places that are worth a visit."""
    patient = replace(parts.parameters, top_k=len(parts.home.furniture))
    return ordered(replace(parts, parameters=patient), rooms_in_turn)


near_the_person = Policy(
    "where the person is, then room by room",
    {"llm": "none", "elicit": "rank"},
    look_near_the_person,
)
"""The policy, and the settings that it is for: those of whoever uses it give way to these."""


def find(words: str, runs: Path | None = None) -> Outcome:
    """One mission in the instant world, in which the ontology knows no default locations."""
    given = {"world": "fake", "user": "none", "defaults": False, **near_the_person.settings}
    settings = load_settings(**given, search="paper", runs=runs)
    with Session(settings, change=near_the_person, policy="near_the_person") as session:
        return session.run(words)


if __name__ == "__main__":
    outcome = find("Find the mug")
    print(f"{outcome.reason} Looked at: {', '.join(outcome.visited)}.")

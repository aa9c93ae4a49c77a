"""The mission: from words to a deed, and to an honest word when it cannot be done.

understand ─> which object ─> search ──────────────────> grasp ───────────> act ─────> report
grammar       ontology        memory: where it was      pick it up         find, take
else LLM,     else person     else ontology: its one    else look again    or bring;
confirmed     hand is free    place; else LLM, verified if gone, search    table full:
  │           else put down   else person; visit, look; again              other furniture
  └─> put down what is held   not seen: ask the person                     else person
"""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.types import Kind
from executive.types import Status as MissionStatus
from trees.act import act, asked_to
from trees.grasp import grasp
from trees.hand import empty_hand, hand_is_free
from trees.nodes import Check, Optionally, Step, fallback, sequence
from trees.object import resolve_object
from trees.person import Apologise
from trees.robot import DriveBack
from trees.search import search
from trees.team import Team
from trees.understand import understand


def mission(team: Team) -> Behaviour:
    """The whole tree. It always ends in success; how the mission ended is in the situation."""
    situation = team.situation
    return fallback(
        "mission",
        sequence(
            "serve",
            understand(team),
            Check("about a thing to look for", team, lambda: not situation.asks_to(Kind.PUT_DOWN)),
            resolve_object(team),
            hand_is_free(team),
            search(team),
            grasp(team),
            act(team),
            Conclude("done", team),
        ),
        sequence(
            "put down",
            asked_to(team, Kind.PUT_DOWN),
            empty_hand(team),
            Conclude("done", team),
        ),
        sequence("give up", come_back(team), Apologise("apologise", team)),
    )


def come_back(team: Team) -> Behaviour:
    """Return to the person, if the robot left and can."""
    return Optionally(
        "if away",
        team.situation,
        sequence(
            "come back",
            Check("is away", team, lambda: team.situation.away),
            DriveBack("drive", team, "person"),
        ),
    )


class Conclude(Step):
    """Marks the mission as done."""

    def update(self) -> Status:
        """Done."""
        self.situation.status = MissionStatus.DONE
        return Status.SUCCESS

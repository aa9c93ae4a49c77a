"""The mission: from words to a deed, and to an honest word when it cannot be done.

understand ─> which object ─> search ─────────────────────────> act ───────────> report
words         ontology        memory: where it was seen         find, take
              else person     else ontology: its one place      or bring
                              else LLM, verified
                              else person; visit, look;
                              not seen: ask the person
"""

from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.decorators import FailureIsSuccess

from executive.records import Utterance
from executive.types import Status as MissionStatus
from trees.act import act
from trees.nodes import Check, Step, fallback, sequence
from trees.object import resolve_object
from trees.person import Apologise
from trees.robot import DriveBack
from trees.search import search
from trees.team import Team


def mission(team: Team) -> Behaviour:
    """The whole tree. It always ends in success; how the mission ended is in the situation."""
    return fallback(
        "mission",
        sequence(
            "serve",
            Understand("understand", team),
            resolve_object(team),
            search(team),
            act(team),
            Conclude("done", team),
        ),
        sequence("give up", come_back(team), Apologise("apologise", team)),
    )


def come_back(team: Team) -> Behaviour:
    """Return to the person, if the robot left and can."""
    return FailureIsSuccess(
        "if away",
        sequence(
            "come back",
            Check("is away", team, lambda: team.situation.away),
            DriveBack("drive", team, "person"),
        ),
    )


class Understand(Step):
    """Words -> command."""

    def update(self) -> Status:
        """Read the words; what cannot be read is the person's to say again."""
        self.team.recorder.record(Utterance("person", self.situation.words))
        command = self.team.interpreter.command(self.situation.words)
        if command is None:
            self.situation.status = MissionStatus.NOT_UNDERSTOOD
            return self.fail(
                f"I do not understand '{self.situation.words}'; "
                "say for example: Find an apple. Take the mug. Bring a sugar_box."
            )
        self.situation.command = command
        return self.succeed(f"{command.kind} {command.target}")


class Conclude(Step):
    """Marks the mission as done."""

    def update(self) -> Status:
        """Done."""
        self.situation.status = MissionStatus.DONE
        return Status.SUCCESS

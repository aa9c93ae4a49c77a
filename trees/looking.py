"""Leaves that point the robot's head, and recognise what is in the picture."""

from collections.abc import Iterable
from dataclasses import replace

from py_trees.common import Status

from executive.records import Activity
from executive.types.goals import Goal, LookAt
from executive.types.home import SOMETHING
from executive.types.knowledge import Candidate
from executive.types.perception import Detection
from executive.types.results import Result, Saw
from trees.body import BodyAction, RobotAction
from trees.context import MissionContext


class LookAtCandidate(RobotAction):
    """Points the head at the next part of the place.

    Reads search.candidate and search.view; clears search.doubtful.
    """

    activity = Activity.LOOKING
    searches = True

    def goal(self) -> Goal:
        """Look at the current view of the place."""
        self.situation.search.doubtful = None
        return LookAt(self.situation.search.place, self.situation.search.view)


class LookCloser(RobotAction):
    """Points the head at what may be the thing, so that it is in the middle of the picture.

    Reads search.doubtful, search.candidate and search.view.
    """

    activity = Activity.LOOKING
    searches = True

    def goal(self) -> Goal:
        """Look at the position of the doubtful detection."""
        assert self.situation.search.doubtful
        point = self.situation.search.doubtful.position
        return LookAt(self.situation.search.place, self.situation.search.view, point)


class LookForLost(RobotAction):
    """Points the head at where the thing may have fallen.

    Reads hand.spot and search.view.
    """

    activity = Activity.LOOKING

    def goal(self) -> Goal:
        """Look at the current view of the spot."""
        return LookAt(self.situation.hand.spot, self.situation.search.view)


class SeeTarget(BodyAction):
    """Takes a picture and succeeds if the thing is in it: all of it, with enough confidence.

    Reads request.object and search.candidate; writes search.detection and search.found if it
    succeeds, else search.doubtful or search.looks.
    """

    activity = Activity.LOOKING

    def __init__(self, name: str, context: MissionContext, closer: bool = False) -> None:
        """If `closer`, a part of the thing is enough: this is the second look."""
        super().__init__(name, context)
        self._closer = closer

    def doing(self) -> str:
        """It looks at the place."""
        candidate = self.situation.search.candidate
        return f"look {self.context.say.at(candidate.place)}" if candidate else ""

    def start(self) -> int:
        """Take a picture."""
        return self.context.perception.see()

    def ended(self, result: Result) -> Status:
        """Keep the best detection of the thing, and its place; remember all that was seen."""
        search = self.situation.search
        if not isinstance(result, Saw):
            return self.failed(result)
        self._remember(result.detections)
        search.doubtful = None
        seen = self._best(result)
        if seen is None:
            search.looks.without(search.place, search.view)
            self.feedback_message = f"no {self.situation.request.object} in view"
            return Status.FAILURE
        if doubt := self._doubt(seen):
            search.doubtful, self.feedback_message = seen, doubt
            return Status.FAILURE
        search.detection = seen
        search.found = self._where(seen)
        if search.looks.all_but(search.place, search.view):
            self.context.facts.looked(search.place)
        return self.succeed(f"{seen.label}, confidence {seen.confidence:.2f}")

    def attempt(self) -> str:
        """It is about the place."""
        candidate = self.situation.search.candidate
        return f"look at {self.context.say.the(candidate.place) if candidate else 'it'}"

    def note_failure(self, why: str) -> None:
        """Note that this view of the place was not seen."""
        self.situation.search.looks.not_seen(self.situation.search.place, why)

    def cancel(self, request: int) -> None:
        """Take no picture."""
        self.context.perception.cancel(request)

    def _doubt(self, seen: Detection) -> str:
        """Why a closer look is needed; empty if it is not."""
        if seen.confidence < self.context.parameters.min_confidence:
            return f"perhaps {seen.label}, confidence {seen.confidence:.2f}"
        if seen.cut_off and not self._closer:
            return f"{seen.label}, at the edge of the picture"
        return ""

    def _where(self, seen: Detection) -> Candidate:
        """The place of a detection: the furniture below it, else the place that is looked at.

        In the picture there may be things on other furniture, behind that place.
        """
        here = self.situation.search.candidate
        assert here
        below = self.context.place_at(seen.position) if seen.position else None
        return replace(here, place=below or here.place)

    def _best(self, saw: Saw) -> Detection | None:
        """The best detection of the thing (detections come in that order); None if not seen."""
        return next((d for d in saw.detections if d.label == self.situation.request.object), None)

    def _remember(self, detections: Iterable[Detection]) -> None:
        """Remember the place of each thing that was recognised with enough confidence."""
        for seen in detections:
            if seen.confidence < self.context.parameters.min_confidence:
                continue
            self.context.facts.saw((seen.label,), self._where(seen).place)


class SeeLost(SeeTarget):
    """Takes a picture and succeeds if what fell from the hand is in it.

    Reads request.object and hand.spot; writes search.detection.
    """

    def ended(self, result: Result) -> Status:
        """Keep the detection: the thing lies there now. `search.found` stays as it was."""
        if not isinstance(result, Saw):
            return self.failed(result)
        seen = self._best(result)
        if seen is None:
            it = self.context.say.it(self.situation.request.object or SOMETHING)
            return self.fail(f"I do not see {it} {self.context.say.at(self.situation.hand.spot)}")
        self.situation.search.detection = seen
        return self.succeed(f"{seen.label}, confidence {seen.confidence:.2f}")

    def attempt(self) -> str:
        """It is about the spot."""
        return f"look at {self.context.say.the(self.situation.hand.spot)}"

    def note_failure(self, why: str) -> None:
        """Nothing to note: no place is being searched."""

"""Leaves that move the robot and use its eyes."""

from abc import abstractmethod
from collections.abc import Iterable

from py_trees.common import Status

from executive.types import (
    Detection,
    DriveTo,
    Failed,
    Goal,
    Halt,
    LookAt,
    Pick,
    PutDown,
    Result,
    Saw,
    Succeeded,
)
from trees.nodes import Action
from trees.team import Team


class RobotAction(Action):
    """Pursues one goal of the robot."""

    def __init__(self, name: str, team: Team) -> None:
        """Give the robot as long as the rules allow."""
        super().__init__(name, team, team.rules.action_s)

    @abstractmethod
    def goal(self) -> Goal:
        """What to pursue."""

    def start(self) -> int:
        """Hand the goal to the robot."""
        goal = self.goal()
        self.feedback_message = _in_words(goal)
        self.situation.restless = True
        return self.team.robot.start(goal)

    def ended(self, result: Result) -> Status:
        """Succeed as the robot did; note if it lost what it held."""
        self.situation.restless = not isinstance(result, Succeeded)
        if isinstance(result, Failed) and result.lost:
            self.situation.lost, self.situation.in_hand = result.reason, None
        return Status.SUCCESS if isinstance(result, Succeeded) else self.failed(result)

    def cancel(self, request: int) -> None:
        """Brake."""
        self.team.robot.cancel(request)


class DriveToCandidate(RobotAction):
    """Goes to the place where the thing may be."""

    def goal(self) -> Goal:
        """Drive to the candidate."""
        assert self.situation.candidate
        self.situation.away = True
        return DriveTo(self.situation.candidate.place)


class Visit(DriveToCandidate):
    """Goes to a place for the first time: it counts as visited, or as out of reach."""

    def ended(self, result: Result) -> Status:
        """Count only a place that was reached."""
        assert self.situation.candidate
        place = self.situation.candidate.place
        if isinstance(result, Succeeded):
            self.situation.visited.append(place)
        elif isinstance(result, Failed):
            self.situation.unreached[place] = result.reason
        return super().ended(result)


class DriveBack(RobotAction):
    """Goes to where things are asked for or delivered: `person` or `delivery`."""

    def __init__(self, name: str, team: Team, place: str) -> None:
        """Name the place."""
        super().__init__(name, team)
        self._place = place

    def goal(self) -> Goal:
        """Drive there."""
        return DriveTo(self._place)

    def ended(self, result: Result) -> Status:
        """Be back with the person."""
        self.situation.away = not isinstance(result, Succeeded)
        return super().ended(result)


class LookAtCandidate(RobotAction):
    """Points the head at the next part of the place."""

    def goal(self) -> Goal:
        """Look at the view at hand."""
        assert self.situation.candidate
        if not self.situation.view:
            self.situation.views_without = 0
        return LookAt(self.situation.candidate.place, self.situation.view)


class LookCloser(RobotAction):
    """Brings what may be the thing to the middle of the picture."""

    def goal(self) -> Goal:
        """Look at the doubtful detection."""
        assert self.situation.candidate
        assert self.situation.doubtful
        point = self.situation.doubtful.position
        return LookAt(self.situation.candidate.place, self.situation.view, point)


class LookForLost(RobotAction):
    """Points the head at where the thing may have fallen."""

    def goal(self) -> Goal:
        """Look at the next part of the spot."""
        return LookAt(self.situation.spot, self.situation.view)


class PickUp(RobotAction):
    """Grasps the thing where it was seen, and lifts it; what the fingers feel decides."""

    def __init__(self, name: str, team: Team) -> None:
        """Reach for it."""
        super().__init__(name, team)
        self._finished = False

    def initialise(self) -> None:
        """Begin."""
        self._finished = False
        super().initialise()

    def goal(self) -> Goal:
        """Pick what was detected."""
        assert self.situation.detection
        self.situation.reached_for = self.situation.detection.label
        return Pick(self.situation.detection)

    def ended(self, result: Result) -> Status:
        """Remember that it is no longer there.

        If the robot failed with the thing in its hand, it is given one chance to finish.
        """
        assert self.situation.detection
        name, felt = self.situation.detection.label, self.situation.felt
        if isinstance(result, Succeeded) and felt is False:
            result = Failed(f"the {name} slipped from my fingers")
        if isinstance(result, Failed) and felt and self.situation.in_hand == name:
            if not self._finished:
                self._finished = True
                return self.start_again()
            result = Succeeded()
        if isinstance(result, Succeeded):
            assert self.situation.found
            self.situation.in_hand = name
            self.team.facts.took(name, self.situation.found.place)
            self.situation.lost = ""
        return super().ended(result)


class PutDownAt(RobotAction):
    """Puts the held thing down."""

    def __init__(self, name: str, team: Team, place: str) -> None:
        """Name the place."""
        super().__init__(name, team)
        self._place = place

    def goal(self) -> Goal:
        """Put it there."""
        return PutDown(self._place)

    def ended(self, result: Result) -> Status:
        """Remember that it is here now."""
        if isinstance(result, Succeeded):
            assert self.situation.object
            self.situation.in_hand = None
            self.team.facts.put(self.situation.object, self._place)
        return super().ended(result)


class SeeTarget(Action):
    """Takes a picture and succeeds if the thing is in it, surely and wholly."""

    def __init__(self, name: str, team: Team, closer: bool = False) -> None:
        """Give the eyes as long as the rules allow; `closer`, a part of the thing is enough."""
        super().__init__(name, team, team.rules.action_s)
        self._closer = closer

    def start(self) -> int:
        """Look."""
        return self.team.eyes.see()

    def ended(self, result: Result) -> Status:
        """Keep the surest detection of the thing, and where it was; remember all that was seen."""
        assert self.situation.candidate
        place = self.situation.candidate.place
        if not isinstance(result, Saw):
            status = self.failed(result)
            self.situation.unseen[place] = self.situation.reason
            return status
        self.situation.unseen.pop(place, None)
        self._remember(result.detections)
        self.situation.doubtful = None
        seen = self._surest(result)
        if seen is None:
            self.situation.views_without += 1
            self.feedback_message = f"no {self.situation.object} in view"
            return Status.FAILURE
        if seen.confidence < self.team.rules.sure:
            self.situation.doubtful = seen
            self.feedback_message = f"perhaps {seen.label}, confidence {seen.confidence:.2f}"
            return Status.FAILURE
        if seen.cut_off and not self._closer:
            self.situation.doubtful = seen
            self.feedback_message = f"{seen.label}, at the edge of the picture"
            return Status.FAILURE
        self.situation.detection = seen
        self.situation.found = self.situation.candidate
        return self.succeed(f"{seen.label}, confidence {seen.confidence:.2f}")

    def cancel(self, request: int) -> None:
        """Look no more."""
        self.team.eyes.cancel(request)

    def _surest(self, saw: Saw) -> Detection | None:
        """The surest detection of the thing, if it was seen."""
        return next((d for d in saw.detections if d.label == self.situation.object), None)

    def _remember(self, detections: Iterable[Detection]) -> None:
        """A thing may be on furniture behind this place; with none below it, it counts as here."""
        assert self.situation.candidate
        for seen in detections:
            if seen.confidence < self.team.rules.sure:
                continue
            below = self.team.place_at(seen.position) if seen.position else None
            self.team.facts.saw((seen.label,), below or self.situation.candidate.place)


class SeeLost(SeeTarget):
    """Takes a picture and succeeds if what fell from the hand is in it."""

    def ended(self, result: Result) -> Status:
        """Keep where it lies now; it was found elsewhere."""
        if not isinstance(result, Saw):
            return self.failed(result)
        seen = self._surest(result)
        if seen is None:
            return self.fail(f"I do not see it on the {self.situation.spot}")
        self.situation.detection = seen
        return self.succeed(f"{seen.label}, confidence {seen.confidence:.2f}")


def _in_words(goal: Goal) -> str:
    match goal:
        case Pick(detection):
            return detection.label
        case Halt():
            return ""
        case _:
            return goal.place

"""Leaves that move the robot and use its eyes."""

from abc import abstractmethod
from collections.abc import Iterable
from dataclasses import replace

from py_trees.common import Status

from executive.records import Activity
from executive.types import (
    FLOOR,
    PERSON,
    SOMETHING,
    Candidate,
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
from trees.context import MissionContext
from trees.nodes import UNSAID, Action, why_of
from trees.progress import on_the_way, on_to_the_next
from trees.recall import is_here
from trees.telling import tell

EXPERIMENTER = "experimenter"
"""Who names a place to which an experimenter sends the robot."""


class BodyAction(Action):
    """Something that the robot does with its body or its eyes.

    Whatever fails, or takes too long, comes by here: it is noted where it counts, once for all.
    """

    def __init__(self, name: str, context: MissionContext) -> None:
        """Give the robot as long as the parameters allow."""
        super().__init__(name, context, context.parameters.action_s)

    @abstractmethod
    def attempt(self) -> str:
        """What is tried, as an infinitive."""

    @abstractmethod
    def note_failure(self, why: str) -> None:
        """Note what cannot be known, or be done, because this failed."""

    def failed(self, result: Result) -> Status:
        """Fail for the reason that the robot gives."""
        why = self.why(result)
        self.note_failure(why)
        return self.fail(f"I could not {self.attempt()}: {why}" if why == UNSAID else why)

    def why(self, result: Result) -> str:
        """Why it failed, in words: what robots say of things and places are names."""
        return self.context.say.in_words(why_of(result))

    def out_of_time(self) -> Status:
        """Fail because it took too long."""
        why = f"it took longer than {self._patience_s:g} s"
        self.note_failure(why)
        return self.fail(f"I could not {self.attempt()}: {why}")


class RobotAction(BodyAction):
    """Pursues one goal of the robot.

    Writes ending.restless, dialogue.at and dialogue.stands where it drove to, and hand.lost if it
    lost what it held; what failed goes to search.looks or hand.unplaced.
    """

    searches = False
    """Whether it serves to look for the thing, so that its failure leaves a place unseen."""

    def __init__(self, name: str, context: MissionContext) -> None:
        """Have no goal yet."""
        super().__init__(name, context)
        self._goal: Goal = Halt()

    @abstractmethod
    def goal(self) -> Goal:
        """What to pursue."""

    def progress(self) -> str:
        """What to tell the person when it begins, who cannot see it; empty if that is known."""
        return ""

    def start(self) -> int:
        """Hand the goal to the robot, and tell the person."""
        if said := self.progress():
            tell(self.context, said)
        self._goal = self.goal()
        self.feedback_message = _in_words(self._goal)
        self.situation.ending.restless = True
        if isinstance(self._goal, DriveTo):
            self.situation.dialogue.stands = ""
        return self.context.robot.start(self._goal)

    def ended(self, result: Result) -> Status:
        """Succeed as the robot did; note if it lost what it held."""
        self.situation.ending.restless = not isinstance(result, Succeeded)
        if isinstance(result, Succeeded):
            if isinstance(self._goal, DriveTo):
                self.situation.dialogue.at = self.situation.dialogue.stands = self._goal.place
            return Status.SUCCESS
        if isinstance(result, Failed) and result.lost:
            self.situation.hand.lost, self.situation.hand.in_hand = self.why(result), None
        return self.failed(result)

    def doing(self) -> str:
        """By the goal."""
        say = self.context.say
        match self._goal:
            case DriveTo(place):
                return f"drive to {say.the(place)}"
            case LookAt(place):
                return f"look {say.at(place)}"
            case Pick(detection):
                return f"pick up {say.the(detection.label)}"
            case PutDown(place):
                return f"put {say.the(self.situation.hand.in_hand or SOMETHING)} {say.at(place)}"
            case Halt():
                return "stop"

    def attempt(self) -> str:
        """By the goal."""
        say = self.context.say
        match self._goal:
            case DriveTo(place):
                return f"get to {say.the(place)}"
            case LookAt(place):
                return f"look at {say.the(place)}"
            case Pick(detection):
                return f"pick up {say.the(detection.label)}"
            case PutDown(place):
                it = say.it(self.situation.request.object or SOMETHING)
                return f"put {it} down {say.at(place)}"
            case Halt():
                return "stop"

    def note_failure(self, why: str) -> None:
        """A place stays out of reach, or unseen; or there is no room for what is in the hand."""
        match self._goal:
            case DriveTo(place) if self.searches:
                self.situation.search.looks.not_reached(place, why)
            case LookAt(place) if self.searches:
                self.situation.search.looks.not_seen(place, why)
            case PutDown(place):
                self.situation.hand.unplaced[place] = why

    def cancel(self, request: int) -> None:
        """Brake."""
        self.context.robot.cancel(request)


class DriveToCandidate(RobotAction):
    """Goes to the place where the thing may be.

    Reads search.candidate; writes dialogue.away.
    """

    activity = Activity.DRIVING
    searches = True

    def goal(self) -> Goal:
        """Drive to the candidate."""
        assert self.situation.search.candidate
        self.situation.dialogue.away = True
        return DriveTo(self.situation.search.candidate.place)


class Visit(DriveToCandidate):
    """Goes to a place for the first time: it counts as visited if it is reached.

    Where an experimenter sends the robot meanwhile, it goes instead, without a word.

    Reads search.candidate, search.sent_to and search.looks; writes search.looks.
    """

    def start(self) -> int:
        """Go where it is sent, if it is."""
        search = self.situation.search
        if search.sent_to and is_here(self.context, search.sent_to):
            search.candidate = Candidate(search.sent_to, EXPERIMENTER)
        search.sent_to = ""
        return super().start()

    def update(self) -> Status:
        """Turn round where it is sent elsewhere."""
        sent_to, request = self.situation.search.sent_to, self._request
        if sent_to and is_here(self.context, sent_to) and request is not None:
            self._wait_no_more(request)
            self.cancel(request)
            return self.start_again()
        return super().update()

    def progress(self) -> str:
        """The first place was announced; of the next ones, say why."""
        return on_to_the_next(self.context)

    def ended(self, result: Result) -> Status:
        """Count only a place that was reached."""
        assert self.situation.search.candidate
        if isinstance(result, Succeeded):
            self.situation.search.looks.reached(self.situation.search.candidate.place)
        return super().ended(result)


class ComeToRest(RobotAction):
    """Stands still, so that the fingers tell what was got hold of; always fails: then one goes on.

    Reads and writes agenda.unsettled.
    """

    activity = Activity.HANDLING

    def goal(self) -> Goal:
        """Do nothing."""
        return Halt()

    def ended(self, result: Result) -> Status:
        """What the hand holds is known by now."""
        self.situation.agenda.unsettled = False
        super().ended(result)
        return Status.FAILURE


class DriveBack(RobotAction):
    """Goes to where things are asked for or delivered: `person` or `delivery`.

    Writes dialogue.away.
    """

    activity = Activity.DRIVING

    def __init__(self, name: str, context: MissionContext, place: str) -> None:
        """Name the place."""
        super().__init__(name, context)
        self._place = place

    def progress(self) -> str:
        """Say what comes of it."""
        return on_the_way(self.context, self._place)

    def goal(self) -> Goal:
        """Drive there."""
        return DriveTo(self._place)

    def ended(self, result: Result) -> Status:
        """Be back with the person."""
        self.situation.dialogue.away = not isinstance(result, Succeeded)
        return super().ended(result)


class LookAtCandidate(RobotAction):
    """Points the head at the next part of the place.

    Reads search.candidate and search.view; clears search.doubtful.
    """

    activity = Activity.LOOKING
    searches = True

    def goal(self) -> Goal:
        """Look at the view at hand."""
        assert self.situation.search.candidate
        self.situation.search.doubtful = None
        return LookAt(self.situation.search.candidate.place, self.situation.search.view)


class LookCloser(RobotAction):
    """Brings what may be the thing to the middle of the picture.

    Reads search.doubtful, search.candidate and search.view.
    """

    activity = Activity.LOOKING
    searches = True

    def goal(self) -> Goal:
        """Look at the doubtful detection."""
        assert self.situation.search.candidate
        assert self.situation.search.doubtful
        point = self.situation.search.doubtful.position
        return LookAt(self.situation.search.candidate.place, self.situation.search.view, point)


class LookForLost(RobotAction):
    """Points the head at where the thing may have fallen.

    Reads hand.spot and search.view.
    """

    activity = Activity.LOOKING

    def goal(self) -> Goal:
        """Look at the next part of the spot."""
        return LookAt(self.situation.hand.spot, self.situation.search.view)


class PickUp(RobotAction):
    """Grasps the thing where it was seen, and lifts it; what the fingers feel decides.

    Reads search.detection, search.found and hand.felt; writes hand.reached_for and hand.in_hand,
    clears hand.lost and hand.unplaced.
    """

    activity = Activity.HANDLING

    def __init__(self, name: str, context: MissionContext) -> None:
        """Reach for it."""
        super().__init__(name, context)
        self._finished = False

    def initialise(self) -> None:
        """Begin."""
        self._finished = False
        super().initialise()

    def goal(self) -> Goal:
        """Pick what was detected."""
        assert self.situation.search.detection
        self.situation.hand.reached_for = self.situation.search.detection.label
        return Pick(self.situation.search.detection)

    def ended(self, result: Result) -> Status:
        """Remember that it is no longer there.

        If the robot failed with the thing in its hand, it is given one chance to finish.
        """
        hand, search = self.situation.hand, self.situation.search
        assert search.detection
        name = search.detection.label
        if isinstance(result, Succeeded) and hand.felt is False:
            result = Failed(f"{self.context.say.the(name)} slipped from my fingers")
        if isinstance(result, Failed) and hand.felt and hand.in_hand == name:
            if not self._finished:
                self._finished = True
                return self.start_again()
            result = Succeeded()
        if isinstance(result, Succeeded):
            hand.in_hand, hand.lost = name, ""
            hand.unplaced.clear()
            self.context.facts.took(name, search.found.place if search.found else FLOOR)
        return super().ended(result)

    def out_of_time(self) -> Status:
        """With the thing in the hand it is as if the robot had failed; only that it may move."""
        hand, seen = self.situation.hand, self.situation.search.detection
        assert seen
        if not (hand.felt and hand.in_hand == seen.label):
            return super().out_of_time()
        status = self.ended(Failed(f"it took longer than {self._patience_s:g} s"))
        self.situation.ending.restless = True
        return status


class PutDownAt(RobotAction):
    """Puts the held thing down.

    Reads hand.in_hand and hand.felt; writes hand.in_hand and hand.put_at.
    """

    activity = Activity.HANDLING

    def __init__(self, name: str, context: MissionContext, place: str) -> None:
        """Name the place."""
        super().__init__(name, context)
        self._place = place
        self._held: str | None = None

    def goal(self) -> Goal:
        """Put it there; afterwards the hand does not tell what it was."""
        self._held = self.situation.hand.in_hand
        return PutDown(self._place_now())

    def ended(self, result: Result) -> Status:
        """Remember that it is here now."""
        if isinstance(result, Succeeded) and self.situation.hand.felt:
            result = Failed("my fingers do not let go of it")
        if isinstance(result, Succeeded):
            place = self._place_now()
            if self._held and self._held != SOMETHING:
                self.context.facts.put(self._held, place)
            self.situation.hand.in_hand, self.situation.hand.put_at = None, place
        return super().ended(result)

    def _place_now(self) -> str:
        return self._place


class PutDownThere(PutDownAt):
    """Puts the held thing down on the surface at hand.

    Reads hand.surface.
    """

    def __init__(self, name: str, context: MissionContext) -> None:
        """Wait for the surface to be chosen."""
        super().__init__(name, context, "")

    def _place_now(self) -> str:
        return self.situation.hand.surface


class PutDownAtGoal(PutDownAt):
    """Puts the held thing down where it is to go.

    Reads request.goal.
    """

    def __init__(self, name: str, context: MissionContext) -> None:
        """Wait for the goal to be chosen."""
        super().__init__(name, context, "")

    def _place_now(self) -> str:
        return self.situation.request.goal


class DriveToSurface(RobotAction):
    """Goes to the furniture where the held thing may be put down.

    Reads hand.surface; writes dialogue.away.
    """

    activity = Activity.DRIVING

    def progress(self) -> str:
        """Say where to."""
        return on_the_way(self.context, self.situation.hand.surface)

    def goal(self) -> Goal:
        """Drive there; the person is not there."""
        self.situation.dialogue.away = True
        return DriveTo(self.situation.hand.surface)


class DriveToGoal(RobotAction):
    """Goes to where the thing, or the robot, is to go.

    Reads request.goal; writes dialogue.away, and hand.unplaced if there is something in the hand.
    """

    activity = Activity.DRIVING

    def progress(self) -> str:
        """Say where to."""
        return on_the_way(self.context, self.situation.request.goal)

    def goal(self) -> Goal:
        """Drive there."""
        self.situation.dialogue.away = True
        return DriveTo(self.situation.request.goal)

    def ended(self, result: Result) -> Status:
        """Be with the person, if that is the goal."""
        if isinstance(result, Succeeded) and self.situation.request.goal == PERSON:
            self.situation.dialogue.away = False
        return super().ended(result)

    def note_failure(self, why: str) -> None:
        """It cannot be put down there."""
        if self.situation.hand.in_hand:
            place = self.situation.request.goal
            there = self.context.say.the(place)
            self.situation.hand.unplaced[place] = f"I could not get to {there}: {why}"


class SeeTarget(BodyAction):
    """Takes a picture and succeeds if the thing is in it, surely and wholly.

    Reads request.object and search.candidate; writes search.detection and search.found if it is
    sure, else search.doubtful or search.looks.
    """

    activity = Activity.LOOKING

    def __init__(self, name: str, context: MissionContext, closer: bool = False) -> None:
        """`closer`, a part of the thing is enough."""
        super().__init__(name, context)
        self._closer = closer

    def doing(self) -> str:
        """It sees."""
        candidate = self.situation.search.candidate
        return f"look {self.context.say.at(candidate.place)}" if candidate else ""

    def start(self) -> int:
        """Look."""
        return self.context.perception.see()

    def ended(self, result: Result) -> Status:
        """Keep the surest detection of the thing, and where it was; remember all that was seen."""
        search = self.situation.search
        assert search.candidate
        if not isinstance(result, Saw):
            return self.failed(result)
        self._remember(result.detections)
        search.doubtful = None
        seen = self._surest(result)
        if seen is None:
            search.looks.without(search.candidate.place, search.view)
            self.feedback_message = f"no {self.situation.request.object} in view"
            return Status.FAILURE
        if seen.confidence < self.context.parameters.min_confidence:
            search.doubtful = seen
            self.feedback_message = f"perhaps {seen.label}, confidence {seen.confidence:.2f}"
            return Status.FAILURE
        if seen.cut_off and not self._closer:
            search.doubtful = seen
            self.feedback_message = f"{seen.label}, at the edge of the picture"
            return Status.FAILURE
        search.detection = seen
        search.found = self._where(seen)
        if search.looks.all_but(search.candidate.place, search.view):
            self.context.facts.looked(search.candidate.place)
        return self.succeed(f"{seen.label}, confidence {seen.confidence:.2f}")

    def attempt(self) -> str:
        """By the place."""
        candidate = self.situation.search.candidate
        return f"look at {self.context.say.the(candidate.place) if candidate else 'it'}"

    def note_failure(self, why: str) -> None:
        """A part of the place stays unseen."""
        assert self.situation.search.candidate
        self.situation.search.looks.not_seen(self.situation.search.candidate.place, why)

    def cancel(self, request: int) -> None:
        """Look no more."""
        self.context.perception.cancel(request)

    def _where(self, seen: Detection) -> Candidate:
        """Here; but what is seen on furniture behind this place is on that."""
        here = self.situation.search.candidate
        assert here
        below = self.context.place_at(seen.position) if seen.position else None
        return replace(here, place=below or here.place)

    def _surest(self, saw: Saw) -> Detection | None:
        """The surest detection of the thing, if it was seen."""
        return next((d for d in saw.detections if d.label == self.situation.request.object), None)

    def _remember(self, detections: Iterable[Detection]) -> None:
        """A thing may be on furniture behind this place; with none below it, it counts as here."""
        assert self.situation.search.candidate
        for seen in detections:
            if seen.confidence < self.context.parameters.min_confidence:
                continue
            self.context.facts.saw((seen.label,), self._where(seen).place)


class SeeLost(SeeTarget):
    """Takes a picture and succeeds if what fell from the hand is in it.

    Reads request.object and hand.spot; writes search.detection.
    """

    def ended(self, result: Result) -> Status:
        """Keep where it lies now; it was found elsewhere."""
        if not isinstance(result, Saw):
            return self.failed(result)
        seen = self._surest(result)
        if seen is None:
            it = self.context.say.it(self.situation.request.object or SOMETHING)
            return self.fail(f"I do not see {it} {self.context.say.at(self.situation.hand.spot)}")
        self.situation.search.detection = seen
        return self.succeed(f"{seen.label}, confidence {seen.confidence:.2f}")

    def attempt(self) -> str:
        """By the spot."""
        return f"look at {self.context.say.the(self.situation.hand.spot)}"

    def note_failure(self, why: str) -> None:
        """Nothing: this is no search of a place."""


def _in_words(goal: Goal) -> str:
    match goal:
        case Pick(detection):
            return detection.label
        case Halt():
            return ""
        case _:
            return goal.place

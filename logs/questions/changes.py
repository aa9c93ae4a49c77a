"""What has changed since the tick before: tasks and parts that ended, places that were left."""

from collections.abc import Container, Iterator, Mapping
from typing import Any

from executive.records import Tick
from executive.situation import TAKEN_BACK
from executive.types.knowledge import Candidate
from logs.questions.decision import EYES, PERSON, Decision
from logs.recording.reader import At


def split(before: At[Tick] | None, at: At[Tick]) -> Iterator[Decision]:
    """The decision to do the current task in parts, with the first part."""
    was, now = _before_and_now(before, at)
    wholes = now.get("wholes") or []
    if len(wholes) > len(was.get("wholes") or ()) and now.get("command"):
        first = f"{_named(wholes[-1])}: first {_named(now['command'])}"
        yield Decision(at.time_s, "in parts", first, "", at.value.tip)


def where_to_look(
    before: At[Tick] | None, at: At[Tick], told: Container[str]
) -> Iterator[Decision]:
    """The places that a source named, unless they are among `told`, or a plan tells them."""
    was, now = _before_and_now(before, at)
    places = now.get("candidates") or ()
    if not places or places == was.get("candidates") or now.get("plan"):
        return
    named = ", ".join(str(Candidate(**place)) for place in places)
    if named not in told:
        yield Decision(at.time_s, "which places", named, places[0]["source"], at.value.tip)


def visits(before: At[Tick] | None, at: At[Tick], searches: Container[str]) -> Iterator[Decision]:
    """The places where the robot looked or could not get; told when it is done with the place.

    `searches` are the paths of the search behaviours.
    """
    was, now = _before_and_now(before, at)
    if before is None or not was.get("candidate"):
        return
    place = was["candidate"]["place"]
    tip = before.value.tip
    is_left = now.get("candidate") != was.get("candidate") or not _runs(searches, at)
    is_tried = _runs(searches, before) and is_left
    unreached, earlier = now.get("unreached") or {}, was.get("unreached") or {}
    was_taken_back = any(task["reason"] == TAKEN_BACK for task in _ended(before, at))
    for lost, why_not in unreached.items():
        again = is_tried and lost == place and not was_taken_back
        if lost not in earlier or again:
            yield Decision(at.time_s, f"look at {lost}", f"not reached: {why_not}", "", tip)
    if now.get("found"):
        if not was.get("found"):
            yield Decision(at.time_s, f"look at {place}", "seen there", EYES, tip)
    elif is_tried and place not in unreached and place in (was.get("visited") or ()):
        if _is_given_up(before, at):
            yield Decision(at.time_s, f"look at {place}", "given up", PERSON, tip)
            return
        yield Decision(at.time_s, f"look at {place}", _seen(before, at, place), EYES, tip)


def _seen(before: At[Tick], at: At[Tick], place: str) -> str:
    """The result of a look at a place: about the thing, or about everything there."""
    was, now = before.value.situation, at.value.situation
    if why_not := (now.get("unseen") or {}).get(place):
        return f"not all of it seen: {why_not}"
    ended = next(iter(_ended(before, at)), None)
    if place not in (was.get("seen") or {}):
        return "seen there" if ended and ended["location"] == place else "not seen there"
    if place in (now.get("seen") or {}):
        there = now["seen"][place]
    elif ended:
        there = ended.get("things") or ()
    else:  # each thing there has become a part of the task
        parts = (now["command"], *(now.get("tasks") or ()))
        there = [part["target"] for part in parts if part.get("source") == place]
    return f"seen there: {', '.join(there)}" if there else "not seen there"


def _is_given_up(before: At[Tick], at: At[Tick]) -> bool:
    """Whether the task was dropped because of what the person said meanwhile."""
    was, now = before.value.situation, at.value.situation
    for task in _ended(before, at):
        return bool(task["reason"] == TAKEN_BACK)
    wholes = now.get("wholes") or []
    if len(wholes) > len(was.get("wholes") or ()) and wholes[-1] == was.get("command"):
        return False  # it is continued in parts
    return now.get("command") != was.get("command") or not now.get("visited")


def _before_and_now(
    before: At[Tick] | None, at: At[Tick]
) -> tuple[Mapping[str, Any], Mapping[str, Any]]:
    return before.value.situation if before else {}, at.value.situation


def _ended(before: At[Tick] | None, at: At[Tick]) -> list[Mapping[str, Any]]:
    """The tasks and parts that have ended since the tick before, with their outcomes."""
    was, now = _before_and_now(before, at)
    known = len(was.get("ended") or ())
    return [*_parts(now)[len(_parts(was)) :], *(now.get("ended") or [])[known:]]


def _parts(situation: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    """The outcomes of parts of tasks, in the order of their ends."""
    ended = [part for task in situation.get("ended") or () for part in _within(task)]
    under_way = [part for whole in situation.get("parts") or () for part in whole]
    return [*ended, *(inner for part in under_way for inner in (*_within(part), part))]


def _within(task: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    for part in task.get("parts") or ():
        yield from _within(part)
        yield part


def parts_ended(before: At[Tick] | None, at: At[Tick]) -> Iterator[Decision]:
    """How each part of a task ended that has ended since."""
    was, now = _before_and_now(before, at)
    for part in _parts(now)[len(_parts(was)) :]:
        yield Decision(at.time_s, f"part: {_named(part)}", _ending(part), "", at.value.tip)


def tasks_ended(before: At[Tick] | None, at: At[Tick]) -> Iterator[Decision]:
    """How each task ended that has ended since; nothing if there was only one task."""
    ended = at.value.situation.get("ended") or ()
    if len(ended) < 2 and not is_under_way(at):
        return
    known = len(before.value.situation.get("ended") or ()) if before else 0
    for number, task in enumerate(ended[known:], start=known + 1):
        what = f"task {number}: {_named(task)}"
        yield Decision(at.time_s, what, _ending(task), "", at.value.tip)


def _named(task: Mapping[str, Any]) -> str:
    """A command or its outcome in words: "bring 2 fruits from desk", "put mug"."""
    number = task.get("number") or 0
    source = f"from {task['source']}" if task.get("source") else ""
    goal = f"to {task['goal']}" if task.get("goal") else ""
    kind, several = task["kind"].replace("_", " "), str(number) if number > 0 else ""
    return " ".join(filter(None, (kind, several, task["target"], source, goal)))


def _ending(task: Mapping[str, Any]) -> str:
    return f"{task['status'].replace('_', ' ')}: {task['reason']}"


def is_under_way(at: At[Tick]) -> bool:
    """Whether the mission goes on after this tick."""
    return any(node.status == "RUNNING" for node in at.value.nodes)


def _runs(paths: Container[str], at: At[Tick]) -> bool:
    return any(node.status == "RUNNING" and node.path in paths for node in at.value.nodes)

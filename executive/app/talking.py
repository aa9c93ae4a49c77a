"""Replies between missions that need no mission, and what was spoken of last."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import chain

from executive.app.parts import Parts
from executive.language.meaning import Correction
from executive.language.phrases import spoken
from executive.language.pronouns import resolved
from executive.language.spoken import after
from executive.language.wording import beginning
from executive.replies import Standing, about, reply
from executive.situation import Before
from executive.types.outcome import Outcome, TaskOutcome
from trees.telling import sentence


def answer(words: str, parts: Parts, before: Before) -> tuple[str, Before]:
    """The reply to words that need no mission (else empty), and the state after it."""
    things = [spoken(name) for name in parts.knowledge.objects()]
    if courtesy := parts.interpreter.talk(words, things):
        return courtesy, before
    said = resolved(parts.interpreter.read(words), before.spoken)
    replied = reply(said, _standing(before), parts.knowledge, parts.facts)
    if not replied:
        return "", before
    now = after(said, before.spoken, things=about(said, parts.knowledge))
    return replied, replace(before, spoken=now)


def remember(words: str, outcome: Outcome, parts: Parts, before: Before) -> Before:
    """The state after a mission, with what was spoken of in it."""
    said = parts.interpreter.read(words)
    goes_on = isinstance(said, Correction) and said.adds  # "and the pear": "both" are spoken of
    known = before.spoken.things if goes_on else ()
    said = resolved(said, before.spoken)
    things = tuple(dict.fromkeys((*known, *chain.from_iterable(map(_things_of, outcome.tasks)))))
    place = outcome.goals[0] if outcome.goals else outcome.location or ""
    return replace(before, spoken=after(said, before.spoken, things=things, place=place))


def _standing(before: Before) -> Standing:
    """What the robot can tell about itself and the last mission."""
    last = before.last
    if last is None:
        return Standing(before.in_hand, stands=before.stands)
    visited = last.tasks[-1].visited if last.tasks else last.visited
    return Standing(
        before.in_hand,
        visits=[one for one in last.candidates if one.place in visited],
        been={*last.visited, *chain.from_iterable(map(_put_at, last.tasks)), before.at},
        reason=sentence(beginning(last.reason)) if last.reason else "",
        stands=before.stands,
        asked=last.command,
    )


def _put_at(task: TaskOutcome) -> Iterator[str]:
    """The places where a task put things down."""
    for part in task.parts:
        yield from _put_at(part)
    if task.put_at:
        yield task.put_at


def _things_of(task: TaskOutcome) -> Iterator[str]:
    """The things that a task was about; of a question, those that were seen."""
    yield from task.things
    for part in task.parts:
        yield from _things_of(part)
    if task.object:
        yield task.object

"""The report about a task done in parts: how many, which ones, and why not more."""

from collections.abc import Iterable, Iterator, Sequence

from executive.language.wording import beginning, listed
from executive.situation import Whole
from executive.types.commands import Command, CommandKind
from executive.types.home import DELIVERY
from executive.types.outcome import MissionStatus, TaskOutcome
from trees.context import MissionContext
from trees.deeds import deed_of
from trees.survey import found_where
from trees.telling import number, to_where


def how_many(context: MissionContext, whole: Whole, wanted: int) -> str:
    """A sentence: "I brought one of two: the apple; not the pear: I did not find it"."""
    command, unmoved = whole.command, already_there(whole)
    done = [part for part in whole.done if part not in unmoved]
    count = f"{number(len(done))} of {number(wanted)}"
    if len(done) == wanted:
        count = {1: "one", 2: "both"}.get(wanted, f"all {number(wanted)}")
        count = number(wanted) if whole.unseen else count
    did = " ".join(filter(None, (deed_of(command.kind).did, count, to_where(context, command))))
    which = named(context, command, done)
    why = why_not_all(context, whole) if len(whole.done) < wanted else ()
    deed = f"I {did}" + f": {which}" * bool(which)
    clauses = ("" if unmoved and not done else deed, found_there(context, unmoved))
    return beginning("; ".join(filter(None, (*clauses, *why, whole.unseen)))) + "."


def already_there(whole: Whole) -> Sequence[TaskOutcome]:
    """The parts for which nothing had to be carried."""
    carries = whole.command.kind.means.carries
    return [part for part in whole.done if carries and not part.put_at]


def found_there(context: MissionContext, parts: Sequence[TaskOutcome]) -> str:
    """A clause: these things were in their place already; empty if there are none."""
    names = [part.object or part.target for part in parts]
    if not names:
        return ""
    were = context.say.agree(names[0], "was", "were") if len(names) == 1 else "were"
    return f"{listed([context.say.the(name) for name in names])} {were} there already"


def named(context: MissionContext, command: Command, done: Iterable[TaskOutcome]) -> str:
    """The things that were done; with their places, unless the words already say where."""
    at = {part.object or part.target: part.put_at or part.location for part in done}
    known = len(set(at.values())) == 1 and (command.goal or DELIVERY in at.values())
    places = {name: place for name, place in at.items() if place}
    if known or len(places) < len(at) or command.kind == CommandKind.TAKE:
        return listed([context.say.the(name) for name in at])
    return found_where(places, context.say)


def why_not_all(context: MissionContext, whole: Whole) -> Iterator[str]:
    """Why it was not done for the others; things with the same reason together."""
    reasons: dict[str, list[str]] = {}
    for part in whole.parts:
        if part.status != MissionStatus.DONE:
            name = context.say.the(part.object or part.target)
            reasons.setdefault(reason_now(context, part), []).append(name)
    for reason, names in reasons.items():
        yield f"not {listed(names)}: {reason}"
    if not reasons:
        one_hand = whole.command.kind == CommandKind.TAKE
        yield "I can hold one thing at a time" if one_hand else "I know of no more"


def reason_now(context: MissionContext, part: TaskOutcome) -> str:
    """Why a part was not done, without "I still hold" if the thing is no longer in the hand."""
    reason = part.reason.rstrip(".")
    if part.object and part.object != context.situation.hand.in_hand:
        return reason.removesuffix(f"; I still hold {context.say.the(part.object)}")
    return reason


def sentences(parts: Iterable[TaskOutcome]) -> str:
    """The reasons of all parts, where one success would have been enough."""
    return "; ".join(dict.fromkeys(part.reason.rstrip(".") for part in parts))

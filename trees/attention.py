"""What the person says while the robot is busy: it is answered at once, and changes the agenda.

Questions are answered, and statements are remembered. A new request goes on the agenda, a
correction changes the current task, and what the person takes back is not done.

In these functions `at_hand` is the current task (None: there is none), `words` what the person
said, and `now` a sentence that says what the robot is doing. Each returns the answer.
"""

import re
from dataclasses import replace

from executive.language.commands import NOT_KNOWN_WHAT, SAY_INSTEAD
from executive.language.corrections import as_correction
from executive.language.meaning import (
    Answer,
    Choice,
    Correction,
    Courtesy,
    Question,
    Refusal,
    Request,
    Said,
    Statement,
    Things,
)
from executive.language.placed import placed
from executive.language.pronouns import resolved
from executive.language.wording import either
from executive.replies import Standing, about, reply
from executive.text import too_long
from executive.types.commands import Command, CommandKind
from trees.at_hand import of_all_spoken, spoken_now
from trees.context import MissionContext
from trees.corrections import correct
from trees.first_or_only import first_of_all, nothing_else, spared
from trees.taken_back import refused
from trees.wished import take_in
from trees.wishes import named_in, objects_of

_FORGETS = re.compile(r"\b(?:forget|never mind)\b(?!.*\b(?:others?|rest)\b)", re.I)

_TELLS = re.compile(
    r"^\W*(?:what|why|how|where|who|when|is|are)\b"
    r"|\b(?:it|that|this|they|(?:the|my|our|your) (?:\w+ ){1,3}?)"
    r"\b ?(?:is|was|are|were|has|does|did|looks|seems)(?:n['’]?t)?\b"
    r"(?!.*\b(?:need|want|necessary|bother|matter))",
    re.I,
)
"""Questions and statements, which take nothing back: "it is not heavy"."""


def attend_to(context: MissionContext, words: str, now: str) -> str:
    """Do what follows from words that answer no question of the robot; return the answer to them.

    Args:
        context: its agenda and its facts may be changed.
        words: what the person said.
        now: what the robot is doing, as a sentence.
    """
    if why := too_long(words):
        return f"Sorry: {why}."
    at_hand = context.situation.agenda.whole_of(context.situation.request.command)
    said = context.interpreter.read(words)
    if at_hand and isinstance(said, Answer) and said.first and isinstance(said.things, Things):
        return first_of_all(context, said.things, at_hand, words, now)
    correction = _as_correction(said, at_hand)
    if isinstance(said, Answer):
        said = correction or resolved(said, of_all_spoken(context.situation, said))
    if said == Answer(Choice.YES):
        return now
    named = correction.meant if correction else said.things if isinstance(said, Answer) else None
    if at_hand and isinstance(named, Things) and context.interpreter.only(words):
        return nothing_else(context, named, words, at_hand)
    if denial := not correction and context.interpreter.denial(words):
        return _denied(context, words, denial, at_hand, now)
    match said:
        case Courtesy():
            return context.interpreter.talk(words)
        case Question() | Statement():
            return _reply(context, said, now) or context.interpreter.talk(words)
        case Request():
            return _reply(context, said, now) or take_in(context, said, words, at_hand, now)
        case Refusal() if answer := _taken_back(context, said, words, at_hand, now):
            return answer
    if correction and at_hand:
        return correct(context, correction, words, now)
    why_not = context.interpreter.remark(words)
    return why_not or f"{context.interpreter.not_understood(words)}. {now}"


def _as_correction(said: Said, at_hand: Command | None) -> Correction | None:
    """The correction that the words are; None if they are not one."""
    match said:
        case Answer(things=None, where=[place, *_], told=False) if _goes_somewhere(at_hand):
            return Correction(place=place)  # "on the sofa": where to, and not where it is
    return as_correction(said)


def _denied(
    context: MissionContext, words: str, denial: str, at_hand: Command | None, now: str
) -> str:
    """Leave out what a negation is about, if that is clear: "I do not need the mug"."""
    if at_hand and _denies_goal(context, words, at_hand):
        context.situation.agenda.replace(replace(at_hand, goal=""))
        return "Then not there."
    beside = _beside(context, words, at_hand)
    answer = "" if _TELLS.search(words) else refused(context, words, at_hand)
    return f"{answer}{beside}" if answer else f"{NOT_KNOWN_WHAT.format(denial)} {now}"


def _taken_back(
    context: MissionContext, said: Refusal, words: str, at_hand: Command | None, now: str
) -> str:
    """Leave out what is refused; no answer if the refusal changes nothing."""
    if at_hand and (only := spared(context, said)):
        return nothing_else(context, only, words, at_hand)
    if answer := refused(context, said.words, at_hand):
        beside = _beside(context, said.words.partition(" but ")[2], at_hand)
        return answer + (SAY_INSTEAD if said.more else beside)
    if not said.words or named_in(context, said.words):
        return ""
    if _FORGETS.search(words) and (all_of_it := refused(context, "everything", at_hand)):
        return all_of_it  # "forget it", of something unknown, may mean all tasks
    return f"{NOT_KNOWN_WHAT.format('not')} {now}"


def _beside(context: MissionContext, words: str, at_hand: Command | None) -> str:
    """A sentence about things that the words name and no task is about; empty if there are none."""
    tasks = [at_hand] if at_hand else []
    tasks += [task.command for task in context.situation.agenda.tasks]
    about = {name for one in tasks for name in objects_of(context, one)}
    others = sorted(named_in(context, words) - about)
    rest = either([context.say.the(name) for name in others])
    return f" What is to be done with {rest} I do not understand." if rest else ""


def _denies_goal(context: MissionContext, words: str, at_hand: Command) -> bool:
    """Whether the words take back where the thing is to go: "not on the sofa"."""
    if at_hand.kind != CommandKind.PUT or named_in(context, words):
        return False
    places = context.knowledge.places_named
    said = (place for place in placed(words, context.knowledge.is_place) if place)
    return any({*places(place)} & {*places(at_hand.goal)} for place in said)


def _goes_somewhere(command: Command | None) -> bool:
    """Whether the current task has a goal: a place where the thing, or the robot, is to go."""
    return command is not None and command.kind.means.at_goal


def _reply(context: MissionContext, said: Question | Statement | Request, now: str) -> str:
    """The answer; a statement about the thing that the robot looks for redirects the search."""
    situation, spoken = context.situation, spoken_now(context.situation)
    if isinstance(said, Statement) and said.denied and (next_one := situation.search.candidate):
        spoken = replace(spoken, place=next_one.place)  # "it is not there": where the robot looks
    meant = resolved(said, spoken)
    visited = situation.search.looks.visited
    visits = [one for one in situation.search.candidates if one.place in visited]
    asked = situation.request.words
    standing = Standing(situation.hand.in_hand, now, visits, visited, asked=asked)
    answer = reply(meant, standing, context.knowledge, context.facts)
    if isinstance(meant, Statement) and situation.search.found is None and not situation.has_it:
        _look_elsewhere(context, meant)
    return answer


def _look_elsewhere(context: MissionContext, said: Statement) -> None:
    """Begin the task anew if the statement is about its thing and changes where to look."""
    request, search = context.situation.request, context.situation.search
    if about(said, context.knowledge) != (request.object,):
        return
    denied = context.facts.places_denied(request.thing)
    if not said.denied or said.more or (search.candidate and search.candidate.place in denied):
        is_source = bool(request.from_places) and {*request.from_places} <= {*denied}
        command = request.command
        context.situation.agenda.instead = (
            replace(command, source="") if command and is_source else command
        )

"""What is said while the robot is at something is answered at once, and the tree goes by it.

A question is answered, and what is told is remembered; a further wish goes on the agenda; a
correction takes the place of the task at hand; what is taken back is not done.
"""

import re
from collections.abc import Sequence
from dataclasses import replace
from itertools import chain

from executive.language.anew import number_alone
from executive.language.commands import NOT_KNOWN_WHAT, SAY_INSTEAD, commands_in, left_alone
from executive.language.corrections import as_correction, corrected
from executive.language.folding import of_several
from executive.language.meaning import (
    ME,
    Answer,
    Choice,
    Correction,
    Courtesy,
    Question,
    Refusal,
    Request,
    Statement,
    Thing,
    Things,
)
from executive.language.placed import placed
from executive.language.pronouns import resolved, with_names
from executive.language.spoken import Spoken
from executive.language.wording import either
from executive.replies import Standing, about, reply
from executive.situation import Situation
from executive.text import too_long
from executive.types.commands import Command, CommandKind, Commands
from trees.context import MissionContext
from trees.taken_back import is_about, refused
from trees.telling import in_one_breath
from trees.wishes import (
    added,
    done_first,
    named_in,
    objects_of,
    only_so_many,
    replaced,
    waiting_first,
)

_FORGETS = re.compile(r"\b(?:forget|never mind)\b(?!.*\b(?:others?|rest)\b)", re.I)

_TELLS = re.compile(
    r"^\W*(?:what|why|how|where|who|when|is|are)\b"
    r"|\b(?:it|that|this|they|(?:the|my|our|your) (?:\w+ ){1,3}?)"
    r"\b ?(?:is|was|are|were|has|does|did|looks|seems)(?:n['’]?t)?\b"
    r"(?!.*\b(?:need|want|necessary|bother|matter))",
    re.I,
)
"""What is asked, or told of a thing, takes nothing back: "it is not heavy"."""


def attend_to(context: MissionContext, words: str, now: str) -> str:
    """Note what follows from words that answer no question, and say what to say to them.

    Args:
        context: whom it is about; its agenda is changed, and its facts.
        words: what the person said.
        now: what the robot is doing, as a sentence.
    """
    if why := too_long(words):
        return f"Sorry: {why}."
    request, agenda = context.situation.request, context.situation.agenda
    at_hand = agenda.whole_of(request.command)
    said = context.interpreter.read(words)
    spoken = _of_all_spoken(context.situation, said)
    correction = as_correction(said)
    match said:
        case Answer(things=None, where=[place, *_], told=False) if _goes_somewhere(at_hand):
            correction = Correction(place=place)  # "on the sofa": where to, and not where it is
        case Answer(things=Things() as things, first=True) if at_hand:
            return _first(context, things, at_hand, words, now)
    if isinstance(said, Answer):
        said = correction or resolved(said, spoken)  # "it is on the sofa"
    if said == Answer(Choice.YES):
        return now
    named = correction.meant if correction else said.things if isinstance(said, Answer) else None
    if at_hand and isinstance(named, Things) and context.interpreter.only(words):
        return _only(context, named, words, at_hand)
    if denial := not correction and context.interpreter.denial(words):
        if at_hand and _denies_goal(context, words, at_hand):
            agenda.replace(replace(at_hand, goal=""))
            return "Then not there."
        beside = _beside(context, words, at_hand)
        answer = "" if _TELLS.search(words) else refused(context, words, at_hand)
        return f"{answer}{beside}" if answer else f"{NOT_KNOWN_WHAT.format(denial)} {now}"
    match said:
        case Courtesy():
            return context.interpreter.talk(words)
        case Question() | Statement():
            return _reply(context, said, now) or context.interpreter.talk(words)
        case Refusal() if answer := refused(context, said.words, at_hand):
            beside = _beside(context, said.words.partition(" but ")[2], at_hand)
            return answer + (SAY_INSTEAD if said.more else beside)
        case Refusal() if said.words and not named_in(context, said.words):
            if _FORGETS.search(words) and (all_of_it := refused(context, "everything", at_hand)):
                return all_of_it  # what nobody knows may be all that is to be done
            return f"{NOT_KNOWN_WHAT.format('not')} {now}"
        case Request() if answer := _reply(context, said, now):
            return answer
        case Request():
            commands = commands_in(resolved(said, spoken), words)
            if (alone := left_alone(said)) and isinstance(commands, tuple):
                return _instead_of(context, alone, commands, at_hand)
            if at_hand and isinstance(commands, tuple):
                if fails := _if_it_fails(context, commands, at_hand):
                    return replaced(context, ((fails,),))
                if _in_its_stead(context, said, at_hand) or _lets_go(context, commands):
                    return replaced(context, commands)
                if said.first:
                    return done_first(context, commands, at_hand)
            return added(context, commands, now)
    if correction and at_hand:
        return correct(context, correction, words, now)
    why_not = context.interpreter.remark(words)
    return why_not or f"{context.interpreter.not_understood(words)}. {now}"


def _beside(context: MissionContext, words: str, at_hand: Command | None) -> str:
    """What words name that none of the tasks is about, as one more sentence; empty if nothing."""
    tasks = [at_hand] if at_hand else []
    tasks += [task.command for task in context.situation.agenda.tasks]
    about = {name for one in tasks for name in objects_of(context, one)}
    others = sorted(named_in(context, words) - about)
    rest = either([context.say.the(name) for name in others])
    return f" What is to be done with {rest} I do not understand." if rest else ""


def _denies_goal(context: MissionContext, words: str, at_hand: Command) -> bool:
    """Whether it is the place where the thing is to go that is not meant: "not on the sofa"."""
    if at_hand.kind != CommandKind.PUT or named_in(context, words):
        return False
    places = context.knowledge.places_named
    said = (place for place in placed(words, context.knowledge.is_place) if place)
    return any({*places(place)} & {*places(at_hand.goal)} for place in said)


def _goes_somewhere(command: Command | None) -> bool:
    """Whether the task at hand has a place where the thing, or the robot, is to go."""
    return command is not None and command.kind.means.at_goal


def spoken_now(situation: Situation) -> Spoken:
    """What "it" and "there" are: what the task at hand is about."""
    request, before = situation.request, situation.dialogue.spoken
    if not request.command:
        return before
    things = (request.object or request.command.target,)
    place = request.goal or request.command.goal or request.command.source or before.place
    return Spoken(things, request.command.target, place, before.request)


def _of_all_spoken(situation: Situation, said: object) -> Spoken:
    """The same; of "them" and "both", with what waits, if it was asked for in one sentence."""
    spoken, at_hand = spoken_now(situation), situation.request.command
    tasks = said.tasks if isinstance(said, Request) else ()
    if at_hand is None or not any(of_several(task.things) for task in tasks):
        return spoken
    waiting = (task.command for task in situation.agenda.whole_tasks)
    others = [one.target for one in waiting if one.words == at_hand.words]
    return replace(spoken, things=(*spoken.things, *others))


def _lets_go(context: MissionContext, commands: Commands) -> bool:
    """Whether what is in the hand is to be put down: now, and not when it is there."""
    match commands:
        case [[Command(kind=CommandKind.PUT_DOWN)]]:
            return context.situation.hand.in_hand is not None
    return False


def _in_its_stead(context: MissionContext, said: Request, at_hand: Command) -> bool:
    """Whether a certain thing is wanted instead of that at hand: "the drill, not the hammer"."""
    things = [t for task in said.tasks if task.things for t in task.things.members]
    certain = (t for t in things if t.definite and t.number is None)
    left_out = (but.words for thing in certain for but in thing.exceptions if but.words)
    return any(is_about(context, words, at_hand) for words in left_out)


def _reply(context: MissionContext, said: Question | Statement | Request, now: str) -> str:
    """Answer; if the thing that is looked for is elsewhere, look there from now on."""
    situation = context.situation
    meant = resolved(said, spoken_now(situation))
    visited = situation.search.looks.visited
    visits = [one for one in situation.search.candidates if one.place in visited]
    asked = situation.request.words
    standing = Standing(situation.hand.in_hand, now, visits, visited, asked=asked)
    answer = reply(meant, standing, context.knowledge, context.facts)
    is_it = about(meant, context.knowledge) == (situation.request.object,)
    searches = situation.search.found is None and not situation.has_it
    if isinstance(meant, Statement) and is_it and searches:
        situation.agenda.instead = situation.request.command
    return answer


def correct(
    context: MissionContext, said: Correction, words: str, now: str, instead: str = " instead"
) -> str:
    """Do this instead of the task at hand, or beside it."""
    at_hand = context.situation.agenda.whole_of(context.situation.request.command)
    assert at_hand
    spoken = _of_all_spoken(context.situation, said.meant)
    if changed := _correct_later(context, said, at_hand, words):
        return changed
    if said.left_out and not _is_goal(context, said.left_out, at_hand):
        return _less(context, said, at_hand, words, now)
    commands = corrected(with_names(said, spoken), at_hand, words)
    if said.adds or not isinstance(commands, tuple):
        return added(context, commands, now)
    commands = (*commands, *_likewise(context, said, at_hand, commands, words))
    return replaced(context, commands, instead)


def _is_goal(context: MissionContext, left_out: Sequence[Thing], at_hand: Command) -> bool:
    """Whether it is where the task at hand goes that is not meant: "on the sofa, not the desk"."""
    places = context.knowledge.places_named
    named = {place for but in left_out for place in places(but.words)}
    return bool(named) and named <= {*places(at_hand.goal)}


def _less(context: MissionContext, said: Correction, at_hand: Command, words: str, now: str) -> str:
    """Do it so, but for what is not meant: "to the desk, but not the pear"."""
    agenda, left_out = context.situation.agenda, " and ".join(but.words for but in said.left_out)
    without = refused(context, left_out, at_hand)
    if not without:
        return f"{context.interpreter.not_understood(words)}. {now}"
    rest = replace(said, left_out=())
    if agenda.taken_back:
        agenda.go_on_with(others := _likewise(context, rest, at_hand, (), words))
        others_so = in_one_breath(context, chain.from_iterable(others))
        return f"{without} All right: I {others_so}." if others else without
    among = tuple(sorted(named_in(context, left_out) & objects_of(context, at_hand)))
    narrower = replace(at_hand, exceptions=(*at_hand.exceptions, *among))
    commands = corrected(rest, narrower, words)
    if isinstance(commands, str):
        return f"{without} {commands}"
    return replaced(context, (*commands, *_likewise(context, rest, narrower, commands, words)))


def _likewise(
    context: MissionContext, said: Correction, at_hand: Command, commands: Commands, words: str
) -> Commands:
    """What else was asked for in one sentence with the task at hand, if it is to go elsewhere, too.

    Tasks that wait, of which that takes the place, are struck out; so are those that are asked for
    anew.
    """
    agenda, asked_anew = context.situation.agenda, [*chain.from_iterable(commands)]
    things = {name for one in asked_anew for name in objects_of(context, one)}
    changed: list[tuple[Command, ...]] = []
    whole = agenda.whole_tasks
    breath = [at_hand, *(t.command for t in whole if t.command.words == at_hand.words)]
    wanted = {name for one in breath for name in objects_of(context, one)}
    only_these = len(asked_anew) > 1 and things <= wanted  # "no, the mug and the pear", of three
    for task in whole:
        command = task.command
        asked_again = set() < objects_of(context, command) <= things
        alike = (command.words, command.kind, command.goal)
        if said.meant is None and alike == (at_hand.words, at_hand.kind, at_hand.goal):
            if isinstance(others := corrected(said, command, words), tuple):
                agenda.tasks.remove(task)
                changed += others
        elif command.words == at_hand.words and isinstance(said.meant, Things):
            if asked_again:
                agenda.tasks.remove(task)
            elif only_these:
                agenda.strike_out(task)
        elif asked_again:
            agenda.tasks.remove(task)
    return tuple(changed)


def is_about_the_same(context: MissionContext, said: Request, words: str) -> bool:
    """Whether all that is asked for is about the one thing of the task at hand."""
    request = context.situation.request
    commands = commands_in(resolved(said, spoken_now(context.situation)), words)
    if request.object is None or not isinstance(commands, tuple):
        return False
    each = chain.from_iterable(commands)
    return all(objects_of(context, one) == {request.object} for one in each)


def differs(context: MissionContext, said: Request, words: str) -> bool:
    """Whether something else is asked for than what is at hand, and nothing beside it."""
    at_hand = context.situation.request.command
    commands = commands_in(resolved(said, spoken_now(context.situation)), words)
    if at_hand is None or not isinstance(commands, tuple):
        return False
    command, *others = chain.from_iterable(commands)
    same = objects_of(context, command) == objects_of(context, at_hand)
    where = (command.kind, command.source, command.goal)
    return bool(others) or not same or where != (at_hand.kind, at_hand.source, at_hand.goal)


def _correct_later(context: MissionContext, said: Correction, at_hand: Command, words: str) -> str:
    """Change the task that waits, if it is that which is not meant: "the pear, not the apple".

    So it is if what it is about is to go elsewhere: "no, the pear to the desk".
    """
    agenda, meant = context.situation.agenda, said.wrong or _to_go_elsewhere(said)
    named = " or ".join(thing.words for thing in meant.members) if meant else ""
    if not (wrong := named_in(context, named)) or wrong & objects_of(context, at_hand):
        return ""
    task = next((one for one in agenda.tasks if wrong & objects_of(context, one.command)), None)
    commands = corrected(replace(said, wrong=None), task.command, words) if task else ""
    if not task or not isinstance(commands, tuple):
        return ""
    [[command], *others] = commands
    wanted = [at_hand, *(one.command for one in agenda.tasks if one is not task)]
    if not others and any(_asks_for_the_same(context, command, one) for one in wanted):
        agenda.strike_out(task)
        return f"Then I do not {in_one_breath(context, (task.command,))}."
    agenda.change(task, command)
    agenda.add(others)
    return f"All right: I {in_one_breath(context, chain.from_iterable(commands))} instead."


def _asks_for_the_same(context: MissionContext, command: Command, other: Command) -> bool:
    """Whether both are the same deed with the same things: one of them is enough."""
    same = (command.kind, command.goal) == (other.kind, other.goal)
    return same and objects_of(context, command) == objects_of(context, other)


def _to_go_elsewhere(said: Correction) -> Things | None:
    """The things that are to go to another place; None if none are."""
    match said.meant:
        case Request(tasks=[task]) if task.goal not in (None, ME):
            return task.things
    return None


def all_of(
    context: MissionContext, names: Sequence[str], words: str, *, one_of: bool = False
) -> str:
    """Do what is at hand with each of these things, which were named where one was asked for.

    Or with `one_of` them, which takes least time.
    """
    at_hand = context.situation.agenda.whole_of(context.situation.request.command)
    assert at_hand
    things = (context.say.words(name) for name in names)
    meant = Things(tuple(Thing(thing, definite=True, said=thing) for thing in things), one_of)
    commands = corrected(Correction(meant), at_hand, words)
    if isinstance(commands, str):
        return commands
    said = replaced(context, commands, "")
    return "All right: I choose the one that takes least time." if one_of else said


def _if_it_fails(context: MissionContext, commands: Commands, at_hand: Command) -> Command | None:
    """The task at hand with what is to be done if the thing is not there; None if that is unasked.

    As in "if you cannot find it, bring the mug".
    """
    match commands:
        case [[Command(kind=CommandKind.CHECK, conditional=True, unless=Command()) as command]]:
            pass
        case _:
            return None
    if at_hand.conditional or objects_of(context, command) != objects_of(context, at_hand):
        return None
    sought = replace(command, conditional=False, unless=None) if command.source else None
    source = command.source or at_hand.source
    return replace(at_hand, conditional=True, source=source, sought=sought, unless=command.unless)


def _first(context: MissionContext, things: Things, at_hand: Command, words: str, now: str) -> str:
    """Do what is named before all else: what waits, or the deed at hand with it."""
    if any(thing.pronoun for thing in things.members):
        return f"{context.interpreter.not_understood(words)}. {now}"
    if said := waiting_first(context, things, at_hand, now):
        return said
    commands = corrected(Correction(things), at_hand, words)
    return commands if isinstance(commands, str) else done_first(context, commands, at_hand)


def _only(context: MissionContext, things: Things, words: str, at_hand: Command) -> str:
    """Do what is named, and nothing else that was to be done; or do it instead of all of that."""
    agenda = context.situation.agenda
    named = named_in(context, " or ".join(thing.words for thing in things.members))
    if not named:
        number = number_alone(things)
        fewer = only_so_many(context, number, at_hand) if number else ""
        return fewer or f"{context.interpreter.not_understood(words)}."
    whole = agenda.whole_tasks
    waiting = [task for task in whole if named & objects_of(context, task.command)]
    wishes = [task.command for task in waiting]
    if not all(objects_of(context, one) <= named for one in wishes):
        return f"{context.interpreter.not_understood(words)}."
    for task in [task for task in whole if task not in waiting]:
        agenda.strike_out(task)
    if not objects_of(context, at_hand) <= named:  # of all that was wanted, only this
        if not waiting:
            return correct(context, Correction(things), words, "")
        agenda.take_back()
    else:
        wishes.insert(0, at_hand)
    return f"All right: I {in_one_breath(context, wishes)}, and nothing else."


def _instead_of(
    context: MissionContext, alone: str, commands: Commands, at_hand: Command | None
) -> str:
    """Do these, and leave alone what is named: it may be what the task at hand is about."""
    if at_hand and is_about(context, alone, at_hand):
        return replaced(context, commands)
    said = refused(context, alone, at_hand)
    return " ".join(filter(None, (said, added(context, commands, ""))))

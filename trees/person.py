"""Leaves that talk with the person."""

import re
from abc import abstractmethod
from dataclasses import replace

from py_trees.common import Status

from executive.interfaces import Knowledge
from executive.language.answers import how_many_of, named, picked
from executive.language.meaning import (
    Answer,
    Choice,
    Correction,
    Refusal,
    Request,
    Said,
    Thing,
    Things,
    Unread,
)
from executive.language.wording import Wording, beginning
from executive.records import Activity, Utterance
from executive.replies import SAYS, SAYS_OF_SEVERAL
from executive.situation import candidates_from
from executive.text import printable, too_long
from executive.types import (
    DELIVERY,
    Answered,
    Command,
    CommandKind,
    Question,
    QuestionKind,
    Result,
    Source,
)
from trees.attention import all_of, attend_to, correct
from trees.context import MissionContext
from trees.nodes import Action, Step, why_of
from trees.telling import BETWEEN, NEXT_TO, sentence, tell
from trees.unknown import nearest, unknown, unresolved

_QUESTIONS = {CommandKind.FIND, CommandKind.COUNT, CommandKind.CHECK, CommandKind.TELL}
NO_PLACE = "I know no such place. "


class Ask(Action):
    """Puts a question, and puts it again while the answer makes no sense.

    Writes dialogue.inquiries, and dialogue.no_help if no answer is of use.
    """

    source = Source.USER
    activity = Activity.ASKING

    def __init__(self, name: str, context: MissionContext) -> None:
        """Wait for each answer as long as the parameters allow."""
        super().__init__(name, context, context.parameters.answer_s)
        self._tries = 0
        self._attended = False

    @abstractmethod
    def question(self) -> Question:
        """What to ask."""

    @abstractmethod
    def understood(self, answer: str) -> bool:
        """Take the answer in, if it makes sense."""

    @abstractmethod
    def unresolved(self) -> str:
        """What stays unknown without an answer, as a clause."""

    def declines(self, answer: str) -> bool:
        """Whether the answer is that there is none."""
        return self.context.interpreter.declines(answer)

    def initialise(self) -> None:
        """Ask for the first time."""
        self._tries, self._attended = 0, False
        super().initialise()

    def start(self) -> int:
        """Ask."""
        question = self.question()
        question = replace(question, text=printable(question.text))
        self._tries += 1
        self.situation.dialogue.inquiries += 1
        self.context.recorder.record(Utterance("robot", question.text))
        return self.context.user.ask(question)

    def ended(self, result: Result) -> Status:
        """Take the answer, ask again, or accept that there is none."""
        if not isinstance(result, Answered):
            return self._no_help(why_of(result))
        self.context.recorder.record(Utterance("person", result.text))
        unread = too_long(result.text)
        said = self.context.interpreter.read(result.text)
        refuses = isinstance(said, Refusal) and said.words != ""
        if not unread and not refuses and self.declines(result.text):
            return self._no_help("you could not tell me")
        if not unread and self.understood(result.text):
            return self.succeed(result.text)
        self._attended = not unread and self._attend_to(said, result.text)
        if self.situation.agenda.interrupts:
            return Status.RUNNING  # until the tree gives it up, in this tick
        if self._tries < self.context.parameters.questions:
            return self.start_again()
        return self._no_help(unread or f"I did not understand your answer '{result.text}'")

    def _attend_to(self, said: Said, words: str) -> bool:
        """Answer what is no answer: a further wish, a correction, a question."""
        if isinstance(said, Answer | Unread):
            return False
        tell(self.context, attend_to(self.context, words, f"I {self.doing()}."))
        return True

    def doing(self) -> str:
        """It waits."""
        return "wait for your answer"

    def out_of_time(self) -> Status:
        """Nobody answered."""
        return self._no_help(f"nobody answered within {self._patience_s:g} s")

    def cancel(self, request: int) -> None:
        """Withdraw the question."""
        self.context.user.cancel(request)

    def _no_help(self, why: str) -> Status:
        self.situation.dialogue.no_help = why
        return self.fail(f"{self.unresolved()}, and {why}")


class AskYesNo(Ask):
    """Asks whether something is so; fails if it is not."""

    _agrees: bool | None = None

    @abstractmethod
    def agreed(self) -> None:
        """Take it as so."""

    def declines(self, answer: str) -> bool:
        """A no is an answer."""
        return self.context.interpreter.agrees(answer) is None and super().declines(answer)

    def understood(self, answer: str) -> bool:
        """Hear yes and no."""
        self._agrees = self.context.interpreter.agrees(answer)
        if self._agrees:
            self.agreed()
        return self._agrees is not None

    def ended(self, result: Result) -> Status:
        """Fail on a no, too; a yes settles what is asked for."""
        status = super().ended(result)
        if status != Status.SUCCESS:
            return status
        if not self._agrees:
            return self.fail(f"{self.unresolved()}, and you said no")
        assert self.situation.request.command
        return self.succeed(
            f"{self.situation.request.command.kind} {self.situation.request.command.target}"
        )


class AskDoYouMean(AskYesNo):
    """Asks whether a known name is meant: the robot never silently guesses.

    Reads request.guess; writes request.command.
    """

    def question(self) -> Question:
        """Offer the guess."""
        assert self.situation.request.command
        target, guess = self.situation.request.command.target, self.situation.request.guess
        meant = self.context.say.the(guess)
        text = f"{unknown(self.context, target)}. Do you mean {meant}?"
        objects = self.context.knowledge.objects_named(guess)
        return Question(QuestionKind.CONFIRM, guess, text, objects)

    def agreed(self) -> None:
        """The guess is what was asked for."""
        assert self.situation.request.command
        command = replace(self.situation.request.command, target=self.situation.request.guess)
        self.situation.request.command = command

    def understood(self, answer: str) -> bool:
        """Instead of yes or no, the person may say what they mean: "no, the mug"."""
        names = self.context.knowledge.names_in(answer)
        refused = self.context.interpreter.agrees(answer) is False
        if len(names) != 1 or (refused and names[0] == self.situation.request.guess):
            return super().understood(answer)
        self.situation.request.guess = names[0]
        self._agrees = True
        self.agreed()
        return True

    def unresolved(self) -> str:
        """Name the guess."""
        assert self.situation.request.command
        target, guess = self.situation.request.command.target, self.situation.request.guess
        return unresolved(self.context, target, (guess,))


class AskWhichObject(Ask):
    """Asks which thing is meant, where the words fit several or none.

    Reads request.options; writes request.object, or fewer request.options.
    """

    def question(self) -> Question:
        """Offer the members of the class, or the nearest known names."""
        assert self.situation.request.command
        target, any_of = self.situation.request.command.target, self.context.say.any_of
        if (options := self.situation.request.options) and self.situation.request.several:
            text = f"I can do one thing at a time. Which first: {any_of(options)}?"
        elif options:
            kind = "" if self.situation.request.command.purpose else f" {target}"
            text = f"Which{kind} do you mean: {any_of(options)}?"
        elif self._all_left_out():
            text = f"I know no other {target}. Which thing do you mean?"
        else:
            options, said = self._other_names(target), unknown(self.context, target)
            meant = f"Do you mean {any_of(options)}, or something else?"
            text = f"{said}. {meant if options else 'Which thing do you mean?'}"
        return Question(QuestionKind.WHICH_OBJECT, target, text, options)

    def _all_left_out(self) -> bool:
        """Whether things were named, and all of them said not to be meant: "another mug"."""
        assert self.situation.request.command
        return bool(self.context.knowledge.objects_named(self.situation.request.command.target))

    def _other_names(self, target: str) -> tuple[str, ...]:
        """The nearest known names, less the one that the person did not mean."""
        names = nearest(self.context, target)
        return tuple(name for name in names if name != self.situation.request.guess)

    def understood(self, answer: str) -> bool:
        """One object is enough; several narrow the next question down."""
        options, find = self.situation.request.options, self.context.knowledge.objects_named
        said = self.context.interpreter.read(answer)
        if chosen := picked(said, self.question().options):
            meant = tuple(one for name in chosen for one in find(name))
        else:
            meant = find(answer) or self._named(said) or self._nearly(answer)
        if options:
            meant = tuple(one for one in meant if one in options)
        assert self.situation.request.command
        meant = without_exceptions(self.context.knowledge, self.situation.request.command, meant)
        if len(meant) > 1:
            self.situation.request.options = meant
        elif meant:
            self.situation.request.object = meant[0]
        return len(meant) == 1

    def _attend_to(self, said: Said, words: str) -> bool:
        """Several may be meant, or any but the one that is named."""
        request, find = self.situation.request, self.context.knowledge.objects_named
        if isinstance(said, Refusal) and (rest := self._but(said.words)):
            request.options = rest
            return True
        if isinstance(said, Answer) and (number := how_many_of(said)):
            said = Correction(Things((Thing(number=number, said=str(number)),)))
            tell(self.context, correct(self.context, said, words, f"I {self.doing()}."))
            return True
        several = self._several(said)
        if not several or not request.options:
            return super()._attend_to(said, words)
        names = tuple(dict.fromkeys(one for name in several for one in find(name)))
        tell(self.context, all_of(self.context, names, words))
        return True

    def _but(self, words: str) -> tuple[str, ...]:
        """What is left of the things that were offered; none if none is named, or each."""
        request, find = self.situation.request, self.context.knowledge.objects_named
        named = [one for name in self.context.knowledge.names_in(words) for one in find(name)]
        rest = tuple(one for one in request.options if one not in named)
        return rest if len(rest) < len(request.options) else ()

    def _several(self, said: Said) -> tuple[str, ...]:
        """More than one of those that were offered: "all", "the apple and the pear"."""
        offered = self.question().options
        if not isinstance(said, Answer) or (said.things and said.things.one_of):
            return ()
        if said.choice == Choice.ALL:
            return offered
        members = said.things.members if said.things else ()
        if members and all(thing.place_in_list for thing in members):
            each = (picked(Answer(place_in_list=t.place_in_list), offered) for t in members)
            return tuple(one for names in each for one in names)
        names = tuple(thing.words for thing in members)
        are_known = all(self.context.knowledge.objects_named(name) for name in names)
        return names if len(names) > 1 and are_known else ()

    def _named(self, said: Said) -> tuple[str, ...]:
        """What an answer names in more words; a command is one only for what was offered."""
        command = self.situation.request.command
        if (
            isinstance(said, Request)
            and command
            and said.tasks[0].verb in _QUESTIONS - {command.kind}
        ):
            return ()  # "where is the apple?"
        if not self.situation.request.options and isinstance(said, Request):
            return ()
        find, words = self.context.knowledge.objects_named, named(said)
        return find(words) or tuple(one for name in words.split(" or ") for one in find(name))

    def _nearly(self, answer: str) -> tuple[str, ...]:
        """What was offered, if an answer is a slip of it; that is asked, with nothing else."""
        near = self.context.knowledge.near_name(answer)
        if near in self.situation.request.options:
            self.situation.request.options = (near,)
        return ()

    def unresolved(self) -> str:
        """Name the nearest known things."""
        assert self.situation.request.command
        target = self.situation.request.command.target
        if self.situation.request.options:
            options = self.context.say.any_of(self.situation.request.options)
            return f"'{self.context.as_said(target)}' may be {options}"
        if self._all_left_out():
            return f"I know no other {target}"
        return unresolved(self.context, target, nearest(self.context, target))


class AskWhere(Ask):
    """Asks where the thing is.

    Reads request.object and search.looks; writes search.candidates.
    """

    def question(self) -> Question:
        """Say where it was looked for, if anywhere."""
        name, say = self.situation.request.object or "", self.context.say
        text = f"Where {say.is_(name)} {say.the(name)}?"
        if so_far := self.situation.search.so_far(name, say):
            text = f"{so_far}. {text}"
        if self._tries:
            text = f"{NO_PLACE * (not self._attended)}{text} {known_places(self.context)}"
        return Question(QuestionKind.WHERE_IS, name, text)

    def understood(self, answer: str) -> bool:
        """Any places that exist become the candidates."""
        places = places_in(self.context, answer)
        if places:
            assert self.situation.request.object
            self.context.facts.heard(self.situation.request.object, places)
            self.situation.search.candidates = candidates_from(places, Source.USER)
        return bool(places)

    def unresolved(self) -> str:
        """Say what was tried."""
        name, say = self.situation.request.object or "", self.context.say
        return self.situation.search.so_far(name, say) or f"I do not know where {say.are(name)}"


class AskWhereToPut(Ask):
    """Asks where what is in the hand may be put down, when it found no room for it.

    Reads hand.unplaced; writes hand.surfaces.
    """

    def question(self) -> Question:
        """Say where there was none."""
        held = self.situation.hand.in_hand or ""
        text = f"Where shall I put {self.context.say.the(held)}?"
        if self._tries:
            text = f"{NO_PLACE * (not self._attended)}{text} {known_places(self.context)}"
        else:
            text = f"{beginning(self.unresolved())}. {text}"
        return Question(QuestionKind.WHERE_TO_PUT, held, text)

    def understood(self, answer: str) -> bool:
        """Any furniture that exists will do."""
        self.situation.hand.surfaces = places_in(self.context, answer)
        return bool(self.situation.hand.surfaces)

    def unresolved(self) -> str:
        """Say where it was tried."""
        hand, say = self.situation.hand, self.context.say
        nowhere = f"I could get to no place to put {say.the(hand.in_hand or '')}"
        return hand.not_put_down(say) or nowhere


class Announce(Step):
    """Tells where the robot is going to look, and who says so.

    Reads search.candidates.
    """

    def update(self) -> Status:
        """Say it."""
        candidates = self.situation.search.candidates
        name, say = self.situation.request.object or "", self.context.say
        places = ", then ".join(say.at_each(candidate.place for candidate in candidates))
        why = who_says(self.context, candidates[0].source)
        tell(self.context, f"I look for {say.the(name)} {places}: {why}.")
        return self.succeed(", then ".join(candidate.place for candidate in candidates))


class Report(Step):
    """Tells what was done.

    Reads search.found and hand.put_at; writes ending.reason.
    """

    def __init__(self, name: str, context: MissionContext, text: str) -> None:
        """`text` may use {the_object}, {is_}, {it}, {at}, {place}, {put} and {goal}.

        As in "{The_object} {is_} {at}": the mug is on the desk in the bedroom; {place} is the same
        without "on", {put} is where it was put down.
        """
        super().__init__(name, context)
        self._text = text

    def update(self) -> Status:
        """Say it, and keep it as the mission's reason."""
        found, hand, say = self.situation.search.found, self.situation.hand, self.context.say
        name = self.situation.request.object or ""
        the = say.the(name) if name else ""
        said = printable(
            self._text.format(
                the_object=the,
                The_object=beginning(the),
                is_=say.is_(name),
                it=say.it(name),
                at=say.at_in_full(found.place) if found else "nowhere",
                place=say.the(found.place) if found else "nowhere",
                put=say.at(hand.put_at),
                goal=say.the(self.situation.request.goal),
            )
        )
        self.situation.ending.tell(said)
        tell(self.context, said)
        return self.succeed(said)


class Apologise(Step):
    """Tells why it was not done.

    Writes ending.reason.
    """

    def update(self) -> Status:
        """Say why the last thing failed that was tried."""
        self.situation.ending.tell(self.why_before())
        why = self.situation.request.remark or f"Sorry: {self.situation.ending.why}"
        tell(self.context, sentence(why))
        return self.succeed(self.situation.ending.why)


def who_says(context: MissionContext, source: str, **others: tuple[str, str]) -> str:
    """Who says where the thing is, as a clause; `others` say it of one thing, and of several."""
    name, say = context.situation.request.object or "", context.say
    says = {
        **(SAYS_OF_SEVERAL if say.agree(name, "", "are") else SAYS),
        **{who: say.agree(name, *clauses) for who, clauses in others.items()},
        **{own.name: own.says for own in context.sources},
    }
    return printable(says.get(source, f"so says the {source}"))


def without_exceptions(
    knowledge: Knowledge, command: Command, names: tuple[str, ...]
) -> tuple[str, ...]:
    """Those of the objects that the command does not leave out: "anything but a banana"."""
    left_out = (name for but in command.exceptions for name in (but, *knowledge.names_in(but)))
    not_meant = {one for name in left_out for one in knowledge.objects_named(name)}
    return tuple(name for name in names if name not in not_meant)


def full_hand(held: str, say: Wording) -> str:
    """Why nothing else is taken, as a clause."""
    return f"my hand holds {say.the(held)}"


def known_places(context: MissionContext) -> str:
    """Which furniture there is, as a sentence."""
    places = (context.say.the(place.name) for place in context.knowledge.places())
    return f"I know: {', '.join(places)}."


def places_in(context: MissionContext, answer: str) -> tuple[str, ...]:
    """The places that words name; the table by the person is one, too."""
    if DELIVERY in re.findall(r"[a-z]+", answer.lower()):
        return (DELIVERY,)
    return context.knowledge.places_named(answer)


def is_place(context: MissionContext, words: str) -> bool:
    """Whether words name places, or what is beside them, and nothing that would be passed over."""
    delivery = DELIVERY in re.findall(r"[a-z]+", words.lower())
    beside = words.lower().removeprefix(NEXT_TO).removeprefix(BETWEEN)
    return delivery or context.knowledge.is_place(beside)

"""Leaves that talk with the person."""

import re
from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import replace

from py_trees.common import Status

from executive.records import Activity, Utterance
from executive.situation import candidates_from, table
from executive.text import printable, too_long
from executive.types import DELIVERY, SOMETHING, Answered, Question, QuestionKind, Result, Source
from trees.context import MissionContext
from trees.nodes import Action, Step, why_of
from trees.unknown import either, nearest, unknown, unresolved

SAYS: Mapping[str, str] = {
    Source.ONTOLOGY: "that is its place",
    Source.LLM: "the language model's guess",
    Source.USER: "as you said",
    Source.MEMORY: "I remember it there",
}
"""How the person is told who names a place to look at; other sources say it themselves."""
NEXT_TO = "next to "
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
        self._commanded = False

    @abstractmethod
    def question(self) -> Question:
        """What to ask."""

    @abstractmethod
    def understood(self, answer: str) -> bool:
        """Take the answer in, if it makes sense."""

    @abstractmethod
    def unresolved(self) -> str:
        """What stays unknown without an answer, as a clause."""

    def busy(self) -> str:
        """What goes on, for who gives a command instead of an answer, as a clause."""
        return "I am still at what you asked for before"

    def declines(self, answer: str) -> bool:
        """Whether the answer is that there is none."""
        return self.context.interpreter.declines(answer)

    def initialise(self) -> None:
        """Ask for the first time."""
        self._tries, self._commanded = 0, False
        super().initialise()

    def start(self) -> int:
        """Ask."""
        question = self.question()
        first = f"{self.busy()}; say stop to end that. " if self._commanded else ""
        question = replace(question, text=printable(first + question.text))
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
        if not unread and self.declines(result.text):
            return self._no_help("you could not tell me")
        if not unread and self.understood(result.text):
            return self.succeed(result.text)
        self._commanded = self.context.interpreter.command(result.text) is not None
        if self._tries < self.context.parameters.questions:
            return self.start_again()
        return self._no_help(unread or f"I did not understand your answer '{result.text}'")

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
        text = f"{unknown(self.context.knowledge, target)}. Do you mean {guess}?"
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
        return unresolved(self.context.knowledge, target, (guess,))


class AskWhichObject(Ask):
    """Asks which thing is meant, where the words fit several or none.

    Reads request.options; writes request.object, or fewer request.options.
    """

    def question(self) -> Question:
        """Offer the members of the class, or the nearest known names."""
        assert self.situation.request.command
        target = self.situation.request.command.target
        if (options := self.situation.request.options) and self.situation.request.several:
            text = f"I can do one thing at a time. Which first: {either(options)}?"
        elif options:
            text = f"Which {target} do you mean: {either(options)}?"
        elif options := self._other_names(target):
            said = unknown(self.context.knowledge, target)
            text = f"{said}. Do you mean {either(options)}, or something else?"
        else:
            text = f"I know no '{target}'. Which thing do you mean?"
        return Question(QuestionKind.WHICH_OBJECT, target, text, options)

    def _other_names(self, target: str) -> tuple[str, ...]:
        """The nearest known names, less the one that the person did not mean."""
        names = nearest(self.context.knowledge, target)
        return tuple(name for name in names if name != self.situation.request.guess)

    def understood(self, answer: str) -> bool:
        """One object is enough; several narrow the next question down."""
        command = self.context.interpreter.command(answer)
        named = self.context.knowledge.objects_named(answer)
        if (
            self.situation.request.options and command and not named
        ):  # "Bring the banana", one of them
            named = self.context.knowledge.objects_named(command.target)
        if self.situation.request.options:
            named = tuple(n for n in named if n in self.situation.request.options)
        named = without_exceptions(self.context, named)
        if len(named) > 1:
            self.situation.request.options = named
        elif named:
            self.situation.request.object = named[0]
        return len(named) == 1

    def unresolved(self) -> str:
        """Name the nearest known things."""
        assert self.situation.request.command
        target = self.situation.request.command.target
        if self.situation.request.options:
            return f"'{target}' may be {either(self.situation.request.options)}"
        knowledge = self.context.knowledge
        return unresolved(knowledge, target, nearest(knowledge, target))


class AskWhere(Ask):
    """Asks where the thing is.

    Reads request.object and search.looks; writes search.candidates.
    """

    def question(self) -> Question:
        """Say where it was looked for, if anywhere."""
        name = self.situation.request.object or ""
        text = f"Where is the {name}?"
        if so_far := self.situation.search.so_far(name):
            text = f"{so_far}. {text}"
        if self._tries:
            known = ", ".join(place.name for place in self.context.knowledge.places())
            text = f"{NO_PLACE * (not self._commanded)}{text} I know: {known}."
        return Question(QuestionKind.WHERE_IS, name, text)

    def busy(self) -> str:
        """It is looked for."""
        return f"I am still looking for the {self.situation.request.object}"

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
        name = self.situation.request.object
        return self.situation.search.so_far(name) or f"I do not know where the {name} is"


class AskWhereToPut(Ask):
    """Asks where what is in the hand may be put down, when it found no room for it.

    Reads hand.unplaced; writes hand.surfaces.
    """

    def question(self) -> Question:
        """Say where there was none."""
        held = self.situation.hand.in_hand or ""
        text = f"{self.unresolved()}. Where shall I put {the(held)}?"
        if self._tries:
            known = ", ".join(place.name for place in self.context.knowledge.places())
            text = f"Where shall I put {the(held)}? I know: {known}."
            text = NO_PLACE * (not self._commanded) + text
        return Question(QuestionKind.WHERE_TO_PUT, held, text)

    def busy(self) -> str:
        """It is in the hand."""
        return f"I am still holding {the(self.situation.hand.in_hand or '')}"

    def understood(self, answer: str) -> bool:
        """Any furniture that exists will do."""
        self.situation.hand.surfaces = places_in(self.context, answer)
        return bool(self.situation.hand.surfaces)

    def unresolved(self) -> str:
        """Say where it was tried."""
        hand = self.situation.hand
        return hand.not_put_down or f"I could get to no place to put {the(hand.in_hand or '')}"


class AskToPutDown(AskYesNo):
    """Asks whether the hand may be emptied for what is asked for now."""

    def question(self) -> Question:
        """Offer it."""
        held, asked = self.situation.hand.in_hand or "", self.situation.request.object or ""
        text = f"My hand holds {the(held)}. Shall I put it down first?"
        return Question(QuestionKind.CONFIRM, held, text, (asked,))

    def agreed(self) -> None:
        """It will be put down."""

    def unresolved(self) -> str:
        """The hand stays full."""
        return full_hand(self.situation.hand.in_hand or "")


class Announce(Step):
    """Tells where the robot is going to look, and who says so.

    Reads search.candidates.
    """

    def update(self) -> Status:
        """Say it."""
        says = {**SAYS, **{source.name: source.says for source in self.context.sources}}
        candidates = self.situation.search.candidates
        places = ", then ".join(candidate.place for candidate in candidates)
        why = printable(says.get(candidates[0].source, f"so says the {candidates[0].source}"))
        tell(self.context, f"I look for the {self.situation.request.object} at {places}: {why}.")
        return self.succeed(places)


class Report(Step):
    """Tells what was done.

    Reads search.found, hand.put_at and hand.unplaced; writes ending.reason.
    """

    def __init__(self, name: str, context: MissionContext, text: str) -> None:
        """`text` may use {object}, {the_object}, {place}, {surface}, {goal} and {why}."""
        super().__init__(name, context)
        self._text = text

    def update(self) -> Status:
        """Say it, and keep it as the mission's reason."""
        found = self.situation.search.found
        said = printable(
            self._text.format(
                object=self.situation.request.object,
                the_object=the(self.situation.request.object or ""),
                place=found.place if found else "nowhere",
                surface=table(self.situation.hand.put_at),
                goal=table(self.situation.request.goal),
                why=self.situation.hand.unplaced.get(DELIVERY, ""),
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


def without_exceptions(context: MissionContext, names: tuple[str, ...]) -> tuple[str, ...]:
    """Those of the objects that the command does not leave out: "anything but a banana"."""
    assert context.situation.request.command
    exceptions = context.situation.request.command.exceptions
    knowledge = context.knowledge
    names_left_out = (name for but in exceptions for name in (but, *knowledge.names_in(but)))
    left_out = {one for name in names_left_out for one in knowledge.objects_named(name)}
    return tuple(name for name in names if name not in left_out)


def tell(context: MissionContext, text: str) -> None:
    """Say something, on one line, to the person and to the log."""
    said = printable(text)
    context.recorder.record(Utterance("robot", said))
    context.user.tell(said)


def sentence(text: str) -> str:
    """The text with a full stop, unless it has an end."""
    return text if text.endswith((".", "!", "?", "…")) else f"{text}."


def full_hand(held: str) -> str:
    """Why nothing else is taken, as a clause."""
    if held == SOMETHING:
        return f"my hand holds {held}; tell me first to put it down"
    return f"my hand holds {the(held)}; ask me first to bring that"


def the(held: str) -> str:
    """What is held, in a sentence: its name, or that it is not known."""
    return held if held == SOMETHING else f"the {held}"


def places_in(context: MissionContext, answer: str) -> tuple[str, ...]:
    """The places that words name; the table by the person is one, too."""
    if DELIVERY in re.findall(r"[a-z]+", answer.lower()):
        return (DELIVERY,)
    return context.knowledge.places_named(answer)


def is_place(context: MissionContext, words: str) -> bool:
    """Whether words name places, or what is beside them, and nothing that would be passed over."""
    delivery = DELIVERY in re.findall(r"[a-z]+", words.lower())
    return delivery or context.knowledge.is_place(words.lower().removeprefix(NEXT_TO))

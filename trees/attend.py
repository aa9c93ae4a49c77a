"""What the person says while the robot is at something: answered at once, whatever it is."""

from py_trees.common import Status

from executive.language.commands import commands_in
from executive.language.corrections import corrected
from executive.language.meaning import (
    Answer,
    Correction,
    Courtesy,
    Question,
    Refusal,
    Request,
    Said,
    Statement,
    Thing,
    Things,
)
from executive.language.spoken import Spoken, resolved
from executive.records import Utterance
from executive.replies import Standing, about, reply
from executive.text import printable, too_long
from executive.types import Command, Commands
from trees.context import MissionContext
from trees.nodes import Action, Step
from trees.person import tell

TAKEN_BACK = "you took it back"


class Attend(Step):
    """Answers what was said unasked, and has the tree do what follows from it; always fails.

    A question is answered, and what is told is remembered; a further wish goes on the agenda; a
    correction replaces the task at hand, from where the robot is; what is taken back is not done.
    Reads dialogue.heard and request.command; writes agenda.
    """

    source = "person"

    def update(self) -> Status:
        """One after the other."""
        heard = self.situation.dialogue.heard
        if not heard:
            return Status.FAILURE
        while heard:
            words = heard.pop(0)
            self.context.recorder.record(Utterance("person", words))
            tell(self.context, printable(self._answer(words)))
        return Status.FAILURE

    def _answer(self, words: str) -> str:
        """What to say to it, when what follows from it is noted."""
        at_hand = self.situation.request.command
        if why := too_long(words):
            return f"Sorry: {why}."
        said = self.context.interpreter.read(words)
        match said:
            case Courtesy():
                return self.context.interpreter.talk(words)
            case Question() | Statement():
                return self._reply(said, words)
            case Refusal() if at_hand and self._takes_back(said, at_hand):
                self.situation.agenda.taken_back = True
                return f"Then I do not {at_hand.in_words()}."
            case Correction(adds=False) | Answer(things=Things()) if at_hand and _corrects(said):
                return self._correct(said, at_hand, words)
            case Correction(adds=True) if at_hand:
                return self._add(corrected(said, at_hand, words))
            case Request():
                return self._add(commands_in(resolved(said, self._spoken()), words))
        remark = self.context.interpreter.remark(words)
        return remark or f"I do not understand '{words}'. {self._doing()}"

    # --- what follows from it ---

    def _reply(self, said: Question | Statement, words: str) -> str:
        """Answer; if the thing at hand turns out to be elsewhere, look there from now on."""
        context, request = self.context, self.situation.request
        meant = resolved(said, self._spoken())
        looks = self.situation.search.looks
        standing = Standing(
            self.situation.hand.in_hand,
            self._doing(),
            tuple(one for one in self.situation.search.candidates if one.place in looks.visited),
        )
        answer = reply(meant, standing, context.knowledge, context.facts)
        told = isinstance(meant, Statement) and about(meant, context.knowledge) == (request.object,)
        if told and not self.situation.search.found and not self.situation.has_it:
            self.situation.agenda.instead = request.command
        return answer or context.interpreter.talk(words)

    def _correct(self, said: Said, at_hand: Command, words: str) -> str:
        """Do this instead of the task at hand."""
        commands = corrected(resolved(said, self._spoken()), at_hand, words)
        if isinstance(commands, str):
            return commands
        first, *others = (command for group in commands for command in group)
        self.situation.agenda.instead = first
        self.situation.agenda.add_next(tuple(others))
        return f"All right: I {first.in_words()} instead."

    def _add(self, commands: Commands | str | None) -> str:
        """Do these afterwards."""
        if not isinstance(commands, tuple):
            return commands or f"I do not understand that. {self._doing()}"
        self.situation.agenda.add(commands)
        wishes = " and ".join(command.in_words() for group in commands for command in group)
        return f"I {wishes} afterwards."

    def _takes_back(self, said: Refusal, at_hand: Command) -> bool:
        """Whether it is the task at hand that is not to be done."""
        words = self.context.interpreter.read(f"{at_hand.kind} {said.words}")
        names = self.context.knowledge.names_in(said.words)
        named = {one for name in names for one in self.context.knowledge.objects_named(name)}
        it = any(word in said.words.split() for word in ("it", "that", "them"))
        return it or self.situation.request.object in named or at_hand.target in said.words

    # --- how it stands ---

    def _spoken(self) -> Spoken:
        """What "it" is now: the thing at hand."""
        request, before = self.situation.request, self.situation.dialogue.spoken
        if not request.command:
            return before
        things = (request.object,) if request.object else (request.command.target,)
        place = request.goal or request.command.goal or request.command.source or before.place
        return Spoken(things, request.command.target, place, before.request)

    def _doing(self) -> str:
        """What the robot is doing, as a sentence."""
        command = self.situation.request.command
        if command is None:
            return "I think about what you said."
        assert self.parent
        running = (n for n in self.parent.iterate() if isinstance(n, Action) and n.is_under_way)
        now = next((node.doing() for node in running), "")
        what = command.in_words()
        return f"I {now}, to {what}." if now else f"I am about to {what}."


def _corrects(said: Said) -> bool:
    """Whether it says what is meant instead; a bare name might as well be a further wish."""
    if isinstance(said, Answer):
        return bool(said.things and any(thing.exceptions for thing in said.things.members))
    return True

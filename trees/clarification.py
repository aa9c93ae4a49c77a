"""Questions to the person about which thing they mean."""

from dataclasses import replace

from executive.language.answers import how_many_of, named, picked
from executive.language.commands import in_words
from executive.language.meaning import (
    ME,
    Answer,
    Choice,
    Correction,
    Refusal,
    Request,
    Said,
    Task,
    Thing,
    Things,
    Unread,
    Where,
)
from executive.types.commands import ALL, CommandKind
from executive.types.dialogue import Question, QuestionKind
from trees.asking import Ask, AskYesNo
from trees.corrections import all_of, correct
from trees.meant import without_exceptions
from trees.passed_over import passed_over_in_name
from trees.telling import tell
from trees.unknown import nearest, unknown, unresolved

_UNNAMED = ("something ", "anything ")
"""So begins what has properties, and no name: "something red"."""
_QUESTIONS = {CommandKind.FIND, CommandKind.COUNT, CommandKind.CHECK, CommandKind.TELL}


class AskDoYouMean(AskYesNo):
    """Asks whether a known name is meant: the robot never guesses in silence.

    Reads request.guess; writes request.command.
    """

    def question(self) -> Question:
        """Offer the guess."""
        target, guess = self.situation.request.asked_for.target, self.situation.request.guess
        meant = self.context.say.the(guess)
        text = f"{unknown(self.context, target)}. Do you mean {meant}?"
        if more := passed_over_in_name(self.context, target, guess):
            text += f" I make nothing of '{self.context.as_said(more)}'."
        objects = self.context.knowledge.objects_named(guess)
        return Question(QuestionKind.CONFIRM, guess, text, objects)

    def agreed(self) -> None:
        """Take the guess as the target of the command."""
        request = self.situation.request
        request.command = replace(request.asked_for, target=request.guess)

    def understood(self, answer: str) -> bool:
        """Take yes or no, or the name that the person says instead: "no, the mug"."""
        if beside := self._beside_yes(answer):
            return beside.adds and self._attend_to(Unread(answer), answer)
        names = self.context.knowledge.names_in(answer)
        refused = self.context.interpreter.agrees(answer) is False
        if len(names) != 1 or (refused and names[0] == self.situation.request.guess):
            return super().understood(answer)
        self.situation.request.guess = names[0]
        self._agrees = True
        self.agreed()
        return True

    def _attend_to(self, said: Said, words: str) -> bool:
        """Take "yes, and the drill" as a yes with one more request."""
        if not (beside := self._beside_yes(words)):
            return super()._attend_to(said, words)
        self._agrees = True
        self.agreed()
        tell(self.context, correct(self.context, beside, words, f"I {self.doing()}.", ""))
        return True

    def _passed_over(self, said: Said, words: str) -> list[str]:
        """Nothing, if the answer is a yes with one more request."""
        return [] if self._beside_yes(words) else super()._passed_over(said, words)

    def _beside_yes(self, words: str) -> Correction | None:
        """What the person asks for after a yes: in addition, or instead."""
        said = self.context.interpreter.after_yes(words)
        if isinstance(said, Request):
            return Correction(said)
        return said if isinstance(said, Correction) else None

    def unresolved(self) -> str:
        """It may be the guess, and that is not sure."""
        target, guess = self.situation.request.asked_for.target, self.situation.request.guess
        return unresolved(self.context, target, (guess,))


class AskWhichObject(Ask):
    """Asks which thing is meant, if the words fit several things or none.

    Reads request.options; writes request.object, or reduces request.options.
    """

    def question(self) -> Question:
        """Offer the members of the class, or the nearest known names."""
        target, any_of = self.situation.request.asked_for.target, self.context.say.any_of
        if (options := self.situation.request.options) and self.situation.request.several:
            text = f"I can do one thing at a time. Which first: {any_of(options)}?"
        elif options:
            unnamed = self.situation.request.asked_for.purpose or target.startswith(_UNNAMED)
            kind = "" if unnamed else f" {target}"
            text = f"Which{kind} do you mean: {any_of(options)}?"
        elif self._all_left_out():
            text = f"I know no other {target}. Which thing do you mean?"
        else:
            options, said = self._other_names(target), unknown(self.context, target)
            meant = f"Do you mean {any_of(options)}, or something else?"
            text = f"{said}. {meant if options else 'Which thing do you mean?'}"
        return Question(QuestionKind.WHICH_OBJECT, target, text, options)

    def _all_left_out(self) -> bool:
        """Whether all things that the target names are excluded, as by "another mug"."""
        return bool(self.context.knowledge.objects_named(self.situation.request.asked_for.target))

    def _other_names(self, target: str) -> tuple[str, ...]:
        """The most similar known names, without the one that the person has rejected."""
        names = nearest(self.context, target)
        return tuple(name for name in names if name != self.situation.request.guess)

    def understood(self, answer: str) -> bool:
        """Take the object that the answer names; if it names several, ask among those next."""
        options, find = self.situation.request.options, self.context.knowledge.objects_named
        said = _all_named(self.context.interpreter.read(answer))
        if self._names_others_too(said) or self._to_another_place(said) or _from_where(said):
            return False
        if chosen := picked(said, self.question().options):
            meant = tuple(one for name in chosen for one in find(name))
        else:
            meant = find(answer) or self._named(said) or self._nearly(answer)
        if options:
            meant = tuple(one for one in meant if one in options)
        meant = without_exceptions(self.context.knowledge, self.situation.request.asked_for, meant)
        if len(meant) > 1:
            self.situation.request.options = meant
        elif meant:
            self.situation.request.object = meant[0]
        return len(meant) == 1

    def _attend_to(self, said: Said, words: str) -> bool:
        """Take answers that name several things, or change the command, or exclude one."""
        request, find = self.situation.request, self.context.knowledge.objects_named
        said = _all_named(said)
        if isinstance(said, Refusal) and (rest := self._but(said.words)):
            request.options = rest
            return True
        if isinstance(said, Answer) and (number := how_many_of(said)):
            so_many = Correction(Things((Thing(number=number, said=str(number)),)))
            return self._correct(so_many, words)
        if self._to_another_place(said):  # "put the pear on the desk"
            assert isinstance(said, Request)
            return self._correct(Correction(said), words)
        if there := _from_where(said):
            return self._correct(there, words, instead="")
        nearest = isinstance(said, Answer) and said.choice == Choice.NEAREST
        several = request.options if nearest else self._several(said)
        if not several or not request.options:
            return super()._attend_to(said, words)
        names = tuple(dict.fromkeys(one for name in several for one in find(name)))
        tell(self.context, all_of(self.context, names, words, one_of=nearest))
        return True

    def _correct(self, said: Correction, words: str, instead: str = " instead") -> bool:
        """Correct the command by the answer; then the question needs no answer any more."""
        tell(self.context, correct(self.context, said, words, f"I {self.doing()}.", instead))
        return True

    def _names_others_too(self, said: Said) -> bool:
        """Whether the answer means several things, and some of them were not offered."""
        find, options = self.context.knowledge.objects_named, self.situation.request.options
        things = said.things if isinstance(said, Answer) else None
        if not options or not things or things.one_of or len(things.members) < 2:
            return False
        named = [find(thing.words) for thing in things.members]
        return all(named) and any(not {*each} & {*options} for each in named)

    def _to_another_place(self, said: Said) -> bool:
        """Whether the answer names another goal than the command does."""
        match said:
            case Request(tasks=[Task(goal=Where() as goal)]) if named(said) and goal != ME:
                command = self.situation.request.command
                return command is None or in_words(goal) != command.goal
        return False

    def _but(self, words: str) -> tuple[str, ...]:
        """The offered things that the words do not name; empty if they name none, or all."""
        request, find = self.situation.request, self.context.knowledge.objects_named
        named = [one for name in self.context.knowledge.names_in(words) for one in find(name)]
        named += picked(self.context.interpreter.read(words), request.options)
        rest = tuple(one for one in request.options if one not in named)
        return rest if len(rest) < len(request.options) else ()

    def _several(self, said: Said) -> tuple[str, ...]:
        """The names of several things that the answer chooses: "all", "the apple and the pear"."""
        offered = self.question().options
        if not isinstance(said, Answer) or (said.things and said.things.one_of):
            return ()
        if said.choice in (Choice.ALL, Choice.BOTH):
            return picked(said, offered)
        members = said.things.members if said.things else ()
        match members:
            case [Thing(words="", number=number, exceptions=[_, *_] as left_out)] if number == ALL:
                known = self.context.knowledge.objects_named
                but = {name for thing in left_out for name in known(thing.words)}
                return tuple(name for name in offered if not but & {*known(name)})
        if members and all(thing.place_in_list for thing in members):
            each = (picked(Answer(place_in_list=t.place_in_list), offered) for t in members)
            return tuple(one for names in each for one in names)
        names = tuple(thing.words for thing in members)
        are_known = all(self.context.knowledge.objects_named(name) for name in names)
        return names if len(names) > 1 and are_known else ()

    def _named(self, said: Said) -> tuple[str, ...]:
        """The objects that a longer answer names.

        A request counts as an answer only if things were offered, and if it is no question.
        """
        command = self.situation.request.command
        if (
            isinstance(said, Request)
            and command
            and said.tasks[0].verb in _QUESTIONS - {command.kind}
        ):
            return ()  # a question such as "where is the apple?"
        if not self.situation.request.options and isinstance(said, Request):
            return ()
        find, words = self.context.knowledge.objects_named, named(said)
        return find(words) or tuple(one for name in words.split(" or ") for one in find(name))

    def _nearly(self, answer: str) -> tuple[str, ...]:
        """No objects; but an offered name that is like the answer is asked about next."""
        near = self.context.knowledge.near_name(answer)
        if near in self.situation.request.options:
            self.situation.request.options = (near,)
        return ()

    def unresolved(self) -> str:
        """It may be one of the options, or of the most similar known names."""
        target = self.situation.request.asked_for.target
        if self.situation.request.options:
            options = self.context.say.any_of(self.situation.request.options)
            return f"'{self.context.as_said(target)}' may be {options}"
        if self._all_left_out():
            return f"I know no other {target}"
        return unresolved(self.context, target, nearest(self.context, target))


def _all_named(said: Said) -> Said:
    """The same; but "the pear, the mug, too" and "no, all of them" are answers, not corrections."""
    match said:
        case Correction(meant=Things(members=[Thing(pronoun=True, number=number)])) if (
            number == ALL
        ):
            return Answer(Choice.ALL)
        case Correction(meant=Things(members=[_, _, *_]) as things, adds=True):
            return Answer(things=things)
    return said


def _from_where(said: Said) -> Correction | None:
    """The correction in an answer that also says where the thing is: "the pear from the sofa"."""
    match said:
        case Answer(things=Things() as things, where=[source]):
            return Correction(things, source=source)
    return None

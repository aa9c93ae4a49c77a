"""People who answer oddly, and the things that they ask for."""

import random
from collections.abc import Callable, Sequence

from executive.events import Inbox
from executive.types.dialogue import Question, QuestionKind
from executive.types.results import Answered, Failed
from sim.home.home import Home
from soaking.chaos import HOSTILE, Chaos

ODD_WORDS = (
    "stop",
    "Please stop!",
    "stop it",
    "quit",
    "Bring it to me",
    "Don't bring me the apple",
    "bring",
    "asdf qwer",
    "Bring me the unicorn",
    "Bring me the hamer",
    "Find a fruit",
    "Take the tool",
    "put it down",
    "Put that down, please",
    "the mug",
    "Bring me a mug and an apple",
    "hammer",
    *HOSTILE,
)
"""Commands that are none, or hardly."""
ODD_ANSWERS = (
    "yes",
    "no",
    "I don't know",
    "the pantry",
    "on the desk",
    "in the kitchen",
    "yes and no",
    "the second",
    "both",
    "cancel",
    "Stop!",
    "never mind",
    "no, the mug",
    *HOSTILE,
)


def words(chance: random.Random, home: Home) -> str:
    """What somebody says to the robot: mostly a command that it knows."""
    if chance.random() < 0.2:
        return chance.choice(ODD_WORDS)
    verb = chance.choice(("Find", "Take", "Bring", "Could you fetch me", "Where is"))
    return f"{verb} the {chance.choice(sorted(home.objects)).replace('_', ' ')}"


class Person:
    """Implements User: knows the truth, says it or not, answers twice, late, or never.

    `heard` is told whatever the robot says, when it says it.
    """

    def __init__(
        self,
        chaos: Chaos,
        inbox: Inbox,
        where: Callable[[str], str | None],
        places: Sequence[str],
        heard: Callable[[str], None],
    ) -> None:
        self._chaos = chaos
        self._inbox = inbox
        self._where = where
        self._places = places
        self._heard = heard
        self.helpful = chaos.chance.choice((0.0, 0.5, 0.9, 1.0))
        """How much of what is asked gets a true answer."""

    def ask(self, question: Question) -> int:
        self._heard(question.text)
        self._chaos.call(self._inbox)
        self._chaos.may_raise("ask")
        chance, inbox = self._chaos.chance, self._inbox
        request = inbox.open()
        if chance.random() < self.helpful:
            inbox.end(request, Answered(self._truth(question)))
        elif (kind := chance.random()) < 0.7:
            inbox.end(request, Answered(self._nonsense(question)))
        elif kind < 0.85:
            inbox.end(request, Failed(chance.choice(("there is nobody to ask", ""))))
        if self._chaos.strikes("person answers twice"):
            inbox.end(request, Answered("yes"))
        return request

    def cancel(self, request: int) -> None:
        self._chaos.may_raise("cancel of the question")
        self._inbox.drop(request)

    def tell(self, text: str) -> None:
        self._heard(text)
        self._chaos.may_raise("tell")

    def _truth(self, question: Question) -> str:
        match question.kind:
            case QuestionKind.WHERE_IS:
                return self._where(question.about) or "I don't know"
            case QuestionKind.CONFIRM:
                return "yes"
            case _:
                here = [name for name in question.options if self._where(name)]
                return here[0] if here else "I don't know"

    def _nonsense(self, question: Question) -> str:
        return self._chaos.chance.choice((*ODD_ANSWERS, *self._places, *question.options))

"""What an experimenter does in the person's stead, or the robot's: each deed is an event.

So it stands in the recording, with who and when, and a replay of the mission is the same.
"""

from collections.abc import Callable
from typing import Any

from executive.errors import InputError
from executive.events import Deed, Inbox, Intervened
from executive.page.board import Board
from executive.page.person import PagePerson
from executive.text import LONGEST, one_line, printable, writable

SOMEBODY = "the experimenter"
LONGEST_NAME = 60
OVER = "it is over"


class Wizard:
    """Steps in. Every method may be called from any thread."""

    def __init__(self, inbox: Inbox, person: PagePerson, board: Board) -> None:
        """Speak for this person, and with the robot's words to them; tell this board."""
        self._inbox = inbox
        self._person = person
        self._board = board
        self._places: tuple[str, ...] = ()
        self.going: Callable[[], str] = lambda: ""
        """Tells to which place the robot goes to look; empty if to none."""
        person.gate.changed = self._tell
        self._tell()

    def know(self, places: dict[str, str]) -> None:
        """Where the robot can be sent: names, each with how it is called."""
        self._places = tuple(places)
        self._board.put("places", [{"name": n, "label": label} for n, label in places.items()])
        self._board.flush()

    def do(self, sent: dict[str, Any]) -> dict[str, Any]:
        """Do what a page wants.

        Raises:
            InputError: if that cannot be, or is over.
        """
        by = _line(sent.get("by"))[:LONGEST_NAME] or SOMEBODY
        match sent:
            case {"deed": Deed.ANSWER, "question": int(question), "words": str(words)}:
                done = bool(_line(words)) and self._person.answers(_line(words), question, by)
            case {"deed": Deed.HOLD, "on": bool(on)}:
                done = self._hold(by, on)
            case {"deed": Deed.WORDS, "number": int(number), "words": str(words)}:
                done = self._say(by, number, _line(words))
            case {"deed": Deed.PLACE, "place": str(place)}:
                done = self._send(by, place)
            case {"deed": Deed.STOP}:
                self._post(by, Deed.STOP, "", "")
                self._person.stops()
                done = True
            case _:
                raise InputError("deed", "there is no such deed")
        if not done:
            raise InputError(str(sent["deed"]), OVER)
        return {}

    def _hold(self, by: str, on: bool) -> bool:
        gate = self._person.gate
        self._post(by, Deed.HOLD, "", "on" if on else "off")
        if on:
            gate.holds = True
            self._tell()
        else:
            gate.let_all_go()
            self._person.show_question()
        return True

    def _say(self, by: str, number: int, words: str) -> bool:
        held = self._person.gate.find(number)
        if held is None:
            return False
        self._post(by, Deed.WORDS, held.text, words)
        done = self._person.gate.let_go(number, words)
        self._person.show_question()
        return done

    def _send(self, by: str, place: str) -> bool:
        if place not in self._places:
            raise InputError("place", "there is no such place")
        if not (was := self.going()):
            return False
        self._post(by, Deed.PLACE, was, place)
        return True

    def _post(self, by: str, deed: Deed, was: str, became: str) -> None:
        self._inbox.post(Intervened(by, deed, was, became))

    def _tell(self) -> None:
        gate = self._person.gate
        held = [{"number": one.number, "text": one.text} for one in gate.held]
        self._board.put("words", {"holds": gate.holds, "held": held})
        self._board.flush()


def _line(value: object) -> str:
    """On one line, printable, and no longer than the robot reads."""
    return printable(one_line(writable(value)))[:LONGEST] if isinstance(value, str) else ""

"""What an experimenter does in the person's stead, or the robot's: each deed is an event.

So it stands in the recording, with who and when, and a replay of the mission is the same.
"""

import threading
from collections.abc import Callable
from typing import Any

from executive.errors import InputError
from executive.events import EXPERIMENTER, OFF, ON, Deed, Event, Inbox, Intervened
from executive.page.board import Board
from executive.page.person import PagePerson
from executive.text import LONGEST, one_line, printable, writable

LONGEST_NAME = 60
OVER = "it is over"
LEFT_S = 30.0
"""A page that was closed, and comes back no later (s), was loaded anew, or lost the connection."""
AS_BEFORE = "as before this mission"
LEFT = "no page of an experimenter is open any more"


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
        self.choosing: Callable[[], dict[str, Any] | None] = lambda: None
        """Tells which choice of a place waits, as the situation has it; None if none does."""
        self._holder = ""
        """Who holds choices of places; empty if nobody does."""
        self._silencer = ""
        """Who holds what the robot says; empty if nobody does."""
        self.done: Callable[[Intervened], None] = lambda event: None
        """Is told of each deed, whether a mission hears of it or not."""
        person.gate.changed = self._tell
        board.left = self._look_again_later
        self._tell()
        self.show_choice()

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
        by = _line(sent.get("by"))[:LONGEST_NAME] or EXPERIMENTER
        match sent:
            case {"deed": Deed.ANSWER, "question": int(question), "words": str(words)}:
                done = bool(_line(words)) and self._answer(by, question, _line(words))
            case {"deed": Deed.HOLD, "on": bool(on)}:
                done = self._hold(by, on)
            case {"deed": Deed.WORDS, "number": int(number), "words": str(words)}:
                done = self._say(by, number, _line(words))
            case {"deed": Deed.PLACE, "place": str(place)}:
                self._send(by, place)
                done = True
            case {"deed": Deed.HOLD_PLACE, "on": bool(on)}:
                done = self._hold_place(by, on)
            case {"deed": Deed.STOP}:
                self._post(by, Deed.STOP, "", "")
                self._person.stops(by if by == EXPERIMENTER else f"{EXPERIMENTER} {by}")
                done = True
            case _:
                raise InputError("deed", "there is no such deed")
        if not done:
            raise InputError(str(sent["deed"]), OVER)
        return {}

    def _answer(self, by: str, question: int, words: str) -> bool:
        """A question that is still held when it is answered is said no more."""
        asked = self._person.asked
        done = self._person.answers(words, question, by)
        for held in self._person.gate.held if done else ():
            if held.text == asked:
                self._say(by, held.number, "")
        return done

    def _hold(self, by: str, on: bool) -> bool:
        gate = self._person.gate
        self._silencer = by if on else ""
        self._post(by, Deed.HOLD, "", ON if on else OFF)
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

    def _send(self, by: str, place: str) -> None:
        if place not in self._places:
            raise InputError("place", "there is no such place")
        choice = self.choosing()
        if choice and choice["among"] and place not in choice["among"]:
            right = f"it may be {' or '.join(choice['among'])}"
            raise InputError("place", "the person wants it elsewhere", right)
        if not (was := choice["place"] if choice else self.going()):
            right = "send the robot while it is on its way to look for something"
            raise InputError("place", f"{OVER}, or has not begun", right)
        self._post(by, Deed.PLACE, was, place)

    # --- choices of places ---

    def standing(self) -> tuple[Event, ...]:
        """What each mission begins with: what is held from before."""
        held = ((self._silencer, Deed.HOLD), (self._holder, Deed.HOLD_PLACE))
        return tuple(Intervened(by, deed, AS_BEFORE, ON) for by, deed in held if by)

    def show_choice(self) -> None:
        """Tell whether choices are held, and which one waits."""
        self._board.put("choice", {"holds": bool(self._holder), "held": self.choosing()})
        self._board.flush()

    def _hold_place(self, by: str, on: bool, why: str = "") -> bool:
        self._holder = by if on else ""
        self._post(by, Deed.HOLD_PLACE, why, ON if on else OFF)
        self.show_choice()
        return True

    def _look_again_later(self) -> None:
        """No page is open: if that stays so, the robot need not wait for one."""
        if self._holder:
            timer = threading.Timer(LEFT_S, self._let_go_if_left)
            timer.daemon = True
            timer.start()

    def _let_go_if_left(self) -> None:
        if (by := self._holder) and not self._board.readers:
            self._hold_place(by, on=False, why=LEFT)

    def _post(self, by: str, deed: Deed, was: str, became: str) -> None:
        event = Intervened(by, deed, was, became)
        self.done(event)
        self._inbox.post(event)

    def _tell(self) -> None:
        gate = self._person.gate
        held = [{"number": one.number, "text": one.text} for one in gate.held]
        self._board.put("words", {"holds": gate.holds, "held": held})
        self._board.flush()


def _line(value: object) -> str:
    """On one line, printable, and no longer than the robot reads."""
    return printable(one_line(writable(value)))[:LONGEST] if isinstance(value, str) else ""

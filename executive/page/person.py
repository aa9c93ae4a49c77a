"""The person at a page."""

import threading
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO, cast

from executive.events import THE_PERSON, Deed, Inbox, Intervened
from executive.page.board import Board
from executive.page.gate import Gate
from executive.page.hearing import BROWSER, Alternative, Hearing, stop_in
from executive.page.lines import Lines, Said
from executive.speech.doubt import Doubt
from executive.speech.interfaces import Reading
from executive.text import LONGEST, one_line, writable
from executive.types.dialogue import Question
from executive.user import Console

if TYPE_CHECKING:
    from executive.app.session import Session


STOPPED, HEARD, NOT_READY = "stopped", "heard", "not ready"
"""What becomes of what a page heard."""


class PagePerson(Console):
    """Implements `User` for who sits at any of the open pages: all of them are the same person.

    That no page is open is no answer, and that one is closed is no stop.
    """

    def __init__(self, inbox: Inbox, board: Board) -> None:
        """Talk by this board."""
        self._board = board
        self._typing = Lines()
        self._question: Question | None = None
        """What was asked last; None if a command is listened for."""
        self._ticking = 0
        """The thread in which the mission speaks."""
        self._session: Session | None = None
        self._doubt: Doubt | None = None
        self._hearing: Hearing | None = None
        self._stopped_in = ""
        """The utterance in which a stop was heard last."""
        self._before: Path | None = None
        """The last mission that was over when a command was listened for."""
        self.gate = Gate(self._let_through)
        """What the mission says goes through it."""
        self.asking: Callable[[dict[str, Any] | None], None] = lambda question: None
        """Is told which question waits for an answer, whether the person was asked it or not."""
        super().__init__(inbox, cast(TextIO, self._typing), cast(TextIO, Said(self._shown)))
        board.put("question", None)
        board.put("asked_back", None)

    def follow(self, session: "Session", names: Sequence[str] = ()) -> None:
        """Tell from now on with each sentence in which mission of this session it was said.

        These names are listened for.
        """
        self._session = session
        if session.doubt:
            self._hearing = Hearing(names, session.parts.interpreter.agrees)
            self._doubt = session.doubt
            self._doubt.changed = self._show_asked_back

    @property
    def asked(self) -> str:
        """The question that was asked last; empty if a command is listened for."""
        question = self._question
        return question.text if question else ""

    # --- the robot speaks ---

    def ask(self, question: Question) -> int:
        """Show it, with the answers that are known."""
        self._ticking = threading.get_ident()
        self._question = question
        request = super().ask(question)
        self._board.flush()
        return request

    def tell(self, text: str) -> None:
        """Show it."""
        self._ticking = threading.get_ident()
        super().tell(text)

    def listen(self, prompt: str = "") -> int:
        """Wait for a command; the page says by itself that the robot does."""
        self._before = self._session.folder if self._session else None
        self._question = None
        request = super().listen()
        with self._lock:
            if self._is_idle:  # or it was answered already
                self._board.put("doing", {"state": "ready"})
        self._board.flush()
        return request

    def cancel(self, request: int) -> None:
        """Withdraw the question."""
        super().cancel(request)
        with self._lock:
            self._show_question()
        self._board.flush()

    # --- the person speaks, in whichever thread serves the page ---

    def says(self, words: str) -> None:
        """They sent words: a command, an answer, a stop."""
        line = one_line(writable(words))
        if not line:
            return
        self._show_said(line)
        self._typing.put(words)

    def answers(self, words: str, question: int, by: str = "") -> bool:
        """They chose an answer of this question; False if it does not wait for one any more.

        So what was chosen a moment too late never answers the next question, unseen. `by` is who
        answers in their stead.
        """
        with self._lock:
            if self._question is None or self._request is None or self._request != question:
                return False
            line = one_line(writable(words))[: LONGEST + 1]
            if by:
                self._inbox.post(Intervened(by, Deed.ANSWER, self._question.text, line))
            self._show_said(line.replace("_", " "))  # a name, as its button has it
            self._lines.append(line)
            self._serve()
        self._ask_nothing_back()
        return True

    def hears(self, heard: Sequence[Alternative], utterance: str, *, final: bool) -> str:
        """A recogniser at the page heard this: what became of it.

        As long as they still speak, only a stop counts, once an utterance.
        """
        if stop := stop_in(heard):
            if utterance != self._stopped_in:
                self._stopped_in = utterance
                self._take_in(Reading(BROWSER, *stop))
            return STOPPED
        if final and self._hearing:
            self._take_in(self._hearing.reading(heard))
        return HEARD if self._hearing else NOT_READY

    def _take_in(self, reading: Reading) -> None:
        """A stop needs nobody who asks back."""
        if self._doubt:
            self._doubt.hear(reading)
        else:
            self.says(reading.text)

    def settles(self, number: int, *, agrees: bool) -> bool:
        """They pressed yes or no to what was asked back; False if that is over."""
        return self._doubt is not None and self._doubt.settle(number, agrees=agrees)

    def stops(self, by: str = THE_PERSON) -> None:
        """They pressed the stop button: nothing has to be read first. Or an experimenter did."""
        who = "person" if by == THE_PERSON else "experimenter"
        self._board.say({"who": who, "stop": True, "at": time.time()})
        self._stop(by)
        self._ask_nothing_back()

    def show_question(self) -> None:
        """Show it as it is by now, after what the robot said was let go."""
        with self._lock:
            self._show_question()
        self._board.flush()

    def _ask_nothing_back(self) -> None:
        if self._doubt:
            self._doubt.forget()

    def _show_asked_back(self) -> None:
        assert self._doubt
        asked = self._doubt.asked_back
        shown = asked and {"id": asked.number, "text": asked.text, "words": asked.words}
        self._board.put("asked_back", shown)
        self._board.flush()

    def _show_said(self, line: str) -> None:
        self._board.say({"who": "person", "text": line[:LONGEST], "at": time.time()})

    def _shown(self, line: str) -> None:
        """What the mission says may be held, and tells when it was said.

        What is said at once to who speaks is not held, and was not decided in the mission.
        """
        entry = {"who": "robot", "text": line, "at": time.time()}
        if threading.get_ident() == self._ticking:
            self.gate.say({**entry, **self._moment()})
        else:
            self._let_through(entry)

    def _let_through(self, entry: dict[str, Any]) -> None:
        """Show it, and say it aloud if there is a voice."""
        self._board.say(entry)
        self.aloud(entry["text"])

    def _speak(self, text: str) -> None:
        """What may be held is said aloud when it is shown."""

    def _moment(self) -> dict[str, Any]:
        """In which mission, if it is recorded, and when in it (mission time, s)."""
        folder = self._session.folder if self._session else None
        if self._session is None or folder is None or folder == self._before:
            return {}
        return {"run": folder.name, "time_s": round(self._session.parts.clock.now(), 3)}

    def _serve(self) -> None:
        """Give the oldest line to whoever waits, and show who does; the lock is held."""
        if self._is_idle and self._lines:
            self._board.put("doing", {"state": "busy"})
        super()._serve()
        self._show_question()
        self._board.flush()

    def _show_question(self) -> None:
        """Show the question as long as an answer would be taken for one; the lock is held."""
        asked, request = self._question, self._request
        waits = None if asked is None or request is None else shown(asked, request)
        said = self.gate.as_said(waits["text"]) if waits else None
        self._board.put("question", {**waits, "text": said} if waits and said else None)
        self.asking(waits)


def shown(question: Question, number: int) -> dict[str, Any]:
    """A question as the page has it."""
    return {
        "id": number,
        "kind": question.kind,
        "about": question.about,
        "text": question.text,
        "options": question.options,
    }

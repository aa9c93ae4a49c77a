"""The participant as the robot's person, who may be led on at any moment."""

from executive.events import Inbox
from executive.language.control import Control, control
from executive.page.board import Board
from executive.page.person import PagePerson
from executive.page.study.tables import GAVE_UP
from executive.types.results import Failed

OVER = "the task is over"


class Participant(PagePerson):
    """Implements `User` for one condition, task by task.

    That they say "quit" ends the task, and not the study.
    """

    def __init__(self, inbox: Inbox, board: Board) -> None:
        """Nothing is to be done yet."""
        self.ended = ""
        """How the task ended; empty as long as it goes on."""
        self.left_it_running = False
        """Whether that stopped what the robot was doing."""
        self._dismissed = False
        super().__init__(inbox, board)

    def begin(self) -> None:
        """The next task."""
        with self._lock:
            self.ended, self.left_it_running = "", False

    def leave(self, how: str) -> None:
        """The task is over, from any thread: what runs is stopped, nothing is listened for."""
        with self._lock:
            if self.ended:
                return
            self.ended = how
            self.left_it_running = not self._is_idle
            self._hush()
        if self.left_it_running:
            self._stop()

    def says(self, words: str) -> None:
        """They sent words."""
        if control(words) is Control.QUIT:
            self.leave(GAVE_UP)
        else:
            super().says(words)

    def listen(self, prompt: str = "") -> int:
        """Wait for a command, as long as the task goes on."""
        request = super().listen(prompt)
        with self._lock:
            if self.ended:
                self._hush()
        return request

    def dismiss(self) -> None:
        """Nobody talks with them any more, and they say nothing."""
        self._dismissed = True
        self._typing.put("quit")

    def _shown(self, line: str) -> None:
        if not self._dismissed:
            super()._shown(line)

    def _show_question(self) -> None:
        if not self._dismissed:
            super()._show_question()

    def _hush(self) -> None:
        """End what listens for a command; the lock is held."""
        if self._is_idle and self._request is not None:
            self._inbox.end(self._request, Failed(OVER))
            self._request = None
            self._rest()

"""What the person says between missions: the next command, or something for the last mission."""

from collections import deque

from executive.events import Ended, Heard, Inbox, Listened, StopRequested
from executive.interfaces.runtime import Clock
from executive.types.results import Answered
from executive.user import Console


class Between:
    """Listens to the person while no mission runs.

    Attributes:
        heard: what they have said and no mission has dealt with yet, the oldest first.
        listened: what a microphone has heard since the last mission, for the next recording.
    """

    def __init__(self, inbox: Inbox, clock: Clock) -> None:
        """Begin with nothing heard."""
        self._inbox = inbox
        self._clock = clock
        self.heard: deque[str] = deque()
        self.listened: list[Listened] = []

    def next_command(self, console: Console, prompt: str) -> str | None:
        """Prompt the person and wait for a command; None if the input or the session has ended.

        Raises:
            KeyboardInterrupt: if a stop ends the session, as a signal does.
        """
        if self.heard:
            return self.heard.popleft()
        request = console.listen(prompt)
        while True:
            self._clock.wait(None)
            command: str | None = None
            for event in self._inbox.take_all():
                match event:
                    case StopRequested() as stop if stop.ends_session:
                        raise KeyboardInterrupt
                    case StopRequested():
                        command = None  # the person has taken it back at once
                        self.heard.clear()
                    case Heard(words):
                        self.heard.append(words)
                    case Listened():
                        self.listened.append(event)
                    case Ended(number, Answered(text)) if number == request:
                        command = text
                    case Ended(number) if number == request:
                        return None
            if command is not None:
                self.heard.append(command)
            if self.heard:
                console.cancel(request)
                return self.heard.popleft()
            if not self._inbox.is_open(request):
                request = console.listen(prompt)

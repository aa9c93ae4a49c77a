"""A recorded mission, read back as the records it was made of."""

import contextlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any, Generic, TypeVar

from mcap.reader import NonSeekingReader, make_reader
from mcap.records import Channel, Metadata
from mcap_protobuf.decoder import DecoderFactory

from executive.errors import InputError
from executive.records import LlmCall, Tick, TreeShape, Utterance, Verified
from executive.types import Outcome
from logs import messages
from logs.recovery import BREAKS, is_whole, records_to_the_break
from logs.times import nanoseconds

FILE_NAME = "mission.mcap"

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class At(Generic[T]):
    """Something, and the mission time at which it was recorded (s)."""

    time_s: float
    value: T


@dataclass(frozen=True, slots=True)
class EventLine:
    """An event in words: its type, the request and the result's type if it ended one, its gist."""

    name: str
    request: int | None
    result: str
    text: str


class Run:
    """One mission's recording; a file that ends early is read as far as it goes."""

    def __init__(self, folder: Path) -> None:
        """Open `mission.mcap` in a run's folder, or an mcap file itself.

        Raises:
            InputError: if there is none, or it records no mission.
        """
        self.path = folder / FILE_NAME if folder.is_dir() else folder
        if not self.path.is_file():
            raise InputError(str(folder), f"holds no {FILE_NAME}", "name a run's folder")
        self.whole = is_whole(self.path)
        """Whether the recording was closed; False after a crash."""
        self.metadata: dict[str, str] = {}
        """Facts about the run: start, seed, versions, model."""
        self._check()

    def tree(self) -> TreeShape:
        """The tree's shape; empty if the mission ended before it was recorded."""
        shapes = self._read("/bt/tree", messages.tree_from_message)
        return next((at.value for at in shapes), TreeShape(()))

    def ticks(self) -> Iterator[At[Tick]]:
        """Every tick, with all behaviours' states."""
        return self._read("/bt/tick", messages.tick_from_message)

    def llm_calls(self) -> Iterator[At[LlmCall]]:
        """Every call of the language model."""
        return self._read("/llm/call", messages.llm_call_from_message)

    def verifications(self) -> Iterator[At[Verified]]:
        """What the verification let through of each reply."""
        return self._read("/llm/verification", messages.verified_from_message)

    def dialog(self) -> Iterator[At[Utterance]]:
        """What was said."""
        return self._read("/dialog", messages.utterance_from_message)

    def events(self) -> Iterator[At[EventLine]]:
        """Every event that the executive took."""
        return self._read("/event", _event_line)

    def frames(self) -> Iterator[At[bytes]]:
        """Every camera picture, as JPEG."""
        return self._read("/camera/image/compressed", lambda message: bytes(message.data))

    def outcome(self) -> Outcome | None:
        """How it ended, or None if the recording ends before the mission did."""
        outcomes = self._read("/outcome", messages.outcome_from_message)
        return next((at.value for at in outcomes), None)

    def _check(self) -> None:
        """Read the facts at the start of the file; refuse what is no mission."""
        for record in records_to_the_break(self.path):
            if isinstance(record, Metadata) and record.name == "run":
                self.metadata = record.metadata
            elif isinstance(record, Channel) and record.topic == "/bt/tree":
                break
        else:
            raise InputError(
                str(self.path),
                "records no mission: topic /bt/tree is missing",
                f"name a run's folder or its {FILE_NAME}",
            )
        try:
            started = datetime.fromisoformat(self.metadata["started"])
        except (KeyError, ValueError) as error:
            what = "its metadata 'run' names no time 'started'"
            raise InputError(str(self.path), what) from error
        self._origin_ns = nanoseconds(started)

    def _read(self, topic: str, decode: Callable[[Any], T]) -> Iterator[At[T]]:
        try:
            for time_ns, message in self._messages(topic):
                yield At((time_ns - self._origin_ns) / 1e9, decode(message))
        except (*BREAKS, AttributeError) as error:
            raise InputError(str(self.path), f"{topic} cannot be read: {error}") from error

    def _messages(self, topic: str) -> Iterator[tuple[int, Any]]:
        """Log times (ns) and decoded messages: by the index, or from the start to the break."""
        decoders = [DecoderFactory()]
        with self.path.open("rb") as file:
            if self.whole:
                whole = make_reader(file, decoder_factories=decoders)
                for _, _, message, decoded in whole.iter_decoded_messages(topics=topic):
                    yield message.log_time, decoded
                return
            with contextlib.suppress(*BREAKS):
                part = NonSeekingReader(file, decoder_factories=decoders)
                for _, _, message, decoded in part.iter_decoded_messages(
                    topic, log_time_order=False
                ):
                    yield message.log_time, decoded


def _event_line(message: Any) -> EventLine:
    request = message.request if message.HasField("request") else None
    return EventLine(message.name, request, message.result, message.text)

"""A recorded mission, read back as the records it was made of."""

import contextlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any, Generic, NamedTuple, TypeVar

from mcap.reader import McapReader, NonSeekingReader, make_reader
from mcap.records import Attachment, Channel, Message, Metadata
from mcap_protobuf.decoder import DecoderFactory

from executive.errors import InputError
from executive.events import Event
from executive.records import LlmCall, Mishap, Tick, TreeShape, Utterance, Verified
from executive.types import Outcome
from logs import messages
from logs.event_messages import event_from_message
from logs.recovery import BREAKS, SoundRecords, damaged_at, is_whole
from logs.times import nanoseconds

FILE_NAME = "mission.mcap"

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class At(Generic[T]):
    """Something, and the mission time at which it was recorded (s)."""

    time_s: float
    value: T


@dataclass(frozen=True, slots=True)
class Turn:
    """One turn of the executive: the events that it took, and the tick that followed.

    There is no tick after a stop, and where the recording ends. `time_s` is mission time, exact.
    """

    time_s: float
    events: tuple[Event, ...]
    tick: Tick | None


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
        named = self.path.parent if self.path.name == FILE_NAME else self.path
        self.name = named.resolve().name
        """What to call it: its folder's name."""
        self.whole = is_whole(self.path)
        """Whether the recording was closed; False after a crash."""
        self.metadata: dict[str, str] = {}
        """Facts about the run: start, seed, versions, model."""
        self.attachments: dict[str, bytes] = {}
        """Files kept with it, by name: configuration, home, ontology."""
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

    def events(self) -> Iterator[At[Event]]:
        """Every event that the executive took; of what was seen, points without masks."""
        return self._read("/event", event_from_message)

    def turns(self) -> Iterator[Turn]:
        """Events and ticks as they belong together."""
        time_s, events = 0.0, list[Event]()
        decoders: dict[str, Callable[[Any], _Exact | Tick]] = {
            "/event": _exact_event,
            "/bt/tick": messages.tick_from_message,
        }
        for _, at in self._read_all(decoders):
            if isinstance(at.value, Tick):
                yield Turn(time_s, tuple(events), at.value)
                events.clear()
            else:
                time_s = at.value.time_s
                events.append(at.value.event)
        if events:
            yield Turn(time_s, tuple(events), None)

    def thoughts(self) -> Iterator[At[Tick | LlmCall | Verified]]:
        """Ticks, calls of the model and verifications, in the order in which they were."""
        decoders: dict[str, Callable[[Any], Tick | LlmCall | Verified]] = {
            "/bt/tick": messages.tick_from_message,
            "/llm/call": messages.llm_call_from_message,
            "/llm/verification": messages.verified_from_message,
        }
        return (at for _, at in self._read_all(decoders))

    def mishaps(self) -> Iterator[At[Mishap]]:
        """What went wrong in the simulated world, because it was told to."""
        return self._read("/mishap", messages.mishap_from_message)

    def frames(self) -> Iterator[At[bytes]]:
        """Every camera picture, as JPEG."""
        return self._read("/camera/image/compressed", lambda message: bytes(message.data))

    def outcome(self) -> Outcome | None:
        """How it ended, or None if the recording ends before the mission did."""
        outcomes = self._read("/outcome", messages.outcome_from_message)
        return next((at.value for at in outcomes), None)

    def last_time_s(self) -> float:
        """Mission time of the last message of all (s)."""
        last = self._origin_ns
        for record in SoundRecords(self.path):
            if isinstance(record, Message):
                last = max(last, record.log_time)
        return (last - self._origin_ns) / 1e9

    def _check(self) -> None:
        """Read the facts at the start of the file; refuse what is no mission."""
        records = SoundRecords(self.path)
        for record in records:
            if isinstance(record, Metadata) and record.name == "run":
                self.metadata = record.metadata
            elif isinstance(record, Attachment):
                self.attachments[record.name] = record.data
            elif isinstance(record, Channel) and record.topic == "/bt/tree":
                break
        else:
            damaged = records.damaged_at
            raise InputError(
                str(self.path),
                "records no mission: topic /bt/tree is missing"
                + (f" (nothing can be read from byte {damaged} on)" if damaged else ""),
                f"name a run's folder or its {FILE_NAME}",
            )
        try:
            started = datetime.fromisoformat(self.metadata["started"])
        except (KeyError, ValueError) as error:
            what = "its metadata 'run' names no time 'started'"
            raise InputError(str(self.path), what) from error
        self._origin_ns = nanoseconds(started)

    def _read(self, topic: str, decode: Callable[[Any], T]) -> Iterator[At[T]]:
        return (at for _, at in self._read_all({topic: decode}))

    def _read_all(self, decoders: dict[str, Callable[[Any], T]]) -> Iterator[tuple[str, At[T]]]:
        """What was recorded under these topics, in the order in which it was."""
        topic = ", ".join(decoders)
        try:
            for topic, time_ns, message in self._messages(tuple(decoders)):
                yield topic, At((time_ns - self._origin_ns) / 1e9, decoders[topic](message))
        except AttributeError as error:
            what = f"{topic} is not as this version records it: {error}"
            raise InputError(str(self.path), what) from error
        except BREAKS as error:
            where = damaged_at(self.path)
            what = f"{topic} cannot be read: " + (
                str(error) if where is None else f"the file is damaged at byte {where}"
            )
            right = f"`python -m logs recover {self.path}` saves the rest"
            raise InputError(str(self.path), what, right) from error

    def _messages(self, topics: tuple[str, ...]) -> Iterator[tuple[str, int, Any]]:
        """Topics, log times (ns), decoded messages: all, or from the start to the break."""
        factories = [DecoderFactory()]
        with self.path.open("rb") as file:
            reader: McapReader
            broken: contextlib.AbstractContextManager[None]
            if self.whole:
                reader, broken = make_reader(file, True, factories), contextlib.nullcontext()
            else:
                reader = NonSeekingReader(file, decoder_factories=factories)
                broken = contextlib.suppress(*BREAKS)
            with broken:
                for _, channel, message, decoded in reader.iter_decoded_messages(
                    topics, log_time_order=False
                ):
                    yield channel.topic, message.log_time, decoded


class _Exact(NamedTuple):
    time_s: float
    event: Event


def _exact_event(message: Any) -> _Exact:
    return _Exact(message.mission_time_s, event_from_message(message))

"""Reads a recorded mission back as records."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any, Generic, NamedTuple, TypeVar

from mcap.records import Attachment, Channel, McapRecord, Message, Metadata

from executive.errors import InputError
from executive.events import Event
from executive.records import (
    EventTaken,
    Finished,
    LlmCall,
    Mishap,
    Record,
    Tick,
    TreeShape,
    Utterance,
    Verified,
)
from executive.text import printable
from executive.toml_file import parse_toml
from executive.types.outcome import Outcome
from logs.recording.channels import decoder
from logs.recording.context import nanoseconds
from logs.recording.events import event_from_message
from logs.recording.mcap_file import Damage, is_whole, records
from logs.recording.parsing import MISFITS, Parsing, in_few_words
from logs.recording.sound import in_mission

FILE_NAME = "mission.mcap"

T = TypeVar("T")
R = TypeVar("R", bound=Record)


@dataclass(frozen=True, slots=True)
class At(Generic[T]):
    """A value, and the mission time at which it was recorded (s)."""

    time_s: float
    value: T


@dataclass(frozen=True, slots=True)
class Turn:
    """One cycle of the executive: the events taken, and the tick that followed.

    After a stop, and at the end of an incomplete recording, there is no tick. `time_s` is the
    mission time at which the last event was taken (s), not rounded.
    """

    time_s: float
    events: tuple[Event, ...]
    tick: Tick | None


class Run:
    """The recording of one mission; an incomplete file is read as far as possible."""

    def __init__(self, folder: Path) -> None:
        """Open `mission.mcap` in a run's folder, or an mcap file.

        Raises:
            InputError: if there is none, or it does not contain a mission.
        """
        self.path = mcap_of(folder)
        named = self.path.parent if self.path.name == FILE_NAME else self.path
        self.name = named.resolve().name
        """The name of its folder; of the file itself, if this is not called `mission.mcap`."""
        self.whole = is_whole(self.path)
        """Whether the recording was closed; False after a crash."""
        self.metadata: dict[str, str] = {}
        """Facts about the run: start, seed, versions, model."""
        self.attachments: dict[str, bytes] = {}
        """Attached files by name: configuration, home, ontology. The names contain no paths."""
        self._tree: TreeShape | None = None
        self._outcome: Outcome | None = None
        self._check()

    def config(self) -> dict[str, Any]:
        """The recorded settings; empty if there are none.

        Raises:
            InputError: if they are not TOML, or have values that are not allowed.
        """
        content = self.attachments.get("config.toml", b"")
        return parse_toml(content, f"{self.path}: its config.toml")

    def records(self, *kinds: type[R]) -> Iterator[At[R]]:
        """All records of these kinds, in the order in which they were recorded.

        Raises:
            InputError: if something cannot be read.
            LookupError: if a kind is recorded for display only.
        """
        return self._read(dict(map(decoder, kinds)))

    def tree(self) -> TreeShape:
        """The shape of the tree; empty if the mission ended before it was recorded."""
        if self._tree is None:
            shapes = self.records(TreeShape)
            self._tree = next((at.value for at in shapes), TreeShape(()))
        return self._tree

    def ticks(self) -> Iterator[At[Tick]]:
        """All ticks, with the states of all behaviours."""
        return self.records(Tick)

    def llm_calls(self) -> Iterator[At[LlmCall]]:
        """All calls of the language model."""
        return self.records(LlmCall)

    def verifications(self) -> Iterator[At[Verified]]:
        """The results of the verification of each reply."""
        return self.records(Verified)

    def dialog(self) -> Iterator[At[Utterance]]:
        """All utterances."""
        return self.records(Utterance)

    def events(self) -> Iterator[At[Event]]:
        """All events that the executive took; detections have points but no masks."""
        return (At(at.time_s, at.value.event) for at in self.records(EventTaken))

    def turns(self) -> Iterator[Turn]:
        """The events and the tick of each cycle."""
        time_s, events = 0.0, list[Event]()
        (event_topic, _), (tick_topic, tick) = decoder(EventTaken), decoder(Tick)
        decoders: dict[str, Callable[[Any], _Exact | Tick]]
        decoders = {event_topic: _exact_event, tick_topic: tick}
        for at in self._read(decoders):
            if isinstance(at.value, Tick):
                yield Turn(time_s, tuple(events), at.value)
                events.clear()
            else:
                time_s = at.value.time_s
                events.append(at.value.event)
        if events:
            yield Turn(time_s, tuple(events), None)

    def thoughts(self) -> Iterator[At[Tick | LlmCall | Verified]]:
        """Ticks, calls of the model and verifications, in order."""
        return self.records(Tick, LlmCall, Verified)

    def mishaps(self) -> Iterator[At[Mishap]]:
        """Faults that were injected into the simulated world."""
        return self.records(Mishap)

    def frames(self) -> Iterator[At[bytes]]:
        """All camera pictures, as JPEG."""
        topic = "/camera/image/compressed"
        return self._read({topic: lambda message: bytes(message.data)})

    def outcome(self) -> Outcome | None:
        """The outcome; None if the recording ends before the mission did."""
        if self._outcome is None:
            self._outcome = next((at.value.outcome for at in self.records(Finished)), None)
        return self._outcome

    def last_time_s(self) -> float:
        """The latest mission time of all messages (s), at least 0."""
        last = self._origin_ns
        for _, record in self._raw("its end"):
            if isinstance(record, Message):
                last = max(last, record.log_time)
        return (last - self._origin_ns) / 1e9

    def _check(self) -> None:
        """Read the facts at the start of the file; raise if it is not a mission."""
        for _, record in self._raw("its start"):
            if isinstance(record, Metadata) and record.name == "run":
                self.metadata = record.metadata
            elif isinstance(record, Attachment) and _is_plain(record.name):
                self.attachments.setdefault(record.name, record.data)
            elif isinstance(record, Channel) and record.topic == "/bt/tree":
                break
        else:
            raise InputError(
                str(self.path),
                "records no mission: topic /bt/tree is missing"
                + ("" if self.whole else f" (it ends early, at byte {self.path.stat().st_size})"),
                f"name a run's folder or its {FILE_NAME}",
            )
        try:
            self._origin_ns = nanoseconds(datetime.fromisoformat(self.metadata["started"]))
        except (KeyError, ValueError, OverflowError) as error:
            what = "its metadata 'run' names no time 'started'"
            raise InputError(str(self.path), what) from error

    def _read(self, decoders: Mapping[str, Callable[[Any], T]]) -> Iterator[At[T]]:
        """The records on these topics, in order."""
        parsing = Parsing(tuple(decoders), self._origin_ns)
        for offset, record in self._raw(", ".join(decoders)):
            try:
                if (found := parsing.take(record)) is None:
                    continue
                topic, time_s, message = found
                value = decoders[topic](message)
                if isinstance(value, Tick):
                    self._check_tick(value)
            except MISFITS as error:
                raise self._damaged(parsing.topic, in_few_words(error), offset) from error
            yield At(time_s, value)

    def _check_tick(self, tick: Tick) -> None:
        """Check that it has the state of every behaviour."""
        told = {node.path for node in tick.nodes}
        if missing := next((n.path for n in self.tree().nodes if n.path not in told), None):
            raise ValueError(f"a tick that does not tell how {missing!r} is")

    def _raw(self, wanted: str) -> Iterator[tuple[int, McapRecord]]:
        """All records; for a file that was not closed, those up to where it breaks off.

        Raises:
            InputError: if something cannot be read.
        """
        for offset, found in records(self.path):
            if not isinstance(found, Damage):
                yield offset, found
            elif self.whole or not found.cut:
                right = f"`python -m logs recover {self.path}` saves the rest"
                raise self._damaged(wanted, found.what, offset, right)

    def _damaged(self, wanted: str, why: str, offset: int, right: str = "") -> InputError:
        what = f"{wanted} cannot be read: {why}: the file is damaged at byte {offset}"
        return InputError(str(self.path), what, right)


def mcap_of(folder: Path) -> Path:
    """The recording in a run's folder, or the file itself.

    Raises:
        InputError: if there is none.
    """
    file = folder / FILE_NAME if folder.is_dir() else folder
    if not file.is_file():
        raise InputError(str(folder), f"holds no {FILE_NAME}", "name a run's folder")
    return file


class _Exact(NamedTuple):
    time_s: float
    event: Event


def _exact_event(message: Any) -> _Exact:
    return _Exact(in_mission(message.mission_time_s), event_from_message(message).event)


def _is_plain(name: str) -> bool:
    """Whether an attachment's name is that of a file: no folder, printable, at most 255 bytes."""
    plain = name == Path(name).name and name not in ("", ".", "..") and printable(name) == name
    return plain and len(name.encode()) <= 255

"""Selects the messages on some topics of a file, and parses them with the file's definitions."""

from typing import Any

from google.protobuf.message import DecodeError
from google.protobuf.message import Message as ProtobufMessage
from mcap.records import Channel, McapRecord, Message, Schema
from pydantic import ValidationError

from logs.recording.channels import TOPICS, is_own, most_in
from logs.recording.mcap_file import MiB
from logs.recording.older import recorded_class
from logs.recording.sound import in_mission

MOST_READ = 1024 * MiB
"""Memory limit (bytes) for the messages of our own in one pass, by a generous estimate."""
MISFITS = (
    DecodeError,
    ValueError,
    TypeError,
    LookupError,
    AttributeError,
    ArithmeticError,
    RecursionError,
)
"""Exceptions from converting a message to a record if it has another form than ours."""
_WHY_LENGTH = 200


class Parsing:
    """Selects the messages on some topics, and parses them with their recorded definitions."""

    def __init__(self, topics: tuple[str, ...], origin_ns: int) -> None:
        """`topics` are wanted; mission time 0 is `origin_ns` after 1970 (ns)."""
        self.topic = topics[0]
        """The topic of the last wanted message; at first, the first of the wanted topics."""
        self._topics = topics
        self._origin_ns = origin_ns
        self._room = MOST_READ
        self._schemas: dict[int, Schema] = {}
        self._channels: dict[int, Channel] = {}

    def take(self, record: McapRecord) -> tuple[str, float, Any] | None:
        """Topic, mission time (s) and message of a record; None if it is not a wanted message.

        Raises:
            Exception: one of `MISFITS`, if the message has another form than ours, or is too large.
        """
        match record:
            case Schema():
                self._schemas.setdefault(record.id, record)
            case Channel():
                self._channels.setdefault(record.id, record)
            case Message():
                channel = self._channels.get(record.channel_id)
                if channel is None:
                    raise ValueError(f"a message of channel {record.channel_id}, which is not told")
                if channel.topic in self._topics:
                    return self._parsed(channel, record)
        return None

    def _parsed(self, channel: Channel, message: Message) -> tuple[str, float, Any]:
        self.topic = channel.topic
        time_s = in_mission((message.log_time - self._origin_ns) / 1e9)
        if len(message.data) > most_in(channel.topic):
            raise ValueError(f"a message of {len(message.data)} bytes is more than is read")
        parsed = self._class(channel).FromString(message.data)
        if is_own(channel.topic):
            self._room -= _estimate(message.data, parsed)
            if self._room < 0:
                raise ValueError("all messages up to here are more than is read")
        return channel.topic, time_s, parsed

    def _class(self, channel: Channel) -> Any:
        """The message class of the topic, with the field numbers in the file."""
        kind = TOPICS[channel.topic]
        name = kind.DESCRIPTOR.full_name
        schema = self._schemas.get(channel.schema_id)
        if schema is None or schema.name != name or channel.message_encoding != "protobuf":
            raise ValueError(f"its messages should be {name}")
        if not is_own(channel.topic):
            return kind
        return recorded_class(kind.DESCRIPTOR.name, schema.data)


def _estimate(data: bytes, parsed: Any) -> int:
    """Estimated memory of a message as a record (bytes): its text, its parts, and JSON in it."""
    values = data.count(b",") + data.count(b"[") + data.count(b"{")
    return 256 * (1 + _parts(parsed)) + 2 * len(data) + 100 * values


def _parts(message: Any) -> int:
    """The number of items in its lists, and in those of its parts that are in no list."""
    return sum(
        _parts(value) if isinstance(value, ProtobufMessage) else len(value)
        for _, value in message.ListFields()
        if not isinstance(value, str | bytes | int | float)
    )


def in_few_words(error: Exception) -> str:
    """What is wrong, in a few words."""
    if isinstance(error, ValidationError):
        fault = error.errors(include_url=False, include_input=False)[0]
        return f"{'.'.join(map(str, fault['loc']))}: {fault['msg']}"
    if isinstance(error, RecursionError):
        return "it is nested too deeply"
    return f"{error}"[:_WHY_LENGTH]

"""The rosbridge protocol, version 2: what can be said over the wire, as frozen values.

Both sides use it: our client, and the simulated robot that is served. `encode` makes a packet of an
operation, `decode` an operation of a packet. Fields that others may add are passed over; one that
is missing or of another kind is a `PacketError` and has no effect.

A packet in a picture (`png`) is read as what it holds.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field, fields
from enum import IntEnum, StrEnum
from typing import Annotated, Any, ClassVar

from pydantic import (
    Field,
    StrictBool,
    StrictFloat,
    StrictInt,
    StrictStr,
    TypeAdapter,
    ValidationError,
)

from executive.ros.fragments import Part, split
from executive.ros.packets import FEW, Packet, PacketError, from_packet, to_cbor, to_json
from executive.ros.png import from_png, to_png

PNG = "png"
"""Operation of a packet that is a picture in which there is another one."""
MOST_NAME = 1000
"""Characters of a name or an id."""

Message = dict[str, Any]
"""A ROS message: its fields by their names."""
Name = Annotated[StrictStr, Field(min_length=1, max_length=MOST_NAME)]
Text = Annotated[StrictStr, Field(max_length=MOST_NAME)]
Count = Annotated[StrictInt, Field(ge=0, lt=2**53)]


class Compression(StrEnum):
    """How a subscriber wants messages packed."""

    NONE = "none"
    PNG = "png"
    CBOR = "cbor"
    CBOR_RAW = "cbor-raw"
    """CBOR, in which the message is as ROS 2 itself packs it."""


class GoalStatus(IntEnum):
    """How a goal stands: `action_msgs/msg/GoalStatus`."""

    UNKNOWN = 0
    ACCEPTED = 1
    EXECUTING = 2
    CANCELING = 3
    SUCCEEDED = 4
    CANCELED = 5
    ABORTED = 6


@dataclass(frozen=True, slots=True)
class Advertise:
    """I shall publish this topic."""

    op: ClassVar[str] = "advertise"
    topic: Name
    type: Name
    id: Text = ""


@dataclass(frozen=True, slots=True)
class Unadvertise:
    """I shall not publish it any more."""

    op: ClassVar[str] = "unadvertise"
    topic: Name
    id: Text = ""


@dataclass(frozen=True, slots=True, eq=False)
class Publish:
    """A message of a topic, either way."""

    op: ClassVar[str] = "publish"
    topic: Name
    msg: Message
    id: Text = ""


@dataclass(frozen=True, slots=True)
class Subscribe:
    """Send me what is published.

    Attributes:
        topic: which.
        type: of its messages; empty: whatever it has.
        throttle_rate: at most one message in so many milliseconds.
        queue_length: how many are kept while they are held back.
        fragment_size: longest text in one piece (characters); None: any.
        compression: `Compression`, or what only others speak.
        id: names this subscription, for `Unsubscribe`.
    """

    op: ClassVar[str] = "subscribe"
    topic: Name
    type: Text = ""
    throttle_rate: Count = 0
    queue_length: Count = 0
    fragment_size: Annotated[StrictInt, Field(ge=1, lt=2**53)] | None = None
    compression: Text = "none"
    id: Text = ""


@dataclass(frozen=True, slots=True)
class Unsubscribe:
    """Send me no more of it; without an id: of any of my subscriptions to it."""

    op: ClassVar[str] = "unsubscribe"
    topic: Name
    id: Text = ""


@dataclass(frozen=True, slots=True, eq=False)
class CallService:
    """Call a service; `args` is its request, or the values of its fields in their order."""

    op: ClassVar[str] = "call_service"
    service: Name
    args: Message | list[Any] = field(default_factory=dict)
    id: Text = ""
    type: Text = ""
    fragment_size: Annotated[StrictInt, Field(ge=1, lt=2**53)] | None = None
    compression: Text = "none"
    timeout: Annotated[StrictFloat, Field(ge=0)] | None = None


@dataclass(frozen=True, slots=True, eq=False)
class ServiceResponse:
    """What a service answered; without `result` it failed, and `values` may say why."""

    op: ClassVar[str] = "service_response"
    service: Name
    result: StrictBool
    values: Any = field(default_factory=dict)
    id: Text = ""


@dataclass(frozen=True, slots=True, eq=False)
class SendActionGoal:
    """Pursue a goal; `args` is the goal."""

    op: ClassVar[str] = "send_action_goal"
    action: Name
    action_type: Name
    args: Message | list[Any] = field(default_factory=dict)
    feedback: StrictBool = False
    id: Text = ""
    fragment_size: Annotated[StrictInt, Field(ge=1, lt=2**53)] | None = None
    compression: Text = "none"


@dataclass(frozen=True, slots=True)
class CancelActionGoal:
    """Give up the goal with this id."""

    op: ClassVar[str] = "cancel_action_goal"
    action: Name
    id: Text = ""


@dataclass(frozen=True, slots=True, eq=False)
class ActionFeedback:
    """How a goal gets on."""

    op: ClassVar[str] = "action_feedback"
    action: Name
    values: Message = field(default_factory=dict)
    id: Text = ""


@dataclass(frozen=True, slots=True, eq=False)
class ActionResult:
    """How a goal ended: `status` is a `GoalStatus`; without `result`, `values` may say why."""

    op: ClassVar[str] = "action_result"
    action: Name
    result: StrictBool
    status: Annotated[StrictInt, Field(ge=-128, le=127)] = GoalStatus.UNKNOWN
    values: Any = field(default_factory=dict)
    id: Text = ""


@dataclass(frozen=True, slots=True)
class Status:
    """The other side has something to say: `level` is error, warning, info or none."""

    op: ClassVar[str] = "status"
    level: Name
    msg: StrictStr
    id: Text = ""


@dataclass(frozen=True, slots=True)
class SetLevel:
    """From which level on I want to be told a `Status`."""

    op: ClassVar[str] = "set_level"
    level: Name
    id: Text = ""


@dataclass(frozen=True, slots=True)
class Fragment:
    """A part of a message that was too long for one piece."""

    op: ClassVar[str] = "fragment"
    id: Name
    data: StrictStr
    num: Count
    total: Count

    @property
    def part(self) -> Part:
        """What `executive.ros.fragments` puts together."""
        return Part(self.id, self.data, self.num, self.total)


Operation = (
    Advertise
    | Unadvertise
    | Publish
    | Subscribe
    | Unsubscribe
    | CallService
    | ServiceResponse
    | SendActionGoal
    | CancelActionGoal
    | ActionFeedback
    | ActionResult
    | Status
    | SetLevel
    | Fragment
)
OPERATIONS: tuple[type[Operation], ...] = Operation.__args__


_READERS: dict[str, TypeAdapter[Operation]] = {k.op: TypeAdapter(k) for k in OPERATIONS}


def encode(operation: Operation, compression: str = Compression.NONE) -> Packet:
    """The packet of an operation: bytes if CBOR is wanted, else text."""
    data: dict[str, Any] = {"op": operation.op}
    for one in fields(operation):
        value = getattr(operation, one.name)
        if value is not None and (value != "" or one.name in ("data", "msg")):
            data[one.name] = value
    match compression:
        case Compression.CBOR | Compression.CBOR_RAW:
            return to_cbor(data)
        case Compression.PNG:
            return to_json({"op": PNG, "data": to_png(to_json(data))})
        case _:
            return to_json(data)


def decode(packet: Packet) -> Operation:
    """The operation that a packet holds.

    Raises:
        PacketError: if it cannot be read, or is no operation that is spoken here.
    """
    read = from_packet(packet)
    if read.get("op") == PNG:
        read = from_packet(from_png(read.get("data")))
    data = {key: value for key, value in read.items() if value is not None}
    op = data.pop("op", None)
    reader = _READERS.get(op) if isinstance(op, str) else None
    if reader is None:
        raise PacketError(f"an operation that I do not know: {str(op)[:FEW]}")
    try:
        return reader.validate_python(data)
    except ValidationError as error:
        fault = error.errors(include_url=False, include_input=False)[0]
        where = ".".join(str(part) for part in fault["loc"])[:FEW]
        raise PacketError(f"{op} with {where} wrong: {fault['msg'].lower()[:FEW]}") from None


def encode_in_parts(
    operation: Operation, id: str, fragment_size: int | None = None
) -> Iterator[Packet]:
    """An operation as text for one who wants it in pieces of this size; `id` names the whole."""
    packet = encode(operation)
    if fragment_size is None or len(packet) <= fragment_size:
        return iter((packet,))
    parts = split(str(packet), fragment_size, id)
    return (encode(Fragment(p.id, p.data, p.num, p.total)) for p in parts)

"""One websocket message as plain data: JSON in text, CBOR in bytes.

Numbers that belong together are arrays: CBOR packs them with the tags of RFC 8746 (64 and up),
which rosbridge uses, and `uint8[]` as a byte string; JSON has lists, and `uint8[]` in base64.

What comes from outside is bounded: so many bytes, nested so deep, plain values only. Anything else
is a `PacketError` and has no effect.
"""

import base64
import binascii
import json
import math
from collections.abc import Mapping
from typing import Any

import cbor2
import numpy as np
from numpy.typing import NDArray

from executive.errors import ExecutiveError

MOST_BYTES = 2**25
"""A colour picture of 3840 x 2160 pixels, and some."""
DEEPEST = 32
"""Tables and lists within one another."""
FEW = 100
"""So many characters of what is wrong are told."""

Packet = str | bytes

_FORMATS = {
    **dict(zip(range(64, 68), ("u1", ">u2", ">u4", ">u8"), strict=True)),
    **dict(zip(range(68, 72), ("u1", "<u2", "<u4", "<u8"), strict=True)),
    **dict(zip(range(72, 76), ("i1", ">i2", ">i4", ">i8"), strict=True)),
    **dict(zip(range(77, 80), ("<i2", "<i4", "<i8"), strict=True)),
    **dict(zip(range(80, 83), (">f2", ">f4", ">f8"), strict=True)),
    **dict(zip(range(84, 87), ("<f2", "<f4", "<f8"), strict=True)),
}
"""Tag of RFC 8746: what is in the bytes, in numpy's words."""
_TAGS = {np.dtype(kind).str: tag for tag, kind in _FORMATS.items() if tag != 68}
_OTHER_TAGS = (*range(64), 100, 256, 258, 260, 261, 1004, 43000, 55799)
"""Tags of which a general decoder would make dates, patterns, large numbers or references."""


class PacketError(ExecutiveError):
    """What came over the wire cannot be read, and why, as a clause."""


# --- as they go out ---


def to_json(data: Mapping[str, Any]) -> str:
    """The data as text."""
    return json.dumps(_for_json(data), allow_nan=False, separators=(",", ":"))


def to_cbor(data: Mapping[str, Any]) -> bytes:
    """The data as bytes."""
    return cbor2.dumps(_for_cbor(data))


def _for_json(value: Any) -> Any:
    match value:
        case Mapping():
            return {key: _for_json(one) for key, one in value.items()}
        case bytes():
            return base64.b64encode(value).decode("ascii")
        case np.ndarray() if value.dtype == np.uint8:
            return base64.b64encode(value.tobytes()).decode("ascii")
        case np.ndarray():
            return _for_json(value.ravel().tolist())
        case np.generic():
            return _for_json(value.item())
        case list() | tuple():
            return [_for_json(one) for one in value]
        case float() if not math.isfinite(value):
            return None  # JSON has no word for it; rosbridge says null, too
        case _:
            return value


def _for_cbor(value: Any) -> Any:
    match value:
        case Mapping():
            return {key: _for_cbor(one) for key, one in value.items()}
        case np.ndarray() if value.dtype == np.uint8:
            return value.tobytes()
        case np.ndarray() if tag := _TAGS.get(value.dtype.newbyteorder("<").str):
            return cbor2.CBORTag(tag, value.astype(value.dtype.newbyteorder("<")).tobytes())
        case np.ndarray():
            return value.ravel().tolist()
        case np.generic():
            return value.item()
        case list() | tuple():
            return [_for_cbor(one) for one in value]
        case _:
            return value


# --- as they come in ---


def from_packet(packet: Packet) -> dict[str, Any]:
    """What a packet says: text is JSON, bytes are CBOR.

    Numbers that a sender packed are arrays, on which nothing may be written.

    Raises:
        PacketError: if it is too large or too deep, or no table of plain values.
    """
    if len(packet) > MOST_BYTES:
        raise PacketError(f"a message of {len(packet):,} bytes, I read at most {MOST_BYTES:,}")
    data = _from_json(packet) if isinstance(packet, str) else _from_cbor(packet)
    if not isinstance(data, dict):
        raise PacketError(f"a message that is no table but {_shown(data)}")
    _check(data)
    return data


def _from_json(text: str) -> Any:
    try:
        return json.loads(text, parse_constant=lambda _: None)
    except RecursionError:
        raise _too_deep() from None
    except ValueError as error:  # also a number of thousands of digits
        raise PacketError(f"a message that is not JSON: {str(error)[:FEW]}") from None


def _from_cbor(content: bytes) -> Any:
    try:
        return cbor2.loads(
            content,
            tag_hook=lambda tag, _: _array(tag.tag, tag.value),
            semantic_decoders=dict.fromkeys(_OTHER_TAGS, _refuse),
            max_depth=DEEPEST,
            strict_hashable_types=True,
        )
    except PacketError:
        raise
    except Exception as error:  # the decoder passes on whatever a value makes it raise
        cause = error.__cause__
        if isinstance(cause, PacketError):
            raise cause from None
        raise PacketError(f"a message that is not CBOR: {str(error)[:FEW]}") from None


def _array(tag: int, content: Any) -> NDArray[Any]:
    kind = _FORMATS.get(tag)
    if kind is None or not isinstance(content, bytes):
        raise PacketError(f"a message with CBOR's tag {tag}, which is no packed array")
    if len(content) % np.dtype(kind).itemsize:
        raise PacketError(f"{len(content)} bytes that are no array of {np.dtype(kind).name}")
    return np.frombuffer(content, kind)


def _refuse(value: Any, immutable: bool) -> Any:
    raise PacketError("a message with a CBOR tag that is no packed array")


def _check(data: dict[str, Any]) -> None:
    """Refuse what is no plain value; without recursion, as it may be nested at will."""
    left: list[tuple[Any, int]] = [(data, 0)]
    while left:
        value, depth = left.pop()
        if depth > DEEPEST:
            raise _too_deep()
        match value:
            case dict():
                if not all(isinstance(key, str) for key in value):
                    raise PacketError("a message with a key that is no text")
                left += [(one, depth + 1) for one in value.values()]
            case list():
                left += [(one, depth + 1) for one in value]
            case None | bool() | float() | str() | bytes() | np.ndarray():
                pass
            case int() if -(2**63) <= value < 2**64:
                pass
            case _:
                raise PacketError(f"a message with {_shown(value)} in it")


def _too_deep() -> PacketError:
    return PacketError(f"a message nested deeper than {DEEPEST} tables and lists")


def _shown(value: object) -> str:
    return f"a {type(value).__name__}"


# --- values of messages ---


def octets(value: Any) -> bytes:
    """The content of a `uint8[]`, in whichever way it came.

    Raises:
        PacketError: if it is none.
    """
    match value:
        case bytes():
            return value
        case str():
            try:
                return base64.b64decode(value, validate=True)
            except (binascii.Error, ValueError):
                raise PacketError("a uint8[] that is not base64") from None
        case np.ndarray() if value.dtype.itemsize == 1:
            return value.tobytes()
        case list() if all(type(one) is int and 0 <= one < 256 for one in value):
            return bytes(value)
        case _:
            raise PacketError(f"a uint8[] that is {_shown(value)}")


def numbers(value: Any) -> tuple[float, ...]:
    """The content of an array of numbers, in whichever way it came; null is not a number.

    Raises:
        PacketError: if it is none.
    """
    if isinstance(value, np.ndarray):
        return tuple(float(one) for one in value)
    if not isinstance(value, list):
        raise PacketError(f"an array of numbers that is {_shown(value)}")
    if not all(one is None or type(one) in (int, float) for one in value):
        raise PacketError("an array of numbers with something else in it")
    return tuple(math.nan if one is None else float(one) for one in value)

"""Messages as ROS 2 itself packs them (CDR, version 1, the least significant byte first)."""

import struct
from collections.abc import Sequence
from typing import Any

import numpy as np

from executive.ros.definitions import VARIABLE, Field, fields_of
from executive.ros.packets import PacketError
from executive.ros.protocol import Message

_HEADER = b"\x00\x01\x00\x00"
_FORMATS = {
    "boolean": "?",
    "uint8": "B",
    "int16": "h",
    "int32": "i",
    "uint32": "I",
    "float": "f",
    "double": "d",
}


def to_cdr(message: Message, kind: str) -> bytes:
    """The message as bytes; fields that it lacks are zero.

    Raises:
        PacketError: if what it consists of is not known here.
    """
    packed = bytearray()
    _put(packed, message, kind)
    return _HEADER + packed


def _put(packed: bytearray, message: Message, kind: str) -> None:
    fields = fields_of(kind)
    if fields is None:
        raise PacketError(f"messages of {kind} cannot be had as cbor-raw")
    for field in fields:
        _put_field(packed, field, message.get(field.name))


def _put_field(packed: bytearray, field: Field, value: Any) -> None:
    if field.length is None:
        _put_one(packed, field.kind, value)
        return
    values = () if value is None else value
    if field.length == VARIABLE:
        _put_one(packed, "uint32", len(values))
    elif not len(values):
        values = [0] * field.length
    if field.kind in _FORMATS:
        _put_numbers(packed, _FORMATS[field.kind], values)
    else:
        for one in values:
            _put_one(packed, field.kind, one)


def _put_numbers(packed: bytearray, code: str, values: Sequence[Any] | bytes) -> None:
    if not len(values):
        return
    _align(packed, struct.calcsize(code))
    if isinstance(values, bytes):
        packed += values
    else:
        packed += np.asarray(values, f"<{code}").tobytes()


def _put_one(packed: bytearray, kind: str, value: Any) -> None:
    if kind == "string":
        content = str(value or "").encode() + b"\0"
        _put_one(packed, "uint32", len(content))
        packed += content
    elif code := _FORMATS.get(kind):
        _align(packed, struct.calcsize(code))
        packed += struct.pack(f"<{code}", value or 0)
    else:
        _put(packed, value or {}, kind)


def _align(packed: bytearray, size: int) -> None:
    packed += bytes(-len(packed) % size)

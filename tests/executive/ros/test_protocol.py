"""What can be said over the wire comes out as it went in; what cannot be read has no effect."""

import base64
import io
import json
import math
import struct
from contextlib import suppress
from dataclasses import fields
from typing import Any

import cbor2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from executive.ros.cdr import to_cdr
from executive.ros.definitions import typedefs
from executive.ros.fragments import Joiner, Part, split
from executive.ros.packets import MOST_BYTES, PacketError, from_packet, numbers, octets
from executive.ros.png import to_png
from executive.ros.protocol import (
    OPERATIONS,
    ActionResult,
    CallService,
    Fragment,
    Operation,
    Publish,
    Status,
    Subscribe,
    decode,
    encode,
    encode_in_parts,
)
from sim.served.offered import GRAPH

NAMES = st.text(min_size=1, max_size=30)
NUMBERS = st.integers(-(2**63), 2**63 - 1) | st.floats(allow_nan=False, allow_infinity=False)
VALUES: st.SearchStrategy[Any] = st.recursive(
    st.booleans() | NUMBERS | st.text(max_size=20),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(NAMES, inner, max_size=4),
    max_leaves=10,
)
MESSAGES = st.dictionaries(NAMES, VALUES, max_size=4)
COUNTS = st.integers(0, 2**53 - 1)
BY_NAME: dict[str, st.SearchStrategy[Any]] = {
    "msg": MESSAGES,
    "args": MESSAGES,
    "values": MESSAGES,
    "data": st.text(max_size=50),
    "compression": st.sampled_from(("none", "cbor", "png")),
    "throttle_rate": COUNTS,
    "queue_length": COUNTS,
    "num": COUNTS,
    "total": COUNTS,
    "fragment_size": st.none() | st.integers(1, 2**53 - 1),
    "timeout": st.none() | st.floats(0, 1e9),
    "status": st.integers(0, 6),
    "result": st.booleans(),
    "feedback": st.booleans(),
}


def made(kind: type[Operation]) -> st.SearchStrategy[Operation]:
    given_names = {one.name: BY_NAME.get(one.name, NAMES) for one in fields(kind)}
    if kind.__name__ == "Status":
        given_names["msg"] = st.text(max_size=20)
    return st.builds(kind, **given_names)


ANY = st.one_of([made(kind) for kind in OPERATIONS])


def said(operation: Operation) -> dict[str, Any]:
    return {one.name: getattr(operation, one.name) for one in fields(operation)}


@given(ANY, st.sampled_from(("none", "cbor", "png")))
def test_an_operation_comes_out_as_it_went_in(operation: Operation, compression: str) -> None:
    other = decode(encode(operation, compression))
    assert type(other) is type(operation)
    assert said(other) == said(operation)


@given(st.binary(max_size=200) | st.text(max_size=200))
def test_whatever_comes_is_an_operation_or_a_clear_error(packet: str | bytes) -> None:
    with suppress(PacketError):
        decode(packet)


@given(ANY, st.integers(0, 10_000), st.integers(0, 255))
def test_a_damaged_packet_is_an_operation_or_a_clear_error(
    operation: Operation, at: int, byte: int
) -> None:
    packet = bytearray(encode(operation, "cbor"))
    packet[at % len(packet)] = byte
    with suppress(PacketError):
        decode(bytes(packet))


@given(VALUES)
def test_fields_that_others_add_are_passed_over(value: object) -> None:
    packet = encode(Publish("/odom", {"new": value}))
    assert isinstance(packet, str)
    extended = packet[:-1] + ',"latch":true}'
    assert said(decode(extended)) == said(Publish("/odom", {"new": value}))


@pytest.mark.parametrize(
    "packet",
    [
        "{}",
        "[]",
        '{"op": "dance"}',
        '{"op": "publish", "topic": "", "msg": {}}',
        '{"op": "publish", "topic": "/odom"}',
        '{"op": "publish", "topic": "/odom", "msg": []}',
        '{"op": "subscribe", "topic": "/odom", "throttle_rate": -1}',
        '{"op": "action_result", "action": "/pick", "result": "true"}',
        "[" * 100_000,
        '{"op": "publish", "topic": "/a", "msg": ' + '{"a":' * 40 + "1" + "}" * 41,
        '{"op": "publish", "topic": "/a", "msg": {"a": ' + "9" * 5000 + "}}",
        cbor2.dumps({"op": "publish", "topic": "/a", "msg": {"a": cbor2.CBORTag(35, "(a+)+")}}),
        cbor2.dumps({"op": "publish", "topic": "/a", "msg": {"a": cbor2.CBORTag(85, b"123")}}),
        cbor2.dumps({"op": "publish", "topic": "/a", "msg": {"a": cbor2.CBORTag(2, b"1" * 99)}}),
        cbor2.dumps({"op": "publish", "topic": "/a", "msg": {1: 2}}),
        b"\x9f" * 1000,
    ],
)
def test_what_is_wrong_is_told_and_nothing_else(packet: str | bytes) -> None:
    with pytest.raises(PacketError):
        decode(packet)


def test_a_packet_that_is_too_large_is_not_even_read() -> None:
    with pytest.raises(PacketError, match="I read at most"):
        decode(" " * (MOST_BYTES + 1))


@pytest.mark.parametrize("kind", ["u2", "u4", "u8", "i1", "i2", "i4", "i8", "f2", "f4", "f8"])
@given(st.lists(st.integers(-100, 100), max_size=20))
def test_packed_arrays_keep_type_and_values(kind: str, values: list[int]) -> None:
    array = np.array(values).astype(kind)
    other = decode(encode(Publish("/scan", {"ranges": array}), "cbor"))
    assert isinstance(other, Publish)
    assert other.msg["ranges"].dtype == array.dtype
    assert np.array_equal(other.msg["ranges"], array)


@given(st.binary(max_size=100), st.sampled_from(("none", "cbor")))
def test_bytes_are_bytes_on_either_way(content: bytes, compression: str) -> None:
    sent = {"a": content, "b": np.frombuffer(content, np.uint8)}
    other = from_packet(encode(Publish("/image", sent), compression))["msg"]
    assert octets(other["a"]) == octets(other["b"]) == content


def test_numbers_may_come_as_a_list_an_array_or_not_at_all() -> None:
    assert numbers([1, 2.5]) == (1.0, 2.5) == numbers(np.array([1, 2.5]))
    assert math.isnan(numbers([None])[0])
    with pytest.raises(PacketError):
        numbers(["1"])


def test_what_is_no_number_is_null_in_json() -> None:
    packet = encode(Publish("/scan", {"range": math.inf, "ranges": np.array([math.nan])}))
    assert from_packet(packet)["msg"] == {"range": None, "ranges": [None]}


# --- parts ---


@given(ANY, st.integers(1, 40), st.randoms())
def test_parts_make_the_whole_in_whichever_order_they_come(
    operation: Operation, size: int, chance: Any
) -> None:
    packets = list(encode_in_parts(operation, "7", size))
    chance.shuffle(packets)
    if len(packets) == 1:
        assert said(decode(packets[0])) == said(operation)
        return
    joiner, whole = Joiner(), []
    for packet in packets:
        part = decode(packet)
        assert isinstance(part, Fragment)
        whole.append(joiner.add(part.part))
    assert whole[:-1] == [None] * (len(packets) - 1)
    assert said(decode(str(whole[-1]))) == said(operation)


def test_parts_that_do_not_belong_together_are_given_up() -> None:
    joiner = Joiner()
    joiner.add(Part("a", "x", 0, 2))
    with pytest.raises(PacketError):
        joiner.add(Part("a", "y", 0, 2))
    assert joiner.add(Part("a", "z", 1, 2)) is None


@pytest.mark.parametrize(("num", "total"), [(2, 2), (0, 0), (0, 10**9)])
def test_a_part_that_cannot_be_is_refused(num: int, total: int) -> None:
    with pytest.raises(PacketError):
        Joiner().add(Part("a", "x", num, total))


def test_what_never_gets_complete_does_not_pile_up() -> None:
    joiner = Joiner()
    for number in range(1000):
        joiner.add(Part(str(number), "x", 0, 2))
    assert joiner.add(Part("0", "y", 1, 2)) is None
    assert joiner.add(Part("999", "y", 1, 2)) == "xy"


def test_incomplete_messages_do_not_fill_the_memory() -> None:
    joiner = Joiner()
    joiner.add(Part("long", "x" * MOST_BYTES, 0, 2))
    with pytest.raises(PacketError, match="more than"):
        joiner.add(Part("longer", "x", 0, 2))


def test_every_text_splits_into_parts_of_that_size() -> None:
    assert [part.data for part in split("abcde", 2, "1")] == ["ab", "cd", "e"]
    assert [part.total for part in split("", 2, "1")] == [1]


def test_defaults_are_those_of_rosbridge() -> None:
    assert decode('{"op":"subscribe","topic":"/a","type":null}') == Subscribe("/a")
    call = decode('{"op":"call_service","service":"/rosapi/topics"}')
    assert isinstance(call, CallService)
    assert call.args == {}
    result = decode('{"op":"action_result","action":"/a","result":false,"values":"why"}')
    assert isinstance(result, ActionResult)
    assert result.values == "why"


def png(width: int, height: int, pixels: bytes = b"") -> str:
    out = io.BytesIO()
    Image.frombytes("RGB", (1, 1), b"{} ").save(out, "png")
    content = bytearray(out.getvalue())
    content[16:24] = struct.pack(">II", width, height)
    return json.dumps({"op": "png", "data": base64.b64encode(content).decode()})


@pytest.mark.parametrize(
    ("packet", "said"),
    [
        ('{"op": "png"}', "whose data is no text"),
        ('{"op": "png", "data": "%"}', "cannot be read"),
        ('{"op": "png", "data": "AAAA"}', "cannot be read"),
        (png(100_000, 100_000), "too long"),
        (png(2, 2), "cannot be read"),
        (encode(Status("info", "x"), "png").replace("png", "pong", 1), "operation"),
        (json.dumps({"op": "png", "data": to_png('{"op": "png", "data": ""}')}), "operation"),
    ],
)
def test_a_picture_that_holds_no_packet_is_a_clear_error(packet: str, said: str) -> None:
    with pytest.raises(PacketError, match=said):
        decode(packet)


def test_every_part_of_a_known_message_is_known() -> None:
    for kind in GRAPH.topics.values():
        told = {one["type"]: one for one in typedefs(kind)}
        parts = {name for one in told.values() for name in one["fieldtypes"] if "/" in name}
        assert parts < set(told), kind


def test_a_message_is_packed_as_ros_packs_it() -> None:
    stamp = {"stamp": {"sec": 1, "nanosec": 2}, "frame_id": "odom"}
    joints = {"header": stamp, "name": ["a"], "position": [0.5], "velocity": np.array([0.25])}
    assert to_cdr({"data": True}, "std_msgs/msg/Bool") == b"\x00\x01\x00\x00\x01"
    assert to_cdr(joints, "sensor_msgs/msg/JointState")[4:] == (
        struct.pack("<iI", 1, 2)
        + struct.pack("<I", 5)
        + b"odom\0\0\0\0"
        + struct.pack("<II", 1, 2)
        + b"a\0\0\0"
        + struct.pack("<I4xd", 1, 0.5)
        + struct.pack("<I4xd", 1, 0.25)
        + struct.pack("<I", 0)
    )
